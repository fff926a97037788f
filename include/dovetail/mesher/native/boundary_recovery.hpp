/// @file
/// Makes the triangles of a boundary sides of a tetrahedrization of their points.
///
/// A Delaunay tetrahedrization lacks few of them when points inside keep away from the boundary. What is in
/// the way of one is taken away by flips, as by P. L. George, H. Borouchaki and E. Saltel, "'Ultimate'
/// robustness in meshing an arbitrary polyhedron", doi 10.1002/nme.808, and J. Chen et al.,
/// "Three-dimensional constrained boundary recovery with an enhanced Steiner point suppression procedure",
/// doi 10.1016/j.compstruc.2010.11.016 (where removal of an edge is a shell transformation); where that
/// fails, points are put inside elements that are in the way, so that there is more to flip. None is ever on
/// the boundary.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/mesher/native/cavity_division.hpp"
#include "dovetail/mesher/native/recovery_flips.hpp"
#include "dovetail/mesher/native/recovery_targets.hpp"
#include "dovetail/triangulation/insertion_order.hpp"
#include "dovetail/triangulation/local_changes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// What recovery found and did.
struct recovery_counts {
  std::size_t missing_edges = 0;     ///< of the boundary, in the tetrahedrization given
  std::size_t missing_triangles = 0; ///< once the edges were there
  std::size_t added_points = 0;      ///< at the end of the points
};

namespace detail {

/// Makes edges and triangles parts of the mesh one after the other.
class boundary_recovery {
public:
  boundary_recovery(local_changes& changes, std::span<const simplex<2>> triangles)
      : changes_(changes), triangles_(triangles), kept_(triangles), flips_(changes, kept_) {}

  recovery_counts run() {
    std::vector<edge_target> edges = missing_edges();
    counts_.missing_edges = edges.size();
    recover_all(edges);
    std::vector<triangle_target> sides = missing_triangles();
    counts_.missing_triangles = sides.size();
    recover_all(sides);
    return counts_;
  }

private:
  static constexpr int most_steps = 200;         // changes for one target in one go
  static constexpr int most_level_steps = 40;    // those of them after which as much is in the way as before
  static constexpr int most_depth = 3;           // of removals of edges for the sake of others
  static constexpr std::size_t most_points = 12; // added for one target

  std::vector<edge_target> missing_edges() {
    std::vector<char> found(kept_.edges().size(), 0);
    const auto& mesh = changes_.mesh();
    for (local_id e = 0; e < static_cast<local_id>(mesh.cells.size()); ++e) {
      if (!mesh.is_alive(e))
        continue;
      for (const auto& ridge : numbering::ridges<3>) {
        const local_id u = mesh[e].vertices[static_cast<std::size_t>(ridge[0])],
                       v = mesh[e].vertices[static_cast<std::size_t>(ridge[1])];
        if (u < 0 || v < 0 || !is_given(u) || !is_given(v))
          continue;
        const std::array edge{std::min(u, v), std::max(u, v)};
        const auto place = std::lower_bound(kept_.edges().begin(), kept_.edges().end(), edge);
        if (place != kept_.edges().end() && *place == edge)
          found[static_cast<std::size_t>(place - kept_.edges().begin())] = 1;
      }
    }
    std::vector<edge_target> missing;
    for (std::size_t k = 0; k < found.size(); ++k)
      if (found[k] == 0)
        missing.push_back({kept_.edges()[k]});
    return missing;
  }

  std::vector<triangle_target> missing_triangles() {
    std::vector<char> found(kept_.triangles().entries().size(), 0);
    const auto& mesh = changes_.mesh();
    for (local_id e = 0; e < static_cast<local_id>(mesh.cells.size()); ++e) {
      if (!mesh.is_alive(e))
        continue;
      for (const auto& local : numbering::sides<3>) {
        simplex<2> side{};
        bool given = true;
        for (std::size_t k = 0; k < 3; ++k) {
          side[k] = mesh[e].vertices[static_cast<std::size_t>(local[k])];
          given = given && side[k] >= 0 && is_given(side[k]);
        }
        if (!given)
          continue;
        if (const auto match = kept_.triangles().find(side))
          found[at(match.entry)] = 1;
      }
    }
    std::vector<triangle_target> missing;
    for (const auto& triangle : triangles_)
      if (char& known = found[at(kept_.triangles().find(triangle).entry)]; known == 0) {
        known = 1; // one listed in both directions is looked for once
        missing.push_back({triangle});
      }
    return missing;
  }
  bool is_given(local_id v) const { return v <= kept_.edges().back()[0] || v <= highest(); }
  local_id highest() const {
    if (highest_ == no_id)
      for (const auto& edge : kept_.edges())
        highest_ = std::max(highest_, edge[1]);
    return highest_;
  }

