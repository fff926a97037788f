#include "dovetail/files/concepts.hpp"
#include "dovetail/files/msh_reader.hpp"
#include "dovetail/files/read_mesh.hpp"
#include "dovetail/files/vtu_reader.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "dovetail/files/write_msh.hpp"
#include "dovetail/files/write_surface.hpp"
#include "dovetail/files/write_vtu.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/mesh/validity.hpp"
#include "dovetail/solver/rank_files.hpp"
#include "dovetail/solver/rank_msh_format.hpp"
#include "files/msh_kinds.hpp"
#include "files/scratch_folder.hpp"
#include "files/stacked_cubes.hpp"
#include "support/refusal.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

using namespace dovetail;
using testing::coarse_cubes_in_eight;

static_assert(mesh_reader<io::vtu_reader>);
static_assert(mesh_reader<io::msh_reader>);

namespace {

/// The error that reading a file with this content gives.
std::string refusal(const std::string& content, const std::string& name = "bad") {
  const testing::scratch_folder folder("refused");
  testing::write_content(folder / name, content);
  const auto says = testing::refusal_of<input_error>([&] { return io::read_mesh(folder / name); });
  CHECK(says.starts_with((folder / name).string()));
  return says;
}

void check_says(const std::string& message, const std::string& expected) {
  INFO(message);
  CHECK(message.find(expected) != std::string::npos);
}

std::string triangle_vtp(const std::string& corners, const std::string& offset,
                         const std::string& lines = "0") {
  return R"(<?xml version="1.0"?><VTKFile type="PolyData" version="1.0" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="4" NumberOfVerts="0" NumberOfLines=")" +
         lines + R"(" NumberOfStrips="0" NumberOfPolys="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 1 1 0</DataArray></Points>
<Polys><DataArray type="Int32" Name="connectivity" format="ascii">)" +
         corners + R"(</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">)" +
         offset + R"(</DataArray></Polys>
<CellData><DataArray type="Int32" Name="cad_face" format="ascii">7</DataArray></CellData>
</Piece></PolyData></VTKFile>)";
}

const std::string two_tetrahedra_msh2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
2 7 "wall"
3 9 "air \"x\""
$EndPhysicalNames
$Nodes
5
10 0 0 0
20 1 0 0
30 0 1 0
40 0 0 1
50 1 1 1
$EndNodes
$Elements
4
1 15 2 0 1 10
2 2 2 7 1 10 30 20
3 4 4 9 1 1 2 10 20 30 40
4 4 4 9 1 1 -1 20 30 40 50
$EndElements
$NodeData
1
"size"
1
0.0
3
0
1
5
50 5
40 4
30 3
20 2
10 1.5
$EndNodeData
)";

const std::string vtu_head = R"(<?xml version="1.0"?>
<!-- a comment -->
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="4" NumberOfCells="1"><Points>
)";
const std::string vtu_cells = R"(<Cells>
<DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray>
</Cells>)";
const std::string vtu_tail = "</Piece></UnstructuredGrid></VTKFile>\n";
const std::string ascii_points = R"(<DataArray type="Float32" NumberOfComponents="3" format="ascii">
0 0 0  1 0 0  0 1e0 0  0 0 +1.0</DataArray></Points>)";

} // namespace

TEST_CASE("a distributed mesh reads back from VTU with the same hash, for any number of files") {
  const auto mesh = coarse_cubes_in_eight.distributed();
  for (const int files : {0, 1, 3}) {
    const testing::scratch_folder folder("reread_vtu");
    io::vtu_writer{.files = files}(mesh, folder);
    const auto read = io::read_mesh(folder);
    CHECK(read.mesh.elements.size() == 6 * 6 * 6 * 6);
    CHECK(read.mesh.points.size() == 7 * 7 * 7);
    REQUIRE(read.subdomains.size() == read.mesh.elements.size());
    CHECK(std::count(read.subdomains.begin(), read.subdomains.end(), 7) == 6 * 27);
    CHECK(std::count(read.mesh.tags.begin(), read.mesh.tags.end(), 1) == 3 * 6 * 6 * 6);
    REQUIRE(read.material_names.size() == 2);
    CHECK(read.material_names[1].second == "solid \"1\" <&>");
    CHECK(io::mesh_hash(read) == io::mesh_hash(mesh));
  }
}

