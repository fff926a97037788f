// What HDF5 files say is what was written, and what one of them says of another must fit.
#include "files/hdf5_at_exit.hpp"
#include "files/read_back.hpp"
#include "files/scratch_folder.hpp"
#include "files/second_order_verdict.hpp"
#include "files/stacked_cubes.hpp"

#include "dovetail/core/encoding.hpp"
#include "dovetail/files/finishing_pass.hpp"
#include "dovetail/files/hdf5_pieces.hpp"
#include "dovetail/files/hdf5_reader.hpp"
#include "dovetail/files/streamed_interfaces.hpp"
#include "dovetail/files/streamed_validity.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/models/plane/svg_path.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "dovetail/solver/hdf5_format.hpp"
#include "dovetail/solver/hdf5_rank_reader.hpp"
#include "dovetail/solver/rank_files.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

using namespace dovetail;
using testing::cubes_in_27;

namespace {

/// Replaces a dataset; of more rows than values the rest is nothing, and takes no room.
template <class T>
void replace(const std::filesystem::path& path, const std::string& name, const std::vector<T>& values,
             std::uint64_t columns = 1, std::uint64_t rows = 0) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  REQUIRE(file >= 0);
  H5Ldelete(file, name.c_str(), H5P_DEFAULT);
  const std::array<hsize_t, 2> extent{rows > 0 ? rows : values.size() / columns, columns};
  const hid_t space = H5Screate_simple(columns == 1 ? 1 : 2, extent.data(), nullptr);
  const hid_t set = H5Dcreate2(file, name.c_str(), io::detail::hdf5_type<T>(), space, H5P_DEFAULT,
                               H5P_DEFAULT, H5P_DEFAULT);
  REQUIRE(set >= 0);
  if (rows == 0 && !values.empty())
    REQUIRE(H5Dwrite(set, io::detail::hdf5_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
  H5Dclose(set);
  H5Sclose(space);
  H5Fclose(file);
}

/// Changes the values of a dataset, which keeps its dimensions.
template <class T>
void change(const std::filesystem::path& path, const std::string& name,
            const std::function<void(std::vector<T>&)>& how, std::uint64_t columns = 1) {
  std::vector<T> values;
  {
    const io::detail::hdf5_input input(path);
    values = input.read<T>(name, 0, input.extent_of(name).rows);
  }
  how(values);
  replace(path, name, values, columns);
}

/// Expects a refusal of a changed file, and puts it back.
template <class Read>
void expect(const std::filesystem::path& file, const std::string& expected, const Read& read,
            const std::function<void()>& spoil) {
  CAPTURE(expected);
  const std::string before = testing::file_content(file);
  spoil();
  const std::string said = testing::refusal_of<input_error>(read);
  CHECK_MESSAGE(said.find(expected) != std::string::npos, said);
  CHECK_MESSAGE(said.find(file.parent_path().string()) == 0, said);
  testing::write_content(file, before);
}

std::string faults_of(const std::filesystem::path& path) {
  io::streamed_validity found;
  io::for_each_hdf5_piece(path, [&](const io::loaded_mesh& piece, const std::filesystem::path& file) {
    found.add(piece, file.string());
  });
  return found.faults();
}

distributed_simplicial_mesh<2> plane_mesh() {
  const plane_domain domain(drawing_from_svg_path("M0 0 H3 V2 H0 Z"));
  return generate<2>(domain, uniform_size(0.4), parameters<>{}.with_options({.subdomains = 4})).mesh;
}

} // namespace

TEST_CASE("pieces: what is read is what was written, by any of the files") {
  const auto mesh = cubes_in_27.distributed();
  for (const int files : {0, 3, 1}) {
    CAPTURE(files);
    const testing::scratch_folder folder("hdf5_read");
    io::hdf5_writer{.files = files}(mesh, folder);
    for (const char* name : {"mesh.xdmf", "mesh_0000.vtkhdf"}) {
      const auto read = io::read_hdf5(folder / name);
      CHECK(io::mesh_hash(read) == io::mesh_hash(mesh));
      CHECK(read.subdomains.size() == 1296);
      CHECK(read.files.size() == (files == 0 ? 27u : static_cast<std::size_t>(files)));
      const auto whole = cubes_in_27.whole();
      CHECK(testing::by_places(read.mesh.points, read.mesh.elements, read.mesh.tags) ==
            testing::by_places(whole.points, whole.elements, whole.tags));
    }
    CHECK(faults_of(folder / "mesh.xdmf") == "");
    CHECK(io::read_hdf5(folder / "skeleton.vtkhdf").triangles.size() == 432 + 6 * 72);
  }
}

TEST_CASE("elements at interfaces are those of the mesh that was written") {
  const auto mesh = cubes_in_27.distributed();
  const testing::scratch_folder folder("hdf5_interfaces");
  io::hdf5_writer{}(mesh, folder);
  io::streamed_interfaces<3> interfaces;
  const auto for_each = [&](const auto& f) {
    io::for_each_hdf5_piece(folder / "mesh.xdmf", [&](const io::loaded_mesh& piece, const auto&) {
      f(io::read_piece<3>{piece.mesh, piece.node_ids, piece.subdomains});
    });
  };
  for_each([&](const io::read_piece<3>& piece) { interfaces.add(piece); });
  const auto points = interfaces.points();
  quality_at_interfaces found;
  for_each([&](const io::read_piece<3>& piece) { found.merge(io::measure_at_interfaces(piece, points)); });
  CHECK(encoded(found) == encoded(io::finish_mesh<3>(mesh, {}, folder, parallel::serial{}).at_interfaces));
  CHECK(found.touching.elements > 0);

  // Of triangles all at once; what the skeleton calls a subdomain is the one behind a side.
  const auto plane = plane_mesh();
  io::hdf5_writer{}(plane, folder);
  const auto read = io::read_hdf5(folder / "mesh.xdmf");
  REQUIRE(read.triangle_subdomains.size() == read.triangles.size());
  const simplicial_mesh<2> triangles{read.mesh.points, read.triangles, read.triangle_tags};
  const io::read_piece<2> whole{triangles, {}, read.triangle_subdomains};
  io::streamed_interfaces<2> lines;
  lines.add(whole);
  CHECK(encoded(io::measure_at_interfaces(whole, lines.points())) ==
        encoded(io::finish_mesh<2>(plane, {}, folder, parallel::serial{}).at_interfaces));
  io::hdf5_writer{}(mesh, folder);
  CHECK(io::read_hdf5(folder / "skeleton.vtkhdf").triangle_subdomains.empty());
}

TEST_CASE("ranks: what is read is what was written, ghosts left out") {
  const auto mesh = cubes_in_27.distributed();
  const testing::scratch_folder folder("hdf5_ranks");
  for (const bool ghosts : {false, true}) {
    io::rank_writer<io::vtkhdf_format>{.ranks = 4, .ghosts = ghosts}(mesh, folder);
    const auto read = io::read_hdf5(folder / "ranks.vtkhdf");
    CHECK(read.mesh.elements.size() == 1296);
    CHECK(read.mesh.points.size() == 343);
    CHECK(faults_of(folder / "ranks.vtkhdf") == "");
  }
  io::rank_writer<io::xdmf_format>{.ranks = 4}(mesh, folder);
  for (const char* name : {"ranks.h5", "ranks.xdmf"}) {
    const auto read = io::read_hdf5_ranks(folder / name);
    CHECK(io::mesh_hash(read) == io::mesh_hash(mesh));
    CHECK(read.triangles.size() > 432);
    CHECK(read.files.front() == folder / "ranks.h5");
  }
}

TEST_CASE("triangles are read too, and second order where that is asked for") {
  const auto mesh = plane_mesh();
  const testing::scratch_folder folder("hdf5_triangles");
  io::hdf5_writer{}(mesh, folder);
  CHECK(io::mesh_hash(io::read_hdf5(folder / "mesh.xdmf")) == io::mesh_hash(mesh));
  io::rank_writer<io::xdmf_format>{.ranks = 2}(mesh, folder);
  CHECK(io::mesh_hash(io::read_hdf5_ranks(folder / "ranks.h5")) == io::mesh_hash(mesh));
  io::rank_writer<io::vtkhdf_format>{.ranks = 2, .ghosts = true}(mesh, folder);
  CHECK(io::read_hdf5(folder / "ranks.vtkhdf").triangles.size() ==
        io::read_hdf5(folder / "mesh.xdmf").triangles.size());
  const auto quadratic = testing::with_bent_edges(cubes_in_27.distributed());
  io::hdf5_writer{}(quadratic, folder);
  io::rank_writer<io::xdmf_format>{.ranks = 2}(quadratic, folder);
  io::rank_writer<io::vtkhdf_format>{.ranks = 2}(quadratic, folder);
  for (const char* name : {"mesh.xdmf", "ranks.vtkhdf"})
    CHECK(testing::refusal_of<input_error>([&] {
            io::read_hdf5(folder / name);
          }).find("elements of second order are not read") != std::string::npos);
  CHECK(testing::refusal_of<input_error>([&] {
          io::read_hdf5_ranks(folder / "ranks.h5");
        }).find("elements of second order are not read") != std::string::npos);
  const auto check = [&](const std::string& name) {
    return testing::check_second_order(
        [&](const auto& f) { io::for_each_hdf5_piece(folder / name, f, io::element_order::any); });
  };
  for (const char* name : {"mesh.xdmf", "ranks.vtkhdf"})
    testing::expect_second_order(check(name), cubes_in_27.whole());
  io::rank_writer<io::vtkhdf_format>{.ranks = 4, .ghosts = true}(quadratic, folder);
  testing::expect_second_order(check("ranks.vtkhdf"), cubes_in_27.whole());
  const auto whole = io::read_hdf5_ranks(folder / "ranks.h5", io::element_order::any);
  testing::expect_bent_edges(whole);
  io::streamed_middles<3> middles;
  middles.add(whole, "");
  CHECK(middles.faults() == "");

  io::rank_writer<io::vtkhdf_format>{.ranks = 4}(quadratic, folder); // whose last point another rank has too
  change<double>(
      folder / "ranks.vtkhdf", "VTKHDF/Points", [](auto& x) { x.back() += 9; }, 3);
  CHECK(testing::refusal_of<input_error>([&] { check("ranks.vtkhdf"); }).find("not the same coordinates") !=
        std::string::npos);
  const auto file = folder / "mesh_0003.vtkhdf";
  change<double>(
      file, "VTKHDF/Points", [](auto& x) { x.back() += 9; }, 3);
  CHECK(check("mesh.xdmf").faults.find("mesh_0003.vtkhdf: ") == 0);
  CHECK(check("mesh.xdmf").faults.find(" x element that its middles may invert (") != std::string::npos);
}

TEST_CASE("pieces: a file with one thing changed is refused, in words that name it") {
  const testing::scratch_folder folder("hdf5_near");
  io::hdf5_writer{.files = 2}(cubes_in_27.distributed(), folder);
  const auto read = [&] { io::read_hdf5(folder / "mesh.xdmf"); };
  const auto file = folder / "mesh_0000.vtkhdf", skeleton = folder / "skeleton.vtkhdf";
  const auto refuse = [&](const std::string& expected, const std::function<void()>& spoil) {
    expect(file, expected, read, spoil);
  };
  const std::string root = "VTKHDF/";
  const auto set = [](const std::filesystem::path& in, const std::string& name, std::size_t at, auto value,
                      std::uint64_t columns = 1) {
    return [=] {
      change<decltype(value)>(
          in, name, [&](auto& values) { values.at(at) = value; }, columns);
    };
  };
  refuse("dataset VTKHDF/Points: a coordinate in partition 0 is not finite",
         set(file, root + "Points", 3, std::nan(""), 3));
  refuse("dataset VTKHDF/Connectivity: partition 0 has the point 99999",
         set(file, root + "Connectivity", 3, local_id{99999}));
  refuse("partition 0 has the point -1", set(file, root + "Connectivity", 3, local_id{-1}));
  refuse("Offsets: element 1 of partition 0 begins at 5, not at 4",
         set(file, root + "Offsets", 1, local_id{5}));
  refuse("Types: it has elements of the types 10 and 5", set(file, root + "Types", 1, std::uint8_t{5}));
  refuse("Types: elements of type 12 are not read", set(file, root + "Types", 0, std::uint8_t{12}));
  refuse("NumberOfPoints: partition 0 has -1 entries",
         set(file, root + "NumberOfPoints", 0, std::int64_t{-1}));
  refuse("NumberOfCells: partition 0 has 9223372036854775807 entries",
         set(file, root + "NumberOfCells", 0, std::numeric_limits<std::int64_t>::max()));
  refuse("NumberOfPoints: the partitions do not add up",
         set(file, root + "NumberOfPoints", 0, std::int64_t{1}));
  refuse("GlobalNodeIds: the own points of subdomain 0 do not follow each other",
         set(file, root + "PointData/GlobalNodeIds", 26, global_id{5}));
  refuse("GlobalNodeIds: the number -5 is negative",
         set(file, root + "PointData/GlobalNodeIds", 0, global_id{-5}));
  refuse("subdomain 0: point 0 is not where the skeleton has it", [&] {
    change<global_id>(file, root + "PointData/GlobalNodeIds", [](auto& ids) { ids[0] = ids[1]; });
  });
  refuse("CellData/subdomain: an element of subdomain 0 says that it is of 1",
         set(file, root + "CellData/subdomain", 0, local_id{1}));
  refuse("it has the material 3, and the skeleton has names of 3", [&] {
    change<local_id>(file, root + "CellData/region", [](auto& regions) {
      for (local_id& region : regions)
        region = 3;
    });
  });
  refuse("CellData/region: subdomain 0 has more than one material",
         set(file, root + "CellData/region", 1, local_id{2}));
  refuse("pieces/subdomain: partition 0 is subdomain 4, not 0",
         set(file, "pieces/subdomain", 0, local_id{4}));
  refuse("pieces/skeleton_points: subdomain 0 has", set(file, "pieces/skeleton_points", 0, local_id{-2}));
  refuse("pieces/first_element: partition 1 begins with 7",
         set(file, "pieces/first_element", 1, global_id{7}));
  refuse("Points: it announces 1125899906842624 rows, for which the file is too small",
         [&] { replace<double>(file, root + "Points", {}, 3, std::uint64_t{1} << 50); });
  refuse("CellData/region: it is 1125899906842624, not 624",
         [&] { replace<local_id>(file, root + "CellData/region", {}, 1, std::uint64_t{1} << 50); });
  refuse("NumberOfPoints: it announces",
         [&] { replace<std::int64_t>(file, root + "NumberOfPoints", {}, 1, std::uint64_t{1} << 50); });
  refuse("Points: it has 2 columns, not 3", [&] {
    change<double>(
        file, root + "Points", [](auto& values) { values.resize(2 * values.size() / 3); }, 2);
  });
  refuse("Connectivity: its values are no whole numbers",
         [&] { replace(file, root + "Connectivity", std::vector<double>(4 * 624)); });
  refuse("GlobalNodeIds: it is missing", [&] {
    const hid_t of = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    H5Ldelete(of, "VTKHDF/PointData/GlobalNodeIds", H5P_DEFAULT);
    H5Fclose(of);
  });
  refuse("subdomain 0: point 0 is not where the skeleton has it", set(file, root + "Points", 0, 0.1, 3));
  refuse("subdomain 0: its sides are not those that the skeleton has of it", [&] {
    change<local_id>(file, root + "Connectivity", [](auto& corners) { std::swap(corners[0], corners[1]); });
  });
  refuse("mesh_0000.vtkhdf: HDF5 cannot read the file",
         [&] { testing::write_content(file, testing::file_content(file).substr(0, 20000)); });
  refuse("mesh_0000.vtkhdf: this is no HDF5 file", [&] { testing::write_content(file, "a letter"); });

  refuse("NumberOfCells: it is not of as many partitions", [&] {
    change<std::int64_t>(file, root + "NumberOfCells", [](auto& counts) { counts.push_back(0); });
  });
  refuse("NumberOfConnectivityIds: it is not 4 per element", [&] {
    change<std::int64_t>(file, root + "NumberOfConnectivityIds", [](auto& counts) {
      counts[0] += 4;
      counts[1] -= 4;
    });
  });
  refuse("point 0 has the number 99999, which is not that of its place",
         set(file, root + "PointData/GlobalNodeIds", 0, global_id{99999}));
  refuse("has not one number per partition",
         [&] { change<global_id>(file, "pieces/first_point", [](auto& first) { first.pop_back(); }); });

  const auto refuse_skeleton = [&](const std::string& expected, const std::function<void()>& spoil) {
    expect(skeleton, expected, read, spoil);
  };
  refuse_skeleton("subdomain 0: it has other points or elements than the skeleton says",
                  set(skeleton, "pieces/first_element", 1, global_id{47}));
  refuse_skeleton("there are not the numbers of 27 pieces", [&] {
    change<global_id>(skeleton, "pieces/first_point", [](auto& first) { first.pop_back(); });
  });
  refuse_skeleton("side 0 has the number 27, and there are 27",
                  set(skeleton, root + "CellData/subdomain", 0, local_id{27}));
  refuse_skeleton("cad_face: side 0 has the number 99",
                  set(skeleton, root + "CellData/cad_face", 0, local_id{99}));
  refuse_skeleton("side 0 has a CAD face and no patch", set(skeleton, root + "CellData/patch", 0, no_id));
  refuse_skeleton("its sides are not those that the skeleton has of it",
                  set(skeleton, root + "CellData/subdomain", 0, local_id{5}));
  refuse_skeleton("its sides are not those that the skeleton has of it", [&] {
    change<local_id>(skeleton, root + "Connectivity",
                     [](auto& corners) { std::swap(corners[0], corners[1]); });
  });
  refuse_skeleton("GlobalNodeIds: point 3 has the number 4",
                  set(skeleton, root + "PointData/GlobalNodeIds", 3, global_id{4}));

  refuse_skeleton("this is no skeleton of tetrahedra",
                  [&] { testing::write_content(skeleton, testing::file_content(file)); });
  refuse_skeleton("the first is not the number of points of the skeleton",
                  set(skeleton, "pieces/first_point", 0, global_id{1}));

  const std::string leaf = "<DataItem Dimensions=\"4\" Format=\"HDF\">a.h5:/b</DataItem>";
  for (const auto& [said, inside] :
       {std::array<std::string, 2>{"there is no <Grid> in the collection",
                                   "<Grid GridType=\"Collection\"></Grid>"},
        {"<Topology> has no <DataItem>", "<Grid><Topology/></Grid>"},
        {"has no NumberOfElements", "<Grid><Topology>" + leaf + "</Topology></Grid>"},
        {"has not its rows and its dataset", "<Grid><A><DataItem ItemType=\"HyperSlab\"/></A></Grid>"},
        {"has 2 numbers, not 3 or 6", "<Grid><A><DataItem ItemType=\"HyperSlab\"><DataItem>1 2</DataItem>" +
                                          leaf + "</DataItem></A></Grid>"},
        {"does not name a dataset", "<Grid><A><DataItem Dimensions=\"4\">a.h5:/b</DataItem></A></Grid>"},
        {"does not name a dataset", "<Grid><A><DataItem Format=\"HDF\">a.h5:/b</DataItem></A></Grid>"}}) {
    testing::write_content(folder / "small.xdmf", "<Xdmf><Domain>" + inside + "</Domain></Xdmf>");
    const auto refusal = testing::refusal_of<input_error>([&] { io::read_hdf5(folder / "small.xdmf"); });
    CHECK_MESSAGE(refusal.find(said) != std::string::npos, refusal);
  }

  const auto index = folder / "mesh.xdmf";
  const auto refuse_index = [&](const std::string& expected, const std::string& old,
                                const std::string& text) {
    expect(index, expected, read, [&] {
      auto content = testing::file_content(index);
      content.replace(content.find(old), old.size(), text);
      testing::write_content(index, content);
    });
  };
  refuse_index("mesh.xdmf: subdomain 0 has 49 elements, and 48 in", "NumberOfElements=\"48\"",
               "NumberOfElements=\"49\"");
  refuse_index("there is no <Grid> in a <Domain>", "<Domain>", "<Domain/><Domain>");
  refuse_index("dataset VTKHDF/Points: it is", "Dimensions=\"351 3\"", "Dimensions=\"350 3\"");
  refuse_index("mesh_0007.vtkhdf: there is no such file", "mesh_0001.vtkhdf:/VTKHDF/Conn",
               "mesh_0007.vtkhdf:/VTKHDF/Conn");
  refuse_index("are not those of the piece whose grid names them", ">192 1 192<", ">191 1 192<");
  refuse_index("has other rows than there are in", ">192 1 192<", ">192 2 192<");
  refuse_index("is no number", ">192 1 192<", ">192 x 192<");
  testing::expect_refusal_when_cut(index, 20, read);
  read();
  std::filesystem::remove(skeleton);
  CHECK(testing::refusal_of<input_error>(read).find("skeleton.vtkhdf: there is no such file") !=
        std::string::npos);
  std::filesystem::remove(index);
  CHECK(testing::refusal_of<input_error>([&] { io::read_hdf5(file); }).find("mesh.xdmf, is not there") !=
        std::string::npos);
}

TEST_CASE("ranks: a file with one thing changed is refused, in words that name it") {
  const testing::scratch_folder folder("hdf5_ranks_near");
  io::rank_writer<io::xdmf_format>{.ranks = 3}(cubes_in_27.distributed(), folder);
  const auto file = folder / "ranks.h5";
  const auto read = [&] { io::read_hdf5_ranks(file); };
  const auto refuse = [&](const std::string& expected, const std::function<void()>& spoil) {
    expect(file, expected, read, spoil);
  };
  const auto set = [&](const std::string& name, std::size_t at, auto value, std::uint64_t columns = 1) {
    return [=, &file] {
      change<decltype(value)>(
          file, name, [&](auto& values) { values.at(at) = value; }, columns);
    };
  };
  const std::string cells = "viz/topology/cells";
  refuse("viz/topology/cells: row 0 has the vertex 343, and there are 343", set(cells, 0, global_id{343}, 4));
  refuse("row 1 has the vertex -1", set(cells, 7, global_id{-1}, 4));
  refuse("geometry/vertices: a coordinate of vertex 1 is not finite",
         set("geometry/vertices", 4, std::nan(""), 3));
  refuse("cells/region: entry 0 is 3, and there are 3", set("cells/region", 0, local_id{3}));
  refuse("cells/subdomain: entry 9 is -1", set("cells/subdomain", 9, local_id{-1}));
  refuse("vertices/mesh_node: the number 5 is there twice", [&] {
    change<global_id>(file, "vertices/mesh_node", [](auto& ids) {
      for (std::size_t i = 0; i < 2; ++i)
        ids[i] = 5;
    });
  });
  refuse("cells/mesh_element: the number -7 is negative", set("cells/mesh_element", 0, global_id{-7}));
  refuse("ranks/first_cell: the numbers do not grow from 0 to 1296",
         set("ranks/first_cell", 1, global_id{2000}));
  refuse("ranks/first_vertex: vertex",
         [&] { change<global_id>(file, "ranks/first_vertex", [](auto& first) { first[1] -= 1; }); });
  refuse("ranks/first_cell: it has other ranks", [&] {
    change<global_id>(file, "ranks/first_cell", [](auto& first) { first.erase(first.begin() + 1); });
  });
  refuse("sides/vertices: side 0 is not turned outwards", [&] {
    change<global_id>(
        file, "sides/vertices", [](auto& ids) { std::swap(ids[0], ids[1]); }, 3);
  });
  refuse("sides/vertices: side 0 is none of an element", set("sides/vertices", 0, global_id{342}, 3));
  refuse("or a later one is twice in rank 0", [&] {
    change<global_id>(
        file, "sides/vertices", [](auto& ids) { std::copy(ids.begin(), ids.begin() + 3, ids.begin() + 3); },
        3);
  });
  refuse("sides/cad: entry 0 is -1", set("sides/cad", 0, local_id{-1}));
  refuse("sides/cad: entry 3 is 1000000, and there are", set("sides/cad", 3, local_id{1000000}));
  refuse("cells/subdomain: entry 7 is 99, and by its number the element is of",
         set("cells/subdomain", 7, local_id{99}));
  refuse("cells/subdomain: entry 1295 is 27, and by its number the element is of",
         set("cells/subdomain", 1295, local_id{27}));
  refuse("sides/patch: entry 0 is 9", set("sides/patch", 0, local_id{9}));
  refuse("viz/topology/cells: it announces",
         [&] { replace<global_id>(file, cells, {}, 4, std::uint64_t{1} << 50); });
  refuse("elements of 5 vertices are not read", [&] { replace<global_id>(file, cells, {}, 5, 10); });
  const auto index = folder / "ranks.xdmf";
  for (const auto& [old, text, expected] :
       {std::array{"343 3", "342 3", "has other dimensions in ranks.h5"},
        std::array{"NumberOfElements=\"1296\"", "NumberOfElements=\"1295\"",
                   "it has not one grid of 1296 elements"},
        std::array{"ranks.h5:/geometry", "other.h5:/geometry", "its grid is not of the whole of ranks.h5"}})
    expect(index, expected, read, [&, old = old, text = text] {
      auto content = testing::file_content(index);
      content.replace(content.find(old), std::string(old).size(), text);
      testing::write_content(index, content);
    });
  read();
  std::filesystem::remove(index);
  read();
}
