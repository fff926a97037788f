/// @file
/// What `make_rank_mesh.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/mid_nodes.hpp"
#include "dovetail/solver/make_rank_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail::io {

namespace detail {

template <int D>
class rank_mesh_builder {
public:
  rank_mesh_builder(const distributed_simplicial_mesh<D>& source, const rank_numbering& ranks, local_id rank)
      : source_(source), skeleton_(source.skeleton), ranks_(ranks), numbers_(number_nodes(source)) {
    result_.rank = rank;
    result_.ranks = ranks.ranks();
    const auto q = static_cast<std::size_t>(rank);
    require_room(ranks.first_vertex[q + 1] - ranks.first_vertex[q]);
    require_room(ranks.first_element[q + 1] - ranks.first_element[q]);
  }

  rank_mesh<D> build(bool ghosts) {
    add_owned_vertices();
    add_vertices_of_others();
    list_sides();
    for (const local_id p : ranks_.pieces_of_rank[result_.rank])
      add_piece(load_checked(source_, p));
    result_.owned_elements = result_.mesh.elements.size();
    require_used();
    list_neighbours();
    if (ghosts)
      add_all_ghosts();
    return std::move(result_);
  }

  rank_counts count(bool ghosts) {
    add_owned_vertices();
    add_vertices_of_others();
    list_sides();
    if (ghosts)
      add_all_ghosts();
    const auto q = static_cast<std::size_t>(result_.rank);
    const global_id owned = ranks_.first_element[q + 1] - ranks_.first_element[q];
    return {result_.mesh.points.size(), static_cast<std::uint64_t>(owned) + result_.mesh.elements.size(),
            result_.sides.size()};
  }

private:
  void require_room(global_id count) const {
    if (count > std::numeric_limits<local_id>::max())
      throw mesh_error("rank " + std::to_string(result_.rank) + " would have " + std::to_string(count) +
                       " vertices or elements, more than local ids can number; make more ranks");
  }

  local_id add_vertex(vec3 at, global_id id, local_id owner, global_id number) {
    result_.mesh.points.push_back(at);
    result_.vertex_ids.push_back(id);
    result_.vertex_owners.push_back(owner);
    result_.vertex_numbers.push_back(number);
    return static_cast<local_id>(result_.mesh.points.size() - 1);
  }
  local_id add_skeleton_node(std::size_t v) {
    const auto node = static_cast<local_id>(v);
    return local_[v] = add_vertex(skeleton_node(source_, node), ranks_.point_ids[v],
                                  ranks_.owner_of_point(node), node);
  }
  /// Of own node i of a piece: its inner points come first, then the middles of its inner edges.
  global_id id_of_own(std::size_t piece, global_id i) const {
    const global_id points = source_.counts[piece].inner_points;
    return i < points ? ranks_.first_inner_of_piece[piece] + i
                      : ranks_.first_middle_of_piece[piece] + i - points;
  }

  /// Room for what is inside pieces is made here, the places come with them.
  void add_owned_vertices() {
    local_.assign(skeleton_nodes(source_), no_id);
    const auto add = [&](bool middles) {
      const std::size_t points = skeleton_.points.size();
      for (std::size_t v = middles ? points : 0; v < (middles ? local_.size() : points); ++v)
        if (ranks_.owner_of_point(static_cast<local_id>(v)) == result_.rank)
          add_skeleton_node(v);
      for (const local_id piece : ranks_.pieces_of_rank[result_.rank]) {
        const auto p = static_cast<std::size_t>(piece);
        const global_id inner = source_.counts[p].inner_points;
        for (global_id i = middles ? inner : 0; i < (middles ? inner_nodes(source_, p) : inner); ++i)
          add_vertex({}, id_of_own(p, i), result_.rank, numbers_.first_point[p] + i);
      }
    };
    add(false);
    result_.owned_corners = result_.mesh.points.size();
    add(true);
    result_.owned_vertices = result_.mesh.points.size();
  }
  void add_vertices_of_others() {
    for (std::size_t v = 0; v < local_.size(); ++v) {
      const auto at = ranks_.ranks_at_point[v];
      if (local_[v] == no_id && std::find(at.begin(), at.end(), result_.rank) != at.end())
        add_skeleton_node(v);
    }
    result_.held_vertices = result_.mesh.points.size();
    require_room(static_cast<global_id>(result_.held_vertices));
  }

