// Fields of VTU files: arrays of points and cells of any number of components, of one file and of several.
#include "dovetail/files/read_mesh.hpp"
#include "dovetail/files/vtu_reader.hpp"
#include "dovetail/files/write_vtu.hpp"
#include "files/scratch_folder.hpp"
#include "files/stacked_cubes.hpp"
#include "support/refusal.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

using namespace dovetail;

namespace {

std::string array(const std::string& name, const std::string& values, int components = 1,
                  const std::string& type = "Float64") {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
         std::to_string(components) + "\" format=\"ascii\">" + values + "</DataArray>\n";
}

/// A tetrahedron on the plane z = 0 with its apex at this height, and a triangle of it, which is the first
/// cell.
std::string piece(int height, const std::string& point_data, const std::string& cell_data) {
  return "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"><UnstructuredGrid>\n"
         "<Piece NumberOfPoints=\"4\" NumberOfCells=\"2\"><Points>" +
         array("Points", "0 0 0 1 0 0 0 1 0 0 0 " + std::to_string(height), 3) + "</Points>\n<Cells>" +
         array("connectivity", height > 0 ? "0 1 2 0 1 2 3" : "0 1 2 0 2 1 3", 1, "Int32") +
         array("offsets", "3 7", 1, "Int32") + array("types", "5 10", 1, "UInt8") + "</Cells>\n<PointData>" +
         point_data + "</PointData>\n<CellData>" + cell_data +
         "</CellData></Piece></UnstructuredGrid></VTKFile>";
}

const std::string tags = array("region", "0 1", 1, "Int32") + array("GlobalCellIds", "3 4", 1, "Int64");

io::loaded_mesh read(const std::filesystem::path& file) {
  return io::read_mesh(file, nullptr, true);
}

/// The error that a file of one piece with these arrays gives when its fields are read.
std::string refusal_of_fields(const std::string& point_data, const std::string& cell_data) {
  const testing::scratch_folder folder("refused_fields");
  testing::write_content(folder / "a.vtu", piece(1, point_data, cell_data));
  const auto says = testing::refusal_of<input_error>([&] { return read(folder / "a.vtu"); });
  CHECK(says.starts_with((folder / "a.vtu").string() + ": "));
  return says;
}

/// The error of a mesh of two pieces, or nothing.
std::string refusal_of_two(const std::string& one, const std::string& two, bool in_cells) {
  const testing::scratch_folder folder("two_pieces");
  testing::write_content(folder / "one.vtu", piece(1, in_cells ? "" : one, in_cells ? one : ""));
  testing::write_content(folder / "two.vtu", piece(-1, in_cells ? "" : two, in_cells ? two : ""));
  testing::write_content(folder / "all.pvtu",
                         "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid><Piece Source=\"one.vtu\"/>"
                         "<Piece Source=\"two.vtu\"/></PUnstructuredGrid></VTKFile>");
  try {
    read(folder / "all.pvtu");
  } catch (const input_error& problem) {
    return problem.what();
  }
  return {};
}

bool contains(const std::string& text, const std::string& part) {
  INFO(text);
  return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("fields are read where they are asked for; what numbers points and cells is none") {
  const testing::scratch_folder folder("fields");
  testing::write_content(folder / "a.vtu", piece(1, array("u", "1 2 3 4") + array("v", "1 2 3 4 5 6 7 8", 2),
                                                 tags + array("load &amp; more", "8 9") +
                                                     array("flux", "1 2 3 4 5 6", 3, "Int8")));
  const auto mesh = read(folder / "a.vtu");
  REQUIRE(mesh.point_scalars.size() == 1);
  CHECK(mesh.point_scalars[0].values == std::vector<double>{1, 2, 3, 4});
  REQUIRE(mesh.point_fields.size() == 1);
  CHECK(mesh.point_fields[0].name == "v");
  CHECK(mesh.point_fields[0].components == 2);
  CHECK(mesh.point_fields[0].values == std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8});
  REQUIRE(mesh.element_fields.size() == 2);
  CHECK(mesh.element_fields[0].name == "load & more");
  CHECK(mesh.element_fields[0].components == 1);
  CHECK(mesh.element_fields[0].values == std::vector<double>{9}); // of the tetrahedron
  CHECK(mesh.element_fields[1].components == 3);
  CHECK(mesh.element_fields[1].values == std::vector<double>{4, 5, 6});
  CHECK(mesh.mesh.tags == std::vector<local_id>{1});
  CHECK(mesh.passed_over.empty());

  const auto without = io::read_mesh(folder / "a.vtu");
  CHECK(without.point_fields.empty());
  CHECK(without.element_fields.empty());
  CHECK(without.passed_over.size() == 3);
}

TEST_CASE("of a mesh of triangles the fields are theirs") {
  const testing::scratch_folder folder("fields_of_triangles");
  auto content = piece(1, "", array("flux", "1 2 3 4", 2));
  content.replace(content.find("5 10"), 4, "5 5 ");
  content.replace(content.find("0 1 2 0 1 2 3"), 13, "0 1 2 0 1 3  ");
  content.replace(content.find("3 7"), 3, "3 6");
  testing::write_content(folder / "a.vtu", content);
  const auto mesh = read(folder / "a.vtu");
  REQUIRE(mesh.element_fields.size() == 1);
  CHECK(mesh.element_fields[0].values == std::vector<double>{1, 2, 3, 4});
}

TEST_CASE("fields of several pieces: points that are merged keep their values, ghosts have none") {
  const testing::scratch_folder folder("fields_of_pieces");
  testing::write_content(folder / "one.vtu", piece(1, array("v", "1 2 3 4 5 6 7 8", 2), array("w", "1 2")));
  testing::write_content(folder / "two.vtu", piece(-1, array("v", "1 2 3 4 5 6 9 10", 2), array("w", "3 4")));
  const auto ghost = array("vtkGhostType", "0 1", 1, "UInt8");
  testing::write_content(folder / "ghost.vtu",
                         piece(2, array("v", "1 2 3 4 5 6 11 12", 2), array("w", "5 6") + ghost));
  testing::write_content(
      folder / "all.pvtu",
      "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid><Piece Source=\"one.vtu\"/>"
      "<Piece Source=\"two.vtu\"/><Piece Source=\"ghost.vtu\"/></PUnstructuredGrid></VTKFile>");
  const auto mesh = read(folder / "all.pvtu");
  CHECK(mesh.mesh.points.size() == 6);
  REQUIRE(mesh.point_fields.size() == 1);
  CHECK(mesh.point_fields[0].values == std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  REQUIRE(mesh.element_fields.size() == 1);
  CHECK(mesh.element_fields[0].values == std::vector<double>{2, 4});
}

TEST_CASE("pieces that another program has joined in one file are one mesh again") {
  const testing::scratch_folder folder("joined_pieces");
  const auto joined = [&](const std::string& ids) {
    const std::string one =
        piece(1, array("GlobalNodeIds", "0 1 2 3", 1, "Int64") + array("v", "1 2 3 4 5 6 7 8", 2), "");
    const std::string two =
        piece(-1, array("GlobalNodeIds", ids, 1, "Int64") + array("v", "1 2 3 4 5 6 9 10", 2), "");
    const auto begin = two.find("<Piece"), end = two.find("</UnstructuredGrid>");
    testing::write_content(folder / "a.vtu", std::string(one).insert(one.find("</UnstructuredGrid>"),
                                                                     two.substr(begin, end - begin)));
    return read(folder / "a.vtu");
  };
  const auto mesh = joined("0 1 2 4");
  CHECK(mesh.mesh.points.size() == 5);
  CHECK(mesh.mesh.elements == std::vector<simplex<3>>{{0, 1, 2, 3}, {0, 2, 1, 4}});
  REQUIRE(mesh.point_fields.size() == 1);
  CHECK(mesh.point_fields[0].values == std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
  CHECK(joined("4 5 6 7").mesh.points.size() == 8);
  CHECK(joined("0 1 2 3").mesh.points.size() == 8); // the last are elsewhere: the numbers mean something else
}

TEST_CASE("fields are written and read back; cells that are no elements have no number") {
  const testing::scratch_folder folder("fields_written");
  io::loaded_mesh mesh;
  mesh.mesh = testing::stacked_cubes{.cells = 3, .cuts = 1, .solids = 2, .jitter = 0.3}.whole();
  mesh.triangles = {{0, 1, 2}};
  mesh.triangle_tags = {3};
  mesh.point_fields = {{"v \"q\"", {}, 3}};
  for (std::size_t i = 0; i < 3 * mesh.mesh.points.size(); ++i)
    mesh.point_fields[0].values.push_back(0.1 * static_cast<double>(i));
  mesh.element_fields = {{"load", {}}, {"flux", {}, 2}};
  for (std::size_t e = 0; e < mesh.mesh.elements.size(); ++e) {
    mesh.element_fields[0].values.push_back(0.5 * static_cast<double>(e));
    for (const double half : {0.0, 0.5})
      mesh.element_fields[1].values.push_back(half + static_cast<double>(e));
  }
  io::write_vtu(mesh, folder / "a.vtu");
  const auto back = read(folder / "a.vtu");
  CHECK(back.mesh.elements == mesh.mesh.elements);
  CHECK(back.triangle_tags == mesh.triangle_tags);
  REQUIRE(back.point_fields.size() == 1);
  CHECK(back.point_fields[0].name == mesh.point_fields[0].name);
  CHECK(back.point_fields[0].values == mesh.point_fields[0].values);
  REQUIRE(back.element_fields.size() == 2);
  for (std::size_t k = 0; k < 2; ++k)
    CHECK(back.element_fields[k].values == mesh.element_fields[k].values);
  const auto bytes = testing::file_content(folder / "a.vtu"); // the last values are the triangle's flux
  double last;
  std::memcpy(&last, bytes.data() + bytes.rfind("\n</AppendedData>") - sizeof last, sizeof last);
  CHECK(std::isnan(last));

  mesh.element_fields[1].values.pop_back();
  CHECK_THROWS_WITH_AS(io::write_vtu(mesh, folder / "b.vtu"), doctest::Contains("components of elements"),
                       io_error);
  mesh.point_fields[0].components = 2;
  CHECK_THROWS_WITH_AS(io::write_vtu(mesh, folder / "b.vtu"), doctest::Contains("components of points"),
                       io_error);
}

TEST_CASE("fields that are no fields are refused by name") {
  CHECK(contains(refusal_of_fields(array("u", "1 2 3 4") + array("u", "1 2 3 4"), ""),
                 "array \"u\": there are two of this name"));
  CHECK(contains(refusal_of_fields("", array("w", "1 2") + array("w", "1 2 3 4", 2)),
                 "array \"w\": there are two of this name"));
  CHECK(contains(refusal_of_fields(array("v", "1 2 3 4 5 6 7", 2), ""),
                 "array \"v\": 8 values are expected, but there are 7"));
  CHECK(contains(refusal_of_fields("", array("w", "1 2 3")),
                 "array \"w\": 2 values are expected, but there are 3"));
  CHECK(contains(refusal_of_fields("", array("w", "", 0)), "array \"w\": 0 components"));
  CHECK(contains(refusal_of_fields(array("v", "1", 257), ""), "array \"v\": 257 components; 1 to 256"));
  std::string many;
  for (int k = 0; k < 257; ++k)
    many += array("w" + std::to_string(k), "1 2");
  CHECK(contains(refusal_of_fields("", many), "more than 256 arrays"));
}

TEST_CASE("fields that only some pieces have, or have otherwise, are refused") {
  CHECK(refusal_of_two(array("GlobalNodeIds", "0 1 2 3", 1, "Int64"), "", false).empty()); // is no field
  for (const bool in_cells : {false, true}) {
    const std::string v = array("v", in_cells ? "1 2 3 4" : "1 2 3 4 5 6 7 8", 2);
    const std::string s = array("v", in_cells ? "1 2" : "1 2 3 4");
    CHECK(refusal_of_two(v, v, in_cells).empty());
    CHECK(refusal_of_two(s, s, in_cells).empty());
    for (const std::string& each : {v, s}) {
      CHECK(contains(refusal_of_two(each, "", in_cells), "array \"v\": only some of the pieces have it"));
      CHECK(contains(refusal_of_two("", each, in_cells), "array \"v\": only some of the pieces have it"));
    }
    CHECK(contains(refusal_of_two(v, s, in_cells),
                   "two.vtu: array \"v\": 1 components, and in another piece 2"));
  }
}
