/// @file
/// What `crossing_triangles.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/octree.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/intersection/crossing_triangles.hpp"
#include "dovetail/intersection/single_sheet.hpp"
#include "dovetail/intersection/triangle_blocks.hpp"
#include "dovetail/intersection/triangle_separation.hpp"
#include "dovetail/mesh/triangle_intersection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// Searches cells of an octree over the triangles' boxes; a triangle is in every cell that its box overlaps.
/// A pair is tested in the cell that has the lower corner of what their boxes share, so once. Boxes of
/// triangles are made when they are needed: beside the mesh there are only those of blocks, and the lists of
/// the cells on the way down.
class crossing_search {
public:
  /// An octant of the root, or a part of one.
  struct cell {
    box3 box;
    std::vector<local_id> items; ///< triangles, or blocks of them
    int depth = 0;
  };

  crossing_search(std::span<const vec3> points, std::span<const simplex<2>> triangles,
                  const std::function<bool(local_id, local_id)>& excluded,
                  const crossing_parameters& parameters, const triangle_blocks& blocks)
      : points_(points), triangles_(triangles), excluded_(excluded), parameters_(parameters),
        blocks_(blocks) {}

  /// Cells of blocks that together hold all pairs, at least `wanted` of them where there is so much to split,
  /// and not many times more.
  std::vector<cell> start(std::size_t wanted) const {
    const std::size_t most =
        std::max<std::size_t>(1000, triangles_.size() / wanted) / triangle_blocks::block_size;
    std::vector<cell> level{root()}, done;
    while (!level.empty()) {
      std::vector<cell> next;
      for (cell& whole : level) {
        const bool may_split = whole.items.size() > most && whole.depth < parameters_.depth_limit &&
                               done.size() + next.size() < 8 * wanted;
        if (!may_split || !split(whole, next))
          done.push_back(std::move(whole));
      }
      level.swap(next);
    }
    return done;
  }

  /// The cell with the triangles of its blocks instead of these.
  cell with_triangles(const cell& of_blocks) const {
    cell result{of_blocks.box, {}, of_blocks.depth};
    for (const local_id block : of_blocks.items)
      blocks_.for_each(static_cast<std::size_t>(block), [&](local_id t) {
        if (box(t).overlaps(of_blocks.box))
          result.items.push_back(t);
      });
    return result;
  }

  /// Appends the crossing pairs of a cell. One searcher for each thread.
  void search(cell&& whole, std::vector<triangle_pair>& found) {
    if (whole.items.size() < 2 || is_sheet_(whole.items))
      return;
    if (whole.items.size() <= parameters_.leaf_size || whole.depth >= parameters_.depth_limit) {
      test_pairs(whole, found);
      return;
    }
    auto parts = octants(whole, [&](local_id item) { return box(item); });
    if (!is_worth_it(whole, parts)) {
      test_pairs(whole, found);
      return;
    }
    whole.items = {};
    for (cell& part : parts)
      search(std::move(part), found);
  }

private:
  box3 box(local_id item) const { return box_of(points_, triangles_[item]); }

  cell root() const {
    cell whole;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      whole.box.include(blocks_.box(b).lower);
      whole.box.include(blocks_.box(b).upper);
    }
    for (int axis = 0; axis < 3; ++axis) // half open: nothing is on its upper side
      whole.box.upper[axis] = std::nextafter(whole.box.upper[axis], std::numeric_limits<double>::max());
    whole.items.resize(blocks_.size());
    std::iota(whole.items.begin(), whole.items.end(), local_id{0});
    return whole;
  }

  /// Appends the parts of a cell of blocks, unless most of these would be in most parts.
  bool split(const cell& whole, std::vector<cell>& parts) const {
    auto eight = octants(whole, [&](local_id block) { return blocks_.box(static_cast<std::size_t>(block)); });
    if (listed_in(eight) > 4 * whole.items.size())
      return false;
    for (cell& part : eight)
      if (!part.items.empty())
        parts.push_back(std::move(part));
    return true;
  }

  template <class BoxOf>
  static std::array<cell, 8> octants(const cell& whole, BoxOf&& box_of_item) {
    auto items = items_by_octant(whole.box, whole.items, [&](local_id item) {
      return [at = box_of_item(item)](const box3& part) { return at.overlaps(part); };
    });
    std::array<cell, 8> parts;
    for (unsigned k = 0; k < 8; ++k)
      parts[k] = {octant(whole.box, k), std::move(items[k]), whole.depth + 1};
    return parts;
  }

  static std::size_t listed_in(const std::array<cell, 8>& parts) {
    std::size_t listed = 0;
    for (const cell& part : parts)
      listed += part.items.size();
    return listed;
  }

  /// Long triangles are in many parts. Where splitting saves less than a quarter of the pairs they only are
  /// copied; so all cells together never take much longer than testing each pair of the whole once. Where
  /// hardly any is copied the triangles are together in one part, which is split in turn.
  static bool is_worth_it(const cell& whole, const std::array<cell, 8>& parts) {
    const auto pairs_of = [](const cell& c) { return static_cast<double>(c.items.size() * c.items.size()); };
    double pairs = 0;
    for (const cell& part : parts)
      pairs += pairs_of(part);
    return pairs <= 0.75 * pairs_of(whole) || listed_in(parts) <= whole.items.size() + whole.items.size() / 8;
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
    const simplex<2>& s = triangles_[i];
    const simplex<2>& t = triangles_[j];
    return !(excluded_ && excluded_(i, j)) && !separated_by_a_plane(points_, s, t) &&
           triangles_cross(points_, s, t);
  }

  std::span<const vec3> points_;
  std::span<const simplex<2>> triangles_;
  const std::function<bool(local_id, local_id)>& excluded_;
  crossing_parameters parameters_;
  const triangle_blocks& blocks_;
  single_sheet is_sheet_{points_, triangles_};
  std::vector<std::pair<box3, local_id>> boxes_; ///< of a cell's triangles
};

DOVETAIL_INLINE crossing_parts parts_of_search(std::span<const vec3> points,
                                               std::span<const simplex<2>> triangles,
                                               const std::function<bool(local_id, local_id)>& excluded,
                                               const crossing_parameters& parameters, int workers) {
  constexpr std::size_t triangles_per_task = 20'000; // a request to stop is seen after each
  const auto most_tasks = 8 * static_cast<std::size_t>(workers) + triangles.size() / triangles_per_task;
  const auto blocks = std::make_shared<const triangle_blocks>(points, triangles);
  const auto searcher = [=, &excluded] {
    return crossing_search(points, triangles, excluded, parameters, *blocks);
  };
  auto cells = searcher().start(most_tasks);
  const std::size_t tasks = std::min(cells.size(), most_tasks);
  return {tasks, [=, cells = std::move(cells)](std::size_t task) {
            auto search = searcher();
            std::vector<triangle_pair> found;
            for (std::size_t c = task; c < cells.size(); c += tasks)
              search.search(search.with_triangles(cells[c]), found);
            return found;
          }};
}

DOVETAIL_INLINE std::vector<triangle_pair>
joined_pairs(const std::vector<std::vector<triangle_pair>>& found) {
  std::vector<triangle_pair> pairs;
  for (const auto& some : found)
    append(pairs, some);
  sort_unique(pairs);
  return pairs;
}

} // namespace detail

} // namespace dovetail
