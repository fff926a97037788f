/// @file
/// A distributed mesh as one mesh in memory: what a solver on one machine assembles on.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/io/face_groups.hpp"
#include "dovetail/io/global_numbering.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::io {

/// A whole mesh, with the sides that lie on CAD entities. Its elements and points are in the order of the
/// global numbers of distributed_mesh.hpp; every point belongs to an element.
template <int D>
struct gathered_mesh {
  simplicial_mesh<D> mesh;          ///< tags: materials (D = 3), CAD faces (D = 2)
  std::vector<local_id> subdomains; ///< per element

  std::vector<simplex<D - 1>> sides; ///< on CAD faces (D = 3) or curves (D = 2), each once
  std::vector<local_id> side_hosts;  ///< per side: its CAD face (D = 3) or curve (D = 2)
  /// Per side: the element that it faces outwards of, and the one in front of it, or no_id where the domain
  /// ends. Of an edge with more than two triangles (D = 2), the first two.
  std::vector<std::array<local_id, 2>> side_elements;

  std::vector<std::string> material_names; ///< per material, none empty; D = 3
  std::vector<std::string> group_names;    ///< of the groups of faces, distinct
  std::vector<local_id> group_of_face;     ///< per CAD face: its group
};

namespace detail {

/// The sides of a skeleton that lie on CAD entities, each once, to be found by their vertices.
template <int D>
class hosted_sides {
public:
  explicit hosted_sides(const simplicial_skeleton<D>& skeleton) {
    for (std::size_t s = 0; s < skeleton.sides.size(); ++s)
      if (skeleton.side_hosts[s] != no_id)
        sides_.push_back({sorted_vertices(skeleton.sides[s]), skeleton.side_hosts[s]});
    std::sort(sides_.begin(), sides_.end());
    sides_.erase(std::unique(sides_.begin(), sides_.end(),
                             [](const auto& a, const auto& b) { return a.first == b.first; }),
                 sides_.end());
  }
  std::size_t size() const { return sides_.size(); }
  local_id host(std::size_t side) const { return sides_[side].second; }
  /// The index of the side with these vertices, or `size()`. O(log sides).
  std::size_t find(const simplex<D - 1>& vertices) const {
    const auto key = sorted_vertices(vertices);
    const auto at =
        std::lower_bound(sides_.begin(), sides_.end(), key,
                         [](const auto& side, const auto& wanted) { return side.first < wanted; });
    return at != sides_.end() && at->first == key ? static_cast<std::size_t>(at - sides_.begin()) : size();
  }

private:
  std::vector<std::pair<simplex<D - 1>, local_id>> sides_; ///< ascending
};

template <int D>
class mesh_gathering {
public:
  explicit mesh_gathering(const distributed_simplicial_mesh<D>& mesh)
      : source_(mesh), numbers_(number_globally(mesh)), hosted_(mesh.skeleton) {
    if (std::max(numbers_.points(), numbers_.elements()) > std::numeric_limits<local_id>::max())
      throw mesh_error("a mesh of " + std::to_string(numbers_.elements()) +
                       " elements is too large to be gathered; read its pieces one at a time");
  }

  gathered_mesh<D> gather() {
    number_used_points();
    list_sides();
    for_each_piece([this](const simplicial_piece<D>& piece) { append(piece); });
    if (std::any_of(result_.side_elements.begin(), result_.side_elements.end(),
                    [](const auto& elements) { return elements[0] == no_id; }))
      throw mesh_error("a side of the skeleton that lies on the CAD model belongs to no element");
    name_faces();
    return std::move(result_);
  }

private:
  template <class Visit>
  void for_each_piece(const Visit& visit) const {
    for (std::size_t p = 0; p < source_.counts.size(); ++p)
      visit(load_checked(source_, static_cast<local_id>(p)));
  }

