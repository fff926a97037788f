/// @file
/// Looking at a tetrahedrization around a vertex or an edge, and exchanging elements there for others.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/triangulation/triangulation.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// The elements around an edge (p, q), and the ring of their other vertices: element i is, positively
/// oriented, (p, q, vertices[i], vertices[i + 1]).
struct edge_ring {
  std::vector<local_id> elements;
  std::vector<local_id> vertices;
};

/// A tetrahedrization and, per vertex, one element at it. Changes keep the invariants of `triangulation`.
class local_changes {
public:
  /// Takes a tetrahedrization over. Linear.
  explicit local_changes(triangulation<3> mesh)
      : mesh_(std::move(mesh)), element_at_(mesh_.points.size(), no_id), seen_(mesh_.cells.size(), 0) {
    for (local_id e = 0; e < static_cast<local_id>(mesh_.cells.size()); ++e)
      if (mesh_.is_alive(e))
        remember(e);
  }

  const triangulation<3>& mesh() const { return mesh_; }
  triangulation<3> take() { return std::move(mesh_); }
  vec3 point(local_id v) const { return mesh_.point(v); }

  local_id add_point(vec3 p) {
    mesh_.points.push_back(p);
    element_at_.push_back(no_id);
    return static_cast<local_id>(mesh_.points.size()) - 1;
  }

  /// Takes back the points from number `count` on, which no element has.
  void drop_points(std::size_t count) {
    mesh_.points.resize(count);
    element_at_.resize(count);
  }

  /// Visits living elements from those at vertex `v` on, each once, and goes from an element across side i
  /// where `crosses(element, i)`. Elements at `v` are all visited, unless `visit` returns true: that ends it.
  template <class Visit, class Crosses>
  void spread_from(local_id v, const Visit& visit, const Crosses& crosses) {
    front_.clear();
    if (element_at_[v] == no_id)
      return;
    ++stamp_;
    push(element_at_[v]);
    for (std::size_t next = 0; next < front_.size(); ++next) {
      const local_id e = front_[next];
      ++work_;
      if constexpr (std::is_void_v<decltype(visit(e))>)
        visit(e);
      else if (visit(e))
        return;
      for (std::size_t i = 0; i < 4; ++i) {
        const bool across_star = has_vertex(e, v) && mesh_[e].vertices[i] != v;
        if (across_star || crosses(e, i))
          push(triangulation<3>::element_of(mesh_[e].across[i]));
      }
    }
  }

  /// Of a vertex that may have been removed.
  bool is_in_element(local_id v) const { return element_at_[v] != no_id; }
  /// The elements at a vertex; none when it is in no element.
  void find_star(local_id v, std::vector<local_id>& elements) {
    elements.clear();
    spread_from(
        v,
        [&](local_id e) {
          if (has_vertex(e, v))
            elements.push_back(e);
        },
        [](local_id, std::size_t) { return false; });
  }
  /// The vertices of side i of an element, oriented outwards of it.
  simplex<2> side_vertices(local_id e, std::size_t i) const {
    const auto& v = mesh_[e].vertices;
    const auto& local = numbering::sides<3>[i];
    return {v[local[0]], v[local[1]], v[local[2]]};
  }
  /// The sides of a region of elements, oriented outwards of it, and the elements beyond.
  void find_rim(std::span<const local_id> elements, std::vector<simplex<2>>& sides,
                std::vector<local_id>* beyond = nullptr) {
    sides.clear();
    work_ += elements.size();
    if (beyond != nullptr)
      beyond->clear();
    ++stamp_;
    for (const local_id e : elements)
      seen_[e] = stamp_;
    for (const local_id e : elements)
      for (std::size_t i = 0; i < 4; ++i) {
        const local_id other = triangulation<3>::element_of(mesh_[e].across[i]);
        if (seen_[other] == stamp_)
          continue;
        sides.push_back(side_vertices(e, i));
        if (beyond != nullptr)
          beyond->push_back(other);
      }
  }

  /// An element with both vertices, `no_id` when there is none. Linear in the elements at `p`.
  local_id element_with_edge(local_id p, local_id q) {
    local_id found = no_id;
    spread_from(
        p,
        [&](local_id e) {
          found = has_vertex(e, q) && has_vertex(e, p) ? e : no_id;
          return found != no_id;
        },
        [](local_id, std::size_t) { return false; });
    return found;
  }
  bool has_triangle(local_id a, local_id b, local_id c) {
    bool found = false;
    spread_from(
        a, [&](local_id e) { return found = has_vertex(e, a) && has_vertex(e, b) && has_vertex(e, c); },
        [](local_id, std::size_t) { return false; });
    return found;
  }
  bool has_vertex(local_id e, local_id v) const {
    const auto& vertices = mesh_[e].vertices;
    return vertices[0] == v || vertices[1] == v || vertices[2] == v || vertices[3] == v;
  }

