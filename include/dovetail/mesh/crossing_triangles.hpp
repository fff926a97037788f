/// @file
/// All crossing pairs in a set of triangles, by an octree (paper, section 3.6) and the exact test of
/// `triangle_intersection.hpp`, leaf by leaf through an executor.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/triangle_intersection.hpp"
#include "dovetail/parallel/concepts.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

namespace dovetail {

/// A pair of triangle indices, the smaller first.
using triangle_pair = std::pair<local_id, local_id>;

/// Parameters of the octree.
struct crossing_parameters {
  std::size_t leaf_size = 100; ///< no further subdivision at or below this many triangles (paper: 100)
  int depth_limit = 16;
};

namespace detail {

inline box3 box_of(std::span<const vec3> points, const simplex<2>& triangle) {
  box3 box;
  for (const local_id v : triangle)
    box.include(points[static_cast<std::size_t>(v)]);
  return box;
}

/// The leaves of an octree over boxes; an item is in every leaf that its box overlaps.
class octree_leaves {
public:
  octree_leaves(const std::vector<box3>& boxes, const crossing_parameters& parameters)
      : boxes_(boxes), parameters_(parameters) {
    box3 root;
    for (const box3& box : boxes)
      if (!box.empty()) {
        root.include(box.lower);
        root.include(box.upper);
      }
    std::vector<local_id> all(boxes.size());
    std::iota(all.begin(), all.end(), local_id{0});
    subdivide(root, std::move(all), 0);
  }

  const std::vector<std::vector<local_id>>& leaves() const { return leaves_; }

private:
  void subdivide(const box3& cell, std::vector<local_id> items, int depth) {
    if (items.size() <= parameters_.leaf_size || depth == parameters_.depth_limit) {
      if (items.size() > 1)
        leaves_.push_back(std::move(items));
      return;
    }
    std::array<std::vector<local_id>, 8> children;
    std::array<box3, 8> cells;
    std::size_t distributed = 0;
    for (unsigned child = 0; child < 8; ++child) {
      cells[child] = octant(cell, child);
      for (const local_id item : items)
        if (cells[child].overlaps(boxes_[static_cast<std::size_t>(item)]))
          children[child].push_back(item);
      distributed += children[child].size();
    }
    if (distributed >= 4 * items.size()) { // items as large as the cell: splitting only copies them
      leaves_.push_back(std::move(items));
      return;
    }
    items = {};
    for (unsigned child = 0; child < 8; ++child)
      subdivide(cells[child], std::move(children[child]), depth + 1);
  }

  static box3 octant(const box3& cell, unsigned child) {
    const vec3 middle = cell.center();
    box3 part = cell;
    for (int axis = 0; axis < 3; ++axis)
      ((child >> axis) & 1u ? part.lower : part.upper)[axis] = middle[axis];
    return part;
  }

  const std::vector<box3>& boxes_;
  crossing_parameters parameters_;
  std::vector<std::vector<local_id>> leaves_;
};

} // namespace detail

/// Crossing pairs among `triangles`, sorted, each once. A pair for which `excluded(i, j)` is true is not
/// tested. O(n log n) for triangles of bounded overlap; exact. Tasks of about equal size go through `run`.
template <executor Executor>
std::vector<triangle_pair>
crossing_triangles(std::span<const vec3> points, std::span<const simplex<2>> triangles,
                   const std::function<bool(local_id, local_id)>& excluded, const Executor& run,
                   const crossing_parameters& parameters = {}) {
  std::vector<box3> boxes(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    boxes[i] = detail::box_of(points, triangles[i]);
  const detail::octree_leaves octree(boxes, parameters);
  const auto& leaves = octree.leaves();

  const auto test_leaf = [&](const std::vector<local_id>& leaf, std::vector<triangle_pair>& found) {
    for (std::size_t a = 0; a < leaf.size(); ++a)
      for (std::size_t b = a + 1; b < leaf.size(); ++b) {
        const auto i = static_cast<std::size_t>(leaf[a]), j = static_cast<std::size_t>(leaf[b]);
        if (boxes[i].overlaps(boxes[j]) && !(excluded && excluded(leaf[a], leaf[b])) &&
            triangles_cross(points, triangles[i], triangles[j]))
          found.push_back({leaf[a], leaf[b]});
      }
  };

  const std::size_t tasks = std::min<std::size_t>(leaves.size(), 8 * static_cast<std::size_t>(run.workers()));
  const auto outcomes = run.run(
      tasks,
      [&](std::size_t task) {
        std::vector<triangle_pair> found;
        for (std::size_t leaf = task; leaf < leaves.size(); leaf += tasks)
          test_leaf(leaves[leaf], found);
        std::vector<local_id> flat;
        for (const auto& [i, j] : found) {
          flat.push_back(i);
          flat.push_back(j);
        }
        byte_writer out;
        out.array(flat);
        return out.take();
      },
      run_options{.stage = "intersection"});

  std::vector<triangle_pair> pairs;
  for (const task_outcome& outcome : outcomes) {
    if (!outcome.ok)
      throw error("intersection test failed: " + outcome.failure);
    const auto flat = byte_reader(outcome.result).template array<local_id>();
    for (std::size_t k = 0; k < flat.size(); k += 2)
      pairs.push_back({flat[k], flat[k + 1]});
  }
  sort_unique(pairs);
  return pairs;
}

} // namespace dovetail