  /// The number in the result of point `i` of a piece; no_id of one that no element uses.
  local_id& number_of(const simplicial_piece<D>& piece, local_id i) {
    return number_[static_cast<std::size_t>(global_point(piece, numbers_, i))];
  }

  /// Of the skeleton's points some may be in no element; a matrix would have empty rows for them.
  void number_used_points() {
    number_.assign(static_cast<std::size_t>(numbers_.points()), no_id);
    for_each_piece([this](const simplicial_piece<D>& piece) {
      for (const auto& element : piece.mesh.elements)
        for (const local_id v : element)
          number_of(piece, v) = 0;
    });
    local_id next = 0;
    for (auto& n : number_)
      if (n != no_id)
        n = next++;
    result_.mesh.points.resize(static_cast<std::size_t>(next));
  }

  void list_sides() {
    result_.sides.resize(hosted_.size());
    result_.side_elements.assign(hosted_.size(), {no_id, no_id});
    for (std::size_t s = 0; s < hosted_.size(); ++s)
      result_.side_hosts.push_back(hosted_.host(s));
  }

  void append(const simplicial_piece<D>& piece) {
    for (std::size_t i = 0; i < piece.mesh.points.size(); ++i)
      if (const auto n = number_of(piece, static_cast<local_id>(i)); n != no_id)
        result_.mesh.points[static_cast<std::size_t>(n)] = piece.mesh.points[i];
    for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e) {
      const auto& vertices = piece.mesh.elements[e];
      for (const auto& side : numbering::sides<D>)
        meet_side(piece, dovetail::detail::pick(vertices, side));
      auto& element = result_.mesh.elements.emplace_back();
      for (std::size_t k = 0; k < element.size(); ++k)
        element[k] = number_of(piece, vertices[k]);
      result_.mesh.tags.push_back(piece.mesh.tags.empty() ? piece.material : piece.mesh.tags[e]);
      result_.subdomains.push_back(piece.subdomain);
    }
  }

  /// `side` is one of the next element to be appended.
  void meet_side(const simplicial_piece<D>& piece, const simplex<D - 1>& side) {
    const auto element = static_cast<local_id>(result_.mesh.elements.size());
    simplex<D - 1> in_skeleton{};
    for (std::size_t k = 0; k < side.size(); ++k) {
      if (static_cast<std::size_t>(side[k]) >= piece.skeleton_points.size())
        return;
      in_skeleton[k] = piece.skeleton_points[static_cast<std::size_t>(side[k])];
    }
    const auto found = hosted_.find(in_skeleton);
    if (found == hosted_.size())
      return;
    auto& [behind, front] = result_.side_elements[found];
    if (behind == no_id) {
      behind = element;
      for (std::size_t k = 0; k < side.size(); ++k)
        result_.sides[found][k] = number_of(piece, side[k]);
    } else if (front == no_id)
      front = element;
  }

  void name_faces() {
    std::size_t faces = 0;
    if constexpr (D == 3)
      result_.material_names = collect_material_names(source_);
    else
      for (const local_id face : result_.mesh.tags)
        faces = std::max(faces, static_cast<std::size_t>(face) + 1);
    auto groups = collect_face_groups(source_, faces);
    result_.group_names = std::move(groups.names);
    result_.group_of_face = std::move(groups.of_face);
  }

  const distributed_simplicial_mesh<D>& source_;
  global_numbering numbers_;
  hosted_sides<D> hosted_;
  std::vector<local_id> number_; ///< per global point
  gathered_mesh<D> result_;
};

} // namespace detail

/// Gathers a distributed mesh. Loads every piece twice; linear, but for a search per side of an element at
/// the skeleton. Memory: the result, and 4 bytes per point. Throws `mesh_error` when pieces and skeleton
/// disagree, or when the mesh has more elements or points than local ids can number.
template <int D>
gathered_mesh<D> gather(const distributed_simplicial_mesh<D>& mesh) {
  return detail::mesh_gathering<D>(mesh).gather();
}

} // namespace dovetail::io
