/// @file
/// What `facing_search.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/sizing/facing_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace dovetail::sizing {

DOVETAIL_INLINE facing_search::ends::ends(const std::vector<surface_sample>& samples, std::vector<end> of_one)
    : list(std::move(of_one)),
      tree(boxes_of_points(list, [&](const end& e) { return samples[e.sample].point; }), leaf_size) {
  tree.put_in_order(list);
  outwards = tree.reduce<box3>([&](local_id k) { return box3{list[k].outwards, list[k].outwards}; }, united);
}

DOVETAIL_INLINE facing_search::facing_search(std::vector<surface_sample> samples,
                                             const geometry_topology& topology)
    : samples_(std::move(samples)), topology_(topology) {
  box_tree(boxes_of_points(samples_, [](const surface_sample& s) { return s.point; }), leaf_size)
      .put_in_order(samples_);
  std::vector<std::vector<end>> of_each(1 + topology.solids.size());
  for (std::size_t k = 0; k < samples_.size(); ++k) {
    const surface_sample& s = samples_[k];
    const auto& solids = topology.faces[s.face].solids;
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}})
      of_each[solids[side] + 1].push_back({static_cast<local_id>(k), side == 0 ? s.normal : -s.normal});
  }
  ends_.reserve(of_each.size());
  for (auto& of_one : of_each)
    ends_.emplace_back(samples_, std::move(of_one));
}

DOVETAIL_INLINE const surface_sample* facing_search::find(const surface_sample& from, std::size_t side,
                                                          double reach, double slack) const {
  const vec3 direction = side == 0 ? -from.normal : from.normal;
  const ends& around = ends_[topology_.faces[from.face].solids[side] + 1];
  query q{from.point, direction, reach, std::numeric_limits<double>::infinity(), slack, nullptr};
  const auto distance_of = [&](std::size_t id) { return distance_squared(around.tree.box(id), from.point); };
  around.tree.search(
      [&](std::size_t id) {
        return may_look_away(around.outwards[id], q) && may_hold(around.tree.box(id), q);
      },
      [&](local_id k) { consider(around.list[k], q); },
      [&](std::size_t a, std::size_t b) { return distance_of(a) < distance_of(b); });
  return q.best;
}

DOVETAIL_INLINE bool facing_search::may_be_better(double height, double offset, const query& q) {
  return height < level * q.height || (height * level < q.height && offset < q.offset);
}

DOVETAIL_INLINE bool facing_search::may_look_away(const box3& normals, const query& q) {
  double most = 0;
  for (int k = 0; k < 3; ++k)
    most += std::max(q.direction[k] * normals.lower[k], q.direction[k] * normals.upper[k]);
  return most >= turned_away;
}

DOVETAIL_INLINE bool facing_search::may_hold(const box3& box, const query& q) {
  const vec3 center = box.center() - q.point;
  const vec3 half = 0.5 * (box.upper - box.lower);
  const double along = dot(center, q.direction);
  const double spread =
      std::abs(q.direction.x) * half.x + std::abs(q.direction.y) * half.y + std::abs(q.direction.z) * half.z;
  const double lowest = along - spread;
  const double highest = std::min(along + spread, q.height);
  const double offset = norm(center - along * q.direction) - norm(half);
  return highest > 0 && offset <= std::max(aside * highest, q.slack) && may_be_better(lowest, offset, q);
}

DOVETAIL_INLINE void facing_search::consider(const end& e, query& q) const {
  if (dot(e.outwards, q.direction) < turned_away)
    return;
  const surface_sample& s = samples_[e.sample];
  const vec3 away = s.point - q.point;
  const double along = dot(away, q.direction);
  const double offset = norm(away - along * q.direction);
  if (along <= 0 || offset > std::max(aside * along, q.slack) || !may_be_better(along, offset, q))
    return;
  q.height = std::min(q.height, along);
  q.offset = offset;
  q.best = &s;
}

} // namespace dovetail::sizing