  /// Goes over the targets as long as some are reached, since one may be in the way of another; then adds
  /// points. Throws `mesher_error` with the places of those that are not reached.
  template <class Target>
  void recover_all(std::vector<Target>& missing) {
    for (std::size_t points = 0; points <= most_points; ++points) {
      for (int depth = 1; depth <= most_depth; ++depth)
        for (std::size_t before = missing.size() + 1; !missing.empty() && missing.size() < before;) {
          before = missing.size();
          std::erase_if(missing, [&](const Target& target) { return recover(target, depth); });
        }
      std::erase_if(missing, [&](const Target& target) { return recover_with_points(target); });
      if (missing.empty())
        return;
      if (points < most_points)
        for (const Target& target : missing)
          add_point_in_the_way(target, points);
    }
    throw_unrecovered(missing);
  }

  template <class Target>
  bool recover(const Target& target, int depth) {
    int level_steps = 0;
    for (int step = 0; step < most_steps; ++step) {
      if (target.is_there(changes_))
        return true;
      find_obstacles(changes_, target, found_);
      if (improve(target, -1))
        continue;
      if (level_steps++ >= most_level_steps)
        return false;
      std::rotate(found_.edges.begin(), found_.edges.begin() + turn(step, found_.edges.size()),
                  found_.edges.end());
      std::rotate(found_.sides.begin(), found_.sides.begin() + turn(step, found_.sides.size()),
                  found_.sides.end());
      if (!improve(target, 0) && !improve_in_steps(target, depth))
        return false;
    }
    return target.is_there(changes_);
  }
  /// Where to begin, the same in every run.
  static std::ptrdiff_t turn(int step, std::size_t count) {
    return count == 0 ? 0 : static_cast<std::ptrdiff_t>(scattered(static_cast<std::uint64_t>(step)) % count);
  }

  /// Makes one change of what is in the way, the least costly first.
  template <class Target>
  bool improve(const Target& target, int allowed_excess) {
    for (const auto& [u, v] : found_.edges)
      if (flips_.remove_edge(target, u, v, allowed_excess))
        return true;
    for (const local_id side : found_.sides)
      if (flips_.remove_side(target, side, allowed_excess))
        return true;
    return for_each_edge_of_sides(
        [&](local_id u, local_id v) { return flips_.remove_edge(target, u, v, allowed_excess); });
  }
  template <class Target>
  bool improve_in_steps(const Target& target, int depth) {
    for (const auto& [u, v] : found_.edges)
      if (flips_.remove_edge_after_others(target, u, v, -1, depth))
        return true;
    return for_each_edge_of_sides(
        [&](local_id u, local_id v) { return flips_.remove_edge_after_others(target, u, v, -1, depth); });
  }
  template <class F>
  bool for_each_edge_of_sides(const F& f) {
    // Changes make sides invalid: their vertices are taken before any of them.
    side_edges_.clear();
    const auto& mesh = changes_.mesh();
    for (const local_id side : found_.sides) {
      const local_id e = triangulation<3>::element_of(side);
      if (!mesh.is_alive(e))
        continue;
      const auto& local = numbering::sides<3>[at(triangulation<3>::place_of(side))];
      for (std::size_t k = 0; k < 3; ++k)
        side_edges_.push_back({mesh[e].vertices[static_cast<std::size_t>(local[k])],
                               mesh[e].vertices[static_cast<std::size_t>(local[(k + 1) % 3])]});
    }
    return std::any_of(side_edges_.begin(), side_edges_.end(),
                       [&](const std::array<local_id, 2>& edge) { return f(edge[0], edge[1]); });
  }

