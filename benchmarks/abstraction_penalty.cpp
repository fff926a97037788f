/// What it costs to see a mesh as a Boost graph: walks on the element-dual view and on the csr graph by way
/// of Boost.Graph's interface, next to the same walks written by hand over the arrays. Each is the median of
/// several runs, taken in turns, each first in every other. No walk is inlined, and each begins at a multiple
/// of 64 bytes, so that none depends on the code around it: that alone changes a short loop by up to 1.7.
/// Usage: abstraction_penalty [cells per axis (default 60: 1.3 million tetrahedra)] [runs (default 31)]
#include "dovetail/core/report.hpp"
#include "dovetail/graph/contraction.hpp"
#include "dovetail/graph/csr_boost.hpp"
#include "dovetail/graph/dual.hpp"
#include "dovetail/graph/traversal.hpp"
#include "support/jittered_meshes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

using namespace dovetail;

/// The sum over all elements of all neighbours times an edge property, which no compiler can skip.
template <class G>
[[gnu::noinline, gnu::aligned(64)]] std::int64_t sum_by_interface(const G& graph) {
  std::int64_t sum = 0;
  for (auto [v, v_end] = vertices(graph); v != v_end; ++v)
    for (auto [e, e_end] = out_edges(*v, graph); e != e_end; ++e)
      sum += static_cast<std::int64_t>(target(*e, graph)) ^ get(boost::edge_index, graph, *e);
  return sum;
}

/// The element across a side, or no_id; `manifold`: the table has no side with three elements or more.
local_id across(const side_table<3>& sides, local_id side, local_id element, bool manifold) {
  const auto& pair = sides.elements[static_cast<std::size_t>(side)];
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
        sum += static_cast<std::int64_t>(other) ^ side;
    }
  return sum;
}

[[gnu::noinline, gnu::aligned(64)]] std::int64_t list_by_hand(const side_table<3>& sides) {
  const bool manifold = sides.further_elements.empty();
  std::int64_t sum = 0;
  for (std::size_t side = 0; side < sides.elements.size(); ++side) {
    const auto& pair = sides.elements[side];
    if (pair[1] != no_id && (manifold || !sides.is_non_manifold(static_cast<local_id>(side))))
      sum += (static_cast<std::int64_t>(pair[0]) + pair[1]) ^ static_cast<std::int64_t>(side);
  }
  return sum;
}

template <class G>
[[gnu::noinline, gnu::aligned(64)]] std::int64_t list_by_interface(const G& graph) {
  std::int64_t sum = 0;
  for (auto [e, end] = edges(graph); e != end; ++e)
    sum += (static_cast<std::int64_t>(source(*e, graph)) + target(*e, graph)) ^
           get(boost::edge_index, graph, *e);
  return sum;
}

[[gnu::noinline, gnu::aligned(64)]] std::int64_t breadth_first_by_hand(const side_table<3>& sides) {
  const bool manifold = sides.further_elements.empty();
  std::vector<bool> seen(sides.of_element.size(), false);
  std::vector<local_id> order{0};
  seen[0] = true;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const local_id element = order[k];
    for (const local_id side : sides.of_element[static_cast<std::size_t>(element)]) {
      const local_id other = across(sides, side, element, manifold);
      if (other != no_id && !seen[static_cast<std::size_t>(other)]) {
        seen[static_cast<std::size_t>(other)] = true;
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
      if (!seen[static_cast<std::size_t>(other)]) {
        seen[static_cast<std::size_t>(other)] = true;
        order.push_back(other);
      }
  return order.back();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Prints a row: both medians and their ratio. `interface` and `hand` must give the same.
template <class Interface, class Hand>
bool compare(const char* what, int runs, const Interface& interface, const Hand& hand) {
  std::vector<double> by_interface, by_hand;
  bool same = true;
  std::int64_t a = 0, b = 0;
  const auto seconds_of = [](const auto& walk, std::int64_t& result) {
    const stopwatch watch;
    result = walk();
    return watch.seconds();
  };
  for (int run = 0; run < runs; ++run) {
    const bool interface_first = run % 2 == 0;
    if (interface_first)
      by_interface.push_back(seconds_of(interface, a));
    by_hand.push_back(seconds_of(hand, b));
    if (!interface_first)
      by_interface.push_back(seconds_of(interface, a));
    same = same && a == b;
  }
  const double m = median(by_interface);
  const double n = median(by_hand);
  std::printf("| %-34s | %9.2f | %7.2f | %5.2f |%s\n", what, 1e3 * m, 1e3 * n, m / n,
              same ? "" : " results differ");
  return same;
}

} // namespace

int main(int argc, char** argv) {
  const int cells = argc > 1 ? std::atoi(argv[1]) : 60;
  const int runs = argc > 2 ? std::atoi(argv[2]) : 31;
  const auto mesh = dovetail_test::jittered_cubes(cells);
  const side_table<3> sides = build_sides(mesh);
  const element_dual<3> view(sides);
  std::vector<weighted_edge> edge_list;
  for (auto [e, end] = edges(view); e != end; ++e)
    edge_list.push_back({e->source, e->target, 1.0});
  const csr_graph csr = make_csr_graph(std::vector<double>(mesh.elements.size(), 1.0), edge_list);

  std::printf("%zu tetrahedra\n\n| walk | interface ms | by hand ms | ratio |\n|---|---|---|---|\n",
              mesh.elements.size());
  bool same = compare(
      "all rows of the view", runs, [&] { return sum_by_interface(view); },
      [&] { return sum_by_hand(sides); });
  same &= compare(
      "edge list of the view", runs, [&] { return list_by_interface(view); },
      [&] { return list_by_hand(sides); });
  same &= compare(
      "breadth first on the view", runs, [&] { return breadth_first_order(view, local_id{0}).back(); },
      [&] { return breadth_first_by_hand(sides); });
  same &= compare(
      "breadth first on the csr graph", runs, [&] { return breadth_first_order(csr, local_id{0}).back(); },
      [&] { return breadth_first_by_hand(csr); });
  return same ? 0 : 1;
}