TEST_CASE("a distributed mesh reads back from MSH with the same hash, whole and partitioned") {
  const auto mesh = coarse_cubes_in_eight.distributed();
  for (const bool partitioned : {false, true})
    for (const bool binary : {false, true}) {
      const testing::scratch_folder folder("reread_msh");
      testing::write_kind_of_msh(mesh, folder, partitioned, true, binary);
      const auto read = io::read_mesh(folder);
      CHECK(io::mesh_hash(read) == io::mesh_hash(mesh));
      CHECK(std::count(read.mesh.tags.begin(), read.mesh.tags.end(), 1) == 3 * 6 * 6 * 6);
      CHECK(read.subdomains.size() == (partitioned ? read.mesh.elements.size() : 0));
      if (partitioned)
        CHECK(std::count(read.subdomains.begin(), read.subdomains.end(), 7) == 6 * 27);
      // With the material interface; those between subdomains of one material are left out.
      CHECK(read.triangles.size() == 7 * 2 * 36);
      REQUIRE(read.material_names.size() == 2);
      CHECK(read.material_names[0].first == 0);
      CHECK(read.material_names[0].second == "solid '0' <&>");
    }
}

TEST_CASE("a mesh in memory reads back from every format that it can be written to") {
  const testing::scratch_folder folder("plain");
  const auto mesh = coarse_cubes_in_eight.whole();
  std::vector<double> sizes;
  for (const auto& p : mesh.points)
    sizes.push_back(1 + p.x);
  io::write_vtu(mesh, folder / "a.vtu", {{"target <size>", sizes}}, {{0, "lower"}, {1, "upper"}});
  const auto vtu = io::read_mesh(folder / "a.vtu");
  CHECK(vtu.mesh.points == mesh.points);
  CHECK(vtu.mesh.elements == mesh.elements);
  CHECK(vtu.mesh.tags == mesh.tags);
  REQUIRE(vtu.scalars("target <size>") != nullptr);
  CHECK(*vtu.scalars("target <size>") == sizes);
  CHECK(vtu.scalars("other") == nullptr);
  CHECK(vtu.material_names == io::tag_names{{0, "lower"}, {1, "upper"}});
  for (const bool binary : {false, true}) {
    io::write_msh(mesh, folder / "a.msh", {{0, "lower"}, {1, "upper"}}, binary);
    const auto msh = io::read_mesh(folder / "a.msh");
    CHECK(io::mesh_hash(msh) == io::mesh_hash(mesh));
    CHECK(std::count(msh.mesh.tags.begin(), msh.mesh.tags.end(), 1) == 3 * 6 * 6 * 6);
    REQUIRE(msh.material_names.size() == 2);
    CHECK(msh.material_names[1] == std::pair(local_id{1}, std::string("upper")));
  }
}

TEST_CASE("the hash of a mesh sees orientation and coordinates, and not how corners are turned") {
  const auto hash = [](const simplex<3>& element, double z = 1) {
    return io::mesh_hash(simplicial_mesh<3>{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, z}}, {element}, {}});
  };
  CHECK(hash({1, 2, 0, 3}) == hash({0, 1, 2, 3}));
  CHECK(hash({1, 0, 2, 3}) != hash({0, 1, 2, 3}));
  CHECK(hash({0, 1, 2, 3}, 2) != hash({0, 1, 2, 3}));
}

