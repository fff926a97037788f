/// @file
/// Is a mesh in several files a mesh? Its pieces are checked one after the other; what they share is kept:
/// their boundaries, and ranges of numbers.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"
#include "dovetail/mesh/validity.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace dovetail::io {

/// Numbers as ranges: little memory where they come in ascending runs.
class number_ranges {
public:
  /// A run of numbers.
  struct range {
    global_id first; ///< the smallest of them
    global_id last;  ///< included
  };

  /// One more number; no range is needed for the one after the last.
  void add(global_id id) {
    if (!ranges_.empty() && ranges_.back().last + 1 == id)
      ranges_.back().last = id;
    else
      ranges_.push_back({id, id});
  }
  /// Sorts the ranges; true when no number was added twice. O(ranges log).
  bool disjoint() {
    sort_all(ranges_, [](const range& a, const range& b) { return a.first < b.first; });
    for (std::size_t i = 1; i < ranges_.size(); ++i)
      if (ranges_[i].first <= ranges_[i - 1].last)
        return false;
    return true;
  }
  /// How many numbers there are. Sorts the ranges.
  std::uint64_t count() {
    disjoint();
    std::uint64_t sum = 0;
    global_id next = ranges_.empty() ? 0 : ranges_.front().first;
    for (const range& r : ranges_) {
      next = std::max(next, r.first);
      if (r.last >= next)
        sum += static_cast<std::uint64_t>(r.last - next) + 1;
      next = std::max(next, r.last + 1);
    }
    return sum;
  }
  /// Of sorted and disjoint ranges.
  bool contains(global_id id) const {
    const auto after = std::upper_bound(ranges_.begin(), ranges_.end(), id,
                                        [](global_id value, const range& r) { return value < r.first; });
    return after != ranges_.begin() && id <= std::prev(after)->last;
  }

private:
  std::vector<range> ranges_;
};

/// `check_validity` of tetrahedra in several files. Inside a piece it is that function; between pieces, sides
/// and points of their boundaries are compared by global number, and a point inside a piece may be in no
/// other. Memory: the boundaries of all pieces.
class streamed_validity {
public:
  /// Adds a piece, its points in the order of their global numbers. About linear.
  void add(const loaded_mesh& piece, const std::string& name) {
    const auto& mesh = piece.mesh;
    elements_ += mesh.elements.size();
    const validity inside = check_validity(mesh, {.isolated_points = true});
    if (!inside.valid()) {
      add_fault(inside_, name + ": " + inside.text());
      return;
    }
    const auto table = build_sides(mesh);
    enum : std::uint8_t { unused, within, on_boundary };
    std::vector<std::uint8_t> place(mesh.points.size(), unused);
    for (const auto& element : mesh.elements)
      for (const auto v : element)
        place[v] = within;
    for (std::size_t s = 0; s < table.size(); ++s)
      if (table.is_boundary(static_cast<local_id>(s)))
        for (const auto v : table.vertices[s])
          place[v] = on_boundary;
    for (std::size_t s = 0; s < table.size(); ++s) {
      const auto& vertices = table.vertices[s];
      if (std::any_of(vertices.begin(), vertices.end(), [&](local_id v) { return place[v] != on_boundary; }))
        continue; // no other piece can have it
      side found;
      for (std::size_t k = 0; k < 3; ++k)
        found.ids[k] = piece.node_ids[vertices[k]];
      std::rotate(found.ids.begin(), std::min_element(found.ids.begin(), found.ids.end()), found.ids.end());
      found.turned = found.ids[1] > found.ids[2];
      if (found.turned)
        std::swap(found.ids[1], found.ids[2]);
      found.elements = table.is_boundary(static_cast<local_id>(s)) ? 1 : 2;
      sides_.push_back(found);
    }
    for (std::size_t v = 0; v < place.size(); ++v) {
      const auto id = piece.node_ids[v];
      if (place[v] == within)
        inner_.add(id);
      else
        (place[v] == unused ? unused_ : shared_).push_back({id, mesh.points[v]});
    }
  }