  local_id rank_of(local_id piece) const { return piece == no_id ? no_id : ranks_.rank_of_piece[piece]; }
  bool is_ours(std::size_t side) const {
    const auto [behind, front] = skeleton_.subdomains[side];
    return rank_of(behind) == result_.rank || rank_of(front) == result_.rank;
  }

  /// The rank's sides on CAD entities, by their vertices. Edges of other than two triangles are listed
  /// several times in a skeleton of D = 2.
  void list_sides() {
    for (std::size_t s = 0; s < skeleton_.sides.size(); ++s)
      if (skeleton_.side_hosts[s] != no_id && is_ours(s))
        keys_.emplace_back(sorted_vertices(skeleton_.sides[s]), skeleton_.side_hosts[s]);
    sort_all(keys_);
    keys_.erase(std::unique(keys_.begin(), keys_.end(),
                            [](const auto& a, const auto& b) { return a.first == b.first; }),
                keys_.end());
    result_.sides.resize(keys_.size());
    result_.side_elements.assign(keys_.size(), {no_id, no_id});
    if (source_.mid_nodes)
      result_.side_middles.resize(keys_.size());
    for (const auto& [key, host] : keys_)
      result_.side_hosts.push_back(host);
  }

  /// Of node i of a piece of this rank.
  local_id local_of(const piece_nodes<D>& nodes, std::size_t piece, std::size_t i) const {
    const auto shared = nodes.shared();
    if (i < shared.size())
      return local_[shared[i]];
    return static_cast<local_id>(id_of_own(piece, static_cast<global_id>(i - shared.size())) -
                                 ranks_.first_vertex[result_.rank]);
  }

  /// `vertices` are the corners and, of second order, the middles of its edges.
  void add_element(const simplicial_piece<D>& piece, std::size_t e, std::span<const local_id> vertices) {
    const auto p = static_cast<std::size_t>(piece.subdomain);
    const auto in_piece = static_cast<global_id>(e);
    std::copy_n(vertices.begin(), D + 1, result_.mesh.elements.emplace_back().begin());
    if (source_.mid_nodes)
      std::copy(vertices.begin() + D + 1, vertices.end(), result_.middles.emplace_back().begin());
    result_.mesh.tags.push_back(piece.mesh.tags.empty() ? piece.material : piece.mesh.tags[e]);
    result_.element_ids.push_back(ranks_.first_element_of_piece[p] + in_piece);
    result_.element_owners.push_back(ranks_.rank_of_piece[p]);
    result_.element_numbers.push_back(numbers_.first_element[p] + in_piece);
    result_.subdomains.push_back(piece.subdomain);
  }

  void require_announced(const piece_nodes<D>& nodes, std::size_t piece) const {
    if (static_cast<global_id>(nodes.own().size()) != inner_nodes(source_, piece))
      throw mesh_error("subdomain " + std::to_string(piece) +
                       ": the loaded piece has other inner edges than announced");
  }

  void add_piece(const simplicial_piece<D>& piece) {
    const auto p = static_cast<std::size_t>(piece.subdomain);
    const piece_nodes<D> nodes(source_, piece);
    require_announced(nodes, p);
    for (std::size_t i = 0; i < nodes.own().size(); ++i)
      result_.mesh.points[local_of(nodes, p, nodes.shared().size() + i)] = nodes.own()[i];
    std::vector<local_id> vertices(nodes.per_element());
    for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e) {
      for (std::size_t k = 0; k < vertices.size(); ++k) {
        vertices[k] = local_of(nodes, p, static_cast<std::size_t>(nodes.of_element(e)[k]));
        if (vertices[k] == no_id)
          throw mesh_error("subdomain " + std::to_string(piece.subdomain) +
                           " has a skeleton point that is on none of its skeleton sides");
      }
      add_element(piece, e, vertices);
      for (const auto& side : numbering::sides<D>)
        meet_side(piece, dovetail::detail::pick(piece.mesh.elements[e], side),
                  dovetail::detail::pick(result_.mesh.elements.back(), side));
    }
  }

