/// @file
/// Makes the triangles of a boundary sides of a tetrahedrization of their points.
///
/// A Delaunay tetrahedrization lacks few of them when points inside keep away from the boundary. What is in
/// the way of one is taken away by flips, as by P. L. George, H. Borouchaki and E. Saltel, "'Ultimate'
/// robustness in meshing an arbitrary polyhedron", doi 10.1002/nme.808, and J. Chen et al.,
/// "Three-dimensional constrained boundary recovery with an enhanced Steiner point suppression procedure",
/// doi 10.1016/j.compstruc.2010.11.016 (where removal of an edge is a shell transformation). What flips do
/// not reach is divided by points (`boundary_splits`), which are on the boundary only until all of it is
/// there.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/mesher/native/boundary_splits.hpp"
#include "dovetail/mesher/native/cavity_division.hpp"
#include "dovetail/mesher/native/kept_entities.hpp"
#include "dovetail/mesher/native/missing_parts.hpp"
#include "dovetail/mesher/native/point_removal.hpp"
#include "dovetail/mesher/native/recovery_flips.hpp"
#include "dovetail/mesher/native/recovery_targets.hpp"
#include "dovetail/triangulation/insertion_order.hpp"
#include "dovetail/triangulation/local_changes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// What recovery found and did.
struct recovery_counts {
  std::size_t missing_edges = 0;     ///< of the boundary, in the tetrahedrization given
  std::size_t missing_triangles = 0; ///< once the edges were there
  std::size_t splits = 0;            ///< edges and triangles divided for a while
  std::size_t added_points = 0;      ///< at the end of the points, with those that are in no element again
  std::size_t removed_points = 0;    ///< that are in no element again
  std::size_t operations = 0;        ///< elements visited and places compared, in all attempts
};

namespace detail {

/// How one attempt at a recovery differs from others. What fails in one order is nearly always done in
/// another.
struct recovery_attempt {
  int level_steps = 5;           ///< changes for one target after which as much is in its way as before
  bool last_first = false;       ///< begins with the last edges
  std::size_t work = 20'000'000; ///< that is allowed, and some more for each triangle: about half a second
  bool thorough = false;         ///< tries more to take each point off the boundary
};

/// Makes edges and triangles parts of the mesh one after the other.
class boundary_recovery {
public:
  boundary_recovery(local_changes& changes, const boundary_sides& sides, const recovery_attempt& attempt)
      : changes_(changes), attempt_(attempt), kept_(sides), flips_(changes, kept_), splits_(changes, kept_),
        removal_(changes, kept_), given_points_(static_cast<local_id>(changes.mesh().points.size())),
        all_work_(changes.work() + attempt.work + work_per_triangle * sides.triangles().size()) {
    changes_.limit_work(all_work_);
  }

  /// `lacking`: the triangles that are no sides of elements.
  recovery_counts run(const std::vector<triangle_target>& lacking) {
    std::vector<edge_target> edges = missing_edges_of(changes_, lacking);
    counts_.missing_edges = edges.size();
    if (attempt_.last_first)
      std::reverse(edges.begin(), edges.end());
    for (bool first = true;; first = false) {
      recover_all(edges);
      std::vector<triangle_target> triangles = still_missing(changes_, lacking, kept_);
      if (first)
        counts_.missing_triangles = triangles.size();
      recover_by_flips(triangles);
      if (triangles.empty())
        break;
      divide_all(triangles, edges);
    }
    if (splits_.undo_all([&](local_id v) { return removal_.remove_edges(v); }, attempt_.thorough) > 0)
      throw mesher_error("the boundary could not be recovered: " + splits_.place_of_last() +
                         " stays divided");
    remove_points();
    return counts_;
  }
  /// Whether parts of the boundary pass through each other, so that no other attempt is worth it.
  bool is_hopeless() const { return is_hopeless_; }

private:
  static constexpr std::size_t target_work = 30'000; // for one target in one go, before it is divided
  static constexpr std::size_t work_per_triangle = 2000;
  static constexpr int most_steps = 100; // changes for one target in one go
  static constexpr int most_depth = 2;   // of removals of edges for the sake of others

  /// Makes edges part of the mesh, if need be in pieces.
  void recover_all(std::vector<edge_target>& missing) {
    recover_by_flips(missing);
    while (!missing.empty()) {
      std::vector<edge_target> pieces;
      divide_all(missing, pieces);
      missing = std::move(pieces);
      recover_by_flips(missing);
    }
  }

