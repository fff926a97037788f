// HDF5 files of whole pieces: h5py, VTK and a reader of XDMF find the mesh that VTU files have
// (check_hdf5_pieces.py).
#include "files/file_size_limit.hpp"
#include "files/hdf5_at_exit.hpp"
#include "files/scratch_folder.hpp"
#include "files/script_outcome.hpp"
#include "files/stacked_cubes.hpp"

#include "dovetail/distributed/processes.hpp"
#include "dovetail/files/concepts.hpp"
#include "dovetail/files/finishing_pass.hpp"
#include "dovetail/files/hdf5_pieces.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/mesh/mid_nodes.hpp"
#include "dovetail/models/plane/svg_path.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using namespace dovetail;
using testing::cubes_in_eight;

static_assert(piecewise_mesh_writer<io::hdf5_writer> && piecewise_mesh_writer<io::hdf5_writer, 2>);

namespace {

testing::script_outcome compare(const std::filesystem::path& folder,
                                const std::filesystem::path& vtu_folder) {
  return testing::run_script(DOVETAIL_TESTS "/check_hdf5_pieces.py '" + folder.string() + "' mesh '" +
                                 (vtu_folder / "mesh.pvtu").string() + "'",
                             folder);
}

bool has_readers() {
  const char* command = "/usr/bin/python3 -c 'import h5py, numpy, vtkmodules.vtkIOHDF' > /dev/null 2>&1";
  if (std::system(command) == 0)
    return true;
  MESSAGE("skipped: Python has no h5py, or VTK none of HDF");
  return false;
}

/// Writes both, and expects the same mesh.
template <int D>
void check_readers(const distributed_simplicial_mesh<D>& mesh, int files, const std::string& expected) {
  CAPTURE(files);
  const testing::scratch_folder folder("hdf5_pieces");
  io::vtu_writer{.files = files}(mesh, folder / "vtu");
  io::hdf5_writer{.files = files}(mesh, folder / "hdf5");
  const auto found = compare(folder / "hdf5", folder / "vtu");
  INFO(found.log);
  CHECK(found.status == 0);
  CHECK(found.log.find(expected) != std::string::npos);
}

distributed_mesh with_straight_middles(distributed_mesh mesh) {
  mid_edge_nodes<3> nodes;
  nodes.edges = edges_of(mesh.skeleton);
  const auto& points = mesh.skeleton.points;
  for (const auto& [a, b] : nodes.edges)
    nodes.points.push_back(midpoint(points[a], points[b]));
  for (local_id p = 0; static_cast<std::size_t>(p) < mesh.counts.size(); ++p) {
    const auto found = edges_of(mesh.load(p), nodes);
    nodes.inner.push_back(std::count(found.in_skeleton.begin(), found.in_skeleton.end(), no_id));
  }
  mesh.mid_nodes = std::make_shared<const mid_edge_nodes<3>>(nodes);
  return mesh;
}

} // namespace

TEST_CASE("h5py, VTK and the XDMF file show the mesh of the VTU files") {
  if (!has_readers())
    return;
  const auto mesh = cubes_in_eight.distributed();
  for (const int files : {0, 3, 1})
    check_readers<3>(mesh, files, " files, 3072 elements, 729 points, 1152 sides, measure 1.000000000");
}

TEST_CASE("second-order elements too") {
  if (!has_readers())
    return;
  check_readers<3>(with_straight_middles(cubes_in_eight.distributed()), 3, "3 files, 3072 elements, ");
}

TEST_CASE("triangles too, whose faces differ within a piece") {
  if (!has_readers())
    return;
  const plane_domain domain(drawing_from_svg_path("M0 0 H3 V2 H0 Z"));
  const auto result = generate<2>(domain, uniform_size(0.2), parameters<>{}.with_options({.subdomains = 5}));
  check_readers<2>(result.mesh, 2, "2 files, ");
}

TEST_CASE("a file that was changed is another mesh") {
  if (!has_readers())
    return;
  const testing::scratch_folder folder("hdf5_changed");
  io::vtu_writer{}(cubes_in_eight.distributed(), folder / "vtu");
  io::hdf5_writer{}(cubes_in_eight.distributed(), folder / "hdf5");
  auto index = testing::file_content(folder / "hdf5/mesh.xdmf");
  index.replace(index.find("mesh_0001.vtkhdf:/VTKHDF/Points"), 9, "mesh_0002");
  testing::write_content(folder / "hdf5/mesh.xdmf", index);
  CHECK(compare(folder / "hdf5", folder / "vtu").status != 0);
  auto moved = cubes_in_eight.distributed();
  moved.skeleton.points.own()[7].x += 1e-9;
  io::hdf5_writer{}(moved, folder / "hdf5");
  CHECK(compare(folder / "hdf5", folder / "vtu").status != 0);
}

