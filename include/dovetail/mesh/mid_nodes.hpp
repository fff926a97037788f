/// @file
/// The nodes in the middle of the edges of a distributed mesh, and the nodes of its pieces with them.
///
/// Nodes are numbered as points are without them (distributed_mesh.hpp): the skeleton's points, then the
/// middles of its edges; of each piece in turn its inner points, then the middles of its inner edges.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/quadratic_element.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace dovetail {

/// The edges of a piece.
template <int D>
struct piece_edges {
  edge_table<D> edges;               ///< on the piece's points
  std::vector<local_id> in_skeleton; ///< per edge: its number among the skeleton's, or no_id
};

/// Makes the elements of a distributed mesh second-order ones.
template <int D>
struct mid_edge_nodes {
  std::vector<simplex<1>> edges = {}; ///< of the skeleton's sides, each once, as an `edge_table` has them
  std::vector<vec3> points = {};      ///< the middle of each
  std::vector<global_id> inner = {};  ///< per piece: how many of its edges are not of the skeleton
  /// The middles of a piece's inner edges, in their order; pure. Straight ones where it is empty.
  std::function<std::vector<vec3>(const simplicial_piece<D>&, const piece_edges<D>&, const mid_edge_nodes&)>
      inner_points = {};
};

/// The edges of the sides of a skeleton. O(sides log sides).
template <int D>
std::vector<simplex<1>> edges_of(const simplicial_skeleton<D>& skeleton) {
  auto table = build_edges<D - 1>(span_of(skeleton.sides), skeleton.points.size());
  return std::move(table.vertices);
}

/// O(elements), and a search per edge between points of the skeleton.
template <int D>
piece_edges<D> edges_of(const simplicial_piece<D>& piece, const mid_edge_nodes<D>& nodes) {
  piece_edges<D> result{build_edges<D>(span_of(piece.mesh.elements), piece.mesh.points.size()), {}};
  for (const auto& [a, b] : result.edges.vertices) { // a < b, and points of the skeleton come first
    const auto at = [&](local_id v) { return piece.skeleton_points[v]; };
    result.in_skeleton.push_back(static_cast<std::size_t>(b) < piece.skeleton_points.size()
                                     ? find_edge(nodes.edges, {at(a), at(b)})
                                     : no_id);
  }
  return result;
}

/// The nodes of a piece, as `simplicial_piece` has points: first those of the skeleton, then its own.
template <int D>
class piece_nodes {
public:
  /// Of a mesh of linear elements the piece's points, in place; the piece must outlive this.
  piece_nodes(const distributed_simplicial_mesh<D>& mesh, const simplicial_piece<D>& piece)
      : shared_(span_of(piece.skeleton_points)),
        own_(span_of(piece.mesh.points).subspan(piece.skeleton_points.size())),
        elements_(piece.mesh.elements.empty() ? nullptr : piece.mesh.elements.front().data()) {
    if (mesh.mid_nodes)
      add_middles(piece, *mesh.mid_nodes, static_cast<local_id>(mesh.skeleton.points.size()));
  }
  piece_nodes(const piece_nodes&) = delete;
  piece_nodes& operator=(const piece_nodes&) = delete;

  std::span<const local_id> shared() const { return shared_; } ///< numbers of nodes of the skeleton
  std::span<const vec3> own() const { return own_; }           ///< the nodes that no other piece has
  /// Of an element: each below `shared().size()`, or that and the number of one of its own.
  std::span<const local_id> of_element(std::size_t e) const {
    return {elements_ + e * per_element_, per_element_};
  }
  std::size_t per_element() const { return per_element_; } ///< how many nodes an element has

private:
  void add_middles(const simplicial_piece<D>& piece, const mid_edge_nodes<D>& nodes,
                   local_id skeleton_points) {
    const auto found = edges_of(piece, nodes);
    std::vector<local_id> place; // of each edge's node, among those of the skeleton or of its own
    shared_store_ = piece.skeleton_points;
    append(own_store_, own_);
    local_id inner = static_cast<local_id>(own_.size());
    for (const local_id edge : found.in_skeleton) {
      place.push_back(edge == no_id ? inner++ : static_cast<local_id>(shared_store_.size()));
      if (edge != no_id)
        shared_store_.push_back(skeleton_points + edge);
    }
    append(own_store_, middles(piece, found, nodes));

    const auto old_shared = static_cast<local_id>(piece.skeleton_points.size());
    const auto new_shared = static_cast<local_id>(shared_store_.size());
    for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e) {
      for (const local_id v : piece.mesh.elements[e])
        element_store_.push_back(v < old_shared ? v : v - old_shared + new_shared);
      for (const local_id edge : found.edges.of_element[e]) {
        const auto k = static_cast<std::size_t>(edge);
        element_store_.push_back(place[k] + (found.in_skeleton[k] == no_id ? new_shared : 0));
      }
    }
    shared_ = span_of(shared_store_);
    own_ = span_of(own_store_);
    elements_ = element_store_.data();
    per_element_ = quadratic_nodes<D>;
  }
  static std::vector<vec3> middles(const simplicial_piece<D>& piece, const piece_edges<D>& found,
                                   const mid_edge_nodes<D>& nodes) {
    if (nodes.inner_points)
      return nodes.inner_points(piece, found, nodes);
    std::vector<vec3> straight;
    for (std::size_t k = 0; k < found.in_skeleton.size(); ++k)
      if (found.in_skeleton[k] == no_id) {
        const auto& [a, b] = found.edges.vertices[k];
        straight.push_back(midpoint(piece.mesh.points[a], piece.mesh.points[b]));
      }
    return straight;
  }

  std::span<const local_id> shared_;
  std::span<const vec3> own_;
  const local_id* elements_;
  std::size_t per_element_ = D + 1;
  std::vector<local_id> shared_store_;
  std::vector<vec3> own_store_;
  std::vector<local_id> element_store_;
};

/// The nodes per element of a distributed mesh.
template <int D>
std::size_t nodes_per_element(const distributed_simplicial_mesh<D>& mesh) {
  return mesh.mid_nodes ? quadratic_nodes<D> : D + 1;
}

/// How many nodes the skeleton has, and where each is.
template <int D>
std::size_t skeleton_nodes(const distributed_simplicial_mesh<D>& mesh) {
  return mesh.skeleton.points.size() + (mesh.mid_nodes ? mesh.mid_nodes->points.size() : 0);
}
/// A point of the skeleton, or a node in the middle of one of its edges.
template <int D>
vec3 skeleton_node(const distributed_simplicial_mesh<D>& mesh, local_id node) {
  const auto at = static_cast<std::size_t>(node);
  const auto points = mesh.skeleton.points.size();
  return at < points ? mesh.skeleton.points[at] : mesh.mid_nodes->points[at - points];
}
/// How many nodes a piece has of its own.
template <int D>
global_id inner_nodes(const distributed_simplicial_mesh<D>& mesh, std::size_t piece) {
  return mesh.counts[piece].inner_points + (mesh.mid_nodes ? mesh.mid_nodes->inner[piece] : 0);
}

} // namespace dovetail
