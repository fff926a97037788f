/// What the default mesher and improver make of the pieces of a CAD file: elements per second of processor
/// time before and after improvement, memory, and how two threads compare with one. The last is wall time, so
/// it wants an idle machine.
/// Usage: pieces MODEL [ELEMENTS (default 5e6)] [SIZE (default: automatic sizes)] [turns (default 1)]
#include "dovetail/adapters/metis.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/improver/wraps.hpp"
#include "dovetail/mesher/native.hpp"
#include "dovetail/mesher/wraps.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/pipeline/divide.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/pipeline/piece_meshing.hpp"
#include "dovetail/pipeline/rounds.hpp"
#include "dovetail/sizing/automatic.hpp"
#include "dovetail/sizing/compose.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <mutex>
#include <string>

namespace {

using namespace dovetail;

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct measured {
  std::mutex guard;
  double elements = 0, meshing = 0, improving = 0;
  double recovered = 0, largest = 0;
};

struct measured_mesher : mesher::wraps<measured_mesher, mesher::native> {
  measured* to = nullptr;
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const {
    const double begin = thread_seconds();
    auto result = wrapped(input, size);
    const double end = thread_seconds();
    const std::scoped_lock lock(to->guard);
    to->meshing += end - begin;
    to->elements += static_cast<double>(result.mesh.elements.size());
    to->largest = std::max(to->largest, static_cast<double>(result.mesh.elements.size()));
    to->recovered += result.summary.get("missing_edges") + result.summary.get("missing_triangles");
    return result;
  }
};

struct measured_improver : improvement::wraps<measured_improver, improvement::native> {
  measured* to = nullptr;
  report operator()(simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen = {},
                    const any_sizing& size = {}) const {
    const double begin = thread_seconds();
    auto result = wrapped(mesh, frozen, size);
    const std::scoped_lock lock(to->guard);
    to->improving += thread_seconds() - begin;
    return result;
  }
};

} // namespace

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::fputs("usage: pieces MODEL [ELEMENTS] [SIZE] [turns]\n", stderr);
    return 2;
  }
  const any_geometry model = read_occt_model(argv[1]).model;
  const double wanted = argc > 2 ? std::atof(argv[2]) : 5e6;
  const double given_size = argc > 3 ? std::atof(argv[3]) : 0;
  const int turns = argc > 4 ? std::atoi(argv[4]) : 1;
  const auto policies =
      parameters<>{}.with_partitioner(partition::metis{}).with_executor(parallel::threads{.worker_count = 2});
  any_sizing size = uniform_size(given_size > 0 ? given_size : 1.0);
  if (!(given_size > 0)) {
    const any_sizing automatic = automatic_size(model);
    double scale = 1;
    for (int step = 0; step < 3; ++step)
      scale *= std::cbrt(
          plan_background<3>(model, keep_bounds(scaled(automatic, scale)), policies).predicted_elements /
          wanted);
    size = keep_bounds(scaled(automatic, scale));
  }
  const auto given = bind_parameters<3>(policies);
  const auto background = make_background<3>(model, size, given);
  const auto divided = divide<3>(background.mesh, background.size, background.plan.subdomains, given);
  decomposition_rounds rounds(model, background.mesh, divided, background.size, given);
  const auto skeleton = rounds.realize_boundaries();
  if (!skeleton)
    throw intersection_error(rounds.too_many_merges());
  const refined_sizing refined(rounds.size());

  std::printf("| threads | pieces | elements | largest | missing | s meshing | s improvement | k/s before | "
              "k/s after | wall s |\n|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (int turn = 0; turn < turns; ++turn)
    for (const int threads : {1, 2}) {
      measured found;
      measured_mesher mesher;
      mesher.to = &found;
      measured_improver improver;
      improver.to = &found;
      improver.wrapped.statistics = false; // as in the driver
      const auto with_threads =
          bind_parameters<3>(policies.with_mesher(mesher).with_improver(improver).with_executor(
              parallel::threads{.worker_count = threads}));
      const stopwatch clock;
      const auto meshed =
          mesh_wanted_pieces<3>(model, background.mesh, *skeleton, divided.weights, refined, with_threads);
      const double wall = clock.seconds();
      std::printf("| %d | %zu | %.0f | %.0f | %.0f | %.2f | %.2f | %.0f | %.0f | %.2f |\n", threads,
                  meshed.pieces.size(), found.elements, found.largest, found.recovered, found.meshing,
                  found.improving, found.elements / found.meshing / 1e3,
                  found.elements / (found.meshing + found.improving) / 1e3, wall);
      std::fflush(stdout);
      if (!meshed.failures.empty())
        std::printf("%zu failures\n", meshed.failures.size());
    }
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
