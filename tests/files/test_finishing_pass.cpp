#include "dovetail/core/encoding.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/files/concepts.hpp"
#include "dovetail/files/finishing_pass.hpp"
#include "dovetail/files/msh_writer.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"
#include "files/scratch_folder.hpp"
#include "files/stacked_cubes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <string>
#include <vector>

using namespace dovetail;
using testing::cubes_in_eight;

static_assert(piecewise_mesh_writer<io::vtu_writer> && piecewise_mesh_writer<io::vtu_writer, 2> &&
              piecewise_mesh_writer<io::msh_writer> && piecewise_mesh_writer<io::msh_writer, 2>);

namespace {

io::vtu_writer vtu(int files = 0, const std::string& stem = "mesh") {
  return {.files = files, .stem = stem};
}

std::int64_t all_low(const poor_elements& poor) {
  return std::accumulate(poor.low.begin(), poor.low.end(), std::int64_t{0});
}

/// Writes where there is no folder.
struct lost_writer {
  io::piecewise_output<3> begin(const distributed_mesh& mesh, const std::filesystem::path& unfinished) const {
    return io::vtu_writer{}.begin(mesh, unfinished / "no_such_folder");
  }
};

/// Pieces that can be given up, as in a spool.
struct store {
  std::map<local_id, piece_note> notes = {};
  std::set<local_id> gone = {};
  std::vector<local_id> loads = {};

  distributed_mesh mesh() {
    auto result = cubes_in_eight.distributed();
    result.load = [this, load = result.load](local_id p) {
      loads.push_back(p);
      if (gone.contains(p))
        throw io_error("the piece was given up");
      return load(p);
    };
    result.release = [this](local_id p, const piece_note& note) {
      gone.insert(p);
      if (!note.files.empty())
        notes[p] = note;
    };
    result.released = [this](local_id p) {
      return notes.contains(p) ? std::optional(notes.at(p)) : std::nullopt;
    };
    return result;
  }
};

} // namespace

TEST_CASE("hash, statistics and files are the same by every executor") {
  const testing::scratch_folder folder("finish_executors");
  const auto mesh = cubes_in_eight.distributed();
  const auto whole = measure_quality(cubes_in_eight.whole());
  const auto numbers = io::number_globally(mesh);
  quality_statistics expected;
  for (std::size_t p = 0; p < mesh.counts.size(); ++p)
    expected.merge(measure_quality(mesh.load(static_cast<local_id>(p)).mesh), numbers.first_element[p]);
  for (const int count : {0, 3, 1}) {
    const auto name = std::to_string(count);
    io::vtu_writer{.files = count}(mesh, folder / name);
    const auto files = testing::content_of(folder / name);
    const auto check = [&](const any_executor& run_tasks) {
      const auto finished = io::finish_mesh<3>(mesh, {vtu(count)}, folder / (name + "by tasks"), run_tasks);
      CHECK(finished.hash == io::mesh_hash(mesh));
      CHECK(finished.quality.elements == whole.elements);
      CHECK(finished.quality.min_dihedral_deg == whole.min_dihedral_deg);
      CHECK(finished.quality.worst_element == expected.worst_element);
      CHECK(finished.quality.min_dihedrals.bins == whole.min_dihedrals.bins);
      REQUIRE(finished.summary.children.size() == 1);
      CHECK(finished.summary.children[0].get("files") == static_cast<double>(files.size()));
      CHECK(testing::content_of(folder / (name + "by tasks")) == files);
    };
    check(parallel::serial{});
    for (const int workers : {1, 2, 4})
      check(parallel::processes{.worker_count = workers});
    check(parallel::threads{.worker_count = 3});
  }
}

TEST_CASE("a piece whose quality is known is not measured again") {
  auto mesh = cubes_in_eight.distributed();
  const auto finished = [&] { return io::finish_mesh<3>(mesh, {}, ".", parallel::serial{}); };
  const auto measured = finished();
  for (std::size_t p = 0; p < mesh.counts.size(); ++p) {
    mesh.quality.push_back({measure_quality(mesh.load(static_cast<local_id>(p)).mesh)});
    mesh.quality.back().all.min_dihedral_deg = 0.5 + static_cast<double>(p);
  }
  const auto known = finished();
  CHECK(measured.quality.min_dihedral_deg > 1);
  CHECK(known.quality.min_dihedral_deg == 0.5);
  CHECK(known.quality.min_dihedrals.bins == measured.quality.min_dihedrals.bins);
  CHECK(encoded(known.at_interfaces) == encoded(measured.at_interfaces));

  for (piece_quality& quality : mesh.quality)
    quality.at_interfaces.emplace().rest.add(60);
  const auto known_apart = finished().at_interfaces;
  CHECK(known_apart.touching.elements == 0);
  CHECK(known_apart.rest.elements == static_cast<std::int64_t>(mesh.counts.size()));
}