TEST_CASE("surfaces are written as VTU and MSH too") {
  const testing::scratch_folder folder("surface");
  const simplicial_mesh<2> surface{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.1, 0.2, 1}}, {{0, 2, 1}, {0, 1, 3}}, {4, 2}};
  io::write_vtu(surface, folder / "s.vtu");
  CHECK(io::read_mesh(folder / "s.vtu").triangles == surface.elements);
  io::write_vtu(surface, folder / "named.vtu", {}, {{2, "wing"}, {4, ""}});
  CHECK(io::read_mesh(folder / "named.vtu").material_names.empty());
  CHECK(io::read_mesh(folder / "named.vtu").triangle_names == io::tag_names{{2, "wing"}});
  io::write_msh(surface, folder / "s.msh");
  CHECK(io::read_mesh(folder / "s.msh").triangle_tags == std::vector<local_id>{2, 4});
  io::write_off(surface, folder / "s.off");
  CHECK(testing::file_content(folder / "s.off") ==
        "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0.1 0.2 1\n3 0 2 1\n3 0 1 3\n");
  io::write_stl(surface, folder / "s.stl");
  CHECK(std::filesystem::file_size(folder / "s.stl") == 84 + 2 * 50);
}

TEST_CASE("MSH 2.2: sparse node numbers, names, tags, partitions and node data") {
  const testing::scratch_folder folder("msh2");
  testing::write_content(folder / "a.msh", two_tetrahedra_msh2);
  const auto read = io::read_mesh(folder / "a.msh");
  CHECK(read.mesh.points.size() == 5);
  CHECK(read.mesh.elements == std::vector<simplex<3>>{{0, 1, 2, 3}, {1, 2, 3, 4}});
  CHECK(read.mesh.tags == std::vector<local_id>{8, 8});
  CHECK(read.triangles == std::vector<simplex<2>>{{0, 2, 1}});
  CHECK(read.triangle_tags == std::vector<local_id>{6});
  CHECK(read.node_ids == std::vector<global_id>{9, 19, 29, 39, 49});
  CHECK(read.subdomains == std::vector<local_id>{1, 0});
  REQUIRE(read.scalars("size") != nullptr);
  CHECK(*read.scalars("size") == std::vector<double>{1.5, 2, 3, 4, 5});
  CHECK(read.triangle_names == io::tag_names{{6, "wall"}});
  CHECK(read.passed_over == std::vector<std::string>{"points and lines as elements"});
}

TEST_CASE("MSH: triangles between partitions are left out, those on surfaces of the model are not") {
  const testing::scratch_folder folder("between_partitions");
  // Two tetrahedra of one volume. As Gmsh writes it, what is between partitions has the group of the volume.
  testing::write_content(folder / "a.msh", R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PartitionedEntities
2
0
0 0 2 2
5 3 1 2 1 2 0 0 0 1 1 1 1 9 0
6 2 4 1 1 0 0 0 1 1 1 1 7 0
7 3 1 1 1 0 0 0 1 1 1 1 9 0
8 3 1 1 2 0 0 0 1 1 1 1 9 0
$EndPartitionedEntities
$Nodes
1 5 1 5
3 7 0 5
1
2
3
4
5
0 0 0
1 0 0
0 1 0
0 0 1
1 1 1
$EndNodes
$Elements
4 4 1 4
2 5 2 1
1 2 3 4
2 6 2 1
2 1 3 2
3 7 4 1
3 1 2 3 4
3 8 4 1
4 2 3 4 5
$EndElements
)");
  const auto read = io::read_mesh(folder / "a.msh");
  CHECK(read.subdomains == std::vector<local_id>{0, 1});
  CHECK(read.triangles == std::vector<simplex<2>>{{0, 2, 1}});
  CHECK(read.triangle_tags == std::vector<local_id>{6});
}

