/// @file
/// What `crossing_triangles.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/octree.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/intersection/crossing_triangles.hpp"
#include "dovetail/intersection/single_sheet.hpp"
#include "dovetail/intersection/triangle_separation.hpp"
#include "dovetail/mesh/triangle_intersection.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/run_task.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

inline box3 box_of(std::span<const vec3> points, const simplex<2>& triangle) {
  box3 box;
  for (const local_id v : triangle)
    box.include(points[static_cast<std::size_t>(v)]);
  return box;
}

/// Searches cells of an octree over the triangles' boxes; a triangle is in every cell that its box overlaps.
/// A pair is tested in the cell that has the lower corner of what their boxes share, so once. Boxes are made
/// when they are needed: beside the mesh there are only the lists of the cells on the way down.
class crossing_search {
public:
  /// An octant of the root, or a part of one.
  struct cell {
    box3 box;
    std::vector<local_id> items;
    int depth = 0;
  };

  crossing_search(std::span<const vec3> points, std::span<const simplex<2>> triangles,
                  const std::function<bool(local_id, local_id)>& excluded,
                  const crossing_parameters& parameters)
      : points_(points), triangles_(triangles), excluded_(excluded), parameters_(parameters) {}

  /// Cells that together hold all pairs, at least `wanted` where there is so much to split.
  std::vector<cell> start(std::size_t wanted) {
    cell root;
    for (const simplex<2>& triangle : triangles_)
      for (const local_id v : triangle)
        root.box.include(points_[static_cast<std::size_t>(v)]);
    for (int axis = 0; axis < 3; ++axis) // half open: nothing is on the upper side of the root
      root.box.upper[axis] = std::nextafter(root.box.upper[axis], std::numeric_limits<double>::max());
    root.items.resize(triangles_.size());
    std::iota(root.items.begin(), root.items.end(), local_id{0});
    std::vector<cell> cells;
    cells.push_back(std::move(root));
    for (int level = 0; level < 3 && cells.size() < wanted; ++level) {
      std::vector<cell> parts;
      for (cell& whole : cells) {
        if (whole.items.size() <= 1000) {
          parts.push_back(std::move(whole));
          continue;
        }
        for (cell& part : octants(whole))
          if (part.items.size() > 1)
            parts.push_back(std::move(part));
      }
      cells = std::move(parts);
    }
    return cells;
  }

  /// Appends the crossing pairs of a cell. One searcher for each thread.
  void search(cell&& whole, std::vector<triangle_pair>& found) {
    if (whole.items.size() < 2 || is_sheet_(whole.items))
      return;
    if (whole.items.size() <= parameters_.leaf_size || whole.depth >= parameters_.depth_limit) {
      test_pairs(whole, found);
      return;
    }
    auto parts = octants(whole);
    // Long triangles are in many parts. Where splitting saves less than a quarter of the pairs they only are
    // copied; so all cells together never take longer than testing each pair of the whole once.
    const auto pairs_of = [](const cell& c) { return static_cast<double>(c.items.size() * c.items.size()); };
    double pairs = 0;
    for (const cell& part : parts)
      pairs += pairs_of(part);
    if (pairs > 0.75 * pairs_of(whole)) {
      test_pairs(whole, found);
      return;
    }
    whole.items = {};
    for (cell& part : parts)
      search(std::move(part), found);
  }

private:
  box3 box(local_id item) const { return box_of(points_, triangles_[static_cast<std::size_t>(item)]); }

  std::array<cell, 8> octants(const cell& whole) const {
    auto items = items_by_octant(whole.box, whole.items, [&](local_id item) {
      return [at = box(item)](const box3& part) { return at.overlaps(part); };
    });
    std::array<cell, 8> parts;
    for (unsigned k = 0; k < 8; ++k)
      parts[k] = {octant(whole.box, k), std::move(items[k]), whole.depth + 1};
    return parts;
  }

  void test_pairs(const cell& leaf, std::vector<triangle_pair>& found) {
    boxes_.clear();
    for (const local_id item : leaf.items)
      boxes_.emplace_back(box(item), item);
    sort_all(boxes_, [](const auto& a, const auto& b) { return a.first.lower.x < b.first.lower.x; });
    for (auto a = boxes_.begin(); a != boxes_.end(); ++a)
      for (auto b = a + 1; b != boxes_.end() && b->first.lower.x <= a->first.upper.x; ++b)
        if (a->first.overlaps(b->first) && is_tested_in(leaf.box, a->first, b->first)) {
          const auto [i, j] = std::minmax(a->second, b->second);
          if (cross(i, j))
            found.push_back({i, j});
        }
  }

  static bool is_tested_in(const box3& cell, const box3& a, const box3& b) {
    for (int axis = 0; axis < 3; ++axis)
      if (const double corner = std::max(a.lower[axis], b.lower[axis]);
          corner < cell.lower[axis] || corner >= cell.upper[axis])
        return false;
    return true;
  }

  bool cross(local_id i, local_id j) const {
    const simplex<2>& s = triangles_[static_cast<std::size_t>(i)];
    const simplex<2>& t = triangles_[static_cast<std::size_t>(j)];
    return !(excluded_ && excluded_(i, j)) && !separated_by_a_plane(points_, s, t) &&
           triangles_cross(points_, s, t);
  }

  std::span<const vec3> points_;
  std::span<const simplex<2>> triangles_;
  const std::function<bool(local_id, local_id)>& excluded_;
  crossing_parameters parameters_;
  single_sheet is_sheet_{points_, triangles_};
  std::vector<std::pair<box3, local_id>> boxes_; ///< of a cell's triangles
};

} // namespace detail

DOVETAIL_INLINE std::vector<triangle_pair>
crossing_triangles(std::span<const vec3> points, std::span<const simplex<2>> triangles,
                   const std::function<bool(local_id, local_id)>& excluded, const any_executor& run,
                   const crossing_parameters& parameters, const progress& on_progress) {
  constexpr std::size_t triangles_per_task = 50'000; // a request to stop is seen after each
  const auto most_tasks = 8 * static_cast<std::size_t>(run.workers()) + triangles.size() / triangles_per_task;
  const auto cells = detail::crossing_search(points, triangles, excluded, parameters).start(most_tasks);
  const std::size_t tasks = std::min(cells.size(), most_tasks);
  const auto outcomes = run.run(
      tasks,
      [&](std::size_t task) {
        detail::crossing_search searcher(points, triangles, excluded, parameters);
        std::vector<triangle_pair> found;
        for (std::size_t c = task; c < cells.size(); c += tasks)
          searcher.search(detail::crossing_search::cell(cells[c]), found);
        std::vector<local_id> flat;
        for (const auto& [i, j] : found) {
          flat.push_back(i);
          flat.push_back(j);
        }
        byte_writer out;
        out.array(flat);
        return out.take();
      },
      run_options{.on_progress = on_progress, .stage = "intersection"});

  std::vector<triangle_pair> pairs;
  for (const task_outcome& outcome : outcomes) {
    detail::require_done(outcome, "the intersection test");
    const auto flat = byte_reader(outcome.result).array<local_id>();
    for (std::size_t k = 0; k < flat.size(); k += 2)
      pairs.push_back({flat[k], flat[k + 1]});
  }
  sort_unique(pairs);
  return pairs;
}

} // namespace dovetail