TEST_CASE("a piece is loaded once, whatever is written of it") {
  const testing::scratch_folder folder("finish_once");
  store pieces;
  for (const auto& writers : {std::vector<io::any_piecewise_writer<3>>{},
                              {vtu(3)},
                              {vtu(1)},
                              {vtu(4), vtu(2, "again"), vtu(0, "third")}}) {
    pieces.loads.clear();
    const auto finished = io::finish_mesh<3>(pieces.mesh(), writers, folder, parallel::serial{});
    CHECK(pieces.loads.size() == 8);
    CHECK(std::set<local_id>(pieces.loads.begin(), pieces.loads.end()).size() == 8);
    CHECK(finished.hash == io::mesh_hash(cubes_in_eight.distributed()));
    CHECK(pieces.gone.empty());
    double bytes = 0;
    for (const auto& summary : finished.summary.children)
      bytes += summary.get("bytes");
    CHECK((bytes > 0) == !writers.empty());
  }
  for (const std::string stem : {"mesh", "again", "third"})
    CHECK(std::filesystem::exists(folder / (stem + ".pvtu")));
  CHECK_FALSE(std::filesystem::exists(folder / "unfinished"));
}

TEST_CASE("a piece that does not fit is an error that names it, and the files stay as they were") {
  const testing::scratch_folder folder("finish_faults");
  io::vtu_writer{.files = 2}(cubes_in_eight.distributed(), folder);
  const auto before = testing::content_of(folder);
  const auto refused = [&](const distributed_mesh& mesh, const char* place) {
    CAPTURE(place);
    for (const any_executor& run_tasks :
         {any_executor(parallel::serial{}), any_executor(parallel::processes{.worker_count = 2})}) {
      CHECK_THROWS_WITH_AS(io::finish_mesh<3>(mesh, {vtu()}, folder, run_tasks), doctest::Contains(place),
                           mesh_error);
      CHECK_THROWS_WITH_AS(io::finish_mesh<3>(mesh, {}, folder, run_tasks), doctest::Contains("subdomain 3"),
                           mesh_error);
      CHECK(testing::content_of(folder) == before);
    }
  };
  refused(cubes_in_eight.spoilt(
              3, [](mesh_piece& p) { p.mesh.points[7].y = std::nextafter(p.mesh.points[7].y, 2.0); }),
          "moved skeleton point (first: ");
  auto open =
      cubes_in_eight.spoilt(3, [](mesh_piece& p) { p.mesh.elements.pop_back(), p.mesh.tags.pop_back(); });
  --open.counts[3].elements;
  refused(open, "boundary side that is not in the skeleton (first: ");
  refused(cubes_in_eight.spoilt(
              3, [](mesh_piece& p) { std::swap(p.mesh.elements[17][0], p.mesh.elements[17][1]); }),
          "inverted element (17)");
  refused(cubes_in_eight.spoilt(3, [](mesh_piece& p) { p.mesh.tags[4] = 7; }), "wrong material (first: 4)");
  auto lost = cubes_in_eight.distributed();
  for (std::size_t t = 0; t < lost.skeleton.sides.size(); ++t)
    if (lost.skeleton.subdomains[t] == std::array<local_id, 2>{3, no_id}) {
      std::swap(lost.skeleton.sides.own()[t][0], lost.skeleton.sides.own()[t][1]);
      refused(lost, ("missing skeleton side (first: " + std::to_string(t)).c_str());
      break;
    }
}

TEST_CASE("a folder that cannot be written is an io_error from every executor") {
  const testing::scratch_folder folder("finish_unwritable");
  testing::write_content(folder / "file", "x");
  for (const any_executor& run_tasks :
       {any_executor(parallel::serial{}), any_executor(parallel::processes{.worker_count = 2})})
    CHECK_THROWS_WITH_AS(
        io::finish_mesh<3>(cubes_in_eight.distributed(), {vtu()}, folder / "file", run_tasks),
        doctest::Contains("file"), io_error);
  CHECK_THROWS_WITH_AS(io::finish_mesh<3>(cubes_in_eight.distributed(), {lost_writer{}}, folder,
                                          parallel::processes{.worker_count = 2}),
                       doctest::Contains("no_such_folder/"), io_error);
}

