/// @file
/// What `result_checks.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/mesher/result_checks.hpp"

#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

namespace dovetail::detail {

DOVETAIL_INLINE void check_points_kept(const std::vector<vec3>& given, const std::vector<vec3>& got) {
  if (got.size() < given.size())
    throw mesher_error(std::to_string(given.size() - got.size()) + " of the boundary's points are lost");
  static_assert(sizeof(vec3) == 3 * sizeof(double));
  for (std::size_t v = 0; v < given.size(); ++v)
    if (std::memcmp(&given[v], &got[v], sizeof(vec3)) != 0)
      throw mesher_error("boundary point " + std::to_string(v) + " was moved");
}

} // namespace dovetail::detail