TEST_CASE("subdomains of triangles: partitions of MSH files, of VTK files an array of elements") {
  const testing::scratch_folder folder("triangle_subdomains");
  // Two triangles in a partition each, and one in none.
  testing::write_content(folder / "a.msh",
                         "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n"
                         "3 0 1 0\n4 1 1 0\n$EndNodes\n$Elements\n3\n1 2 4 7 7 1 2 1 2 3\n"
                         "2 2 4 7 7 1 1 2 4 3\n3 2 2 7 7 1 3 2\n$EndElements\n");
  CHECK(io::read_mesh(folder / "a.msh").triangle_subdomains == std::vector<local_id>{1, 0, -1});
  auto with_tetrahedra = two_tetrahedra_msh2; // a triangle in a partition, but a side of an element
  const std::string triangle = "\n2 2 2 7 1 10";
  with_tetrahedra.replace(with_tetrahedra.find(triangle), triangle.size(), "\n2 2 4 7 1 1 1 10");
  testing::write_content(folder / "b.msh", with_tetrahedra);
  CHECK(io::read_mesh(folder / "b.msh").triangles.size() == 1);
  CHECK(io::read_mesh(folder / "b.msh").triangle_subdomains.empty());

  const auto vtk = [&](const std::string& type, const std::string& cells) {
    testing::write_content(
        folder / "a.vtk",
        "<VTKFile type=\"" + type + "\"><" + type + "><Piece NumberOfPoints=\"4\" " + cells +
            "<CellData><DataArray type=\"Int32\" Name=\"subdomain\" format=\"ascii\">3 5</DataArray>"
            "</CellData><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">"
            "0 0 0 1 0 0 0 1 0 1 1 0</DataArray></Points></Piece></" +
            type + "></VTKFile>");
    return io::read_mesh(folder / "a.vtk");
  };
  const std::string arrays =
      "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 1 3 2</DataArray>"
      "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 6</DataArray>";
  const auto grid =
      vtk("UnstructuredGrid", "NumberOfCells=\"2\"><Cells>" + arrays +
                                  "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5 5"
                                  "</DataArray></Cells>");
  CHECK(grid.triangles.size() == 2);
  CHECK(grid.triangle_subdomains == std::vector<local_id>{3, 5});
  const auto sides = vtk("PolyData", "NumberOfPolys=\"2\"><Polys>" + arrays + "</Polys>"); // of a skeleton
  CHECK(sides.triangles.size() == 2);
  CHECK(sides.triangle_subdomains.empty());
}

TEST_CASE("VTU in text and in base64, with small types and without optional arrays") {
  const testing::scratch_folder folder("vtu_forms");
  testing::write_content(folder / "a.vtu", vtu_head + ascii_points + vtu_cells + vtu_tail);
  const auto text = io::read_mesh(folder / "a.vtu");
  CHECK(text.mesh.points == std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  CHECK(text.mesh.tags == std::vector<local_id>{0});
  CHECK(text.node_ids.empty());
  CHECK(text.passed_over.empty());
  testing::write_content(folder / "c.vtu",
                         vtu_head + ascii_points + vtu_cells +
                             R"(<CellData><DataArray type="Int32" Name="region" format="ascii">3</DataArray>
<DataArray type="Int32" Name="porosity" format="ascii">1</DataArray></CellData>)" +
                             vtu_tail);
  CHECK(io::read_mesh(folder / "c.vtu").passed_over ==
        std::vector<std::string>{"the values 'porosity' of cells"});
  // Twelve floats behind a 32-bit byte count: in one base64 text, and as two.
  for (const std::string base64 :
       {"MAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAACAPw==",
        " MAAAAA==AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAA\nAAAAAIA/ "}) {
    testing::write_content(folder / "b.vtu",
                           vtu_head +
                               "<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"binary\">" +
                               base64 + "</DataArray></Points>" + vtu_cells + vtu_tail);
    CHECK(io::read_mesh(folder / "b.vtu").mesh.points == text.mesh.points);
  }
}

