/// @file
/// The step of Bowyer and Watson: the elements whose spheres hold a new point go, and the hole is filled by
/// elements from its sides to the point.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/triangulation/triangulation.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dovetail::detail {

/// A list that looks after room for several items at once. `add` does not: call `make_room` before.
template <class T>
class roomy_list {
public:
  std::size_t size() const { return size_; }
  void clear() { size_ = 0; }
  /// For `more` items.
  void make_room(std::size_t more) {
    if (size_ + more > items_.size())
      items_.resize(2 * (size_ + more));
  }
  void add(const T& item) { items_[size_++] = item; }
  T& operator[](std::size_t k) { return items_[k]; }
  T* begin() { return items_.data(); }
  T* end() { return items_.data() + size_; }

private:
  std::vector<T> items_;
  std::size_t size_ = 0;
};

/// Inserts points into a Delaunay triangulation. The buffers are kept from point to point.
///
/// A point on a sphere counts as outside. With exact signs that is all that degenerate input needs: the
/// elements whose open spheres hold the point are connected, and none of the hole's sides is in one plane
/// with it (were it so, the point would be inside the circle of that side, hence inside both spheres there).
template <int D>
class cavity {
public:
  static constexpr auto side_corners = static_cast<std::size_t>(D);

  /// A side of the hole, seen from outside of it.
  struct rim_side {
    local_id outer;                                ///< the side of the element that stays
    std::array<local_id, side_corners> vertices;   ///< oriented outwards of the hole
    std::array<std::uint32_t, side_corners> ranks; ///< of the vertices among those of the rim
  };

  /// Inserts vertex `v`, which is strictly inside the sphere of element `start`. Returns an element at it
  /// that is no ghost. The expected time is constant for points in random order.
  local_id insert(triangulation<D>& t, const box_predicates<D>& predicates, local_id v, local_id start) {
    dig(t, predicates, t.point(v), start);
    number_rim(t);
    return fill(t, v);
  }

private:
  enum class state : std::uint8_t { unknown, inside, outside };

  state& state_of(local_id e) { return states_[e]; }

  static bool in_conflict(const triangulation<D>& t, const box_predicates<D>& predicates, local_id e,
                          const point_of<D>& p) {
    if (t.is_ghost(e)) [[unlikely]]
      return in_conflict_with_ghost(t, predicates, e, p);
    return predicates.in_sphere(t.points_of(e), p) > 0;
  }
  /// The sphere of a ghost is the open half-space beyond its hull side, and the open disc in its plane.
  [[gnu::noinline]] static bool in_conflict_with_ghost(const triangulation<D>& t,
                                                       const box_predicates<D>& predicates, local_id e,
                                                       const point_of<D>& p) {
    const std::size_t far = t.infinite_place(e);
    corner_places<D> corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
      corners[i] = i == far ? &p : &t.point(t[e].vertices[i]);
    const double side = predicates.orientation(corners);
    if (side != 0)
      return side > 0;
    return in_conflict(t, predicates, triangulation<D>::element_of(t[e].across[far]), p);
  }

  /// Finds the elements in conflict with `p`, breadth first, and the sides between them and the others.
  void dig(const triangulation<D>& t, const box_predicates<D>& predicates, const point_of<D>& p,
           local_id start) {
    states_.resize(t.cells.size(), state::unknown);
    hole_.clear();
    hole_.make_room(1);
    rim_.clear();
    hole_.add(start);
    state_of(start) = state::inside;
    for (std::size_t next = 0; next < hole_.size(); ++next) {
      hole_.make_room(side_corners + 1);
      rim_.make_room(side_corners + 1);
      look_across<0>(t, predicates, p, hole_[next]);
      look_across<1>(t, predicates, p, hole_[next]);
      look_across<2>(t, predicates, p, hole_[next]);
      if constexpr (D == 3)
        look_across<3>(t, predicates, p, hole_[next]);
    }
    for (const local_id e : hole_)
      state_of(e) = state::unknown;
    for (const rim_side& side : rim_)
      state_of(triangulation<D>::element_of(side.outer)) = state::unknown;
  }

  /// Side `I` of an element of the hole is one of the rim, or the element beyond is in the hole, too.
  template <std::size_t I>
  void look_across(const triangulation<D>& t, const box_predicates<D>& predicates, const point_of<D>& p,
                   local_id of) {
    const auto& cell = t[of];
    const local_id outer = cell.across[I];
    const local_id e = triangulation<D>::element_of(outer);
    state& known = state_of(e);
    if (known == state::inside)
      return;
    if (known == state::unknown) {
      if (in_conflict(t, predicates, e, p)) {
        known = state::inside;
        hole_.add(e);
        return;
      }
      known = state::outside;
    }
    constexpr auto& local = numbering::sides<D>[I];
    if constexpr (D == 2)
      rim_.add({outer, {cell.vertices[local[0]], cell.vertices[local[1]]}, {}});
    else
      rim_.add({outer, {cell.vertices[local[0]], cell.vertices[local[1]], cell.vertices[local[2]]}, {}});
  }

