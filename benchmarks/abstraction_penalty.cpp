/// What it costs to see a mesh as a Boost graph: walks on the element-dual view and on the csr graph by way
/// of Boost.Graph's interface, next to the same walks written by hand over the arrays. Each is the fastest of
/// several runs, taken in turns. Usage: abstraction_penalty [cells per axis (default 60: 1.3 million
/// tetrahedra)] [runs (default 9)]
#include "dovetail/core/report.hpp"
#include "dovetail/graph/contraction.hpp"
#include "dovetail/graph/csr_boost.hpp"
#include "dovetail/graph/dual.hpp"
#include "dovetail/graph/traversal.hpp"
#include "support/jittered_meshes.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace dovetail;

/// The sum over all elements of all neighbours times an edge property, which no compiler can skip.
template <class G>
std::int64_t sum_by_interface(const G& graph) {
  std::int64_t sum = 0;
  for (auto [v, v_end] = vertices(graph); v != v_end; ++v)
    for (auto [e, e_end] = out_edges(*v, graph); e != e_end; ++e)
      sum += static_cast<std::int64_t>(target(*e, graph)) ^ get(boost::edge_index, graph, *e);
  return sum;
}

std::int64_t sum_by_hand(const side_table<3>& sides) {
  std::int64_t sum = 0;
  for (std::size_t e = 0; e < sides.of_element.size(); ++e)
    for (const local_id side : sides.of_element[e]) {
      const local_id other = sides.across(side, static_cast<local_id>(e));
      if (other != no_id)
        sum += static_cast<std::int64_t>(other) ^ side;
    }
  return sum;
}

std::int64_t breadth_first_by_hand(const side_table<3>& sides) {
  std::vector<bool> seen(sides.of_element.size(), false);
  std::vector<local_id> order{0};
  seen[0] = true;
  for (std::size_t k = 0; k < order.size(); ++k)
    for (const local_id side : sides.of_element[static_cast<std::size_t>(order[k])]) {
      const local_id other = sides.across(side, order[k]);
      if (other != no_id && !seen[static_cast<std::size_t>(other)]) {
        seen[static_cast<std::size_t>(other)] = true;
        order.push_back(other);
      }
    }
  return order.back();
}

std::int64_t breadth_first_by_hand(const csr_graph& graph) {
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

/// Prints a row: both times and their ratio. `interface` and `hand` must give the same.
template <class Interface, class Hand>
bool compare(const char* what, int runs, const Interface& interface, const Hand& hand) {
  double by_interface = 1e300, by_hand = 1e300;
  bool same = true;
  for (int run = 0; run < runs; ++run) {
    const stopwatch first;
    const std::int64_t a = interface();
    by_interface = std::min(by_interface, first.seconds());
    const stopwatch second;
    const std::int64_t b = hand();
    by_hand = std::min(by_hand, second.seconds());
    same = same && a == b;
  }
  std::printf("| %-34s | %9.2f | %7.2f | %5.2f |%s\n", what, 1e3 * by_interface, 1e3 * by_hand,
              by_interface / by_hand, same ? "" : " results differ");
  return same;
}

} // namespace

int main(int argc, char** argv) {
  const int cells = argc > 1 ? std::atoi(argv[1]) : 60;
  const int runs = argc > 2 ? std::atoi(argv[2]) : 9;
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
      "all edges of the view", runs, [&] { return sum_by_interface(view); },
      [&] { return sum_by_hand(sides); });
  same &= compare(
      "breadth first on the view", runs, [&] { return breadth_first_order(view, local_id{0}).back(); },
      [&] { return breadth_first_by_hand(sides); });
  same &= compare(
      "breadth first on the csr graph", runs, [&] { return breadth_first_order(csr, local_id{0}).back(); },
      [&] { return breadth_first_by_hand(csr); });
  return same ? 0 : 1;
}
