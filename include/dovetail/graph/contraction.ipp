/// @file
/// What `contraction.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/graph/contraction.hpp"
#include "dovetail/graph/csr_graph.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// Sorts half edges by their other end, equal ones in their order. Mostly these are a few, for which
/// `std::stable_sort` would ask for memory each time.
inline void sort_row(std::pair<local_id, double>* first, std::pair<local_id, double>* last) {
  constexpr std::ptrdiff_t few = 32;
  const auto comes_first = [](const auto& x, const auto& y) { return x.first < y.first; };
  if (last - first > few) {
    std::stable_sort(first, last, comes_first);
    return;
  }
  for (auto* next = first; next < last; ++next)
    std::rotate(std::upper_bound(first, next, *next, comes_first), next, next + 1);
}

} // namespace detail

DOVETAIL_INLINE csr_graph make_csr_graph(std::vector<double> node_weights,
                                         const std::vector<weighted_edge>& edges) {
  const std::size_t n = node_weights.size();
  std::vector<std::int64_t> begins(n + 1, 0);
  for (const weighted_edge& e : edges) {
    if (e.a < 0 || e.b < 0 || static_cast<std::size_t>(std::max(e.a, e.b)) >= n)
      throw usage_error("edge (" + std::to_string(e.a) + ", " + std::to_string(e.b) + ") leaves the " +
                        std::to_string(n) + " nodes of the graph");
    if (e.a != e.b) {
      ++begins[static_cast<std::size_t>(e.a) + 1];
      ++begins[static_cast<std::size_t>(e.b) + 1];
    }
  }
  for (std::size_t v = 0; v < n; ++v)
    begins[v + 1] += begins[v];
  std::vector<std::pair<local_id, double>> half_edges(static_cast<std::size_t>(begins[n]));
  std::vector<std::int64_t> next(begins.begin(), begins.end() - 1);
  for (const weighted_edge& e : edges)
    if (e.a != e.b) {
      half_edges[next[e.a]++] = {e.b, e.weight};
      half_edges[next[e.b]++] = {e.a, e.weight};
    }

  csr_graph graph;
  graph.node_weights = std::move(node_weights);
  graph.offsets.reserve(n + 1);
  graph.neighbours.reserve(half_edges.size());
  graph.edge_weights.reserve(half_edges.size());
  for (std::size_t v = 0; v < n; ++v) {
    auto* const first = half_edges.data() + begins[v];
    auto* const last = half_edges.data() + begins[v + 1];
    detail::sort_row(first, last);
    for (const auto* it = first; it != last; ++it)
      if (it != first && (it - 1)->first == it->first) {
        graph.edge_weights.back() += it->second;
      } else {
        graph.neighbours.push_back(it->first);
        graph.edge_weights.push_back(it->second);
      }
    graph.offsets.push_back(static_cast<std::int64_t>(graph.neighbours.size()));
  }
  return graph;
}

DOVETAIL_INLINE std::vector<vec3> mean_positions(std::span<const vec3> positions,
                                                 std::span<const local_id> label, local_id labels) {
  if (positions.empty())
    return {};
  std::vector<vec3> sums(static_cast<std::size_t>(labels));
  std::vector<double> counts(static_cast<std::size_t>(labels), 0.0);
  for (std::size_t v = 0; v < label.size(); ++v) {
    sums[label[v]] += positions[v];
    counts[label[v]] += 1;
  }
  for (std::size_t k = 0; k < sums.size(); ++k)
    sums[k] = sums[k] / std::max(1.0, counts[k]);
  return sums;
}

} // namespace dovetail
