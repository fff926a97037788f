#include "dovetail/distributed/processes.hpp"
#include "dovetail/distributed/ranks.hpp"
#include "dovetail/improver/any_improver.hpp"
#include "dovetail/intersection/offending_facets.hpp"
#include "dovetail/mesher/any_mesher.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/checkpointed.hpp"
#include "dovetail/parallel/clock_watch.hpp"
#include "dovetail/parallel/in_process.hpp"
#include "dovetail/parallel/remembering.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"
#include "files/scratch_folder.hpp"
#include "mesher/shapes.hpp"
#include "support/refusal.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <utility>

#include <sys/wait.h>
#include <unistd.h>

using namespace dovetail;
namespace fs = std::filesystem;

namespace {

/// Connects a star-shaped boundary to its middle. The first `bad_attempts` attempts fail on the
/// subdomains of material 1, in the way given.
struct fan_mesher {
  enum class misbehaviour { throws, aborts, hangs, loses_an_element };
  static constexpr mesher_traits traits{.keeps_boundary = true, .repeats_in_process = true};

  int bad_attempts = 0;
  misbehaviour how = misbehaviour::throws;
  int attempt = 0;

  std::vector<fan_mesher> fallbacks() const { return {{bad_attempts, how, 1}, {bad_attempts, how, 2}}; }

  mesher_result<3> operator()(const mesher_input<3>& in, const any_sizing& size) const {
    const bool fails = in.material == 1 && attempt < bad_attempts;
    if (fails && how == misbehaviour::throws)
      throw mesher_error("attempt " + std::to_string(attempt));
    if (fails && how == misbehaviour::aborts)
      std::abort();
    while (fails && how == misbehaviour::hangs)
      std::this_thread::sleep_for(std::chrono::seconds(1));
    mesher_result<3> result;
    result.mesh.points = in.boundary.points;
    box3 box;
    for (const vec3 p : in.boundary.points)
      box.include(p);
    const auto middle = static_cast<local_id>(result.mesh.points.size());
    result.mesh.points.push_back(box.center());
    if (!(size(box.center()) > 0))
      throw sizing_error("no size");
    for (const auto& t : in.boundary.elements)
      result.mesh.elements.push_back({t[0], t[2], t[1], middle});
    if (fails)
      result.mesh.elements.pop_back();
    result.mesh.tags.assign(result.mesh.elements.size(), in.material);
    return result;
  }
};
static_assert(boundary_keeping_mesher<fan_mesher, 3>);

struct counting_improver {
  bool throws = false;
  static constexpr improver_traits traits{};
  report operator()(simplicial_mesh<3>&, const frozen_entities<3>& frozen, const any_sizing&) const {
    if (throws)
      throw mesh_error("cannot improve");
    report r;
    r.set("frozen points", frozen.points);
    return r;
  }
};

/// A row of cubes; cube 2 is of material 1.
subdomain_input cube_number(local_id s) {
  subdomain_input input;
  input.boundary.boundary = shapes::cube(2 + s % 3, 1, {static_cast<double>(s), 0, 0});
  input.boundary.material = s == 2 ? 1 : 0;
  for (std::size_t v = 0; v < input.boundary.boundary.points.size(); ++v)
    input.skeleton_points.push_back(static_cast<local_id>(v) + 1000 * s);
  return input;
}

const any_sizing unit_size = [](vec3) { return 1.0; };
constexpr std::size_t piece_count = 6;

/// A folder that is not there yet.
struct scratch_folder {
  testing::scratch_folder around{"pieces"};
  fs::path path = around / "folder";
};

byte_buffer all_bytes(const meshing_result& result) {
  byte_writer bytes;
  for (local_id s = 0; s < static_cast<local_id>(result.pieces.size()); ++s)
    encode(bytes, result.load(s));
  return bytes.take();
}

meshing_result run_fan(const fan_mesher& mesher, const meshing_options& options = {},
                       const any_executor& run = parallel::processes{2}) {
  return mesh_subdomains(piece_count, cube_number, mesher, counting_improver{}, unit_size, run, options);
}

} // namespace

