// Speed of the volume mesher: elements per second on one core, what the checks and the bytes cost, memory,
// and how two worker processes compare with one. Prints one line per case.
//
// The last two lines are wall time, so they want an otherwise idle machine.
//
//   mesher [elements per case, default 1000000]
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "mesher/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

using namespace dovetail;

namespace {

/// Seconds of this process's processor time: what a busy machine does not change.
double cpu_seconds_of(const auto& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}
double wall_seconds_of(const auto& work) {
  const stopwatch clock;
  work();
  return clock.seconds();
}

/// Squares per cube edge for about this many elements.
int squares_for(double elements) {
  return std::max(2, static_cast<int>(std::lround(std::cbrt(elements / 7.88))));
}

void time_one_cube(double wanted) {
  const auto boundary = shapes::cube(squares_for(wanted));
  const double h = shapes::mean_edge(boundary);
  const mesher_input<3> input{boundary, 0};
  mesher_result<3> result;
  const double total = cpu_seconds_of([&] { result = mesher::tetgen{}(input, [h](vec3) { return h; }); });
  const double checks = cpu_seconds_of([&] { check_mesher_result(input, result.mesh); });
  const double labels = cpu_seconds_of([&] { label_elements(result.mesh, input.boundary.elements); });
  const double quality = cpu_seconds_of([&] { measure_quality(result.mesh); });
  const auto count = static_cast<double>(result.mesh.elements.size());
  std::printf("cube: %.0f elements in %.2f s of processor time, %.0f k/s; of that checks %.3f s, labels %.3f "
              "s; quality %.3f s; "
              "%.2f size evaluations per element\n",
              count, total, count / total / 1e3, checks, labels, quality,
              result.summary.get("sizing_calls") / count);
}

void time_pieces(double wanted) {
  constexpr int pieces = 16;
  const int n = squares_for(wanted / pieces);
  const subdomain_source source = [n](local_id s) {
    subdomain_input input;
    input.boundary.boundary = shapes::cube(n, 1, {static_cast<double>(s), 0, 0});
    input.skeleton_points.resize(input.boundary.boundary.points.size());
    return input;
  };
  const double h = shapes::mean_edge(source(0).boundary.boundary);
  double one = 0;
  for (const int workers : {1, 2}) {
    meshing_result result;
    const double total = wall_seconds_of([&] {
      result = mesh_subdomains(
          pieces, source, mesher::tetgen{}, no_improver{}, [h](vec3) { return h; },
          parallel::processes{workers});
    });
    one = workers == 1 ? total : one;
    std::printf("%d cubes, %d workers: %.0f elements, %.0f k/s, speed-up %.2f, peak %.0f MiB, %zu failed\n",
                pieces, workers, result.summary.get("elements"), result.summary.get("elements") / total / 1e3,
                one / total, result.summary.get("peak_rss_bytes") / (1 << 20), result.failures.size());
  }
}

void time_executor() {
  constexpr std::size_t tasks = 10000;
  const task_function nothing = [](std::size_t) { return byte_buffer(8); };
  const double tiny = wall_seconds_of([&] { parallel::processes{2}.run(tasks, nothing); });
  constexpr std::size_t size = std::size_t{64} << 20;
  const double large = wall_seconds_of(
      [&] { parallel::processes{2}.run(8, [](std::size_t) { return byte_buffer(size, std::byte{1}); }); });
  std::printf("processes: %.1f us per tiny task, %.2f GB/s of results\n", tiny / tasks * 1e6,
              8.0 * static_cast<double>(size) / large / 1e9);
}

} // namespace

int main(int argc, char** argv) {
  const double wanted = argc > 1 ? std::atof(argv[1]) : 1e6;
  time_executor();
  time_one_cube(wanted);
  time_pieces(wanted);
}
