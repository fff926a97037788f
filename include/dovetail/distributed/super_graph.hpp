/// @file
/// The elements of all pieces as one graph: each piece's super-elements, joined over the skeleton.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/graph/contraction.hpp"
#include "dovetail/graph/distributed_csr_graph.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/distributed_validity.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Whether a subdomain is behind the i-th of the sides that are listed as its own. It is behind a sheet
/// inside it, which is listed twice, the first time.
template <int D>
bool is_behind(const simplicial_skeleton<D>& skeleton, std::span<const local_id> listed, std::size_t i,
               local_id subdomain) {
  const bool second_of_sheet = i > 0 && listed[i - 1] == listed[i];
  return skeleton.subdomains[listed[i]][0] == subdomain && !second_of_sheet;
}

/// The sides of the skeleton that bound a piece, in the order of `sides_of_subdomains`, as the piece has
/// them.
struct sides_of_piece {
  std::vector<local_id> sides;    ///< of the piece's side table
  std::vector<local_id> elements; ///< of the piece
};

/// Finds them by their points. `table` is `build_sides(piece.mesh)`. Throws `mesh_error` when the piece has
/// no element at a side. About linear in the piece's boundary.
template <int D>
sides_of_piece find_skeleton_sides(const simplicial_piece<D>& piece, const side_table<D>& table,
                                   const simplicial_skeleton<D>& skeleton, std::span<const local_id> listed) {
  const auto expected = io::detail::expected_sides<D>(skeleton, listed, piece.subdomain);
  std::vector<std::pair<simplex<D - 1>, std::array<local_id, 2>>> found; // with side and element
  for (std::size_t s = 0; s < table.size(); ++s) {
    const auto& vertices = table.vertices[s];
    if (std::any_of(vertices.begin(), vertices.end(),
                    [&](local_id v) { return static_cast<std::size_t>(v) >= piece.skeleton_points.size(); }))
      continue;
    const auto side = static_cast<local_id>(s);
    for (const local_id e : table.all_elements(side)) {
      auto outwards = side_of_element(piece.mesh, table, side, e);
      for (local_id& v : outwards)
        v = piece.skeleton_points[v];
      found.push_back({io::detail::make_oriented<D>(outwards, e).vertices, {side, e}});
    }
  }
  sort_all(found);
  sides_of_piece result;
  result.sides.resize(listed.size());
  result.elements.resize(listed.size());
  std::size_t at = 0;
  for (const auto& wanted : expected) {
    while (at < found.size() && found[at].first < wanted.vertices)
      ++at;
    const auto i = static_cast<std::size_t>(wanted.origin);
    if (at == found.size() || found[at].first != wanted.vertices)
      throw mesh_error("subdomain " + std::to_string(piece.subdomain) + " has no element at side " +
                       std::to_string(listed[i]) + " of the skeleton");
    result.sides[i] = found[at].second[0];
    result.elements[i] = found[at].second[1];
    ++at;
  }
  return result;
}

/// What is known of a piece whose elements were joined to super-elements.
struct simplified_piece {
  csr_graph graph;                     ///< of its super-elements; nodes weigh their elements
  std::vector<local_id> super_at_side; ///< per side of the skeleton, as in `sides_of_piece`
  std::vector<double> penalty_of_side; ///< of each such side as an interface; 1 for a good one

  using fields = field_list<&simplified_piece::graph, &simplified_piece::super_at_side, ///< what is stored
                            &simplified_piece::penalty_of_side>;
};

/// The super-elements of a whole mesh.
struct joined_supers {
  csr_graph graph;                      ///< super-elements and what is between them
  std::vector<local_id> first_of_piece; ///< number of a piece's first super-element; the last is their number
  std::vector<std::array<local_id, 2>>
      at_side;                         ///< per side of the skeleton: behind and in front of it, or no_id
  std::vector<double> penalty_of_side; ///< per side of the skeleton: the higher of those of its two pieces
};

/// Joins the graphs of all pieces over the sides of the skeleton. A side inside a solid weighs `seam_weight`
/// times its penalty: the partitioner goes elsewhere where it can, and what was an interface becomes
/// interior. Sides on CAD entities, which stay in any skeleton, weigh 1. Linear but for sorting rows.
template <int D>
joined_supers join_supers(const simplicial_skeleton<D>& skeleton, const std::vector<simplified_piece>& pieces,
                          double seam_weight) {
  joined_supers joined;
  joined.first_of_piece = {0};
  joined.at_side.assign(skeleton.sides.size(), {no_id, no_id});
  joined.penalty_of_side.assign(skeleton.sides.size(), 1);
  const auto sides = sort_by_subdomain(skeleton, pieces.size());
  std::vector<double> weights;
  std::vector<vec3> positions;
  std::vector<weighted_edge> edges;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const csr_graph& graph = pieces[p].graph;
    const local_id first = joined.first_of_piece.back();
    append(weights, graph.node_weights);
    append(positions, graph.positions);
    for (local_id v = 0; v < graph.node_count(); ++v)
      graph.for_each_edge(v, [&](local_id w, double weight) {
        if (v < w)
          edges.push_back({first + v, first + w, weight});
      });
    const auto listed = sides[p];
    for (std::size_t i = 0; i < listed.size(); ++i) {
      const auto s = static_cast<std::size_t>(listed[i]);
      const bool behind = is_behind(skeleton, listed, i, static_cast<local_id>(p));
      joined.at_side[s][behind ? 0 : 1] = first + pieces[p].super_at_side[i];
      joined.penalty_of_side[s] = std::max(joined.penalty_of_side[s], pieces[p].penalty_of_side[i]);
    }
    joined.first_of_piece.push_back(first + graph.node_count());
  }
  for (std::size_t s = 0; s < joined.at_side.size(); ++s)
    if (const auto [behind, front] = joined.at_side[s];
        front != no_id && skeleton.subdomains[s][0] != skeleton.subdomains[s][1])
      edges.push_back(
          {behind, front, skeleton.side_hosts[s] == no_id ? seam_weight * joined.penalty_of_side[s] : 1.0});
  joined.graph = make_csr_graph(std::move(weights), edges);
  joined.graph.positions = std::move(positions);
  return joined;
}

} // namespace dovetail