TEST_CASE("Every subdomain is meshed, and the pieces know their skeleton points") {
  const any_executor keeping = parallel::remembering(parallel::serial{});
  const auto result =
      mesh_subdomains(piece_count, cube_number, fan_mesher{}, counting_improver{}, unit_size, keeping);
  CHECK(result.failures.empty());
  global_id elements = 0;
  for (local_id s = 0; s < static_cast<local_id>(piece_count); ++s) {
    const auto input = cube_number(s);
    const auto piece = result.load(s);
    const auto& summary = result.pieces[s];
    CHECK(piece.subdomain == s);
    CHECK(piece.material == input.boundary.material);
    CHECK(piece.skeleton_points == input.skeleton_points);
    CHECK_NOTHROW(check_mesher_result(input.boundary, piece.mesh));
    CHECK(summary.counts.elements == static_cast<global_id>(input.boundary.boundary.elements.size()));
    CHECK(summary.counts.inner_points == 1);
    CHECK(summary.quality.all.elements == summary.counts.elements);
    CHECK(summary.summary.children.at(1).name == "improver");
    const auto found = keeping.results()->of("piece")->value<finished_piece<3>>(result.finished[s].key());
    CHECK(found.summary.summary.children.at(1).get("frozen points") ==
          static_cast<double>(input.skeleton_points.size()));
    elements += summary.counts.elements;
  }
  CHECK(result.quality.elements == elements);
  CHECK(result.summary.get("elements") == static_cast<double>(elements));
  CHECK(result.summary.get("failed") == 0);
}

TEST_CASE("The result does not depend on the executor, its workers or where pieces are kept") {
  const scratch_folder scratch;
  const auto run = [&](const any_executor& executor) {
    return all_bytes(
        mesh_subdomains(piece_count, cube_number, fan_mesher{1}, counting_improver{}, unit_size, executor));
  };
  const auto expected = run(parallel::serial{});
  for (const int workers : {1, 2, 4}) {
    const parallel::processes executor{workers};
    CHECK(run(executor) == expected);
    CHECK(run(parallel::remembering(executor)) == expected);
    CHECK(run(parallel::checkpointed(executor, spool::start(scratch.path, {}))) == expected);
  }
}

/// Runs tasks one after the other and counts the bytes that they return.
struct weighing_executor {
  std::shared_ptr<std::size_t> bytes = std::make_shared<std::size_t>(0);
  std::vector<task_outcome> run(std::size_t count, const task_function& task,
                                const run_options& options) const {
    auto outcomes = parallel::serial{}.run(count, task, options);
    for (const task_outcome& outcome : outcomes)
      *bytes += outcome.result.size();
    return outcomes;
  }
  int workers() const { return 1; }
  bool shares_process() const { return false; } // so that values come as bytes
};

TEST_CASE("With a spool a piece is a few bytes of its worker's, however large its boundary") {
  const scratch_folder scratch;
  subdomain_input input;
  input.boundary.boundary = shapes::cube(40);
  input.skeleton_points.resize(input.boundary.boundary.points.size());
  const auto bytes_for = [&](const subdomain_input& piece) {
    const weighing_executor weigh;
    const auto result = mesh_subdomains(
        1, [&](local_id) { return piece; }, fan_mesher{}, counting_improver{}, unit_size,
        parallel::checkpointed(weigh, spool::start(scratch.path, {})));
    CHECK(result.pieces[0].counts.elements > 10000);
    CHECK(result.pieces[0].quality.at_interfaces.has_value() == !piece.on_interface.empty());
    return *weigh.bytes;
  };
  const std::size_t bytes = bytes_for(input);
  CHECK(bytes < 300);
  CHECK(bytes > 50);
  input.on_interface.resize(input.skeleton_points.size());
  std::fill_n(input.on_interface.begin(), input.on_interface.size() / 3, std::uint8_t{1});
  CHECK(bytes_for(input) < 600); // with the angles of the elements at interfaces
}

TEST_CASE("Loading asks for the skeleton's points where it is said") {
  meshing_options options;
  options.skeleton_points = [](local_id s) { return std::vector<local_id>{s, 7}; };
  const auto result = run_fan({}, options, parallel::serial{});
  CHECK(result.load(3).skeleton_points == std::vector<local_id>{3, 7});
}

