/// @file
/// What `line_skeleton.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/skeleton/line_skeleton.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace dovetail {

namespace detail {

/// Appends the edges of a line in the direction of the coarse edge from -> to.
inline void append_line_edges(const numbered_lines& lines, local_id line, local_id from,
                              std::array<local_id, 2> parts, simplicial_skeleton<2>& skeleton) {
  const auto l = static_cast<std::size_t>(line);
  const skeleton_line& key = lines.keys[l];
  const auto numbers = lines.along(line, from);
  for (std::size_t i = 0; i + 1 < numbers.size(); ++i) {
    skeleton.sides.own().push_back({numbers[i], numbers[i + 1]});
    skeleton.subdomains.own().push_back(parts);
    skeleton.side_hosts.own().push_back(key.on.dimension == 1 ? key.on.id : no_id);
  }
}

} // namespace detail

DOVETAIL_INLINE simplicial_skeleton<2> skeleton_of_lines(const surface_mesh& surface,
                                                         const side_table<2>& sides,
                                                         const std::vector<local_id>& subdomain_of_triangle,
                                                         const numbered_lines& lines) {
  simplicial_skeleton<2> skeleton;
  skeleton.points = lines.points;
  skeleton.point_hosts = lines.hosts;
  const auto part = [&](local_id triangle) { return subdomain_of_triangle[triangle]; };
  for (std::size_t l = 0; l < lines.keys.size(); ++l) {
    const auto line = static_cast<local_id>(l);
    const local_id side = find_side<2>(sides, lines.keys[l].vertices);
    const auto at_side = sides.all_elements(side);
    const auto passage = [&](std::size_t k) {
      return side_of_element(surface.mesh, sides, side, at_side[k]);
    };
    if (at_side.size() == 2 && passage(0) != passage(1)) {
      const bool swap = part(at_side[1]) < part(at_side[0]);
      detail::append_line_edges(lines, line, passage(swap ? 1 : 0)[0],
                                {part(at_side[swap ? 1 : 0]), part(at_side[swap ? 0 : 1])}, skeleton);
      continue;
    }
    for (std::size_t k = 0; k < at_side.size(); ++k)
      detail::append_line_edges(lines, line, passage(k)[0], {part(at_side[k]), no_id}, skeleton);
  }
  return skeleton;
}

DOVETAIL_INLINE chord_rule::chord_rule(const coarse_skeleton& skeleton, const simplicial_skeleton<2>& fine,
                                       const numbered_lines& lines, const surface_mesh& surface)
    : edges_(fine.sides.begin(), fine.sides.end()), regions_at_(fine.points.size()) {
  for (simplex<1>& edge : edges_)
    edge = sorted_vertices(edge);
  sort_unique(edges_);
  for (std::size_t r = 0; r < skeleton.regions.size(); ++r)
    for (const local_id t : skeleton.regions[r].triangles)
      add_region(static_cast<local_id>(r), surface.mesh.elements[t], lines);
  for (auto& regions : regions_at_) {
    sort_unique(regions);
  }
}

DOVETAIL_INLINE bool chord_rule::comes_before(local_id region, local_id other) const {
  const bool is_flat = plane_of_[region] != no_id;
  return is_flat == (plane_of_[other] != no_id) ? region < other : is_flat;
}

DOVETAIL_INLINE local_id chord_rule::told_apart_by(local_id region, local_id other) const {
  const auto regions = static_cast<local_id>(plane_of_.size());
  return plane_of_[region] == no_id && plane_of_[other] != no_id ? regions + plane_of_[other] : other;
}

DOVETAIL_INLINE bool chord_rule::forbids(local_id region, local_id a, local_id b) const {
  const auto& at_a = regions_at_[a];
  const auto& at_b = regions_at_[b];
  const auto is_at_b = [&](local_id r) {
    return std::any_of(at_b.begin(), at_b.end(), [&](local_id other) {
      return told_apart_by(region, other) == told_apart_by(region, r);
    });
  };
  const bool an_earlier_region = std::any_of(
      at_a.begin(), at_a.end(), [&](local_id r) { return comes_before(r, region) && is_at_b(r); });
  return an_earlier_region ||
         std::binary_search(edges_.begin(), edges_.end(), sorted_vertices(simplex<1>{a, b}));
}

DOVETAIL_INLINE std::vector<std::int64_t> chord_rule::facts(std::span<const local_id> regions,
                                                            std::span<const local_id> points) const {
  std::vector<std::int64_t> facts;
  for (const local_id region : regions) {
    const auto earlier = earlier_regions(region, points);
    facts.push_back(static_cast<std::int64_t>(earlier.size()));
    append(facts, earlier);
  }
  for (std::size_t i = 0; i < points.size(); ++i) // edges of lines, by their places in `points`
    for (auto edge = std::lower_bound(edges_.begin(), edges_.end(), simplex<1>{points[i], 0});
         edge != edges_.end() && (*edge)[0] == points[i]; ++edge)
      if (const auto at = std::lower_bound(points.begin(), points.end(), (*edge)[1]);
          at != points.end() && *at == (*edge)[1])
        append(facts, std::array{static_cast<std::int64_t>(i), at - points.begin()});
  return facts;
}

DOVETAIL_INLINE std::vector<std::int64_t>
chord_rule::earlier_regions(local_id region, std::span<const local_id> points) const {
  std::map<local_id, std::size_t> met;
  for (const local_id point : points)
    for (const local_id r : regions_at_[point])
      ++met[told_apart_by(region, r)];
  std::map<local_id, std::int64_t> number;
  std::vector<std::int64_t> listed;
  for (const local_id point : points) {
    const std::size_t at = listed.size();
    listed.push_back(0);
    for (const local_id r : regions_at_[point])
      if (const local_id name = told_apart_by(region, r); comes_before(r, region) && met[name] > 1) {
        listed.push_back(number.try_emplace(name, static_cast<std::int64_t>(number.size())).first->second);
        ++listed[at];
      }
  }
  return listed;
}

DOVETAIL_INLINE void chord_rule::add_region(local_id region, const simplex<2>& triangle,
                                            const numbered_lines& lines) {
  for (std::size_t i = 0; i < 3; ++i) {
    const local_id line = find_line(lines.keys, triangle[i], triangle[(i + 1) % 3]);
    if (line != no_id && lines.keys[line].on.dimension == 1)
      for (const local_id v : lines.along(line, triangle[i]))
        regions_at_[v].push_back(region);
    if (const local_id v = lines.number_of(triangle[i]); v != no_id && lines.hosts[v].dimension < 2)
      regions_at_[v].push_back(region);
  }
}

DOVETAIL_INLINE std::vector<std::vector<local_id>> regions_of_subdomains(const coarse_skeleton& skeleton,
                                                                         std::size_t subdomains) {
  std::vector<std::vector<local_id>> regions(subdomains);
  for (std::size_t r = 0; r < skeleton.regions.size(); ++r)
    regions[skeleton.regions[r].subdomains[0]].push_back(static_cast<local_id>(r));
  return regions;
}

} // namespace dovetail
