/// @file
/// Are elements of second order in one or several files right? Of an edge all elements have the same middle,
/// and none is inverted. Pieces are checked one after the other.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/files/streamed_validity.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"
#include "dovetail/mesh/quadratic_element.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail::io {

/// The middles of edges of tetrahedra (D = 3), of which those of triangles are compared too, or of triangles.
/// `streamed_validity` and `check_validity` are for the mesh of the corners. Of pieces without any of second
/// order there is nothing to say. Memory: the edges on the boundaries of all pieces, and ranges of numbers.
template <int D>
class streamed_middles {
public:
  /// Adds a piece, its points in the order of their global numbers. n log n.
  /// \param piece as a reader gives it that takes `element_order::any`
  /// \param name stands before the faults inside it; may be empty
  void add(const loaded_mesh& piece, const std::string& name) {
    const auto& elements = elements_of(piece);
    const auto& middles = middles_of(piece);
    elements_ += elements.size();
    quadratic_ += middles.size();
    if (middles.empty() || middles.size() != elements.size())
      return;
    const std::string before = name.empty() ? name : name + ": ";
    number_nodes(piece, before);
    find_inverted(piece, before);
    compare_edges(piece, before);
  }

  /// What is wrong, on one line; empty where all is right. Throws `input_error` when middles of the same
  /// number are at different places. O(boundaries, log for sorting).
  std::string faults() {
    if (quadratic_ == 0)
      return {};
    if (quadratic_ != elements_)
      return std::to_string(elements_ - quadratic_) + " x element of first order among those of second order";
    compare_places();
    if (!inside_.empty())
      return inside_;
    std::string found;
    compare(shared_, found, "");
    if (!inner_.disjoint())
      add_fault(found, "a middle is inside two pieces");
    count_fault(found, "", "edge with the middle of one inside another piece", shared_,
                [&](std::size_t i) { return inner_.contains(shared_[i].middle); });
    if (corners_.count() + middles_.count() != nodes_.count())
      add_fault(found, "a corner in one piece is a middle in another");
    if (nodes_.count() != points_.count())
      add_fault(found, std::to_string(points_.count() - nodes_.count()) + " x isolated point");
    return found;
  }

  /// How many middles there are.
  std::uint64_t points() { return middles_.count(); }

private:
  /// An edge, and the point that an element has in the middle of it.
  struct use {
    std::pair<global_id, global_id> edge; ///< ascending
    global_id middle;
    vec3 at;

    auto by_edge() const { return std::tuple(edge, middle); }
    auto by_middle() const { return std::tuple(middle, edge); }
  };

  static const auto& elements_of(const loaded_mesh& piece) {
    if constexpr (D == 3)
      return piece.mesh.elements;
    else
      return piece.triangles;
  }
  static const auto& middles_of(const loaded_mesh& piece) {
    if constexpr (D == 3)
      return piece.middles;
    else
      return piece.triangle_middles;
  }
  static global_id id_of(const loaded_mesh& piece, local_id v) {
    return piece.node_ids.empty() ? v : piece.node_ids[v];
  }

  static void add_fault(std::string& to, const std::string& what) { to += (to.empty() ? "" : "; ") + what; }
  /// Counts the edges that are wrong, and names the first.
  template <class Wrong>
  static void count_fault(std::string& to, const std::string& before, const std::string& what,
                          const std::vector<use>& uses, const Wrong& wrong) {
    std::size_t count = 0;
    std::pair<global_id, global_id> first;
    for (std::size_t i = 0; i < uses.size(); ++i)
      if (wrong(i) && count++ == 0)
        first = uses[i].edge;
    if (count > 0)
      add_fault(to, before + std::to_string(count) + " x " + what + " (from point " +
                        std::to_string(first.first) + " to " + std::to_string(first.second) + ")");
  }

  void number_nodes(const loaded_mesh& piece, const std::string& before) {
    const std::size_t points = piece.mesh.points.size();
    std::vector<bool> is_corner(points, false), is_middle(points, false);
    const auto mark = [](const auto& simplices, std::vector<bool>& marks) {
      for (const auto& vertices : simplices)
        for (const local_id v : vertices)
          marks[v] = true;
    };
    mark(elements_of(piece), is_corner);
    mark(middles_of(piece), is_middle);
    std::size_t both = 0;
    for (std::size_t v = 0; v < points; ++v) {
      const global_id id = id_of(piece, static_cast<local_id>(v));
      if (is_corner[v] && is_middle[v] && both++ == 0)
        add_fault(inside_,
                  before + "a corner is also the middle of an edge (point " + std::to_string(id) + ")");
      points_.add(id);
      if (is_corner[v] || is_middle[v])
        nodes_.add(id);
      if (is_corner[v])
        corners_.add(id);
      if (is_middle[v])
        middles_.add(id);
    }
  }

