/// @file
/// When smaller triangles do not help a surface that is folded over.
#pragma once

#include <cstddef>

namespace dovetail {

/// Whether smaller triangles have made many more of so many folded ones, of which there were some: then the
/// surface is folded, and not its mesh. O(1), throws nothing.
/// \param before folded triangles, or crossing lines of regions, before
/// \param now the same, at smaller sizes
constexpr bool are_multiplied(std::size_t before, std::size_t now) {
  return before > 0 && now > 3 * before + 20;
}

} // namespace dovetail