  /// `side` and `ours`, in the numbers of piece and rank, is one of the last element.
  void meet_side(const simplicial_piece<D>& piece, simplex<D - 1> side, const simplex<D - 1>& ours) {
    for (local_id& v : side) {
      if (static_cast<std::size_t>(v) >= piece.skeleton_points.size())
        return;
      v = piece.skeleton_points[v];
    }
    const auto key = sorted_vertices(side);
    const auto found = std::lower_bound(keys_.begin(), keys_.end(), key,
                                        [](const auto& at, const auto& wanted) { return at.first < wanted; });
    if (found == keys_.end() || found->first != key)
      return;
    const auto s = static_cast<std::size_t>(found - keys_.begin());
    const auto element = static_cast<local_id>(result_.mesh.elements.size() - 1);
    auto& [behind, front] = result_.side_elements[s];
    if (behind == no_id) {
      behind = element;
      result_.sides[s] = ours;
      if (source_.mid_nodes)
        for (std::size_t k = 0; k < edges_per_element<D - 1>; ++k)
          result_.side_middles[s][k] = middle_of(vertices_of_edge(side, numbering::edges<D - 1>[k]));
    } else if (front == no_id)
      front = element;
  }

  /// The vertex in the middle of an edge of the skeleton.
  local_id middle_of(const simplex<1>& edge) const {
    const auto number = static_cast<std::size_t>(find_edge(source_.mid_nodes->edges, edge));
    return local_[skeleton_.points.size() + number];
  }

  void require_used() const {
    std::vector<bool> used(result_.held_vertices, false);
    for (std::size_t e = 0; e < result_.mesh.elements.size(); ++e)
      for_each_node(result_, e, [&](local_id v) { used[v] = true; });
    if (const auto at = std::find(used.begin(), used.end(), false); at != used.end())
      throw mesh_error("point " + std::to_string(result_.vertex_numbers[at - used.begin()]) +
                       " is in no element of the subdomains that it should be in");
    for (const auto& elements : result_.side_elements)
      if (elements[0] == no_id)
        throw mesh_error("a side of the skeleton that lies on the CAD model belongs to no element");
  }

  rank_neighbour& neighbour(local_id rank) {
    auto [at, is_new] = neighbours_.try_emplace(rank);
    at->second.rank = rank;
    return at->second;
  }

  /// All in the order of the skeleton, which every rank sees alike.
  void list_neighbours() {
    for (std::size_t v = 0; v < local_.size(); ++v)
      if (local_[v] != no_id)
        for (const local_id r : ranks_.ranks_at_point[v])
          if (r != result_.rank)
            neighbour(r).vertices.push_back(local_[v]);
    list_shared_edges();
    if constexpr (D == 3)
      list_shared_faces();
    for (auto& [rank, shared] : neighbours_)
      result_.neighbours.push_back(std::move(shared));
  }

  bool is_shared(local_id point) const {
    return local_[point] != no_id && ranks_.ranks_at_point[point].size() > 1;
  }

  /// An edge has elements of two ranks only if it is on the boundary of a piece of each.
  void list_shared_edges() {
    std::vector<std::pair<simplex<1>, local_id>> met; // edge, rank
    for (std::size_t s = 0; s < skeleton_.sides.size(); ++s)
      for (std::size_t k = 0; k < (D == 3 ? 3 : 1); ++k) {
        const auto& side = skeleton_.sides[s];
        const simplex<1> edge = sorted_vertices(simplex<1>{side[k], side[(k + 1) % D]});
        if (is_shared(edge[0]) && is_shared(edge[1]))
          for (const local_id p : skeleton_.subdomains[s])
            if (p != no_id)
              met.emplace_back(edge, rank_of(p));
      }
    sort_unique(met);
    for (std::size_t first = 0, last = 0; first < met.size(); first = last) {
      bool ours = false;
      for (last = first; last < met.size() && met[last].first == met[first].first; ++last)
        ours = ours || met[last].second == result_.rank;
      for (std::size_t i = first; ours && i < last; ++i)
        if (met[i].second != result_.rank)
          neighbour(met[i].second).edges.push_back({local_[met[i].first[0]], local_[met[i].first[1]]});
    }
  }

  void list_shared_faces() requires(D == 3) {
    for (std::size_t s = 0; s < skeleton_.sides.size(); ++s) {
      const local_id behind = rank_of(skeleton_.subdomains[s][0]);
      const local_id front = rank_of(skeleton_.subdomains[s][1]);
      if (front == no_id || behind == front || !is_ours(s))
        continue;
      simplex<2> face = skeleton_.sides[s];
      std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
      if (behind != result_.rank)
        std::swap(face[1], face[2]);
      for (local_id& v : face)
        v = local_[v];
      neighbour(behind == result_.rank ? front : behind).faces.push_back(face);
    }
  }