  /// Goes over the targets as long as some are reached, since one may be in the way of another. Throws
  /// `mesher_error` when parts of the boundary pass through each other, naming them.
  template <class Target>
  void recover_by_flips(std::vector<Target>& missing) {
    require_no_conflict(missing); // what is there already tells at once of most that pass through each other
    for (int depth = 0; depth <= most_depth; ++depth) {
      for (std::size_t before = missing.size() + 1; !missing.empty() && missing.size() < before;) {
        before = missing.size();
        std::erase_if(missing, [&](const Target& target) { return recover(target, depth); });
      }
      if (changes_.is_spent() && !missing.empty())
        give_up_for_work(missing);
      if (depth == 0)
        require_no_conflict(missing);
    }
    std::erase_if(missing, [&](const Target& target) { return recover_with_points(target); });
  }

  /// Divides each target, or clears it of points that may go; what is to be recovered then is added to
  /// `edges`. Throws `mesher_error` with the places of those for which neither is possible.
  template <class Target>
  void divide_all(std::vector<Target>& missing, std::vector<edge_target>& edges) {
    std::vector<Target> stuck;
    for (std::size_t k = 0; k < missing.size(); ++k) {
      const Target& target = missing[k];
      if (changes_.is_spent()) {
        missing.erase(missing.begin(), missing.begin() + static_cast<std::ptrdiff_t>(k));
        append(missing, stuck);
        give_up_for_work(missing);
      }
      if (target.is_there(changes_))
        continue;
      find_obstacles(changes_, target, found_);
      if (splits_.split(target, found_, edges))
        ++counts_.splits;
      else if (clear(target))
        keep_for_later(target, edges);
      else
        stuck.push_back(target);
    }
    if (stuck.size() == missing.size())
      throw_unrecovered(stuck, "");
    for (const Target& target : stuck)
      keep_for_later(target, edges);
  }
  static void keep_for_later(const edge_target& target, std::vector<edge_target>& edges) {
    edges.push_back(target);
  }
  static void keep_for_later(const triangle_target&, std::vector<edge_target>&) {
  } // those are looked for again

  /// Removes vertices that are none of the boundary from the inside of a target.
  template <class Target>
  bool clear(const Target& target) {
    bool any = false;
    for (const local_id v : vertices_within(changes_, target))
      any = (!kept_.is_of_boundary(v) && !splits_.has_point(v) && removal_.remove(v)) || any;
    return any;
  }

  /// Two parts of the boundary cannot pass through each other.
  template <class Target>
  void require_no_conflict(const std::vector<Target>& missing) {
    if (splits_.count() > 0)
      return; // points on edges are there but for rounding
    std::vector<std::string> conflicts;
    for (const Target& target : missing) {
      if (conflicts.size() == most_named)
        break;
      if (const std::string what = conflict_of(target); !what.empty())
        conflicts.push_back(place_of(target) + ", which passes through " + what);
    }
    if (!conflicts.empty())
      give_up_for_conflicts(conflicts);
  }
  template <class Target>
  std::string conflict_of(const Target& target) {
    find_obstacles(changes_, target, found_);
    for (const auto& [u, v] : found_.edges)
      if (kept_.has(u, v))
        return place_of(edge_target{{u, v}});
    for (const local_id side : found_.sides) {
      const auto t =
          changes_.side_vertices(triangulation<3>::element_of(side), triangulation<3>::place_of(side));
      if (kept_.has(t[0], t[1], t[2]))
        return place_of(triangle_target{t});
    }
    for (const local_id v : vertices_within(changes_, target))
      if (kept_.is_of_boundary(v))
        return "point " + place_text(changes_.point(v));
    return "";
  }

  template <class Target>
  bool recover(const Target& target, int depth) {
    changes_.limit_work(std::min(all_work_, changes_.work() + target_work));
    const bool is_there = recover_in_steps(target, depth);
    changes_.limit_work(all_work_);
    return is_there;
  }
  template <class Target>
  bool recover_in_steps(const Target& target, int depth) {
    int level_steps = 0;
    for (int step = 0; step < most_steps && !changes_.is_spent(); ++step) {
      if (target.is_there(changes_))
        return true;
      find_obstacles(changes_, target, found_);
      if (improve(target, -1))
        continue;
      if (level_steps++ >= attempt_.level_steps)
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
      const auto& local = numbering::sides<3>[triangulation<3>::place_of(side)];
      for (std::size_t k = 0; k < 3; ++k)
        side_edges_.push_back({mesh[e].vertices[local[k]], mesh[e].vertices[local[(k + 1) % 3]]});
    }
    return std::any_of(side_edges_.begin(), side_edges_.end(),
                       [&](const std::array<local_id, 2>& edge) { return f(edge[0], edge[1]); });
  }