  /// Numbers the vertices of the rim from 0, so that its ridges are found by place in a small table.
  void number_rim(const triangulation<D>& t) {
    rank_of_.resize(t.points.size() + 1);
    rim_vertices_.clear();
    rim_vertices_.make_room(side_corners * rim_.size());
    for (rim_side& side : rim_)
      for (std::size_t k = 0; k < side_corners; ++k) {
        const local_id v = side.vertices[k];
        std::uint32_t& rank = rank_of_[v + 1]; // `infinite` is -1
        if (rank >= rim_vertices_.size() || rim_vertices_[rank] != v) {
          rank = static_cast<std::uint32_t>(rim_vertices_.size());
          rim_vertices_.add(v);
        }
        side.ranks[k] = rank;
      }
  }

  /// Joins every side of the rim to `v`. New element: v, then the side's vertices.
  local_id fill(triangulation<D>& t, local_id v) {
    fresh_.clear();
    fresh_.make_room(rim_.size());
    std::size_t reused = 0;
    local_id inner = no_id;
    for (const rim_side& side : rim_) {
      const local_id e = reused < hole_.size() ? hole_[reused++] : t.add();
      fresh_.add(e);
      bool ghost = false;
      auto& cell = t[e];
      cell.vertices[0] = v;
      for (std::size_t k = 0; k < side_corners; ++k) {
        cell.vertices[k + 1] = side.vertices[k];
        ghost = ghost || side.vertices[k] < 0;
      }
      t.join(triangulation<D>::side_of(e, 0), side.outer);
      if (!ghost)
        inner = e;
    }
    while (reused < hole_.size())
      t.remove(hole_[reused++]);
    if constexpr (D == 2)
      join_around_point(t);
    else if (rim_vertices_.size() <= most_tabled)
      join_by_table(t);
    else
      join_by_sorting(t);
    return inner;
  }

  /// D = 2: the rim is a cycle, in which each vertex begins one side.
  void join_around_point(triangulation<D>& t) {
    table_.resize(rim_vertices_.size());
    for (std::size_t k = 0; k < rim_.size(); ++k)
      table_[rim_[k].ranks[0]] = fresh_[k];
    for (std::size_t k = 0; k < rim_.size(); ++k)
      t.join(triangulation<D>::side_of(fresh_[k], 1), triangulation<D>::side_of(table_[rim_[k].ranks[1]], 2));
  }

  /// D = 3: each edge of the rim is passed once in each direction. Nothing in the table needs to be cleared,
  /// as all that is read was written for the same rim.
  void join_by_table(triangulation<D>& t) {
    const std::size_t width = rim_vertices_.size();
    if (table_.size() < width * width)
      table_.resize(width * width);
    for (std::size_t k = 0; k < rim_.size(); ++k) {
      const auto& [a, b, c] = rim_[k].ranks;
      const local_id side = triangulation<D>::side_of(fresh_[k], 0);
      table_[b * width + c] = side + 1;
      table_[c * width + a] = side + 2;
      table_[a * width + b] = side + 3;
    }
    for (std::size_t k = 0; k < rim_.size(); ++k) {
      const auto& [a, b, c] = rim_[k].ranks;
      auto& across = t[fresh_[k]].across;
      across[1] = table_[c * width + b];
      across[2] = table_[a * width + c];
      across[3] = table_[b * width + a];
    }
  }

  /// As `join_by_table`, for the rare rim of so many vertices that the table would be large.
  void join_by_sorting(triangulation<D>& t) {
    edges_.clear();
    for (std::size_t k = 0; k < rim_.size(); ++k)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = rim_[k].ranks[(i + 1) % 3], b = rim_[k].ranks[(i + 2) % 3];
        const bool upwards = a < b;
        edges_.push_back({upwards ? a : b, upwards ? b : a,
                          triangulation<D>::side_of(fresh_[k], static_cast<local_id>(i) + 1)});
      }
    sort_all(edges_, [](const rim_edge& a, const rim_edge& b) {
      return a.lower != b.lower ? a.lower < b.lower : a.upper < b.upper;
    });
    for (std::size_t k = 0; k < edges_.size(); k += 2)
      t.join(edges_[k].side, edges_[k + 1].side);
  }

  struct rim_edge {
    std::uint32_t lower, upper;
    local_id side;
  };
  static constexpr std::size_t most_tabled = 512;

  std::vector<state> states_; // per element; unknown between two points
  roomy_list<local_id> hole_, fresh_, rim_vertices_;
  roomy_list<rim_side> rim_;
  std::vector<local_id> table_;
  std::vector<rim_edge> edges_;
  std::vector<std::uint32_t>
      rank_of_; // per vertex; what is left of earlier points is told by `rim_vertices_`
};

} // namespace dovetail::detail
