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
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace dovetail::io {

/// What is counted of the middles of edges.
struct middle_counts {
  std::int64_t nodes = 0;        ///< in the middles of edges
  std::int64_t on_cad = 0;       ///< of edges on curves and faces
  std::int64_t not_found = 0;    ///< of these: the model has no point near, so that they are straight
  std::int64_t moved_back = 0;   ///< from the model, so that no element is inverted
  std::int64_t straightened = 0; ///< of these: moved back all the way
  std::optional<std::int64_t> rounds = {}; ///< of looking at the pieces

  using fields = field_list<&middle_counts::nodes, &middle_counts::on_cad, &middle_counts::not_found,
                            &middle_counts::moved_back, &middle_counts::straightened, &middle_counts::rounds>;
};

} // namespace dovetail::io

namespace dovetail::io::detail {

/// How often the middle of an edge was moved half of its way back; the last time all the way.
using halvings = std::uint8_t;
inline constexpr halvings all_the_way = 7;

/// The middles of the edges of a mesh in memory, on their way.
struct moving_middles {
  std::vector<vec3> straight;
  std::vector<vec3> curved; ///< on the CAD model; where there is none as `straight`
  std::vector<halvings> moved;

  vec3 at(std::size_t edge) const;
  bool bent(std::size_t edge) const { return at(edge) != straight[edge]; }
};

std::vector<vec3> straight_middles(const std::vector<simplex<1>>& edges, std::span<const vec3> points);

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
        nodes[k] = mesh.points[mesh.elements[e][k]];
      for (std::size_t k = 0; k < edges_per_element<D>; ++k)
        nodes[D + 1 + k] = middles.at(edges.of_element[e][k]);
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
std::vector<host> faces_of_edges(const simplicial_mesh<2>& mesh, const edge_table<2>& edges);

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

middle_counts count_middles(const std::vector<host>& hosts, const moving_middles& middles,
                            std::int64_t not_found);

void warn_of_middles(const middle_counts& counts, report& summary);

} // namespace dovetail::io::detail

#ifndef DOVETAIL_COMPILED
#include "dovetail/solver/moving_middles.ipp"
#endif