  /// Makes the target with points where there is a place for them that is known to do.
  bool recover_with_points(const edge_target& target) {
    if (target.is_there(changes_))
      return true;
    find_obstacles(changes_, target, found_);
    const auto divide = [&](local_id u, local_id v) { return flips_.divide_ring(target, u, v); };
    for (const auto& [u, v] : found_.edges)
      if (divide(u, v))
        return true;
    return for_each_edge_of_sides(divide);
  }
  bool recover_with_points(const triangle_target& target) {
    if (target.is_there(changes_))
      return true;
    find_obstacles(changes_, target, found_);
    return cavity_division(changes_, kept_, target.corners, found_.elements).run();
  }

  /// Removes what was added, as far as possible.
  void remove_points() {
    for (std::size_t before = counts_.removed_points + 1; before != counts_.removed_points;) {
      before = counts_.removed_points;
      for (local_id v = given_points_; v < static_cast<local_id>(changes_.mesh().points.size()); ++v)
        if (changes_.is_in_element(v) && !changes_.is_spent())
          removal_.remove(v);
      counts_.removed_points = 0;
      for (local_id v = given_points_; v < static_cast<local_id>(changes_.mesh().points.size()); ++v)
        counts_.removed_points += !changes_.is_in_element(v);
    }
    counts_.added_points = changes_.mesh().points.size() - given_points_;
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
  [[noreturn]] void throw_unrecovered(const std::vector<Target>& missing, const std::string& how) const {
    std::string text;
    for (std::size_t k = 0; k < std::min(missing.size(), most_named); ++k)
      text += (k == 0 ? "" : "; ") + place_of(missing[k]);
    throw mesher_error(std::to_string(missing.size()) + " parts of the boundary could not be recovered" +
                       how + ": " + text + (missing.size() > most_named ? "; ..." : ""));
  }
  template <class Target>
  [[noreturn]] void give_up_for_work(const std::vector<Target>& missing) {
    throw_unrecovered(missing, " with the work that is allowed");
  }
  /// Throws when another attempt could not help.
  [[noreturn]] void give_up_for_conflicts(const std::vector<std::string>& conflicts) {
    is_hopeless_ = true;
    std::string text;
    for (const std::string& conflict : conflicts)
      text += (text.empty() ? "" : "; ") + conflict;
    throw mesher_error("parts of the boundary could not be recovered: " + text);
  }
  static constexpr std::size_t most_named = 5;

  local_changes& changes_;
  recovery_attempt attempt_;
  kept_entities kept_;
  recovery_flips flips_;
  boundary_splits splits_;
  point_removal removal_;
  local_id given_points_;
  std::size_t all_work_;
  recovery_counts counts_;
  bool is_hopeless_ = false;
  obstacles found_;
  std::vector<vertex_pair> side_edges_;
};

} // namespace detail

/// Changes a tetrahedrization, in which all vertices of the boundary are, until each of its triangles is a
/// side of an element. Points that had to be added are behind the others and inside of elements, or in none
/// at all when they could be removed again. Triangles may be listed in both directions. Throws
/// `mesher_error`, and the tetrahedrization is as it was, naming the places when some could not be recovered:
/// those that pass through others, or what was missing when the work was spent that is allowed, which is a
/// few seconds' in all attempts and some more for each triangle.
///
/// Linear in the elements, and where something was missing about 20 us for each edge or triangle.
/// \param mesh a tetrahedrization with its ghosts, which changes
/// \param sides triangles of three indices of its vertices each
inline recovery_counts recover_boundary(triangulation<3>& mesh, const boundary_sides& sides) {
  const auto lacking = detail::missing_triangles(mesh, sides);
  if (lacking.empty())
    return {};
  using attempt = detail::recovery_attempt;
  // About one piece in a hundred of the hardest kinds (tests/mesher/random_pieces.hpp) needs a second
  // attempt, of these about every third the next.
  constexpr std::array attempts{attempt{}, attempt{40, true, 10'000'000}, attempt{15, false, 10'000'000},
                                attempt{5, true, 25'000'000, true}, attempt{40, false, 10'000'000, true}};
  std::size_t operations = 0;
  for (std::size_t k = 0;; ++k) {
    detail::local_changes changes(mesh);
    detail::boundary_recovery recovery(changes, sides, attempts[k]);
    try {
      recovery_counts counts = recovery.run(lacking);
      counts.operations = operations + changes.work();
      mesh = changes.take();
      return counts;
    } catch (const mesher_error&) {
      operations += changes.work();
      if (recovery.is_hopeless() || k + 1 == attempts.size())
        throw;
    }
  }
}

} // namespace dovetail
