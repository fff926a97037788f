/// @file
/// What `selected_pieces.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/selected_pieces.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// New numbers by old ones; no_id for what goes.
using renumbering = std::vector<local_id>;

inline renumbering number_wanted(std::size_t pieces, std::span<const local_id> wanted) {
  renumbering number(pieces, no_id);
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    if (wanted[k] < 0 || static_cast<std::size_t>(wanted[k]) >= pieces)
      throw usage_error("there is no piece " + std::to_string(wanted[k]) + "; the mesh has " +
                        std::to_string(pieces));
    if (k > 0 && wanted[k] <= wanted[k - 1])
      throw usage_error("the pieces that are selected must grow, each once");
    number[wanted[k]] = static_cast<local_id>(k);
  }
  return number;
}

/// The sides that wanted pieces have, with the points' old numbers.
template <int D>
void select_sides(const simplicial_skeleton<D>& whole, const renumbering& number,
                  simplicial_skeleton<D>& part) {
  const auto renumbered = [&](local_id piece) { return piece == no_id ? no_id : number[piece]; };
  for (std::size_t s = 0; s < whole.sides.size(); ++s) {
    std::array<local_id, 2> beside{renumbered(whole.subdomains[s][0]), renumbered(whole.subdomains[s][1])};
    simplex<D - 1> side = whole.sides[s];
    if (beside[0] == no_id && beside[1] == no_id)
      continue;
    if (beside[0] == no_id) { // a side is oriented outwards of its first piece
      std::swap(beside[0], beside[1]);
      std::swap(side[D - 2], side[D - 1]);
    }
    part.sides.own().push_back(side);
    part.subdomains.own().push_back(beside);
    part.side_hosts.own().push_back(whole.side_hosts[s]);
  }
}

/// The edges on CAD curves that are edges of the sides kept, with the points' old numbers.
inline void select_curve_edges(const simplicial_skeleton<3>& whole, simplicial_skeleton<3>& part) {
  std::vector<std::array<local_id, 2>> kept;
  for (const auto& [a, b, c] : part.sides)
    for (const auto& edge : {std::array{a, b}, std::array{b, c}, std::array{c, a}})
      kept.push_back(sorted_vertices(edge));
  sort_unique(kept);
  for (std::size_t e = 0; e < whole.curve_edges.size(); ++e)
    if (std::binary_search(kept.begin(), kept.end(), sorted_vertices(whole.curve_edges[e]))) {
      part.curve_edges.push_back(whole.curve_edges[e]);
      part.curves.push_back(whole.curves[e]);
    }
}
inline void select_curve_edges(const simplicial_skeleton<2>&, simplicial_skeleton<2>&) {
  // In D = 2 they are sides.
}

/// Takes the points of the sides along, and numbers them in their order.
template <int D>
renumbering select_points(const simplicial_skeleton<D>& whole, simplicial_skeleton<D>& part) {
  renumbering number(whole.points.size(), no_id);
  for (const auto& side : part.sides)
    for (const local_id v : side)
      number[v] = 0;
  local_id next = 0;
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] != no_id) {
      number[v] = next++;
      part.points.own().push_back(whole.points[v]);
      part.point_hosts.own().push_back(whole.point_hosts[v]);
    }
  for (auto& side : part.sides.own())
    for (local_id& v : side)
      v = number[v];
  for (auto& edge : part.curve_edges)
    for (local_id& v : edge)
      v = number[v];
  return number;
}

} // namespace detail

template <int D>
distributed_simplicial_mesh<D> selected_pieces(const distributed_simplicial_mesh<D>& mesh,
                                               std::span<const local_id> wanted) {
  if (mesh.mid_nodes)
    throw usage_error("pieces are selected before mid-edge nodes are added");
  const auto number_of_piece = detail::number_wanted(mesh.counts.size(), wanted);
  distributed_simplicial_mesh<D> result;
  detail::select_sides<D>(mesh.skeleton, number_of_piece, result.skeleton);
  detail::select_curve_edges(mesh.skeleton, result.skeleton);
  const std::vector<local_id> old(wanted.begin(), wanted.end());
  for (const local_id p : old) {
    result.counts.push_back(mesh.counts[p]);
    if (!mesh.quality.empty())
      result.quality.push_back(mesh.quality[p]);
  }
  result.load = [load = mesh.load, old,
                 number = detail::select_points<D>(mesh.skeleton, result.skeleton)](local_id p) {
    simplicial_piece<D> piece = load(old[p]);
    piece.subdomain = p;
    for (local_id& v : piece.skeleton_points)
      v = number[v];
    return piece;
  };
  if (mesh.release)
    result.release = [release = mesh.release, old](local_id p, const piece_note& note) {
      release(old[p], note);
    };
  if (mesh.released)
    result.released = [released = mesh.released, old](local_id p) { return released(old[p]); };
  result.material_names = mesh.material_names;
  result.face_names = mesh.face_names;
  result.group_names = mesh.group_names;
  return result;
}

#ifdef DOVETAIL_COMPILED
template distributed_simplicial_mesh<2> selected_pieces<2>(const distributed_simplicial_mesh<2>& mesh,
                                                           std::span<const local_id> wanted);
template distributed_simplicial_mesh<3> selected_pieces<3>(const distributed_simplicial_mesh<3>& mesh,
                                                           std::span<const local_id> wanted);
#endif

} // namespace dovetail