  /// Pieces of other ranks at points of this one, growing.
  std::vector<local_id> touching_pieces() const {
    std::vector<bool> touches(source_.counts.size(), false);
    for (std::size_t s = 0; s < skeleton_.sides.size(); ++s)
      if (std::any_of(skeleton_.sides[s].begin(), skeleton_.sides[s].end(),
                      [this](local_id v) { return is_shared(v); }))
        for (const local_id p : skeleton_.subdomains[s])
          if (p != no_id && rank_of(p) != result_.rank)
            touches[p] = true;
    std::vector<local_id> pieces;
    for (std::size_t p = 0; p < touches.size(); ++p)
      if (touches[p])
        pieces.push_back(static_cast<local_id>(p));
    return pieces;
  }

  void add_all_ghosts() {
    for (const local_id p : touching_pieces())
      add_ghosts(load_checked(source_, p));
  }
  void add_ghosts(const simplicial_piece<D>& piece) {
    const auto p = static_cast<std::size_t>(piece.subdomain);
    const piece_nodes<D> nodes(source_, piece);
    require_announced(nodes, p);
    const auto shared = nodes.shared();
    std::map<std::size_t, local_id> inner; // own nodes of the piece that are vertices of ghosts
    const auto is_held = [&](local_id v) {
      const auto at = static_cast<std::size_t>(v);
      const local_id ours = at < shared.size() ? local_[shared[at]] : no_id;
      return ours != no_id && static_cast<std::size_t>(ours) < result_.held_vertices;
    };
    const auto place = [&](local_id v) {
      const auto at = static_cast<std::size_t>(v);
      if (at < shared.size()) {
        const auto node = static_cast<std::size_t>(shared[at]);
        return local_[node] != no_id ? local_[node] : add_skeleton_node(node);
      }
      const auto [known, is_new] = inner.try_emplace(at - shared.size(), no_id);
      if (is_new) {
        const auto i = static_cast<global_id>(known->first);
        known->second = add_vertex(nodes.own()[known->first], id_of_own(p, i), ranks_.rank_of_piece[p],
                                   numbers_.first_point[p] + i);
      }
      return known->second;
    };
    std::vector<local_id> vertices(nodes.per_element());
    for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e) {
      const auto of_element = nodes.of_element(e);
      if (std::none_of(of_element.begin(), of_element.begin() + D + 1, is_held))
        continue;
      for (std::size_t k = 0; k < vertices.size(); ++k)
        vertices[k] = place(of_element[k]);
      add_element(piece, e, vertices);
    }
    require_room(static_cast<global_id>(std::max(result_.mesh.points.size(), result_.mesh.elements.size())));
  }

  const distributed_simplicial_mesh<D>& source_;
  const simplicial_skeleton<D>& skeleton_;
  const rank_numbering& ranks_;
  const global_numbering numbers_;
  std::vector<local_id> local_;                           ///< per node of the skeleton, or no_id
  std::vector<std::pair<simplex<D - 1>, local_id>> keys_; ///< per side: points of the skeleton, host
  std::map<local_id, rank_neighbour> neighbours_;
  rank_mesh<D> result_;
};

} // namespace detail

template <int D>
rank_mesh<D> make_rank_mesh(const distributed_simplicial_mesh<D>& mesh, const rank_numbering& numbers,
                            local_id rank, bool ghosts) {
  return detail::rank_mesh_builder<D>(mesh, numbers, rank).build(ghosts);
}

template <int D>
rank_counts count_rank_mesh(const distributed_simplicial_mesh<D>& mesh, const rank_numbering& numbers,
                            local_id rank, bool ghosts) {
  return detail::rank_mesh_builder<D>(mesh, numbers, rank).count(ghosts);
}

#ifdef DOVETAIL_COMPILED
template rank_mesh<2> make_rank_mesh<2>(const distributed_simplicial_mesh<2>&, const rank_numbering&,
                                        local_id, bool);
template rank_mesh<3> make_rank_mesh<3>(const distributed_simplicial_mesh<3>&, const rank_numbering&,
                                        local_id, bool);
template rank_counts count_rank_mesh<2>(const distributed_simplicial_mesh<2>&, const rank_numbering&,
                                        local_id, bool);
template rank_counts count_rank_mesh<3>(const distributed_simplicial_mesh<3>&, const rank_numbering&,
                                        local_id, bool);
#endif

} // namespace dovetail::io