  void find_inverted(const loaded_mesh& piece, const std::string& before) {
    const auto& elements = elements_of(piece);
    std::size_t count = 0, first = 0;
    for (std::size_t e = 0; e < elements.size(); ++e) {
      std::array<vec3, quadratic_nodes<D>> nodes;
      const auto at = [&](local_id v) { return piece.mesh.points[v]; };
      const auto middles = std::transform(elements[e].begin(), elements[e].end(), nodes.begin(), at);
      std::transform(middles_of(piece)[e].begin(), middles_of(piece)[e].end(), middles, at);
      if (!(least_jacobian(nodes) > 0) && count++ == 0)
        first = e;
    }
    if (count > 0)
      add_fault(inside_, before + std::to_string(count) + " x element that its middles may invert (" +
                             std::to_string(first) + ")");
  }

  /// Those that no other piece can have; the others are kept.
  void compare_edges(const loaded_mesh& piece, const std::string& before) {
    std::vector<use> inner, outer;
    const std::vector<bool> on_boundary = boundary_points(piece);
    const auto add_uses = [&]<int E>(const std::vector<simplex<E>>& simplices, const auto& middles) {
      for (std::size_t s = 0; s < middles.size(); ++s)
        for (std::size_t k = 0; k < edges_per_element<E>; ++k) {
          const auto [a, b] = vertices_of_edge(simplices[s], numbering::edges<E>[k]);
          const local_id v = middles[s][k];
          (on_boundary[a] && on_boundary[b] ? outer : inner)
              .push_back(
                  {std::minmax(id_of(piece, a), id_of(piece, b)), id_of(piece, v), piece.mesh.points[v]});
        }
    };
    add_uses.template operator()<D>(elements_of(piece), middles_of(piece));
    if (D == 3 && piece.triangle_middles.size() == piece.triangles.size())
      add_uses.template operator()<2>(piece.triangles, piece.triangle_middles);
    else if (D == 3 && !piece.triangle_middles.empty())
      add_fault(inside_, before + "triangles of first order are among those of second order");
    compare(inner, inside_, before);
    for (const use& of : inner)
      inner_.add(of.middle);
    drop_repeated(outer);
    append(shared_, outer);
  }
  /// Triangles are not in several files where they are checked.
  static std::vector<bool> boundary_points(const loaded_mesh& piece) {
    std::vector<bool> on_boundary(piece.mesh.points.size(), D == 2);
    if constexpr (D == 3) {
      const auto table = build_sides(piece.mesh);
      for (std::size_t s = 0; s < table.size(); ++s)
        if (table.is_boundary(static_cast<local_id>(s)))
          for (const local_id v : table.vertices[s])
            on_boundary[v] = true;
    }
    return on_boundary;
  }

  static void drop_repeated(std::vector<use>& uses) {
    sort_all(uses, [](const use& a, const use& b) { return a.by_edge() < b.by_edge(); });
    const auto same = [](const use& a, const use& b) { return a.by_edge() == b.by_edge(); };
    uses.erase(std::unique(uses.begin(), uses.end(), same), uses.end());
  }
  /// Leaves them by middle, each once where all is right.
  static void compare(std::vector<use>& uses, std::string& found, const std::string& before) {
    drop_repeated(uses);
    count_fault(found, before, "edge with more than one middle", uses,
                [&](std::size_t i) { return i > 0 && uses[i].edge == uses[i - 1].edge; });
    sort_all(uses, [](const use& a, const use& b) { return a.by_middle() < b.by_middle(); });
    count_fault(found, before, "edge with the middle of another", uses,
                [&](std::size_t i) { return i > 0 && uses[i].middle == uses[i - 1].middle; });
  }

  /// The same number at one place.
  void compare_places() {
    sort_all(shared_, [](const use& a, const use& b) { return a.by_middle() < b.by_middle(); });
    for (std::size_t i = 1; i < shared_.size(); ++i)
      if (shared_[i].middle == shared_[i - 1].middle && shared_[i].at != shared_[i - 1].at)
        throw input_error("two points have the global number " + std::to_string(shared_[i].middle) +
                          " but not the same coordinates");
  }

  std::vector<use> shared_; ///< edges between points of the boundary of a piece
  number_ranges inner_;     ///< middles of other edges
  number_ranges corners_, middles_, nodes_, points_;
  std::uint64_t elements_ = 0, quadratic_ = 0; ///< so many, and of second order
  std::string inside_;                         ///< faults inside pieces
};

} // namespace dovetail::io
