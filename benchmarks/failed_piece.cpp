// What one failed piece costs: the built-in aircraft, once as it is and once with a mesher that fails on all
// rungs of one piece, which is then merged with its neighbour. Wall time, so it wants an otherwise idle
// machine.
//
//   failed_piece [elements, default 2000000] [subdomains, default 72] [workers, default 2]
#include "dovetail/geometry/builtin_models.hpp"
#include "dovetail/mesher/tetgen.hpp"
#include "dovetail/parallel/processes.hpp"
#include "dovetail/partition/metis.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/compose.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

using namespace dovetail;

namespace {

/// TetGen, but for a piece whose boundary has so many points.
struct fails_on_one_piece {
  static constexpr mesher_traits traits = mesher::tetgen::traits;
  std::size_t points_of_failing = 0;

  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const {
    if (input.boundary.points.size() == points_of_failing)
      throw mesher_error("this piece fails on purpose");
    return mesher::tetgen{}(input, size);
  }
};

generated<3> run(const any_geometry& model, const any_sizing& size, int subdomains, int workers,
                 std::size_t points_of_failing) {
  return generate<3>(model, size,
                     parameters<>{}
                         .with_mesher(fails_on_one_piece{points_of_failing})
                         .with_partitioner(partition::metis{})
                         .with_executor(parallel::processes{workers})
                         .with_options({.subdomains = subdomains}));
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
  const auto plain = run(model, size, subdomains, workers, 0);
  const std::size_t failing = pick_piece(plain);
  const auto failed = run(model, size, subdomains, workers, failing);
  const report& meshing = failed.summary.children.back();
  const double before = plain.summary.seconds - plain.summary.children.front().seconds;
  const double after = failed.summary.seconds - failed.summary.children.front().seconds;
  std::printf("%lld elements in %zu pieces: %.2f s after the background mesh; with one failed piece %.2f s "
              "(%+.1f %%; "
              "%.0f merged, %.0f pieces of %zu found again)\n",
              static_cast<long long>(plain.quality.elements), plain.mesh.counts.size(), before, after,
              100 * (after / before - 1), meshing.get("merged_after_failure"), meshing.get("reused"),
              failed.mesh.counts.size());
  return 0;
}
