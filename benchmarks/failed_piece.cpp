// What one failed piece costs: the built-in aircraft as it is; with a mesher that fails at its first attempt
// on one piece, so that the next attempt meshes it; and with one that fails on all attempts, so that the
// piece is merged with its neighbour. Wall time, which wants an otherwise idle machine, and processor time of
// all workers.
//
//   failed_piece [elements, default 2000000] [subdomains, default 72] [workers, default 2]
#include "dovetail/adapters/metis.hpp"
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/experiments/builtin_models.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/compose.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <sys/resource.h>

using namespace dovetail;

namespace {

/// TetGen, but for a piece whose boundary has so many points.
struct fails_on_one_piece {
  static constexpr mesher_traits traits = mesher::tetgen::traits;
  std::size_t points_of_failing = 0;
  bool succeeds_at_second = false;

  std::vector<fails_on_one_piece> fallbacks() const {
    return succeeds_at_second ? std::vector{fails_on_one_piece{}} : std::vector<fails_on_one_piece>{};
  }

  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const {
    if (input.boundary.points.size() == points_of_failing)
      throw mesher_error("this piece fails on purpose");
    return mesher::tetgen{}(input, size);
  }
};

double processor_seconds() {
  double sum = 0;
  for (const int whose : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage used{};
    ::getrusage(whose, &used);
    for (const timeval& t : {used.ru_utime, used.ru_stime})
      sum += static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  }
  return sum;
}

struct timed_run {
  generated<3> result;
  double seconds = 0; ///< after the background mesh
  double processor_seconds = 0;
};

timed_run run(const any_geometry& model, const any_sizing& size, int subdomains, int workers,
              const fails_on_one_piece& mesher) {
  const double before = processor_seconds();
  timed_run timed;
  timed.result = generate<3>(model, size,
                             parameters<>{}
                                 .with_mesher(mesher)
                                 .with_partitioner(partition::metis{})
                                 .with_executor(parallel::processes{workers})
                                 .with_options({.subdomains = subdomains}));
  const report& all = timed.result.summary;
  timed.seconds = all.seconds - all.children.front().seconds;
  timed.processor_seconds = processor_seconds() - before;
  return timed;
}

/// The number of boundary points of a piece of middling size that no other piece has.
std::size_t pick_piece(const generated<3>& result) {
  std::vector<std::size_t> counts;
  for (std::size_t p = 0; p < result.mesh.counts.size(); ++p)
    counts.push_back(result.mesh.load(static_cast<local_id>(p)).skeleton_points.size());
  std::sort(counts.begin(), counts.end());
  for (std::size_t k = counts.size() / 2; k < counts.size(); ++k)
    if (std::count(counts.begin(), counts.end(), counts[k]) == 1)
      return counts[k];
  return counts.back();
}

} // namespace

int main(int argc, char** argv) {
  const double elements = argc > 1 ? std::atof(argv[1]) : 2e6;
  const int subdomains = argc > 2 ? std::atoi(argv[2]) : 72;
  const int workers = argc > 3 ? std::atoi(argv[3]) : 2;
  auto built = builtin_model("aircraft");
  const any_geometry model(std::move(built.model));
  const any_sizing own = keep_bounds(source_field(built.size, std::move(built.sources)));
  const double predicted =
      plan_background<3>(model, own, parameters<>{}.with_mesher(fails_on_one_piece{})).predicted_elements;
  const any_sizing size = keep_bounds(scaled<any_sizing>(own, std::cbrt(predicted / elements)));
  const timed_run plain = run(model, size, subdomains, workers, {});
  const std::size_t failing = pick_piece(plain.result);
  const timed_run again = run(model, size, subdomains, workers, {failing, true});
  const timed_run merged = run(model, size, subdomains, workers, {failing, false});
  std::printf("%lld elements in %zu pieces: %.2f s after the background mesh, %.2f s of processors in all\n",
              static_cast<long long>(plain.result.quality.elements), plain.result.mesh.counts.size(),
              plain.seconds, plain.processor_seconds);
  const auto compare = [&](const char* what, const timed_run& with) {
    const auto meshing = with.result.summary.find("meshing").as<meshing_counts>();
    const auto intersection = with.result.summary.find("intersection").as<intersection_counts>();
    std::printf("%s: %+.1f %% (processors %+.1f %%); %zu meshed again, %d merged, %zu of %zu found again\n",
                what, 100 * (with.seconds / plain.seconds - 1),
                100 * (with.processor_seconds / plain.processor_seconds - 1), meshing.retried,
                intersection.merged_after_failure, meshing.reused, with.result.mesh.counts.size());
  };
  compare("one piece fails once", again);
  compare("one piece always fails", merged);
  return 0;
}