  /// The ring around the edge (p, q) of element `e`; empty when it has more than `most` vertices.
  void find_ring(local_id e, local_id p, local_id q, std::size_t most, edge_ring& ring) const {
    ring.elements.clear();
    ring.vertices.clear();
    local_id r = first_of_ring(e, p, q);
    const local_id begin = e;
    do {
      if (ring.elements.size() == most) {
        ring.elements.clear();
        ring.vertices.clear();
        return;
      }
      ring.elements.push_back(e);
      ring.vertices.push_back(r);
      const auto& cell = mesh_[e];
      const std::size_t opposite = place_of_vertex(e, r);
      for (std::size_t i = 0; i < 4; ++i)
        if (const local_id v = cell.vertices[i]; v != p && v != q && i != opposite) {
          r = v;
          break;
        }
      e = triangulation<3>::element_of(cell.across[opposite]);
    } while (e != begin);
  }

  /// Exchanges elements for others, positively oriented, that fill the same region.
  void replace(std::span<const local_id> old, std::span<const simplex<3>> fresh) {
    faces_.clear();
    ++stamp_;
    for (const local_id e : old)
      seen_[e] = stamp_;
    for (const local_id e : old)
      for (const local_id side : mesh_[e].across)
        if (seen_[triangulation<3>::element_of(side)] != stamp_)
          add_face(side);
    for (const local_id e : old) {
      for (const local_id v : mesh_[e].vertices)
        if (v >= 0)
          element_at_[v] = no_id; // unless one of the fresh has it
      mesh_.remove(e);
    }
    for (const simplex<3>& vertices : fresh) {
      const local_id e = mesh_.add();
      seen_.resize(mesh_.cells.size(), 0);
      mesh_[e].vertices = vertices;
      remember(e);
      for (local_id i = 0; i < 4; ++i)
        add_face(triangulation<3>::side_of(e, i));
    }
    sort_all(faces_, [](const face& a, const face& b) { return a.key < b.key; });
    for (std::size_t k = 0; k < faces_.size(); k += 2) {
      if (k + 1 == faces_.size() || faces_[k].key != faces_[k + 1].key)
        throw mesher_error("a local change does not fill the place of the elements it exchanges");
      mesh_.join(faces_[k].side, faces_[k + 1].side);
    }
  }

  /// Positive when the finite side (u, v, w), oriented outwards, is seen by `p` from inside.
  double orientation(vec3 p, local_id u, local_id v, local_id w) const {
    ++work_;
    return orient3d(p, point(u), point(v), point(w));
  }
  /// Whether the tetrahedron is positively oriented and has no infinite vertex.
  bool is_positive(const simplex<3>& v) const {
    ++work_;
    return (v[0] | v[1] | v[2] | v[3]) >= 0 &&
           orient3d(point(v[0]), point(v[1]), point(v[2]), point(v[3])) > 0;
  }

  /// Elements visited and places compared so far: a measure of time that is the same in every run.
  std::size_t work() const { return work_; }
  void count_work(std::size_t more = 1) const { work_ += more; }
  /// From when on `is_spent`: for callers that shall give up then.
  void limit_work(std::size_t most) { most_work_ = most; }
  bool is_spent() const { return work_ > most_work_; }

private:
  struct face {
    simplex<2> key;
    local_id side;
  };

  void remember(local_id e) {
    for (const local_id v : mesh_[e].vertices)
      if (v >= 0)
        element_at_[v] = e;
  }
  void push(local_id e) {
    if (seen_[e] == stamp_)
      return;
    seen_[e] = stamp_;
    front_.push_back(e);
  }
  std::size_t place_of_vertex(local_id e, local_id v) const {
    std::size_t i = 0;
    while (mesh_[e].vertices[i] != v)
      ++i;
    return i;
  }
  /// The vertex r of element (p, q, r, s), as it is oriented.
  local_id first_of_ring(local_id e, local_id p, local_id q) const {
    const auto& v = mesh_[e].vertices;
    const std::size_t i = place_of_vertex(e, p), j = place_of_vertex(e, q);
    std::size_t k = 0;
    while (k == i || k == j)
      ++k;
    const std::size_t l = 6 - i - j - k;
    // The permutation (i, j, k, l) is even when it has an even number of inversions.
    const int inversions = (i > j) + (i > k) + (i > l) + (j > k) + (j > l) + (k > l);
    return inversions % 2 == 0 ? v[k] : v[l];
  }
  void add_face(local_id side) {
    simplex<2> key = side_vertices(triangulation<3>::element_of(side), triangulation<3>::place_of(side));
    sort_all(key);
    faces_.push_back({key, side});
  }

  triangulation<3> mesh_;
  std::vector<local_id> element_at_;
  std::vector<std::uint32_t> seen_; // per element: the number of the last search that came by
  std::uint32_t stamp_ = 0;
  std::vector<local_id> front_;
  std::vector<face> faces_;
  mutable std::size_t work_ = 0;
  std::size_t most_work_ = static_cast<std::size_t>(-1);
};

} // namespace dovetail::detail