TEST_CASE("The largest predicted cost is started first") {
  std::vector<local_id> started;
  meshing_options options;
  options.predicted_cost = {1, 5, 2, 5, 9, 0};
  mesh_subdomains(
      piece_count,
      [&](local_id s) {
        started.push_back(s);
        return cube_number(s);
      },
      fan_mesher{}, counting_improver{}, unit_size, parallel::serial{}, options);
  CHECK(started == std::vector<local_id>{4, 1, 3, 2, 0, 5});
  options.predicted_cost.pop_back();
  CHECK_THROWS_AS(run_fan({}, options), usage_error);
}

TEST_CASE("A failed subdomain is tried by the fallbacks, the others are not") {
  for (const auto how : {fan_mesher::misbehaviour::throws, fan_mesher::misbehaviour::aborts,
                         fan_mesher::misbehaviour::loses_an_element}) {
    const auto result = run_fan({2, how});
    CHECK(result.failures.empty());
    CHECK(result.summary.get("retried") == 1);
    for (std::size_t s = 0; s < piece_count; ++s)
      CHECK(result.pieces[s].summary.get("attempt") == (s == 2 ? 2 : 0));
  }
}

TEST_CASE("What no attempt can mesh comes back as data, with a file of its facets") {
  const scratch_folder scratch;
  meshing_options options;
  options.on_failure = write_facets_of_failures(scratch.path);
  const auto result = run_fan({3, fan_mesher::misbehaviour::aborts}, options);
  REQUIRE(result.failures.size() == 1);
  const piece_failure& failure = result.failures[0];
  CHECK(failure.subdomain == 2);
  REQUIRE(failure.reasons.size() == 4);
  CHECK(failure.reasons[0].find("signal 6") != std::string::npos);
  CHECK(failure.crossing_facets == 0);
  CHECK(result.pieces[2].counts.elements == 0);
  CHECK(result.summary.get("failed") == 1);
  std::ifstream file(failure.facets);
  std::string keyword;
  std::size_t points = 0;
  std::size_t triangles = 0;
  file >> keyword >> points >> triangles;
  CHECK(keyword == "OFF");
  CHECK(triangles == cube_number(2).boundary.boundary.elements.size()); // none crosses: all of them
  CHECK_NOTHROW(result.load(3));
}

namespace {

/// Fails on subdomains of material 1, in whatever thread.
struct failing_anywhere {
  static constexpr mesher_traits traits{
      .keeps_boundary = true, .thread_safe = true, .repeats_in_process = true};
  mesher_result<3> operator()(const mesher_input<3>& in, const any_sizing& size) const {
    return fan_mesher{1}(in, size);
  }
};

} // namespace

TEST_CASE("What the rank that leads has recorded of a failure all ranks know") {
  std::atomic<int> recorded = 0;
  parallel::run_ranks(3, [&](parallel::in_process& mine) {
    meshing_options options;
    if (mine.rank() == 0)
      options.on_failure = [&](piece_failure& known, const simplicial_mesh<2>&) {
        known.crossing_facets = 7;
        known.facets = "somewhere";
        ++recorded;
      };
    const auto result = mesh_subdomains(piece_count, cube_number, failing_anywhere{}, any_improver<3>{},
                                        unit_size, parallel::ranks(mine), options);
    CHECK(result.failures.size() == 1);
    const piece_failure& failure = result.failures.at(0);
    CHECK(failure.subdomain == 2);
    CHECK(failure.reasons.size() == 1);
    CHECK(failure.crossing_facets == 7);
    CHECK(failure.facets == "somewhere");
  });
  CHECK(recorded == 1);
}

TEST_CASE("The facets that cross are singled out") {
  const scratch_folder scratch;
  auto crossing = shapes::cube(2);
  shapes::append(crossing, shapes::cube(2, 1, {0.9, 0.1, 0.1}));
  fs::create_directories(scratch.path);
  const auto path = scratch.path / "facets.off";
  const std::size_t count = write_offending_facets(crossing, path);
  CHECK(count > 0);
  CHECK(count < crossing.elements.size());
  CHECK(crossing_facets(shapes::cube(2)).empty());
}

