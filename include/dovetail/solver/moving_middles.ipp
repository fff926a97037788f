/// @file
/// What `moving_middles.hpp` declares.
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/quadratic_element.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/solver/moving_middles.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace dovetail::io {

namespace detail {

DOVETAIL_INLINE vec3 moving_middles::at(std::size_t edge) const {
  const auto h = moved[edge];
  return h == 0             ? curved[edge]
         : h == all_the_way ? straight[edge]
                            : straight[edge] + std::ldexp(1.0, -h) * (curved[edge] - straight[edge]);
}

DOVETAIL_INLINE std::vector<vec3> straight_middles(const std::vector<simplex<1>>& edges,
                                                   std::span<const vec3> points) {
  std::vector<vec3> middles;
  middles.reserve(edges.size());
  for (const auto& [a, b] : edges)
    middles.push_back(midpoint(points[a], points[b]));
  return middles;
}

DOVETAIL_INLINE std::vector<host> faces_of_edges(const simplicial_mesh<2>& mesh, const edge_table<2>& edges) {
  std::vector<host> hosts(edges.vertices.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (const local_id k : edges.of_element[e])
      hosts[k] = {2, mesh.tags[e]};
  return hosts;
}

DOVETAIL_INLINE middle_counts count_middles(const std::vector<host>& hosts, const moving_middles& middles,
                                            std::int64_t not_found) {
  const auto& moved = middles.moved;
  return {.nodes = static_cast<std::int64_t>(moved.size()),
          .on_cad = std::count_if(hosts.begin(), hosts.end(), on_cad),
          .not_found = not_found,
          .moved_back = std::count_if(moved.begin(), moved.end(), [](halvings h) { return h > 0; }),
          .straightened = std::count(moved.begin(), moved.end(), all_the_way)};
}

DOVETAIL_INLINE void warn_of_middles(const middle_counts& counts, report& summary) {
  if (counts.not_found > 0)
    summary.warnings.push_back(std::to_string(counts.not_found) +
                               " edges on the CAD model have straight middles: it has no point near");
  if (counts.moved_back > 0)
    summary.warnings.push_back(std::to_string(counts.moved_back) +
                               " middles of edges were moved back from the CAD model, " +
                               std::to_string(counts.straightened) +
                               " of them all the way, so that no second-order element is inverted");
}

} // namespace detail

} // namespace dovetail::io
