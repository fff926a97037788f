// HDF5 files of parallel solvers, filled by all ranks at once: h5py and VTK read them (check_rank_files.py).
#include "files/bent_edges.hpp"
#include "files/file_size_limit.hpp"
#include "files/hdf5_at_exit.hpp"
#include "files/scratch_folder.hpp"
#include "files/script_outcome.hpp"
#include "files/stacked_cubes.hpp"

#include "dovetail/distributed/processes.hpp"
#include "dovetail/distributed/ranks.hpp"
#include "dovetail/files/finishing_pass.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "dovetail/models/plane/svg_path.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/parallel/in_process.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "dovetail/solver/hdf5_format.hpp"
#include "dovetail/solver/mfem_format.hpp"
#include "dovetail/solver/pvtu_format.hpp"
#include "dovetail/solver/rank_files.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace dovetail;
using testing::cubes_in_27;

namespace {

testing::script_outcome check(const std::string& format, const std::filesystem::path& folder, int ranks) {
  return testing::run_script(DOVETAIL_TESTS "/check_rank_files.py " + format + " '" + folder.string() + "' " +
                                 std::to_string(ranks),
                             folder);
}

bool has_python_module(const std::string& name) {
  if (std::system(("/usr/bin/python3 -c 'import numpy, " + name + "' > /dev/null 2>&1").c_str()) == 0)
    return true;
  MESSAGE("skipped: Python has no " << name);
  return false;
}

const std::string one_mesh = "1296 elements, 343 vertices, 432 boundary sides, measure 1.000000000, ";

} // namespace

TEST_CASE("plain arrays with an XDMF file: h5py reads one mesh") {
  if (!has_python_module("h5py"))
    return;
  const testing::scratch_folder folder("ranks_xdmf");
  const auto summary = io::rank_writer<io::xdmf_format>{.ranks = 4}(cubes_in_27.distributed(), folder);
  CHECK(summary.get("files") == 2);
  const auto found = check("xdmf", folder, 4);
  INFO(found.log);
  CHECK(found.status == 0);
  CHECK(found.log.find(one_mesh) != std::string::npos);
  CHECK(found.log.find("'side walls': 288") != std::string::npos);
  CHECK(found.log.find("regions: ['solid \"0\" <&>', ") != std::string::npos);
  auto spoilt = testing::file_content(folder / "ranks.xdmf");
  spoilt.replace(spoilt.find("343 3"), 5, "342 3");
  testing::write_content(folder / "ranks.xdmf", spoilt);
  CHECK(check("xdmf", folder, 4).status != 0);
}

TEST_CASE("plain arrays of second order: h5py reads nodes in the middle of edges, in XDMF's order") {
  if (!has_python_module("h5py"))
    return;
  const auto mesh = testing::with_bent_edges(cubes_in_27.distributed());
  const testing::scratch_folder folder("ranks_xdmf_quadratic");
  io::rank_writer<io::xdmf_format>{.ranks = 4}(mesh, folder);
  const auto found = check("xdmf", folder, 4);
  INFO(found.log);
  CHECK(found.status == 0);
  CHECK(found.log.find("1296 elements, 2197 vertices, 432 boundary sides, measure 1.000000000") !=
        std::string::npos);
  CHECK(testing::file_content(folder / "ranks.xdmf").find("\"Tetrahedron_10\"") != std::string::npos);
  const std::string exchange =
      "import h5py; f = h5py.File('" + (folder / "ranks.h5").string() +
      "', 'r+'); c = f['viz/topology/cells']; c[5] = c[5][[0, 1, 2, 3, 4, 6, 5, 7, 8, 9]]";
  REQUIRE(std::system(("/usr/bin/python3 -c \"" + exchange + "\"").c_str()) == 0);
  CHECK(check("xdmf", folder, 4).status != 0);
}

TEST_CASE("plain arrays of triangles, of first and second order: h5py reads one mesh") {
  if (!has_python_module("h5py"))
    return;
  const plane_domain domain(drawing_from_svg_path("M0 0 H3 V2 H0 Z"));
  const auto result = generate<2>(domain, uniform_size(0.2), parameters<>{}.with_options({.subdomains = 7}));
  const testing::scratch_folder folder("ranks_xdmf_triangles");
  for (const auto& mesh : {result.mesh, testing::with_bent_edges(result.mesh)}) {
    io::rank_writer<io::xdmf_format>{.ranks = 3}(mesh, folder);
    const auto found = check("xdmf", folder, 3);
    INFO(found.log);
    CHECK(found.status == 0);
    CHECK(found.log.find("measure 6.000000000") != std::string::npos);
    CHECK(found.log.find(" " + std::to_string(io::number_nodes(mesh).points()) + " vertices") !=
          std::string::npos);
    const auto topology = testing::file_content(folder / "ranks.xdmf");
    CHECK((topology.find("\"Triangle_6\"") != std::string::npos) == (mesh.mid_nodes != nullptr));
  }
}