  /// What is wrong, on one line; empty for a valid mesh. Throws `input_error` when points of the same number
  /// are at different places. O(boundaries, log for sorting).
  std::string faults() {
    join_points();
    if (!inside_.empty())
      return inside_;
    std::string found;
    compare_points(found);
    compare_sides(found);
    return found;
  }

  std::uint64_t elements() const { return elements_; } ///< elements checked so far
  /// After `faults`, of a valid mesh.
  std::uint64_t points() { return inner_.count() + shared_.size(); }

private:
  struct side {
    std::array<global_id, 3> ids; ///< ascending
    bool turned;                  ///< an odd permutation of the side as its first element has it
    std::uint8_t elements;        ///< in its piece
  };
  struct numbered_point {
    global_id id;
    vec3 at;
  };

  static void add_fault(std::string& to, const std::string& what) { to += (to.empty() ? "" : "; ") + what; }
  static void add_fault(std::string& to, std::int64_t count, const std::string& what, global_id first) {
    if (count > 0)
      add_fault(to, std::to_string(count) + " x " + what + " (point " + std::to_string(first) + ")");
  }
  template <class Wrong>
  static void count_points(std::string& found, const std::vector<numbered_point>& points,
                           const std::string& what, const Wrong& wrong) {
    std::int64_t count = 0;
    global_id first = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (wrong(i) && count++ == 0)
        first = points[i].id;
    add_fault(found, count, what, first);
  }

  void join_points() {
    sort_all(shared_, [](const numbered_point& a, const numbered_point& b) { return a.id < b.id; });
    std::vector<numbered_point> distinct;
    for (const auto& point : shared_) {
      if (distinct.empty() || distinct.back().id != point.id)
        distinct.push_back(point);
      else if (distinct.back().at != point.at)
        throw input_error("two points have the global number " + std::to_string(point.id) +
                          " but not the same coordinates");
    }
    shared_ = std::move(distinct);
  }

  void compare_points(std::string& found) {
    if (!inner_.disjoint())
      add_fault(found, "a point is inside two pieces");
    count_points(found, shared_, "point inside one piece that another has",
                 [&](std::size_t i) { return inner_.contains(shared_[i].id); });
    count_points(found, unused_, "isolated point", [&](std::size_t i) {
      const auto at = std::lower_bound(shared_.begin(), shared_.end(), unused_[i].id,
                                       [](const numbered_point& p, global_id id) { return p.id < id; });
      return !inner_.contains(unused_[i].id) && (at == shared_.end() || at->id != unused_[i].id);
    });
    auto by_place = shared_;
    sort_all(by_place, [](const numbered_point& a, const numbered_point& b) {
      return std::tuple(a.at.x, a.at.y, a.at.z, a.id) < std::tuple(b.at.x, b.at.y, b.at.z, b.id);
    });
    count_points(found, by_place, "coincident point",
                 [&](std::size_t i) { return i > 0 && by_place[i].at == by_place[i - 1].at; });
  }

  void compare_sides(std::string& found) {
    sort_all(sides_, [](const side& a, const side& b) { return a.ids < b.ids; });
    std::int64_t crowded = 0, misoriented = 0;
    global_id first_crowded = 0, first_misoriented = 0;
    for (std::size_t i = 0, end; i < sides_.size(); i = end) {
      int elements = 0;
      for (end = i; end < sides_.size() && sides_[end].ids == sides_[i].ids; ++end)
        elements += sides_[end].elements;
      if (elements > 2 && crowded++ == 0)
        first_crowded = sides_[i].ids[0];
      if (elements == 2 && end == i + 2 && sides_[i].turned == sides_[i + 1].turned && misoriented++ == 0)
        first_misoriented = sides_[i].ids[0];
    }
    add_fault(found, crowded, "non-manifold side", first_crowded);
    add_fault(found, misoriented, "misoriented side", first_misoriented);
  }

  std::vector<side> sides_;
  std::vector<numbered_point> shared_; ///< on the boundary of a piece
  std::vector<numbered_point> unused_; ///< of no element of their piece
  number_ranges inner_;
  std::uint64_t elements_ = 0;
  std::string inside_; ///< faults inside pieces
};

} // namespace dovetail::io