TEST_CASE("A hang ends at the time limit and is recorded") {
  const auto result =
      run_fan({1, fan_mesher::misbehaviour::hangs}, {}, parallel::clock_watch(parallel::processes{2}, 0.3));
  CHECK(result.failures.empty());
  REQUIRE(result.summary.warnings.size() == 1);
  CHECK(result.summary.warnings[0].find("exceeded the time limit") != std::string::npos);
  CHECK(stops_by_clock(result.summary) == 1);
}

TEST_CASE("A piece that cannot be improved is kept unimproved, with a warning") {
  const auto result = mesh_subdomains(2, cube_number, fan_mesher{}, counting_improver{true}, unit_size,
                                      parallel::processes{2});
  CHECK(result.failures.empty());
  CHECK(result.summary.warnings.size() == 2);
  CHECK(result.pieces[0].summary.get("attempt") == 3);
}

TEST_CASE("An unusable field and a mesher in threads are typed errors") {
  const any_sizing nothing = [](vec3) { return 0.0; };
  CHECK_THROWS_AS(mesh_subdomains(piece_count, cube_number, fan_mesher{}, counting_improver{}, nothing,
                                  parallel::processes{2}),
                  sizing_error);
  CHECK_THROWS_AS(mesh_subdomains(piece_count, cube_number, fan_mesher{}, counting_improver{}, unit_size,
                                  parallel::threads{2}),
                  usage_error);
  CHECK_NOTHROW(mesh_subdomains(piece_count, cube_number, fan_mesher{}, counting_improver{}, unit_size,
                                parallel::threads{1}));
}

namespace {

struct fan_mesher_for_threads : fan_mesher {
  static constexpr mesher_traits traits{
      .keeps_boundary = true, .thread_safe = true, .repeats_in_process = true};
};

} // namespace

TEST_CASE("In threads no attempt may be a mesher that must not run there") {
  const any_mesher<3> alone(fan_mesher_for_threads{}, "safe");
  const any_mesher<3> backed = alone.with_fallback({fan_mesher{}, "unsafe"});
  CHECK_NOTHROW(require_policies(alone, any_improver<3>{}, parallel::threads{2}));
  CHECK_NOTHROW(require_policies(backed, any_improver<3>{}, parallel::processes{2}));
  CHECK_THROWS_WITH_AS(require_policies(backed, any_improver<3>{}, parallel::threads{2}),
                       doctest::Contains("'unsafe'"), usage_error);
}

namespace {

struct forking_mesher : fan_mesher {
  std::vector<forking_mesher> fallbacks() const { return {}; }
  mesher_result<3> operator()(const mesher_input<3>& in, const any_sizing& size) const {
    parallel::processes{1}.run(1, [](std::size_t) { return byte_buffer{}; });
    return fan_mesher::operator()(in, size);
  }
};

} // namespace

TEST_CASE("A mesher that cannot fork here is a usage_error, and no other one takes its place") {
  const any_mesher<3> forks = any_mesher<3>(forking_mesher{}, "forks").with_fallback({fan_mesher{}, "fan"});
  const auto run = [&](const any_executor& on) {
    return mesh_subdomains(2, cube_number, forks, counting_improver{}, unit_size, on);
  };
  CHECK(run(parallel::serial{}).failures.empty());
  const auto beside_a_thread = [&] {
    parallel::run_ranks(1, [&](parallel::in_process& mine) { run(parallel::ranks(mine)); });
  };
  CHECK_THROWS_WITH_AS(beside_a_thread(),
                       doctest::Contains("mesher 'forks': worker processes cannot be forked"), usage_error);
}

TEST_CASE("A spool that cannot be written is an io_error") {
  const scratch_folder scratch;
  const any_executor keeping = parallel::checkpointed(parallel::processes{2}, spool::start(scratch.path, {}));
  fs::remove_all(scratch.path);
  CHECK_THROWS_AS(run_fan({}, {}, keeping), io_error);
}

