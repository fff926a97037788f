/// @file
/// What `make_rank_mesh.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/io/make_rank_mesh.hpp"
#include "dovetail/mesh/adjacency.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
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
      : source_(source), skeleton_(source.skeleton), ranks_(ranks), numbers_(number_globally(source)) {
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
      for (const local_id p : touching_pieces())
        add_ghosts(load_checked(source_, p));
    return std::move(result_);
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
  local_id add_skeleton_point(std::size_t v) {
    const auto point = static_cast<local_id>(v);
    return local_[v] =
               add_vertex(skeleton_.points[v], ranks_.point_ids[v], ranks_.owner_of_point(point), point);
  }

  /// Room for the inner points is made here, their places come with the pieces.
  void add_owned_vertices() {
    local_.assign(skeleton_.points.size(), no_id);
    for (std::size_t v = 0; v < local_.size(); ++v)
      if (ranks_.owner_of_point(static_cast<local_id>(v)) == result_.rank)
        add_skeleton_point(v);
    for (const local_id piece : ranks_.pieces_of_rank[result_.rank]) {
      const auto p = static_cast<std::size_t>(piece);
      for (global_id i = 0; i < source_.counts[p].inner_points; ++i)
        add_vertex({}, ranks_.first_inner_of_piece[p] + i, result_.rank, numbers_.first_point[p] + i);
    }
    result_.owned_vertices = result_.mesh.points.size();
  }
  void add_vertices_of_others() {
    for (std::size_t v = 0; v < local_.size(); ++v) {
      const auto at = ranks_.ranks_at_point[v];
      if (local_[v] == no_id && std::find(at.begin(), at.end(), result_.rank) != at.end())
        add_skeleton_point(v);
    }
    result_.held_vertices = result_.mesh.points.size();
    require_room(static_cast<global_id>(result_.held_vertices));
  }

  local_id rank_of(local_id piece) const {
    return piece == no_id ? no_id : ranks_.rank_of_piece[static_cast<std::size_t>(piece)];
  }
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
    for (const auto& [key, host] : keys_)
      result_.side_hosts.push_back(host);
  }

  local_id local_of(const simplicial_piece<D>& piece, local_id i) const {
    const auto shared = piece.skeleton_points.size();
    if (const auto at = static_cast<std::size_t>(i); at < shared)
      return local_[static_cast<std::size_t>(piece.skeleton_points[at])];
    const auto p = static_cast<std::size_t>(piece.subdomain);
    return static_cast<local_id>(ranks_.first_inner_of_piece[p] -
                                 ranks_.first_vertex[static_cast<std::size_t>(result_.rank)]) +
           i - static_cast<local_id>(shared);
  }

  void add_element(const simplicial_piece<D>& piece, std::size_t e, const simplex<D>& element) {
    const auto p = static_cast<std::size_t>(piece.subdomain);
    const auto in_piece = static_cast<global_id>(e);
    result_.mesh.elements.push_back(element);
    result_.mesh.tags.push_back(piece.mesh.tags.empty() ? piece.material : piece.mesh.tags[e]);
    result_.element_ids.push_back(ranks_.first_element_of_piece[p] + in_piece);
    result_.element_owners.push_back(ranks_.rank_of_piece[p]);
    result_.element_numbers.push_back(numbers_.first_element[p] + in_piece);
    result_.subdomains.push_back(piece.subdomain);
  }

  void add_piece(const simplicial_piece<D>& piece) {
    for (std::size_t i = 0; i < piece.mesh.points.size(); ++i)
      if (const local_id v = local_of(piece, static_cast<local_id>(i)); v != no_id)
        result_.mesh.points[static_cast<std::size_t>(v)] = piece.mesh.points[i];
    for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e) {
      simplex<D> element = piece.mesh.elements[e];
      for (local_id& v : element) {
        v = local_of(piece, v);
        if (v == no_id)
          throw mesh_error("subdomain " + std::to_string(piece.subdomain) +
                           " has a skeleton point that is on none of its skeleton sides");
      }
      for (const auto& side : numbering::sides<D>)
        meet_side(piece, dovetail::detail::pick(piece.mesh.elements[e], side),
                  dovetail::detail::pick(element, side));
      add_element(piece, e, element);
    }
  }

  /// `side` and `ours`, in the numbers of piece and rank, is one of the next element.
  void meet_side(const simplicial_piece<D>& piece, simplex<D - 1> side, const simplex<D - 1>& ours) {
    for (local_id& v : side) {
      if (static_cast<std::size_t>(v) >= piece.skeleton_points.size())
        return;
      v = piece.skeleton_points[static_cast<std::size_t>(v)];
    }
    const auto key = sorted_vertices(side);
    const auto found = std::lower_bound(keys_.begin(), keys_.end(), key,
                                        [](const auto& at, const auto& wanted) { return at.first < wanted; });
    if (found == keys_.end() || found->first != key)
      return;
    const auto s = static_cast<std::size_t>(found - keys_.begin());
    const auto element = static_cast<local_id>(result_.mesh.elements.size());
    auto& [behind, front] = result_.side_elements[s];
    if (behind == no_id) {
      behind = element;
      result_.sides[s] = ours;
    } else if (front == no_id)
      front = element;
  }

  void require_used() const {
    std::vector<bool> used(result_.held_vertices, false);
    for (const auto& element : result_.mesh.elements)
      for (const local_id v : element)
        used[static_cast<std::size_t>(v)] = true;
    if (const auto at = std::find(used.begin(), used.end(), false); at != used.end())
      throw mesh_error("point " +
                       std::to_string(result_.vertex_numbers[static_cast<std::size_t>(at - used.begin())]) +
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
    return local_[static_cast<std::size_t>(point)] != no_id && ranks_.ranks_at_point[point].size() > 1;
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
          neighbour(met[i].second)
              .edges.push_back({local_[static_cast<std::size_t>(met[i].first[0])],
                                local_[static_cast<std::size_t>(met[i].first[1])]});
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
        v = local_[static_cast<std::size_t>(v)];
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
            touches[static_cast<std::size_t>(p)] = true;
    std::vector<local_id> pieces;
    for (std::size_t p = 0; p < touches.size(); ++p)
      if (touches[p])
        pieces.push_back(static_cast<local_id>(p));
    return pieces;
  }

  void add_ghosts(const simplicial_piece<D>& piece) {
    const auto shared = piece.skeleton_points.size();
    const auto p = static_cast<std::size_t>(piece.subdomain);
    std::map<local_id, local_id> inner; // points of the piece that are vertices of ghosts
    const auto is_held = [&](local_id v) {
      const local_id at =
          static_cast<std::size_t>(v) < shared
              ? local_[static_cast<std::size_t>(piece.skeleton_points[static_cast<std::size_t>(v)])]
              : no_id;
      return at != no_id && static_cast<std::size_t>(at) < result_.held_vertices;
    };
    const auto place = [&](local_id v) {
      const auto at = static_cast<std::size_t>(v);
      if (at < shared) {
        const auto point = static_cast<std::size_t>(piece.skeleton_points[at]);
        return local_[point] != no_id ? local_[point] : add_skeleton_point(point);
      }
      const auto [known, is_new] = inner.try_emplace(v, no_id);
      if (is_new) {
        const global_id offset = v - static_cast<local_id>(shared);
        known->second = add_vertex(piece.mesh.points[at], ranks_.first_inner_of_piece[p] + offset,
                                   ranks_.rank_of_piece[p], numbers_.first_point[p] + offset);
      }
      return known->second;
    };
    for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e) {
      simplex<D> element = piece.mesh.elements[e];
      if (std::none_of(element.begin(), element.end(), is_held))
        continue;
      for (local_id& v : element)
        v = place(v);
      add_element(piece, e, element);
    }
    require_room(static_cast<global_id>(std::max(result_.mesh.points.size(), result_.mesh.elements.size())));
  }

  const distributed_simplicial_mesh<D>& source_;
  const simplicial_skeleton<D>& skeleton_;
  const rank_numbering& ranks_;
  const global_numbering numbers_;
  std::vector<local_id> local_;                           ///< per point of the skeleton, or no_id
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

#ifdef DOVETAIL_COMPILED
template rank_mesh<2> make_rank_mesh<2>(const distributed_simplicial_mesh<2>&, const rank_numbering&,
                                        local_id, bool);
template rank_mesh<3> make_rank_mesh<3>(const distributed_simplicial_mesh<3>&, const rank_numbering&,
                                        local_id, bool);
#endif

} // namespace dovetail::io