TEST_CASE("missing, empty and foreign files are refused by name") {
  const testing::scratch_folder folder("foreign");
  CHECK_THROWS_WITH_AS(io::read_mesh(folder / "none.vtu"),
                       doctest::Contains("none.vtu: there is no such file"), input_error);
  CHECK_THROWS_WITH_AS(io::read_mesh(folder), doctest::Contains("no .pvtu or .msh"), input_error);
  check_says(refusal(""), "empty");
  check_says(refusal("ISO-10303-21;\nHEADER;"),
             "no mesh file that is known: neither VTU, PVTU, VTP, MSH, HDF5, MFEM nor OpenFOAM");
  check_says(refusal("<?xml version=\"1.0\"?><svg></svg>"), "not a VTK XML file");
  check_says(refusal("<VTKFile type=\"PolyData\"><PolyData></PolyData></VTKFile>"), "no <Piece>");
  check_says(refusal("<VTKFile type=\"ImageData\"><ImageData></ImageData></VTKFile>"), "ImageData");
}

TEST_CASE("what is wrong with a VTU file is named") {
  const auto with = [](const std::string& points, const std::string& cells) {
    return vtu_head + points + cells + vtu_tail;
  };
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  check_says(refusal(with("</Points>", vtu_cells)), "no point coordinates");
  check_says(refusal(with(replaced(ascii_points, "1e0", ""), vtu_cells)),
             "12 values are expected, but there are 11");
  check_says(refusal(with(replaced(ascii_points, "1e0", "x"), vtu_cells)), "a number is expected");
  check_says(refusal(with(replaced(ascii_points, "1e0", "nan"), vtu_cells)),
             "point 2 has a coordinate that is not finite");
  check_says(refusal(with(replaced(ascii_points, "ascii", "zip"), vtu_cells)), "format \"zip\" is unknown");
  check_says(refusal(with(ascii_points, "")), "no <Cells>");
  check_says(refusal(with(ascii_points, replaced(vtu_cells, ">10<", ">12<"))), "hexahedron");
  check_says(refusal(with(ascii_points, replaced(vtu_cells, "2 3<", "2 4<"))), "refers to point 4 of 4");
  check_says(refusal(with(ascii_points, replaced(vtu_cells, "2 3<", "2 -1<"))), "refers to point -1");
  check_says(refusal(with(ascii_points, replaced(vtu_cells, ">4<", ">3<"))), "values are expected");
  check_says(refusal(with(ascii_points, replaced(vtu_cells, ">4<", ">-4<"))), "negative");
  check_says(refusal(with(ascii_points, replaced(vtu_cells, "offsets", "ofsets"))), "no array \"offsets\"");
  check_says(refusal(replaced(with(ascii_points, vtu_cells), "\"4\"", "\"four\"")), "a number is expected");
  check_says(refusal(replaced(with(ascii_points, vtu_cells), "\"4\"", "\"4000000000000\"")), "too large");
  check_says(refusal(replaced(with(ascii_points, vtu_cells), "byte_order",
                              "compressor=\"vtkLZ4DataCompressor\" byte_order")),
             "vtkLZ4DataCompressor");
  check_says(refusal(replaced(with(ascii_points, vtu_cells), "</Cells>", "</Sells>")),
             "line 10: </Cells> is expected");
  std::string deep = "<VTKFile>";
  for (int i = 0; i < 100000; ++i)
    deep += "<a>";
  check_says(refusal(deep), "nested too deep");
}

TEST_CASE("what is wrong with an MSH file is named") {
  const auto replaced = [](const std::string& from, const std::string& to) {
    auto text = two_tetrahedra_msh2;
    return text.replace(text.find(from), from.size(), to);
  };
  check_says(refusal(replaced("2.2 0 8", "4.0 0 8")), "version 4.0 is not supported");
  check_says(refusal(replaced("2.2 0 8", "2.2 1 8")), "byte order is unclear");
  check_says(refusal(replaced("50 1 1 1\n", "")), "a number is expected");
  check_says(refusal(replaced("50 1 1 1\n", "50 1 1 1\n60 1 1 1\n")), "\"$EndNodes\" is expected");
  check_says(refusal(replaced("50 1 1 1\n", "40 1 1 1\n")), "node number 40 occurs twice");
  check_says(refusal(replaced("50 1 1 1\n", "51 1 1 1\n")), "refers to node 50");
  check_says(refusal(replaced("50 1 1 1\n", "50 1 inf 1\n")),
             "line 15: a node has a coordinate that is not finite");
  check_says(refusal(replaced("10 20 30 40", "10 20 30")), "expected");
  check_says(refusal(replaced("3 4 4 9", "3 5 4 9")), "elements of type 5");
  check_says(refusal(replaced("Elements\n4\n", "Elements\n4000000000\n")),
             "4000000000 entries are announced");
  check_says(refusal(replaced("$Elements", "$Elefants")), "$EndElefants is missing");
  check_says(refusal(two_tetrahedra_msh2.substr(0, two_tetrahedra_msh2.find("$Elements"))),
             "no section $Elements");
}