TEST_CASE("pieces are given up once their files are complete, and a second run goes on from there") {
  const testing::scratch_folder folder("finish_resumed");
  io::vtu_writer{.files = 4}(cubes_in_eight.distributed(), folder / "expected");
  store pieces;
  auto mesh = pieces.mesh();
  mesh.load = [load = mesh.load](local_id p) {
    if (p == 5)
      throw io_error("a damaged file");
    return load(p);
  };
  const auto finish = [&](const distributed_mesh& given, int files) {
    return io::finish_mesh<3>(given, {vtu(files)}, folder / "out", parallel::serial{}, {.release = true});
  };
  CHECK_THROWS_WITH_AS(finish(mesh, 4), "a damaged file", io_error);
  CHECK(pieces.gone == std::set<local_id>{0, 1, 2, 3, 6, 7});
  CHECK(testing::content_of(folder / "out").size() == 1); // the folder of unfinished files

  // Killed between two pieces of a file.
  pieces.gone.erase(7);
  pieces.notes.erase(7);
  CHECK_THROWS_WITH_AS(finish(pieces.mesh(), 8), doctest::Contains("mesh_0000.vtu"), usage_error);
  CHECK_THROWS_WITH_AS(io::finish_mesh<3>(pieces.mesh(), {}, folder / "out", parallel::serial{}),
                       doctest::Contains("mesh_0000.vtu"), usage_error);

  pieces.loads.clear();
  const auto finished = finish(pieces.mesh(), 4);
  CHECK(finished.hash == io::mesh_hash(cubes_in_eight.distributed()));
  CHECK(finished.quality.elements == 6 * 8 * 8 * 8);
  CHECK(finished.summary.get("taken_over") == 3);
  CHECK(pieces.loads == std::vector<local_id>{4, 5});
  CHECK(pieces.gone.size() == 8);
  CHECK(testing::content_of(folder / "out") == testing::content_of(folder / "expected"));
}

TEST_CASE(
    "elements of low quality and at interfaces are counted by every executor, and where pieces are taken "
    "over") {
  const testing::scratch_folder folder("finish_poor");
  const auto flattened = [](distributed_mesh mesh) {
    for (vec3& p : mesh.skeleton.points.own())
      p.z *= 0.1;
    mesh.load = [load = mesh.load](local_id piece_number) {
      auto piece = load(piece_number);
      for (vec3& p : piece.mesh.points)
        p.z *= 0.1;
      return piece;
    };
    return mesh;
  };
  const auto counted = [&](const distributed_mesh& mesh, const any_executor& run_tasks,
                           bool release = false) {
    return io::finish_mesh<3>(mesh, {vtu(4)}, folder / "out", run_tasks, {.release = release});
  };
  const auto expected = counted(flattened(cubes_in_eight.distributed()), parallel::serial{});
  CHECK(all_low(expected.poor) == expected.quality.min_dihedrals.below(low_dihedral_deg));
  REQUIRE(all_low(expected.poor) > 0);
  const auto& [touching, next_ring, rest] = expected.at_interfaces;
  CHECK(touching.elements > 0);
  CHECK(touching.elements + next_ring.elements + rest.elements == expected.quality.elements);
  CHECK(touching.min_dihedrals.below(low_dihedral_deg) + next_ring.min_dihedrals.below(low_dihedral_deg) +
            rest.min_dihedrals.below(low_dihedral_deg) ==
        all_low(expected.poor));
  const auto by_processes =
      counted(flattened(cubes_in_eight.distributed()), parallel::processes{.worker_count = 2});
  CHECK(encoded(by_processes.poor) == encoded(expected.poor));
  CHECK(encoded(by_processes.at_interfaces) == encoded(expected.at_interfaces));

  store pieces;
  auto interrupted = flattened(pieces.mesh());
  interrupted.load = [load = interrupted.load](local_id p) {
    if (p == 5)
      throw io_error("a damaged file");
    return load(p);
  };
  CHECK_THROWS_AS(counted(interrupted, parallel::serial{}, true), io_error);
  const auto resumed = counted(flattened(pieces.mesh()), parallel::serial{}, true);
  CHECK(resumed.summary.get("taken_over") > 0);
  CHECK(encoded(resumed.poor) == encoded(expected.poor));
  CHECK(encoded(resumed.at_interfaces) == encoded(expected.at_interfaces));
}

