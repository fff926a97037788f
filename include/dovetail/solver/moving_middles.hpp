/// @file
/// The middles of the edges of a mesh, moved back from the CAD model until no second-order element is
/// inverted.
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/quadratic_element.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/solver/edge_middles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <vector>

namespace dovetail::io::detail {

/// How often the middle of an edge was moved half of its way back; the last time all the way.
using halvings = std::uint8_t;
inline constexpr halvings all_the_way = 7;

/// The middles of the edges of a mesh in memory, on their way.
struct moving_middles {
  std::vector<vec3> straight;
  std::vector<vec3> curved; ///< on the CAD model; where there is none as `straight`
  std::vector<halvings> moved;

  vec3 at(std::size_t edge) const {
    const auto h = moved[edge];
    return h == 0             ? curved[edge]
           : h == all_the_way ? straight[edge]
                              : straight[edge] + std::ldexp(1.0, -h) * (curved[edge] - straight[edge]);
  }
  bool bent(std::size_t edge) const { return at(edge) != straight[edge]; }
};

inline std::vector<vec3> straight_middles(const std::vector<simplex<1>>& edges,
                                          std::span<const vec3> points) {
  std::vector<vec3> middles;
  middles.reserve(edges.size());
  for (const auto& [a, b] : edges)
    middles.push_back(midpoint(points[static_cast<std::size_t>(a)], points[static_cast<std::size_t>(b)]));
  return middles;
}

/// Moves middles back until no element is inverted; those of edges that are not `movable` stay, if there are
/// any.
template <int D, class Movable>
void settle(const simplicial_mesh<D>& mesh, const edge_table<D>& edges, moving_middles& middles, double least,
            const Movable& movable) {
  std::vector<std::size_t> elements(mesh.elements.size());
  std::iota(elements.begin(), elements.end(), std::size_t{0});
  while (true) {
    std::erase_if(elements, [&](std::size_t e) {
      const auto& of = edges.of_element[e];
      return std::none_of(of.begin(), of.end(),
                          [&](local_id k) { return middles.bent(static_cast<std::size_t>(k)); });
    });
    std::vector<std::size_t> back;
    for (const std::size_t e : elements) {
      std::array<vec3, quadratic_nodes<D>> nodes;
      for (std::size_t k = 0; k <= D; ++k)
        nodes[k] = mesh.points[static_cast<std::size_t>(mesh.elements[e][k])];
      for (std::size_t k = 0; k < edges_per_element<D>; ++k)
        nodes[D + 1 + k] = middles.at(static_cast<std::size_t>(edges.of_element[e][k]));
      if (least_jacobian(nodes) >= least)
        continue;
      for (const local_id k : edges.of_element[e])
        if (const auto edge = static_cast<std::size_t>(k); middles.bent(edge) && movable(edge))
          back.push_back(edge);
    }
    if (back.empty())
      return;
    sort_unique(back);
    for (const std::size_t edge : back)
      ++middles.moved[edge];
  }
}

/// The face of each edge of a mesh of triangles, where there are several the one of the last triangle.
inline std::vector<host> faces_of_edges(const simplicial_mesh<2>& mesh, const edge_table<2>& edges) {
  std::vector<host> hosts(edges.vertices.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (const local_id k : edges.of_element[e])
      hosts[static_cast<std::size_t>(k)] = {2, mesh.tags[e]};
  return hosts;
}

/// Finds the middles of some edges, and counts those that the model has not.
struct found_middles {
  std::int64_t not_found = 0;
  std::vector<vec3> points;

  void find(edge_middles& middle, vec3 a, vec3 b, host on) {
    const auto found = middle(a, b, on);
    not_found += found ? 0 : 1;
    points.push_back(found.value_or(midpoint(a, b)));
  }
};

inline bool on_cad(host on) {
  return on.dimension == 1 || on.dimension == 2;
}

inline void count_middles(report& summary, const std::vector<host>& hosts, const moving_middles& middles,
                          std::int64_t not_found) {
  const auto& moved = middles.moved;
  summary.set("nodes", static_cast<double>(moved.size()));
  summary.set("on_cad", static_cast<double>(std::count_if(hosts.begin(), hosts.end(), on_cad)));
  summary.set("not_found", static_cast<double>(not_found));
  summary.set("moved_back", static_cast<double>(
                                std::count_if(moved.begin(), moved.end(), [](halvings h) { return h > 0; })));
  summary.set("straightened", static_cast<double>(std::count(moved.begin(), moved.end(), all_the_way)));
}

inline void warn_of_middles(report& summary) {
  const auto count = [&](const char* counter) { return std::to_string(std::llround(summary.get(counter))); };
  if (summary.get("not_found") > 0)
    summary.warnings.push_back(count("not_found") +
                               " edges on the CAD model have straight middles: it has no point near");
  if (summary.get("moved_back") > 0)
    summary.warnings.push_back(
        count("moved_back") + " middles of edges were moved back from the CAD model, " +
        count("straightened") + " of them all the way, so that no second-order element is inverted");
}

} // namespace dovetail::io::detail