TEST_CASE("what the arrays say of each vertex, element and side is the same in all formats") {
  if (!has_python_module("h5py, vtkmodules.vtkIOHDF, vtkmodules.vtkIOXML"))
    return;
  const auto mesh = cubes_in_27.distributed();
  const testing::scratch_folder folder("ranks_agree");
  io::vtu_writer{}(mesh, folder);
  io::rank_writer<io::pvtu_format>{.ranks = 3, .ghosts = true}(mesh, folder);
  io::rank_writer<io::xdmf_format>{.ranks = 3}(mesh, folder);
  io::rank_writer<io::vtkhdf_format>{.ranks = 3, .ghosts = true}(mesh, folder);
  io::rank_writer<io::mfem_format>{.ranks = 3}(mesh, folder);
  const auto found = check("agreement", folder, 3);
  INFO(found.log);
  CHECK(found.status == 0);
  std::map<local_id, int> sides; // of the boundary; those between two ranks are listed by both
  for (std::size_t t = 0; t < mesh.skeleton.sides.size(); ++t)
    if (mesh.skeleton.subdomains[t][1] == no_id)
      ++sides[mesh.skeleton.side_hosts[t]];
  REQUIRE(sides.size() > 10);
  const auto counts = found.log.substr(found.log.find("sides by cad: {") + 14); // "{0: 72, 4: 24}"
  for (const auto& [host, count] : sides) {
    const auto of_host = std::to_string(host) + ": " + std::to_string(count);
    CHECK((counts.find("{" + of_host + ",") == 0 || counts.find(" " + of_host + ",") != std::string::npos ||
           counts.find(" " + of_host + "}") != std::string::npos));
  }
  for (const char* array : {"cells/region", "cells/subdomain", "cells/mesh_element", "vertices/mesh_node",
                            "geometry/vertices", "viz/topology/cells"}) {
    CAPTURE(array);
    const testing::scratch_folder spoilt("ranks_spoilt");
    std::filesystem::copy(folder, spoilt, std::filesystem::copy_options::recursive);
    const std::string reverse = "import h5py; f = h5py.File('" + (spoilt / "ranks.h5").string() +
                                "', 'r+'); f['" + array + "'][:] = f['" + array + "'][:][::-1]";
    REQUIRE(std::system(("/usr/bin/python3 -c \"" + reverse + "\"").c_str()) == 0);
    CHECK(check("agreement", spoilt, 3).status != 0);
  }
}

TEST_CASE("nodes in the middle of edges are the same in all formats") {
  if (!has_python_module("h5py, vtkmodules.vtkIOHDF, vtkmodules.vtkIOXML"))
    return;
  const auto mesh = testing::with_bent_edges(cubes_in_27.distributed());
  const testing::scratch_folder folder("ranks_agree_quadratic");
  io::vtu_writer{}(mesh, folder);
  io::rank_writer<io::pvtu_format>{.ranks = 5, .ghosts = true}(mesh, folder);
  io::rank_writer<io::xdmf_format>{.ranks = 5}(mesh, folder);
  io::rank_writer<io::vtkhdf_format>{.ranks = 5}(mesh, folder);
  io::rank_writer<io::mfem_format>{.ranks = 5}(mesh, folder);
  const auto found = check("agreement", folder, 5);
  INFO(found.log);
  CHECK(found.status == 0);
  auto spoilt = testing::file_content(folder / "mesh.000002");
  const auto last = spoilt.rfind('\n', spoilt.find("\nmfem_serial_mesh_end") - 2);
  spoilt[last + 1] = spoilt[last + 1] == '-' ? ' ' : '-'; // one node elsewhere
  testing::write_content(folder / "mesh.000002", spoilt);
  CHECK(check("agreement", folder, 5).status != 0);
}