TEST_CASE("pieces that disagree about a shared point are refused") {
  const testing::scratch_folder folder("disagree");
  auto mesh = coarse_cubes_in_eight.distributed();
  io::vtu_writer{}(mesh, folder);
  for (auto& p : mesh.skeleton.points.own())
    p.x += 1e-9;
  io::vtu_writer{}(mesh, folder / "other");
  std::filesystem::copy_file(folder / "other/mesh_0000.vtu", folder / "mesh_0000.vtu",
                             std::filesystem::copy_options::overwrite_existing);
  CHECK_THROWS_WITH_AS(io::read_mesh(folder), doctest::Contains("not the same coordinates"), input_error);
  std::filesystem::remove(folder / "mesh_0003.vtu");
  CHECK_THROWS_WITH_AS(io::read_mesh(folder), doctest::Contains("mesh_0003.vtu"), input_error);
}

TEST_CASE("the triangles of a VTP file are read; other polygons and lines are named") {
  const testing::scratch_folder folder("polygons");
  testing::write_content(folder / "surface.vtp", triangle_vtp("2 0 1", "3"));
  const io::loaded_mesh read = io::read_mesh(folder / "surface.vtp");
  CHECK(read.mesh.elements.empty());
  REQUIRE(read.triangles.size() == 1);
  CHECK(read.triangles.front() == simplex<2>{2, 0, 1});
  CHECK(read.triangle_tags.front() == 7);
  check_says(refusal(triangle_vtp("2 0 1 3", "4")), "cell 0 has 4 points instead of 3");
  check_says(refusal(triangle_vtp("2 0 1", "3", "2")), "only triangles are read");
}

namespace {

/// The files of four ranks, with elements of each other or without.
void write_ranks(const std::filesystem::path& folder, bool ghosts, bool binary = true) {
  io::rank_writer<io::rank_msh_format>{.ranks = 4, .format = {.binary = binary}, .ghosts = ghosts}(
      coarse_cubes_in_eight.distributed(), folder);
}

} // namespace

TEST_CASE("of MSH files of ranks the whole mesh is read, whichever is named") {
  for (const bool ghosts : {false, true}) {
    const testing::scratch_folder folder("ranks_read");
    write_ranks(folder, ghosts, ghosts);
    const std::filesystem::path whole = folder;
    for (const auto& named : {whole, folder / "ranks_1.msh", folder / "ranks_3.msh"}) {
      const auto read = io::read_mesh(named);
      CHECK(read.mesh.elements.size() == 6 * 6 * 6 * 6);
      CHECK(read.mesh.points.size() == 7 * 7 * 7);
      CHECK(check_validity(read.mesh).valid());
      CHECK(std::count(read.mesh.tags.begin(), read.mesh.tags.end(), 1) == 3 * 6 * 6 * 6);
      REQUIRE(read.subdomains.size() == read.mesh.elements.size());
      for (local_id rank = 0; rank < 4; ++rank)
        CHECK(std::count(read.subdomains.begin(), read.subdomains.end(), rank) > 0);
      CHECK(read.material_names.size() == 2);
      CHECK(read.files.size() == 4);
      std::size_t pieces = 0, elements = 0;
      CHECK(io::for_each_piece_file(named, nullptr, [&](const io::loaded_mesh& piece, const auto& file) {
        CHECK(file == folder / ("ranks_" + std::to_string(++pieces) + ".msh"));
        elements += piece.mesh.elements.size();
      }));
      CHECK(pieces == 4);
      CHECK(elements == read.mesh.elements.size());
    }
  }
}

