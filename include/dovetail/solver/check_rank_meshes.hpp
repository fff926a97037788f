/// @file
/// Do the meshes of all ranks make one mesh, and do the ranks agree about what they share?
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/mesh/rank_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::io {

namespace detail {

template <int D>
class rank_mesh_check {
public:
  explicit rank_mesh_check(std::span<const rank_mesh<D>> ranks) : ranks_(ranks) {}

  std::vector<std::string> run() {
    check_numbering();
    if (!faults_.empty())
      return std::move(faults_); // everything after goes by the ids
    check_copies();
    for (const auto& rank : ranks_)
      check_neighbours(rank);
    check_ghosts();
    check_middles();
    return std::move(faults_);
  }

private:
  void refuse(local_id rank, const std::string& what) {
    faults_.push_back("rank " + std::to_string(rank) + ": " + what);
  }

  bool of_second_order() const {
    return std::any_of(ranks_.begin(), ranks_.end(), [](const auto& rank) { return !rank.middles.empty(); });
  }

  /// Ids go on from rank to rank; the mesh's own numbers are those of a permutation.
  void check_numbering() {
    std::vector<global_id> vertex_numbers, element_numbers;
    for (std::size_t q = 0; q < ranks_.size(); ++q) {
      const auto& rank = ranks_[q];
      const auto& mesh = rank.mesh;
      const auto points = mesh.points.size(), elements = mesh.elements.size();
      if (rank.rank != static_cast<local_id>(q) || static_cast<std::size_t>(rank.ranks) != ranks_.size())
        refuse(static_cast<local_id>(q), "it is called another rank");
      if (rank.owned_corners > rank.owned_vertices || rank.owned_vertices > rank.held_vertices ||
          rank.held_vertices > points || rank.owned_elements > elements || rank.vertex_ids.size() != points ||
          rank.vertex_owners.size() != points || rank.vertex_numbers.size() != points ||
          rank.element_ids.size() != elements || rank.element_owners.size() != elements ||
          rank.element_numbers.size() != elements || rank.subdomains.size() != elements ||
          mesh.tags.size() != elements || rank.side_hosts.size() != rank.sides.size() ||
          rank.side_elements.size() != rank.sides.size() ||
          rank.middles.size() != (of_second_order() ? elements : 0) ||
          rank.side_middles.size() != (of_second_order() ? rank.sides.size() : 0))
        return refuse(rank.rank, "its arrays do not have the lengths that they should have");
      const auto first_vertex = static_cast<global_id>(vertex_numbers.size());
      const auto first_element = static_cast<global_id>(element_numbers.size());
      for (std::size_t v = 0; v < rank.owned_vertices; ++v)
        if (rank.vertex_ids[v] != first_vertex + static_cast<global_id>(v) ||
            rank.vertex_owners[v] != rank.rank)
          return refuse(rank.rank, "the ids of its vertices are not contiguous");
      for (std::size_t e = 0; e < rank.owned_elements; ++e)
        if (rank.element_ids[e] != first_element + static_cast<global_id>(e) ||
            rank.element_owners[e] != rank.rank)
          return refuse(rank.rank, "the ids of its elements are not contiguous");
      for (std::size_t e = 0; e < elements; ++e) {
        bool there = true;
        for_each_node(rank, e, [&](local_id v) {
          there = there && v >= 0 &&
                  static_cast<std::size_t>(v) < (e < rank.owned_elements ? rank.held_vertices : points);
        });
        if (!there)
          return refuse(rank.rank, "an element has a vertex that is not there");
      }
      append(vertex_numbers, span_of(rank.vertex_numbers).first(rank.owned_vertices));
      append(element_numbers, span_of(rank.element_numbers).first(rank.owned_elements));
    }
    for (auto* numbers : {&vertex_numbers, &element_numbers}) {
      const std::size_t count = numbers->size();
      sort_unique(*numbers);
      if (numbers->size() != count)
        faults_.push_back("ranks 0 to " + std::to_string(ranks_.size() - 1) +
                          ": two of them own the same vertex or element");
    }
  }

  /// What a rank holds of others is as the owner has it, and the owner is the lowest that has it.
  void check_copies() {
    for (const auto& rank : ranks_)
      for (std::size_t v = 0; v < rank.held_vertices; ++v)
        holders_[rank.vertex_ids[v]].push_back(rank.rank);
    for (const auto& rank : ranks_)
      for (std::size_t v = rank.owned_vertices; v < rank.mesh.points.size(); ++v) {
        const auto& owner = ranks_[rank.vertex_owners[v]];
        const global_id there = rank.vertex_ids[v] - (owner.vertex_ids.empty() ? 0 : owner.vertex_ids[0]);
        if (there < 0 || static_cast<std::size_t>(there) >= owner.owned_vertices ||
            owner.mesh.points[there] != rank.mesh.points[v] ||
            owner.vertex_numbers[there] != rank.vertex_numbers[v] ||
            holders_[rank.vertex_ids[v]].front() != owner.rank)
          return refuse(rank.rank, "vertex " + std::to_string(v) + " is not as its owner has it");
      }
  }

  template <std::size_t N>
  std::array<global_id, N> ids_of(const rank_mesh<D>& rank, const std::array<local_id, N>& vertices) const {
    std::array<global_id, N> ids;
    for (std::size_t k = 0; k < N; ++k)
      ids[k] = rank.vertex_ids[vertices[k]];
    return ids;
  }
  template <std::size_t N>
  std::vector<std::array<global_id, N>> ids_of(const rank_mesh<D>& rank,
                                               const std::vector<std::array<local_id, N>>& list) const {
    std::vector<std::array<global_id, N>> ids;
    for (const auto& vertices : list)
      ids.push_back(ids_of(rank, vertices));
    return ids;
  }
  std::vector<global_id> ids_of(const rank_mesh<D>& rank, const std::vector<local_id>& list) const {
    std::vector<global_id> ids;
    for (const local_id v : list)
      ids.push_back(rank.vertex_ids[v]);
    return ids;
  }
  std::vector<global_id> ids_of_element(const rank_mesh<D>& rank, std::size_t e) const {
    std::vector<global_id> ids;
    for_each_node(rank, e, [&](local_id v) { ids.push_back(rank.vertex_ids[v]); });
    return ids;
  }

  /// The edges (N = 2) or faces (N = 3) of a rank's elements whose vertices another rank holds too.
  template <std::size_t N>
  std::vector<std::array<global_id, N>> simplices_held_by(const rank_mesh<D>& rank, local_id other) {
    std::vector<std::array<global_id, N>> found;
    for (std::size_t e = 0; e < rank.owned_elements; ++e) {
      std::array<global_id, N> ids{};
      const auto choose = [&](auto&& self, std::size_t taken, std::size_t next) -> void {
        if (taken == N) {
          auto key = ids;
          std::sort(key.begin(), key.end());
          found.push_back(key);
          return;
        }
        for (; next <= D; ++next) {
          ids[taken] = rank.vertex_ids[rank.mesh.elements[e][next]];
          const auto& holders = holders_[ids[taken]];
          if (std::find(holders.begin(), holders.end(), other) != holders.end())
            self(self, taken + 1, next + 1);
        }
      };
      choose(choose, 0, 0);
    }
    sort_unique(found);
    return found;
  }
  template <std::size_t N>
  bool lists_all(const rank_mesh<D>& rank, const rank_mesh<D>& other,
                 std::vector<std::array<global_id, N>> listed) {
    const auto mine = simplices_held_by<N>(rank, other.rank);
    const auto theirs = simplices_held_by<N>(other, rank.rank);
    std::vector<std::array<global_id, N>> common;
    std::set_intersection(mine.begin(), mine.end(), theirs.begin(), theirs.end(), std::back_inserter(common));
    for (auto& ids : listed)
      std::sort(ids.begin(), ids.end());
    std::sort(listed.begin(), listed.end());
    return listed == common;
  }

  void check_neighbours(const rank_mesh<D>& rank) {
    std::map<local_id, std::vector<global_id>> expected;
    for (std::size_t v = 0; v < rank.held_vertices; ++v)
      for (const local_id r : holders_[rank.vertex_ids[v]])
        if (r != rank.rank)
          expected[r].push_back(rank.vertex_ids[v]);
    if (expected.size() != rank.neighbours.size())
      return refuse(rank.rank, "it has " + std::to_string(expected.size()) + " neighbours and lists " +
                                   std::to_string(rank.neighbours.size()));
    for (const auto& shared : rank.neighbours) {
      const auto name = "what it shares with rank " + std::to_string(shared.rank);
      if (expected.find(shared.rank) == expected.end())
        return refuse(rank.rank, name + " is nothing");
      const auto& other = ranks_[shared.rank];
      const auto back = std::find_if(other.neighbours.begin(), other.neighbours.end(),
                                     [&](const auto& there) { return there.rank == rank.rank; });
      if (back == other.neighbours.end() || ids_of(rank, shared.vertices) != ids_of(other, back->vertices) ||
          ids_of(rank, shared.edges) != ids_of(other, back->edges))
        return refuse(rank.rank, name + " is not in the same order there");
      auto turned = back->faces;
      for (auto& face : turned)
        std::swap(face[1], face[2]);
      if (ids_of(rank, shared.faces) != ids_of(other, turned))
        refuse(rank.rank, name + ": faces differ, or are not turned against each other");
      auto vertices = ids_of(rank, shared.vertices);
      sort_all(vertices);
      sort_all(expected[shared.rank]);
      if (vertices != expected[shared.rank] || !lists_all<2>(rank, other, ids_of(rank, shared.edges)) ||
          (D == 3 && !lists_all<3>(rank, other, ids_of(rank, shared.faces))))
        refuse(rank.rank, name + " is not all of it");
    }
  }

  /// Where ghosts are: exactly the elements of others at a vertex that the rank holds.
  void check_ghosts() {
    const bool wanted = std::any_of(ranks_.begin(), ranks_.end(), [](const auto& rank) {
      return rank.mesh.elements.size() > rank.owned_elements;
    });
    if (!wanted)
      return;
    std::vector<std::map<global_id, std::vector<global_id>>> expected(ranks_.size());
    for (const auto& rank : ranks_)
      for (std::size_t e = 0; e < rank.owned_elements; ++e) {
        const auto ids = ids_of_element(rank, e);
        for (const global_id id : ids)
          for (const local_id r : holders_[id])
            if (r != rank.rank)
              expected[r][rank.element_ids[e]] = ids;
      }
    for (const auto& rank : ranks_) {
      std::map<global_id, std::vector<global_id>> found;
      for (std::size_t e = rank.owned_elements; e < rank.mesh.elements.size(); ++e) {
        found[rank.element_ids[e]] = ids_of_element(rank, e);
        const auto& owner = ranks_[rank.element_owners[e]];
        const global_id there = rank.element_ids[e] - (owner.element_ids.empty() ? 0 : owner.element_ids[0]);
        if (there < 0 || static_cast<std::size_t>(there) >= owner.owned_elements ||
            owner.element_numbers[there] != rank.element_numbers[e] ||
            owner.subdomains[there] != rank.subdomains[e] || owner.mesh.tags[there] != rank.mesh.tags[e])
          return refuse(rank.rank, "ghost " + std::to_string(e) + " is not as its owner has it");
      }
      if (found != expected[rank.rank] || found.size() != rank.mesh.elements.size() - rank.owned_elements)
        refuse(rank.rank, "its ghosts are not the elements of others that touch it");
    }
  }

  /// An edge has the same vertex in its middle in all elements and sides, and no other edge has it; a rank's
  /// own corners come before its own middles.
  void check_middles() {
    std::map<std::array<global_id, 2>, global_id> middle_of;
    std::map<global_id, std::array<global_id, 2>> edge_of;
    for (const auto& rank : ranks_) {
      const auto meet = [&](const auto& vertices, const auto& middles, const auto& edges) {
        for (std::size_t k = 0; k < middles.size(); ++k) {
          auto key = ids_of(rank, vertices_of_edge(vertices, edges[k]));
          std::sort(key.begin(), key.end());
          const global_id middle = rank.vertex_ids[middles[k]];
          const bool owned = static_cast<std::size_t>(middles[k]) < rank.owned_vertices;
          if (middle_of.try_emplace(key, middle).first->second != middle ||
              edge_of.try_emplace(middle, key).first->second != key ||
              (owned && static_cast<std::size_t>(middles[k]) < rank.owned_corners))
            return false;
        }
        return true;
      };
      bool agreed = true;
      for (std::size_t e = 0; e < rank.middles.size(); ++e)
        agreed = agreed && meet(rank.mesh.elements[e], rank.middles[e], numbering::edges<D>);
      for (std::size_t s = 0; s < rank.side_middles.size(); ++s)
        agreed = agreed && meet(rank.sides[s], rank.side_middles[s], numbering::edges<D - 1>);
      for (const auto& element : rank.mesh.elements)
        for (const local_id v : element)
          agreed = agreed && (static_cast<std::size_t>(v) < rank.owned_corners ||
                              static_cast<std::size_t>(v) >= rank.owned_vertices);
      if (!agreed)
        refuse(rank.rank, "the middle of an edge is not the same vertex for all who have the edge");
    }
  }

  std::span<const rank_mesh<D>> ranks_;
  std::map<global_id, std::vector<local_id>> holders_; ///< of each vertex, growing ranks
  std::vector<std::string> faults_;
};

} // namespace detail

/// What is wrong with the meshes of ranks 0, 1, 2, ..., one sentence each; nothing when they make one mesh:
/// ids are contiguous per owner and number each vertex and element once, owners are lowest, copies equal
/// what they copy, neighbours list all that they share in the same order, ghosts are one layer, edges of
/// second-order elements have one middle each. All are in memory, with 100 bytes more per vertex, and of
/// second order with 200 per edge. About n log n, and linear in the pairs of neighbours.
/// Throws nothing but for a lack of memory.
/// \param ranks from `make_rank_mesh`, by rank
template <int D>
std::vector<std::string> check_rank_meshes(std::span<const rank_mesh<D>> ranks) {
  return detail::rank_mesh_check<D>(ranks).run();
}

/// Adds what a rank owns to the hash of the mesh: over all ranks that of the distributed mesh they were made
/// from, when every point of its skeleton is in an element. O(rank). Throws `usage_error` for elements of
/// second order: the hash is that of the mesh without middles of edges.
template <int D>
void hash_rank_mesh(mesh_hasher& hasher, const rank_mesh<D>& rank) {
  if (!rank.middles.empty())
    throw usage_error("the hash of a mesh is that of its elements of first order");
  for (std::size_t v = 0; v < rank.owned_vertices; ++v)
    hasher.point(rank.vertex_numbers[v], rank.mesh.points[v]);
  for (std::size_t e = 0; e < rank.owned_elements; ++e) {
    std::array<global_id, D + 1> vertices;
    for (std::size_t k = 0; k < vertices.size(); ++k)
      vertices[k] = rank.vertex_numbers[rank.mesh.elements[e][k]];
    hasher.element(vertices);
  }
}

} // namespace dovetail::io