TEST_CASE("an MSH file is put together from the parts of pieces, also by workers and after an interruption") {
  const testing::scratch_folder folder("finish_msh");
  const auto check = [&](const auto& writer) {
    CAPTURE(writer.stem);
    const std::string file = writer.stem + ".msh";
    store pieces;
    writer(pieces.mesh(), folder / "expected");
    CHECK(pieces.loads.size() == 8);
    const auto expected = testing::file_content(folder / "expected" / file);

    io::finish_mesh<3>(pieces.mesh(), {writer}, folder / "workers", parallel::processes{.worker_count = 2});
    CHECK(testing::file_content(folder / "workers" / file) == expected);

    auto damaged = pieces.mesh();
    damaged.load = [load = damaged.load](local_id p) {
      if (p == 5)
        throw io_error("a damaged file");
      return load(p);
    };
    const auto finish = [&](const distributed_mesh& mesh) {
      io::finish_mesh<3>(mesh, {writer}, folder / "again", parallel::serial{}, {.release = true});
    };
    CHECK_THROWS_WITH_AS(finish(damaged), "a damaged file", io_error);
    pieces.loads.clear();
    finish(pieces.mesh());
    CHECK(pieces.loads == std::vector<local_id>{5});
    CHECK(testing::file_content(folder / "again" / file) == expected);
    CHECK(testing::content_of(folder / "again").size() == 1); // the folder of parts has gone
    std::filesystem::remove_all(folder / "again");
  };
  check(io::msh_writer{});
  check(io::partitioned_msh_writer{.ghosts = true});
  check(io::partitioned_msh_writer{.ghosts = true, .binary = false, .stem = "text"});
}

TEST_CASE("a lost or shortened part of an MSH file is an io_error that names it") {
  const testing::scratch_folder folder("finish_msh_lost");
  const auto mesh = cubes_in_eight.distributed();
  for (const std::uintmax_t bytes : {0, 7, 100}) {
    const auto output = io::msh_writer{}.begin(mesh, folder);
    for (std::size_t f = 0; f + 1 < output.bounds.size(); ++f) {
      const auto part = output.open(f);
      part.add(io::load_checked(mesh, static_cast<local_id>(f)));
      part.close();
    }
    std::filesystem::resize_file(folder / output.names[3], bytes);
    CHECK_THROWS_WITH_AS(output.complete(), doctest::Contains(output.names[3].c_str()), io_error);
    CHECK(!std::filesystem::exists(folder / "mesh.msh"));
  }
}

TEST_CASE("no file gets its final name before those of all writers are complete") {
  const testing::scratch_folder folder("finish_blocked");
  struct blocked_writer {
    io::piecewise_output<3> begin(const distributed_mesh& mesh,
                                  const std::filesystem::path& unfinished) const {
      std::filesystem::create_directory(unfinished / "mesh.msh"); // where the file would be
      std::ofstream(unfinished / "mesh.msh" / "full");
      return io::msh_writer{}.begin(mesh, unfinished);
    }
  };
  CHECK_THROWS_WITH_AS(
      io::finish_mesh<3>(cubes_in_eight.distributed(), {vtu(), blocked_writer{}}, folder, parallel::serial{}),
      doctest::Contains("mesh.msh"), io_error);
  CHECK(testing::content_of(folder).empty());
}

TEST_CASE("files of pieces that were numbered otherwise are not taken over") {
  const testing::scratch_folder folder("finish_renumbered");
  store pieces;
  auto mesh = pieces.mesh();
  const auto finish = [&](const distributed_mesh& given) {
    io::finish_mesh<3>(given, {vtu(8)}, folder / "out", parallel::serial{}, {.release = true});
  };
  mesh.load = [load = mesh.load](local_id p) {
    if (p == 5)
      throw io_error("a damaged file");
    return load(p);
  };
  CHECK_THROWS_AS(finish(mesh), io_error);
  auto other = pieces.mesh();
  other.counts[0].inner_points += 1;
  CHECK_THROWS_WITH_AS(finish(other), doctest::Contains("another decomposition"), usage_error);
  auto moved = pieces.mesh();
  moved.skeleton.points.own()[0].x += 1e-9;
  CHECK_THROWS_WITH_AS(finish(moved), doctest::Contains("another decomposition"), usage_error);
}

TEST_CASE("a writer alone leaves nothing in a folder of unfinished files that was there") {
  const testing::scratch_folder folder("write_into_old");
  std::filesystem::create_directories(folder / "unfinished");
  auto mesh = cubes_in_eight.distributed();
  mesh.load = [load = mesh.load](local_id p) {
    if (p == 1)
      throw io_error("a damaged file");
    return load(p);
  };
  CHECK_THROWS_AS(io::vtu_writer{}(mesh, folder), io_error);
  CHECK_THROWS_AS(io::msh_writer{}(mesh, folder), io_error);
  CHECK(testing::content_of(folder).empty());
}
