/// What it costs that the algorithms take graphs by concept: walks over the element-dual graph of a mesh and
/// over a csr graph, next to the same walks written by hand over the arrays. Each is the median of several
/// runs, taken in turns, each first in every other. No walk is inlined, and each begins at a multiple of 64
/// bytes, so that none depends on the code around it: that alone changes a short loop by up to 1.7.
/// Then what it costs to hide the rule of the simplification: the contraction by `simplifier::paper`, which
/// is bound at compile time, next to the same by an `any_simplification_rule` that holds it.
/// Usage: abstraction_penalty [cells per axis (default 60: 1.3 million tetrahedra)] [runs (default 31)]
#include "dovetail/core/report.hpp"
#include "dovetail/graph/breadth_first.hpp"
#include "dovetail/graph/contraction.hpp"
#include "dovetail/simplification/any_simplification_rule.hpp"
#include "dovetail/simplification/mesh_duals.hpp"
#include "dovetail/simplification/paper.hpp"
#include "dovetail/simplification/simplify.hpp"
#include "support/jittered_meshes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

using namespace dovetail;

/// The sum over all elements of all neighbours times the element, which no compiler can skip.
template <graph G>
[[gnu::noinline, gnu::aligned(64)]] std::int64_t sum_by_concept(const G& graph) {
  std::int64_t sum = 0;
  for (local_id v = 0; v < static_cast<local_id>(graph.node_count()); ++v)
    graph.for_each_neighbour(v, [&](local_id w) { sum += static_cast<std::int64_t>(w) ^ v; });
  return sum;
}

/// The element across a side, or no_id; `manifold`: the table has no side with three elements or more.
local_id across(const side_table<3>& sides, local_id side, local_id element, bool manifold) {
  const auto& pair = sides.elements[side];
  const local_id other = pair[0] == element ? pair[1] : pair[0];
  return manifold || !sides.is_non_manifold(side) ? other : no_id;
}

[[gnu::noinline, gnu::aligned(64)]] std::int64_t sum_by_hand(const side_table<3>& sides) {
  const bool manifold = sides.further_elements.empty();
  std::int64_t sum = 0;
  for (std::size_t e = 0; e < sides.of_element.size(); ++e)
    for (const local_id side : sides.of_element[e]) {
      const local_id other = across(sides, side, static_cast<local_id>(e), manifold);
      if (other != no_id)
        sum += static_cast<std::int64_t>(other) ^ static_cast<local_id>(e);
    }
  return sum;
}

[[gnu::noinline, gnu::aligned(64)]] std::int64_t breadth_first_by_hand(const side_table<3>& sides) {
  const bool manifold = sides.further_elements.empty();
  std::vector<bool> seen(sides.of_element.size(), false);
  std::vector<local_id> order{0};
  seen[0] = true;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const local_id element = order[k];
    for (const local_id side : sides.of_element[element]) {
      const local_id other = across(sides, side, element, manifold);
      if (other != no_id && !seen[other]) {
        seen[other] = true;
        order.push_back(other);
      }
    }
  }
  return order.back();
}

[[gnu::noinline, gnu::aligned(64)]] std::int64_t breadth_first_by_hand(const csr_graph& graph) {
  std::vector<bool> seen(graph.node_weights.size(), false);
  std::vector<local_id> order{0};
  seen[0] = true;
  for (std::size_t k = 0; k < order.size(); ++k)
    for (const local_id other : graph.row(order[k]))
      if (!seen[other]) {
        seen[other] = true;
        order.push_back(other);
      }
  return order.back();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Prints a row: the medians of both ways and their ratio. The two must give the same.
template <class Way, class OtherWay>
bool compare(const char* what, int runs, const Way& walk_by_concept, const OtherWay& hand) {
  std::vector<double> by_concept, by_hand;
  bool same = true;
  std::int64_t a = 0, b = 0;
  const auto seconds_of = [](const auto& walk, std::int64_t& result) {
    const stopwatch watch;
    result = walk();
    return watch.seconds();
  };
  for (int run = 0; run < runs; ++run) {
    const bool concept_first = run % 2 == 0;
    if (concept_first)
      by_concept.push_back(seconds_of(walk_by_concept, a));
    by_hand.push_back(seconds_of(hand, b));
    if (!concept_first)
      by_concept.push_back(seconds_of(walk_by_concept, a));
    same = same && a == b;
  }
  const double m = median(by_concept);
  const double n = median(by_hand);
  std::printf("| %-34s | %9.2f | %7.2f | %5.2f |%s\n", what, 1e3 * m, 1e3 * n, m / n,
              same ? "" : " results differ");
  return same;
}

/// The contraction by a rule that has judged already, as a number that hangs on all of its result.
template <contraction_rule Rule>
std::int64_t contract_by(const Rule& rule, const mesh_duals<3>& duals, const side_judgement& judged) {
  const auto result = contract_bounded(duals.elements(), duals.dihedrals(), judged, rule,
                                       {.subdomains = 32, .fraction = 0.5});
  std::int64_t sum = result.super_count;
  for (const double weight : result.graph.edge_weights)
    sum = 31 * (sum % 1'000'003) + static_cast<std::int64_t>(weight);
  return sum;
}

} // namespace

int main(int argc, char** argv) {
  const int cells = argc > 1 ? std::atoi(argv[1]) : 60;
  const int runs = argc > 2 ? std::atoi(argv[2]) : 31;
  const auto mesh = dovetail_test::jittered_cubes(cells);
  const side_table<3> sides = build_sides(mesh);
  const element_dual<3> view(sides);
  std::vector<weighted_edge> edges;
  for (local_id v = 0; v < static_cast<local_id>(view.node_count()); ++v)
    view.for_each_neighbour(v, [&](local_id w) {
      if (v < w)
        edges.push_back({v, w, 1.0});
    });
  const csr_graph csr = make_csr_graph(std::vector<double>(mesh.elements.size(), 1.0), edges);

  std::printf("%zu tetrahedra\n\n| walk | by concept ms | by hand ms | ratio |\n|---|---|---|---|\n",
              mesh.elements.size());
  bool same = compare(
      "all rows of the view", runs, [&] { return sum_by_concept(view); }, [&] { return sum_by_hand(sides); });
  same &= compare(
      "breadth first on the view", runs, [&] { return breadth_first_order(view, 0).back(); },
      [&] { return breadth_first_by_hand(sides); });
  same &= compare(
      "breadth first on the csr graph", runs, [&] { return breadth_first_order(csr, 0).back(); },
      [&] { return breadth_first_by_hand(csr); });

  const auto flat = [](auto coarse) {
    for (vec3& p : coarse.points)
      p.z *= 0.3; // so that the rule has much to decide
    return coarse;
  }(dovetail_test::jittered_cubes(std::max(2, cells / 2)));
  const mesh_duals<3> duals(flat);
  const simplifier::paper rule;
  const any_simplification_rule hidden(rule);
  const side_judgement judged = rule(flat, duals.sides());
  std::printf("\n%zu tetrahedra\n\n| contraction | erased rule ms | static ms | ratio |\n|---|---|---|---|\n",
              flat.elements.size());
  same &= compare(
      "by the paper's rule", std::max(3, runs / 3), [&] { return contract_by(hidden, duals, judged); },
      [&] { return contract_by(rule, duals, judged); });
  return same ? 0 : 1;
}