TEST_CASE("VTKHDF: VTK reads one mesh, with ghosts") {
  if (!has_python_module("vtkmodules.vtkIOHDF"))
    return;
  const testing::scratch_folder folder("ranks_vtkhdf");
  io::rank_writer<io::vtkhdf_format>{.ranks = 3, .ghosts = true}(cubes_in_27.distributed(), folder);
  const auto found = check("vtkhdf", folder, 3);
  INFO(found.log);
  CHECK(found.status == 0);
  CHECK(found.log.starts_with(one_mesh));
  CHECK(found.log.find(" 0 ghosts") == std::string::npos);
  CHECK(check("vtkhdf", folder, 4).status != 0); // there is no rank 3
}

TEST_CASE("VTKHDF of second order: VTK reads nodes in the middle of edges, with and without ghosts") {
  if (!has_python_module("vtkmodules.vtkIOHDF"))
    return;
  const auto mesh = testing::with_bent_edges(cubes_in_27.distributed());
  for (const bool ghosts : {false, true}) {
    const testing::scratch_folder folder("ranks_vtkhdf_quadratic");
    io::rank_writer<io::vtkhdf_format>{.ranks = 4, .ghosts = ghosts}(mesh, folder);
    const auto found = check("vtkhdf", folder, 4);
    INFO(found.log);
    CHECK(found.status == 0);
    CHECK(found.log.starts_with("1296 elements, 2197 vertices, 432 boundary sides, measure 1.000000000"));
    CHECK((found.log.find(" 0 ghosts") == std::string::npos) == ghosts);
  }
}

TEST_CASE("VTKHDF: VTK reads triangles") {
  if (!has_python_module("vtkmodules.vtkIOHDF"))
    return;
  const plane_domain domain(drawing_from_svg_path("M0 0 H3 V2 H0 Z M1 1 h0.5 v0.5 h-0.5 Z"));
  const auto result = generate<2>(domain, uniform_size(0.2), parameters<>{}.with_options({.subdomains = 7}));
  const testing::scratch_folder folder("ranks_vtkhdf_triangles");
  io::rank_writer<io::vtkhdf_format>{.ranks = 3}(result.mesh, folder);
  const auto found = check("vtkhdf", folder, 3);
  INFO(found.log);
  CHECK(found.status == 0);
  CHECK(found.log.find("measure 5.750000000") != std::string::npos);
}

TEST_CASE("each rank's share is a task, and the bytes are the same by every executor") {
  const auto compare = [&](const auto& mesh, const auto& writer) {
    CAPTURE(writer.format.name());
    const testing::scratch_folder alone("ranks_hdf5_alone"), folder("ranks_hdf5_tasks");
    writer(mesh, alone);
    const auto expected = testing::content_of(alone);
    const auto check_files = [&](const any_executor& run_tasks) {
      const auto finished = io::finish_mesh<3>(mesh, {writer}, folder, run_tasks);
      CHECK(finished.summary.get("tasks") == 27 + 4 + 4); // pieces, counts of ranks, shares of ranks
    };
    for (const auto& run_tasks :
         {any_executor(parallel::serial{}), any_executor(parallel::processes{.worker_count = 1}),
          any_executor(parallel::processes{.worker_count = 4}),
          any_executor(parallel::threads{.worker_count = 3})}) {
      check_files(run_tasks);
      CHECK(testing::content_of(folder) == expected);
    }
    parallel::run_ranks(3, [&](parallel::in_process& mine) { check_files(parallel::ranks(mine)); });
    CHECK(testing::content_of(folder) == expected);
  };
  const auto mesh = cubes_in_27.distributed();
  compare(mesh, io::rank_writer<io::xdmf_format>{.ranks = 4});
  compare(testing::with_bent_edges(mesh), io::rank_writer<io::xdmf_format>{.ranks = 4});
  compare(mesh, io::rank_writer<io::vtkhdf_format>{.ranks = 4});
  compare(mesh, io::rank_writer<io::vtkhdf_format>{.ranks = 4, .ghosts = true});
}