TEST_CASE("A killed run is resumed, makes only what is missing, and gives the same mesh") {
  const scratch_folder scratch;
  const auto expected = all_bytes(run_fan({}));
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) { // is killed while cube 4 is being made
    const any_executor keeping =
        parallel::checkpointed(parallel::processes{1}, spool::start(scratch.path, {}));
    mesh_subdomains(
        piece_count,
        [](local_id s) {
          if (s == 4) {
            ::kill(::getppid(), SIGKILL); // by its worker: the death of the parent ends the worker too
            for (;;)                      // which must not finish the cube before
              ::pause();
          }
          return cube_number(s);
        },
        fan_mesher{}, counting_improver{}, unit_size, keeping);
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(WIFSIGNALED(status));

  const spool disk = spool::resume(scratch.path, {});
  const auto name_of = [](local_id cube) {
    return "piece_" + to_string(kept_piece(cube_number(cube), {}).key());
  };
  REQUIRE(disk.read(name_of(3)));
  REQUIRE_FALSE(disk.read(name_of(5)));
  fs::resize_file(disk.path_of(name_of(1)), 100); // and one is damaged
  const auto result = mesh_subdomains(piece_count, cube_number, fan_mesher{}, counting_improver{}, unit_size,
                                      parallel::checkpointed(parallel::serial{}, disk));
  CHECK(result.summary.get("reused") == 3); // 0, 2 and 3
  CHECK(all_bytes(result) == expected);
  CHECK(result.summary.get("elements") > 0);
  fs::remove(disk.path_of(name_of(0)));
  CHECK_THROWS_AS(result.load(0), io_error);
}

TEST_CASE("What an executor remembers is not made again, under whatever number") {
  const auto shifted = [](local_id s) { return cube_number((s + 2) % static_cast<local_id>(piece_count)); };
  const auto changed = [](local_id s) {
    auto input = cube_number(s);
    if (s == 4)
      input.boundary.boundary.points.front().x -= 1e-9;
    return input;
  };
  const parallel::remembering keeping(parallel::processes{2});
  const auto run = [&](const auto& source, const refined_sizing& size = unit_size) {
    return mesh_subdomains(piece_count, source, fan_mesher{}, counting_improver{}, size, keeping);
  };
  CHECK(run(cube_number).summary.get("reused") == 0);
  const auto result = run(shifted);
  CHECK(result.summary.get("reused") == piece_count);
  for (local_id s = 0; s < static_cast<local_id>(piece_count); ++s) {
    const auto piece = result.load(s);
    CHECK(piece.subdomain == s);
    CHECK(piece.skeleton_points == shifted(s).skeleton_points);
    CHECK_NOTHROW(check_mesher_result(shifted(s).boundary, piece.mesh));
  }
  CHECK(run(changed).summary.get("reused") == piece_count - 1);
  refined_sizing refined(unit_size);
  refined.refine(std::vector<size_ball>{{{4.5, 0.5, 0.5}, 0.1, 0.9}}); // reaches over less than its cube
  CHECK(run(cube_number, refined).summary.get("reused") == piece_count - 1);
}

TEST_CASE("Of a boundary that nothing can fill the boundary is said to be at fault, and no mesher") {
  const auto told = [](const auto& change) {
    const auto source = [&](local_id) {
      auto input = cube_number(0);
      change(input.boundary.boundary);
      return input;
    };
    const auto result = mesh_subdomains(1, source, any_mesher<3>(fan_mesher{}, "mine"), any_improver<3>{},
                                        unit_size, parallel::serial{});
    REQUIRE(result.failures.size() == 1);
    return result.failures[0].reasons.front();
  };
  using testing::has;
  CHECK(has(told([](auto& b) { b.points[3].y = std::nan(""); }), "boundary point 3 is at ("));
  CHECK(has(told([](auto& b) { b.elements[5][1] = 9999; }), "boundary triangle 5 refers to point 9999"));
  CHECK(has(told([](auto& b) { b.elements[5][1] = b.elements[5][0]; }), "boundary triangle 5 (points"));
  CHECK(has(told([](auto& b) { std::swap(b.elements[5][1], b.elements[5][0]); }),
            "there twice or turned over"));
  CHECK(has(told([](auto& b) { b.elements.pop_back(); }), "a triangle is missing"));
  CHECK(has(told([](auto& b) { b.elements.push_back(b.elements[5]); }), "there twice"));
  const std::string inwards = told([](auto& b) {
    for (auto& t : b.elements)
      std::swap(t[1], t[2]);
  });
  CHECK(has(inwards, "orient its outer shells outwards"));
  CHECK(inwards.find("mine") == std::string::npos);
}