  /// Makes the target with points where there is a place for them that is known to do.
  bool recover_with_points(const edge_target& target) {
    if (target.is_there(changes_))
      return true;
    find_obstacles(changes_, target, found_);
    const auto divide = [&](local_id u, local_id v) {
      return flips_.divide_ring(target, u, v, counts_.added_points);
    };
    for (const auto& [u, v] : found_.edges)
      if (divide(u, v))
        return true;
    return for_each_edge_of_sides(divide);
  }
  bool recover_with_points(const triangle_target& target) {
    if (target.is_there(changes_))
      return true;
    find_obstacles(changes_, target, found_);
    return cavity_division(changes_, kept_, target.corners, found_.elements).run(counts_.added_points);
  }

  /// Puts a point into the largest of the elements in the way, or, in later attempts, into the next ones.
  template <class Target>
  void add_point_in_the_way(const Target& target, std::size_t attempt) {
    find_obstacles(changes_, target, found_);
    auto& elements = found_.elements;
    if (elements.empty())
      return;
    const auto volume = [&](local_id e) {
      const auto p = changes_.mesh().points_of(e);
      return signed_volume(p[0], p[1], p[2], p[3]);
    };
    std::sort(elements.begin(), elements.end(), [&](local_id a, local_id b) {
      const double va = volume(a), vb = volume(b);
      return va != vb ? va > vb : a < b;
    });
    const local_id e = elements[attempt % elements.size()];
    const auto p = changes_.mesh().points_of(e);
    const vec3 middle = 0.25 * (p[0] + p[1] + p[2] + p[3]);
    const local_id v = changes_.add_point(middle);
    const auto old = changes_.mesh()[e].vertices;
    std::array<simplex<3>, 4> fresh{old, old, old, old};
    bool fits = true;
    for (std::size_t i = 0; i < 4; ++i) {
      fresh[i][i] = v;
      fits = fits && changes_.is_positive(fresh[i]);
    }
    if (!fits)
      return; // it stays a point of no element
    changes_.replace(std::array{e}, fresh);
    ++counts_.added_points;
  }

  std::string place_of(const edge_target& target) const {
    return "edge " + place_text(changes_.point(target.ends[0])) + " to " +
           place_text(changes_.point(target.ends[1]));
  }
  std::string place_of(const triangle_target& target) const {
    return "triangle " + place_text(changes_.point(target.corners[0])) + ", " +
           place_text(changes_.point(target.corners[1])) + ", " +
           place_text(changes_.point(target.corners[2]));
  }
  template <class Target>
  [[noreturn]] void throw_unrecovered(const std::vector<Target>& missing) const {
    constexpr std::size_t most_named = 5;
    std::string places;
    for (std::size_t k = 0; k < std::min(missing.size(), most_named); ++k)
      places += (k == 0 ? "" : "; ") + place_of(missing[k]);
    throw mesher_error(std::to_string(missing.size()) + " parts of the boundary could not be recovered: " +
                       places + (missing.size() > most_named ? "; ..." : ""));
  }

  local_changes& changes_;
  std::span<const simplex<2>> triangles_;
  kept_entities kept_;
  recovery_flips flips_;
  recovery_counts counts_;
  obstacles found_;
  std::vector<std::array<local_id, 2>> side_edges_;
  mutable local_id highest_ = no_id;
};

} // namespace detail

/// Changes a tetrahedrization, in which all vertices of `triangles` are, until each of these is a side of an
/// element. Points that had to be added are behind the others and inside of elements. `triangles` may be
/// listed in both directions. Throws `mesher_error` naming the places when some could not be recovered.
///
/// Linear in the elements, and about 20 us for each edge or triangle that was missing.
inline recovery_counts recover_boundary(triangulation<3>& mesh, std::span<const simplex<2>> triangles) {
  if (triangles.empty())
    return {};
  detail::local_changes changes(std::move(mesh));
  const recovery_counts counts = detail::boundary_recovery(changes, triangles).run();
  mesh = changes.take();
  return counts;
}

} // namespace dovetail
