/// @file
/// What `tabulated.hpp` declares.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/sizing/erased.hpp"
#include "dovetail/sizing/octree_values.hpp"
#include "dovetail/sizing/tabulated.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE tabulated_size::table::table(erased_sizing field, const box3& domain,
                                             const table_options& options)
    : octree_values(cube_of(domain)), field_(std::move(field)), domain_(domain) {
  sizing::checked_size(options.relative_error, "the error of precomputed sizes");
  fill(options);
  id_of_ = {};
  find_least_values();
}

DOVETAIL_INLINE double tabulated_size::table::smallest_in(const box3& box) const {
  double least = std::numeric_limits<double>::infinity();
  if (box.overlaps(domain_))
    least = least_in(box);
  if (!contains(domain_, box.lower) || !contains(domain_, box.upper))
    least = std::min(least, field_.smallest_size_in(box));
  return least;
}

DOVETAIL_INLINE void tabulated_size::table::fill(const table_options& options) {
  std::vector<std::size_t> level{tree_.leaf(0)};
  while (!level.empty()) {
    corners_.resize(tree_.leaf_count());
    for (const std::size_t leaf : level)
      for (std::uint32_t k = 0; k < 8; ++k)
        corners_[tree_.leaf_index(leaf)][k] = corner_at(tree_.corner_key(leaf, k));
    std::vector<std::size_t> next;
    for (const std::size_t leaf : level) {
      const box3 box = tree_.box(leaf);
      if (!box.overlaps(domain_))
        continue;
      const double exact = field_(box.center());
      const double error = std::abs(interpolated(leaf, box.center()) - exact) / exact;
      const bool is_fine = error <= options.relative_error &&
                           box.upper.x - box.lower.x <= width_per_size * field_.smallest_size_in(box);
      const std::size_t first = tree_.node_count();
      if (!is_fine && tree_.leaf_count() < options.largest_leaves)
        tree_.split(leaf);
      if (tree_.node_count() == first)
        error_ = std::max(error_, error);
      for (std::size_t child = first; child < tree_.node_count(); ++child)
        next.push_back(child);
    }
    level.swap(next);
  }
}

DOVETAIL_INLINE std::uint32_t tabulated_size::table::corner_at(const octree::key& at) {
  const std::uint64_t code = (std::uint64_t{at[0]} << 42U) | (std::uint64_t{at[1]} << 21U) | at[2];
  const auto [found, is_new] = id_of_.try_emplace(code, static_cast<std::uint32_t>(values_.size()));
  if (is_new)
    values_.push_back(field_(tree_.corner_point(at)));
  return found->second;
}

} // namespace dovetail