TEST_CASE("an MSH file of a rank is refused where the others are not there, or are of another mesh") {
  const testing::scratch_folder folder("ranks_missing");
  write_ranks(folder, false);
  const auto says = [&](const std::string& name) {
    const auto streamed = testing::refusal_of<input_error>(
        [&] { io::for_each_piece_file(folder / name, nullptr, [](const auto&, const auto&) {}); });
    const auto whole = testing::refusal_of<input_error>([&] { return io::read_mesh(folder / name); });
    CHECK(streamed == whole);
    return whole;
  };
  std::filesystem::rename(folder / "ranks_3.msh", folder / "third.msh");
  CHECK(says("ranks_2.msh") == (folder / "ranks_3.msh").string() +
                                   ": there is no such file, and ranks_2.msh is part 2 of a mesh in 4 parts");
  check_says(says("third.msh"), "this is part 3 of a mesh in 4 parts; the others are not found");
  std::filesystem::copy_file(folder / "ranks_1.msh", folder / "ranks_3.msh");
  check_says(says("ranks_2.msh"), "ranks_3.msh: this is not part 3 of a mesh in 4 parts");
}

TEST_CASE("one VTU file of several is refused, and read by its own reader") {
  const testing::scratch_folder folder("one_piece");
  io::vtu_writer{.files = 3}(coarse_cubes_in_eight.distributed(), folder);
  check_says(testing::refusal_of<input_error>([&] { return io::read_mesh(folder / "mesh_0001.vtu"); }),
             "mesh_0001.vtu: this is one of the 3 files of " + (folder / "mesh.pvtu").string());
  CHECK(io::vtu_reader{}(folder / "mesh_0001.vtu").mesh.elements.size() > 0);
  CHECK(io::points_elsewhere(io::read_mesh(folder)) == "");
  std::filesystem::rename(folder / "mesh.pvtu", folder / "else"); // by itself it is known by its numbers
  for (const char* name : {"mesh_0000.vtu", "mesh_0001.vtu"})
    check_says(io::points_elsewhere(io::read_mesh(folder / name)), "this is a part of a larger mesh");
  io::vtu_writer{.files = 1}(coarse_cubes_in_eight.distributed(), folder);
  CHECK(io::points_elsewhere(io::read_mesh(folder / "mesh_0000.vtu")) == "");
}

TEST_CASE("a folder with several meshes, or with files that are not read") {
  const testing::scratch_folder folder("several");
  const std::filesystem::path path = folder;
  testing::write_content(folder / "b.msh", "");
  CHECK(io::find_mesh_file(path) == folder / "b.msh");
  testing::write_content(folder / "a.msh", "");
  check_says(testing::refusal_of<input_error>([&] { return io::find_mesh_file(path); }),
             "several meshes in this folder, a.msh and b.msh for example");
  testing::write_content(folder / "mesh_partitioned.msh", "");
  CHECK(io::find_mesh_file(path) == folder / "mesh_partitioned.msh");
  testing::write_content(folder / "z.pvtu", "");
  CHECK(io::find_mesh_file(path) == folder / "z.pvtu");
  const testing::scratch_folder other("unread");
  testing::write_content(other / "ranks.h5", "\x89HDF\r\n");
  testing::write_content(other / "mesh.000001", "MFEM mesh v1.2");
  std::filesystem::create_directory(other / "processor0");
  check_says(testing::refusal_of<input_error>([&] { return io::read_mesh(other); }),
             "it has files of HDF5, MFEM, OpenFOAM, which have readers of their own");
  check_says(testing::refusal_of<input_error>([&] { return io::read_mesh(other / "ranks.h5"); }),
             "a file of HDF5, which has a reader of its own");
  check_says(testing::refusal_of<input_error>([&] { return io::read_mesh(other / "mesh.000001"); }),
             "a file of MFEM");
}
