/// @file
/// What `fine_lines.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/skeleton/fine_lines.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE std::vector<local_id> numbered_lines::along(local_id line, local_id from) const {
  const auto l = static_cast<std::size_t>(line);
  const std::size_t inner = lines[l].points.size();
  std::vector<local_id> numbers(inner + 2);
  numbers.front() = number_of(keys[l].vertices[0]);
  std::iota(numbers.begin() + 1, numbers.end() - 1, first_point[l]);
  numbers.back() = number_of(keys[l].vertices[1]);
  if (from != keys[l].vertices[0])
    std::reverse(numbers.begin(), numbers.end());
  return numbers;
}

DOVETAIL_INLINE numbered_lines number_lines(const coarse_skeleton& skeleton, remeshed_lines made,
                                            std::span<const vec3> coarse_points,
                                            std::span<const host> coarse_hosts, numbered_lines before) {
  numbered_lines result = std::move(before);
  result.first_point.clear();
  result.points.clear();
  result.hosts.clear();
  result.keys = skeleton.lines;
  result.number_of_coarse_point.assign(coarse_points.size(), no_id);
  const auto use = [&](local_id v) { result.number_of_coarse_point[v] = 0; };
  for (const skeleton_line& line : skeleton.lines)
    std::for_each(line.vertices.begin(), line.vertices.end(), use);
  for (const skeleton_region& region : skeleton.regions)
    std::for_each(region.fixed_points.begin(), region.fixed_points.end(), use);
  std::size_t points = static_cast<std::size_t>(
      std::count(result.number_of_coarse_point.begin(), result.number_of_coarse_point.end(), 0));
  for (const fine_line& line : made.lines)
    points += line.points.size();
  result.points.reserve(points);
  result.hosts.reserve(points);
  result.first_point.reserve(made.lines.size());
  for (std::size_t v = 0; v < coarse_points.size(); ++v)
    if (result.number_of_coarse_point[v] != no_id) {
      result.number_of_coarse_point[v] = static_cast<local_id>(result.points.size());
      result.points.push_back(coarse_points[v]);
      result.hosts.push_back(v < coarse_hosts.size() ? coarse_hosts[v] : host{});
    }
  for (std::size_t l = 0; l < made.lines.size(); ++l) {
    result.first_point.push_back(static_cast<local_id>(result.points.size()));
    append(result.points, made.lines[l].points);
    result.hosts.resize(result.points.size(), skeleton.lines[l].on);
  }
  result.lines = std::move(made.lines);
  result.names = std::move(made.names);
  return result;
}

} // namespace dovetail
