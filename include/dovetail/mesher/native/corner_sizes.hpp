/// @file
/// The sizes at the corners of an octree's nodes, each asked of the field once.
#pragma once

#include "dovetail/core/octree.hpp"
#include "dovetail/core/scattered.hpp"
#include "dovetail/sizing/checked_size.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dovetail::detail {

/// A table from corners to sizes, with open addressing: corners are shared by up to eight leaves and by
/// nodes of several levels, and a field may be costly. Amortised constant time. Not thread-safe; one belongs
/// to one call.
class corner_sizes {
public:
  /// A field need not be defined outside `domain`: the size at a corner is that at the nearest place in it.
  corner_sizes(const octree& tree, const box3& domain, const any_sizing& size)
      : tree_(tree), domain_(domain), size_(size), slots_(64) {}

  /// The number of a corner, from 0 in the order of first use. Throws `sizing_error` when the size there is
  /// not positive and finite.
  std::uint32_t number_of(const octree::key& corner) {
    if (2 * (sizes_.size() + 1) > slots_.size())
      grow();
    slot& found = place_of(packed(corner));
    if (found.key == 0) {
      sizes_.push_back(checked_size(size_, in_domain(tree_.corner_point(corner))));
      found = {packed(corner), static_cast<std::uint32_t>(sizes_.size() - 1)};
    }
    return found.number;
  }
  double operator[](std::uint32_t number) const { return sizes_[number]; }
  /// Makes a size smaller if it is not; true when it was larger.
  bool lower(std::uint32_t number, double bound) {
    if (!(bound < sizes_[number]))
      return false;
    sizes_[number] = bound;
    return true;
  }

private:
  struct slot {
    std::uint64_t key = 0; ///< 0: free
    std::uint32_t number = 0;
  };

  /// Never 0: coordinates are at most 2^largest_depth, so 21 bits each.
  static std::uint64_t packed(const octree::key& corner) {
    static_assert(octree::largest_depth < 21);
    return (std::uint64_t{1} << 63) | (std::uint64_t{corner[0]} << 42) | (std::uint64_t{corner[1]} << 21) |
           corner[2];
  }
  vec3 in_domain(vec3 p) const {
    for (int k = 0; k < 3; ++k)
      p[k] = std::clamp(p[k], domain_.lower[k], domain_.upper[k]);
    return p;
  }
  slot& place_of(std::uint64_t key) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = static_cast<std::size_t>(scattered(key)) & mask;
    while (slots_[at].key != 0 && slots_[at].key != key)
      at = (at + 1) & mask;
    return slots_[at];
  }
  void grow() {
    std::vector<slot> before(2 * slots_.size());
    before.swap(slots_);
    for (const slot& one : before)
      if (one.key != 0)
        place_of(one.key) = one;
  }

  const octree& tree_;
  box3 domain_;
  const any_sizing& size_;
  std::vector<slot> slots_;
  std::vector<double> sizes_;
};

} // namespace dovetail::detail