TEST_CASE("the files are the same by every executor, at any time") {
  const testing::scratch_folder folder("hdf5_executors");
  const auto mesh = cubes_in_eight.distributed();
  const auto summary = io::hdf5_writer{.files = 3}(mesh, folder / "alone");
  const auto expected = testing::content_of(folder / "alone");
  std::uint64_t bytes = 0;
  for (const auto& [name, content] : expected)
    bytes += content.size();
  CHECK(summary.get("elements") == 3072);
  CHECK(summary.get("files") == 5);
  CHECK(summary.get("bytes") == static_cast<double>(bytes));
  std::this_thread::sleep_for(std::chrono::milliseconds(1100)); // HDF5's times are in seconds
  const auto check = [&](const char* name, const any_executor& run_tasks) {
    CAPTURE(name);
    const auto finished =
        io::finish_mesh<3>(mesh, {io::hdf5_writer{.files = 3}}, folder / name, run_tasks, {.release = true});
    CHECK(finished.hash == io::mesh_hash(mesh));
    CHECK(testing::content_of(folder / name) == expected);
  };
  check("serial", parallel::serial{});
  check("processes", parallel::processes{.worker_count = 2});
  check("threads", parallel::threads{.worker_count = 4});
}

TEST_CASE("pieces are given up once their files are complete, and a second run goes on from there") {
  const testing::scratch_folder folder("hdf5_resumed");
  io::hdf5_writer{.files = 4}(cubes_in_eight.distributed(), folder / "expected");
  std::map<local_id, piece_note> notes;
  std::set<local_id> gone;
  std::vector<local_id> loads;
  auto mesh = cubes_in_eight.distributed();
  bool is_damaged = true;
  mesh.load = [&, load = mesh.load](local_id p) {
    loads.push_back(p);
    if (gone.contains(p) || (p == 5 && is_damaged))
      throw io_error("a damaged file");
    return load(p);
  };
  mesh.release = [&](local_id p, const piece_note& note) {
    gone.insert(p);
    notes[p] = note;
  };
  mesh.released = [&](local_id p) { return notes.contains(p) ? std::optional(notes[p]) : std::nullopt; };
  const auto finish = [&] {
    return io::finish_mesh<3>(mesh, {io::hdf5_writer{.files = 4}}, folder / "out", parallel::serial{},
                              {.release = true});
  };
  CHECK_THROWS_WITH_AS(finish(), "a damaged file", io_error);
  CHECK(gone == std::set<local_id>{0, 1, 2, 3, 6, 7});
  CHECK(testing::content_of(folder / "out").size() == 1); // the folder of unfinished files
  loads.clear();
  is_damaged = false;
  CHECK(finish().summary.get("taken_over") == 3);
  CHECK(loads == std::vector<local_id>{4, 5});
  CHECK(testing::content_of(folder / "out") == testing::content_of(folder / "expected"));
}

TEST_CASE("a file that would not fit leaves no trace, and the error names it and the reason") {
  const testing::scratch_folder folder("hdf5_full");
  for (const std::size_t bytes : {0, 500, 10000, 20000}) {
    CAPTURE(bytes);
    const testing::file_size_limit limit(bytes);
    try {
      io::hdf5_writer{}(cubes_in_eight.distributed(), folder);
      FAIL_CHECK("it fits");
    } catch (const io_error& error) {
      const std::string said = error.what();
      CAPTURE(said);
      CHECK(said.find("mesh_0000.vtkhdf.part: ") != std::string::npos);
      CHECK(said.ends_with(": File too large"));
    }
    CHECK(testing::content_of(folder).empty());
  }
}

TEST_CASE("files of an earlier mesh in the folder disappear, other files stay") {
  const testing::scratch_folder folder("hdf5_stale");
  io::hdf5_writer{}(cubes_in_eight.distributed(), folder);
  testing::write_content(folder / "mesh_mine.vtkhdf", "x");
  io::hdf5_writer{.files = 2}(cubes_in_eight.distributed(), folder);
  std::set<std::string> names;
  for (const auto& [name, content] : testing::content_of(folder))
    names.insert(name);
  CHECK(names == std::set<std::string>{"mesh.xdmf", "mesh_0000.vtkhdf", "mesh_0001.vtkhdf",
                                       "mesh_mine.vtkhdf", "skeleton.vtkhdf"});
}

TEST_CASE("a piece that has not the skeleton's points, or comes out of turn, is refused") {
  const testing::scratch_folder folder("hdf5_disagree");
  auto mesh = cubes_in_eight.distributed();
  mesh.load = [load = mesh.load](local_id p) {
    auto piece = load(p);
    if (p == 2) {
      piece.mesh.points.insert(piece.mesh.points.begin(), vec3{});
      piece.skeleton_points.insert(piece.skeleton_points.begin(), 0);
    }
    return piece;
  };
  CHECK_THROWS_WITH_AS(io::hdf5_writer{}(mesh, folder), doctest::Contains("subdomain 2"), mesh_error);
  const auto other = cubes_in_eight.distributed();
  {
    const auto file = io::hdf5_writer{}.begin(other, folder).open(1);
    CHECK(testing::content_of(folder).contains("mesh_0001.vtkhdf.part"));
    CHECK_THROWS_WITH_AS(file.add(other.load(0)), doctest::Contains("subdomain 0 is not the next"),
                         mesh_error);
  }
  CHECK(testing::content_of(folder).empty()); // what is not closed leaves nothing
}