TEST_CASE(
    "a share is written with the pieces of its rank in memory, in any order; ghosts do not change XDMF's") {
  auto mesh = cubes_in_27.distributed();
  std::vector<local_id> loads;
  mesh.load = [&loads, load = mesh.load](local_id p) {
    loads.push_back(p);
    return load(p);
  };
  const testing::scratch_folder alone("ranks_hdf5_alone"), folder("ranks_hdf5_shares");
  const io::rank_writer<io::xdmf_format, redistribution_by::blocks> writer{.ranks = 3};
  writer(mesh, alone);
  const auto output = writer.begin(mesh, folder);
  loads.clear();
  std::vector<byte_buffer> counted;
  for (const auto& count : output.counts)
    counted.push_back(count.run());
  output.prepare(counted);
  CHECK(loads.empty());
  REQUIRE(output.others.size() == 3);
  for (const local_id q : {2, 0, 1}) {
    loads.clear();
    output.others[q].run();
    CHECK(loads.size() == 9);
    for (const local_id p : loads)
      CHECK(p / 9 == q);
  }
  output.finish(folder);
  CHECK(testing::content_of(folder) == testing::content_of(alone));
  io::rank_writer<io::xdmf_format, redistribution_by::blocks>{.ranks = 3, .ghosts = true}(mesh, folder);
  CHECK(testing::content_of(folder) == testing::content_of(alone));
}

TEST_CASE("on a full disk there is an error that names the file, and no file") {
  const testing::scratch_folder folder("ranks_hdf5_full");
  std::optional<testing::file_size_limit> limit;
  auto mesh = cubes_in_27.distributed();
  mesh.load = [&limit, load = mesh.load](local_id p) { // not before the file has been laid out
    if (!limit)
      limit.emplace(10000);
    return load(p);
  };
  const auto check_refused = [&](const auto& writer, const any_executor& run_tasks) {
    CAPTURE(writer.format.name());
    CHECK_THROWS_WITH_AS(io::finish_mesh<3>(mesh, {writer}, folder, run_tasks),
                         doctest::Contains("0.rank_file: File too large"), io_error);
    limit.emplace(10000);
    CHECK_THROWS_WITH_AS(io::finish_mesh<3>(mesh, {writer}, folder, run_tasks),
                         doctest::Contains("0.rank_file: HDF5: File too large"), io_error);
    limit.reset();
    CHECK(testing::file_count(folder) == 0);
  };
  for (const auto& run_tasks :
       {any_executor(parallel::serial{}), any_executor(parallel::processes{.worker_count = 2})}) {
    check_refused(io::rank_writer<io::xdmf_format>{.ranks = 4}, run_tasks);
    check_refused(io::rank_writer<io::vtkhdf_format>{.ranks = 4}, run_tasks);
  }
}

TEST_CASE("rows go where they belong, and nowhere else") {
  const testing::scratch_folder folder("hdf5_slices");
  const auto path = folder / "rows.h5";
  {
    io::detail::hdf5_file file(path);
    file.create_in_place<local_id>("of/pairs", 3, 2);
    file.add("given", std::vector<global_id>{5, 7});
    file.close();
  }
  io::detail::hdf5_slices slices(path);
  CHECK(slices.read<global_id>("given") == std::vector<global_id>{5, 7});
  slices.write("of/pairs", 1, std::vector<local_id>{3, 4, 5, 6}, 2);
  slices.write("of/pairs", 0, std::vector<local_id>{1, 2}, 2);
  slices.write("of/pairs", 3, std::vector<local_id>{}, 2);
  CHECK_THROWS_WITH_AS(slices.write("of/pairs", 2, std::vector<local_id>{7, 8, 9, 9}, 2),
                       doctest::Contains("of/pairs has no room for rows 2 to 3"), io_error);
  CHECK_THROWS_WITH_AS(slices.write("nothing", 0, std::vector<local_id>{1}), doctest::Contains("rows.h5"),
                       io_error);
  slices.close();
  CHECK(io::detail::hdf5_file(path, io::detail::hdf5_file::access::read).read<local_id>("of/pairs") ==
        std::vector<local_id>{1, 2, 3, 4, 5, 6});
  CHECK_THROWS_WITH_AS(io::detail::hdf5_slices(folder / "none.h5"), doctest::Contains("none.h5"), io_error);
}

TEST_CASE("a file that cannot be made is named, and HDF5 prints nothing") {
  const testing::scratch_folder folder("ranks_hdf5");
  const auto mesh = cubes_in_27.distributed();
  const io::rank_source<3> source{mesh, io::number_by_ranks(mesh, std::vector<local_id>(27, 0), 1)};
  CHECK_THROWS_WITH_AS(io::vtkhdf_format{}.lay_out<3>(source, {{}}, {folder / "none" / "ranks.vtkhdf"}),
                       doctest::Contains("ranks.vtkhdf: HDF5"), io_error);
}
