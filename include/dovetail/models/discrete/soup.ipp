/// @file
/// What `soup.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/models/discrete/soup.hpp"

#include <cmath>
#include <cstddef>
#include <string>

namespace dovetail {

DOVETAIL_INLINE void check_soup(const triangle_soup& soup, const std::string& name) {
  if (!soup.groups.empty() && soup.groups.size() != soup.triangles.size())
    throw geometry_error(name + ": there are " + std::to_string(soup.groups.size()) + " groups or ids for " +
                         std::to_string(soup.triangles.size()) +
                         " triangles; give one per triangle, or none");
  for (std::size_t i = 0; i < soup.points.size(); ++i)
    if (const vec3 p = soup.points[i]; !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw geometry_error(name + ": point " + std::to_string(i) + " is not finite");
  const auto is_index = [](local_id i, std::size_t size) {
    return i >= 0 && static_cast<std::size_t>(i) < size;
  };
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (const local_id v : soup.triangles[t])
      if (!is_index(v, soup.points.size()))
        throw geometry_error(name + ": triangle " + std::to_string(t) + " refers to point " +
                             std::to_string(v) + ", but there are " + std::to_string(soup.points.size()) +
                             " points");
  if (!soup.group_names.empty())
    for (std::size_t t = 0; t < soup.groups.size(); ++t)
      if (soup.groups[t] != no_id && !is_index(soup.groups[t], soup.group_names.size()))
        throw geometry_error(name + ": triangle " + std::to_string(t) + " refers to group " +
                             std::to_string(soup.groups[t]) + ", but there are " +
                             std::to_string(soup.group_names.size()) + " names of groups");
}

} // namespace dovetail
