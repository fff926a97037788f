/// What it costs to hide policies behind one type each (`any_parameters`), next to the same policies bound at
/// compile time: the contraction of the background mesh of a built-in model, the meshing of its pieces, and
/// the whole of `generate`. Header-only, as the compiled library has them hidden. Each is the median of
/// several runs in turns, in processor time of this one process; both ways must make the same.
/// Usage: policy_binding [MODEL (default aircraft)] [ELEMENTS (default 1e5)] [runs (default 5)]
#include "dovetail/adapters/metis.hpp"
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/experiments/builtin_models.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/pipeline/any_parameters.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/compose.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace dovetail;

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Prints a row. Each way returns a number that hangs on all of its result.
template <class Bound, class Hidden>
bool compare(const char* what, int runs, const Bound& bound, const Hidden& hidden) {
  std::vector<double> seconds_bound, seconds_hidden;
  bool same = true;
  for (int run = 0; run < runs; ++run) {
    const double begin = processor_seconds();
    const auto a = bound();
    const double middle = processor_seconds();
    const auto b = hidden();
    seconds_bound.push_back(middle - begin);
    seconds_hidden.push_back(processor_seconds() - middle);
    same = same && a == b;
  }
  const double m = median(seconds_bound), n = median(seconds_hidden);
  std::printf("| %s | %.3f | %.3f | %.3f |%s\n", what, m, n, n / m, same ? "" : " results differ");
  std::fflush(stdout);
  return same;
}

} // namespace

int main(int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "aircraft";
  const double elements = argc > 2 ? std::atof(argv[2]) : 1e5;
  const int runs = argc > 3 ? std::atoi(argv[3]) : 5;
  auto built = builtin_model(name);
  const any_geometry model(std::move(built.model));
  const any_sizing wanted = keep_bounds(source_field(built.size, std::move(built.sources)));
  const auto bound = bind_parameters<3>(parameters<>{}
                                            .with_mesher(mesher::tetgen{})
                                            .with_partitioner(partition::metis{})
                                            .with_options({.subdomains = 4}));
  const any_parameters<3> hidden(bound);
  double scale = 1;
  for (int step = 0; step < 3; ++step)
    scale *= std::cbrt(
        plan_background<3>(model, keep_bounds(scaled(wanted, scale)), hidden).predicted_elements / elements);
  const any_sizing size = keep_bounds(scaled(wanted, scale));

  const auto background = make_background<3>(model, size, hidden);
  const auto divided = divide<3>(background.mesh, background.size, background.plan.subdomains, hidden);
  decomposition_rounds rounds(model, background.mesh, divided, background.size, hidden);
  const auto skeleton = rounds.realize_boundaries();
  if (!skeleton) {
    std::fputs(rounds.too_many_merges().c_str(), stderr);
    return 1;
  }
  const refined_sizing refined{rounds.size()};
  const auto contract = [&](const auto& given) {
    report summary;
    const auto simplified = detail::simplify_background(background.mesh, divided.sides, divided.weights,
                                                        {.subdomains = 4}, given.simplify_by, summary, {});
    return simplified.super_of_element;
  };
  const auto mesh_pieces = [&](const auto& given) {
    const auto meshed =
        mesh_wanted_pieces<3>(model, background.mesh, *skeleton, divided.weights, refined, given);
    return meshed.quality.elements;
  };
  const auto generate_all = [&](const auto& given) {
    return io::mesh_hash(generate<3>(model, size, given).mesh);
  };
  std::printf("%s: %zu coarse elements, %d subdomains\n\n| | bound s | hidden s | hidden / bound |\n"
              "|---|--:|--:|--:|\n",
              name.c_str(), background.mesh.volume.elements.size(), rounds.merges().subdomains());
  const auto both = [&](const char* what, int times, const auto& way) {
    return compare(
        what, times, [&] { return way(bound); }, [&] { return way(hidden); });
  };
  bool same = both("simplification of the background mesh", 3 * runs, contract);
  same &= both("meshing of the pieces", runs, mesh_pieces);
  same &= both("the whole of generate", runs, generate_all);
  return same ? 0 : 1;
}
