/// @file
/// What `proximity.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/sizing/proximity.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dovetail::sizing {

DOVETAIL_INLINE const surface_sample* facing_search::find(const surface_sample& from, std::size_t side,
                                                          double reach, double slack) const {
  const vec3 direction = side == 0 ? -from.normal : from.normal;
  query q{from, topology_.faces[from.face].solids[side], direction, reach, slack, nullptr};
  const auto height_of = [&](std::size_t id) { return dot(tree_.box(id).center() - from.point, direction); };
  tree_.search([&](std::size_t id) { return may_hold(tree_.box(id), q); },
               [&](local_id k) { consider(samples_[k], q); },
               [&](std::size_t a, std::size_t b) { return height_of(a) < height_of(b); });
  return q.best;
}

DOVETAIL_INLINE bool facing_search::may_hold(const box3& box, const query& q) {
  const vec3 center = box.center() - q.from.point;
  const vec3 half = 0.5 * (box.upper - box.lower);
  const double along = dot(center, q.direction);
  const double spread =
      std::abs(q.direction.x) * half.x + std::abs(q.direction.y) * half.y + std::abs(q.direction.z) * half.z;
  const double lowest = along - spread;
  const double highest = std::min(along + spread, q.height);
  if (highest <= 0 || lowest >= q.height)
    return false;
  const double off = norm(center - along * q.direction) - norm(half);
  return off <= std::max(aside * highest, q.slack);
}

DOVETAIL_INLINE void facing_search::consider(const surface_sample& s, query& q) const {
  const vec3 away = s.point - q.from.point;
  const double along = dot(away, q.direction);
  if (along <= 0 || along >= q.height || !ends_at(s, q))
    return;
  if (norm(away - along * q.direction) > std::max(aside * along, q.slack))
    return;
  q.height = along;
  q.best = &s;
}

DOVETAIL_INLINE bool facing_search::ends_at(const surface_sample& s, const query& q) const {
  const auto& solids = topology_.faces[s.face].solids;
  const double turned = dot(s.normal, q.direction);
  return (solids[0] == q.solid && turned >= turned_away) || (solids[1] == q.solid && turned <= -turned_away);
}

DOVETAIL_INLINE meeting_faces::meeting_faces(const geometry_topology& topology) {
  curves_.reserve(topology.faces.size());
  for (const auto& face : topology.faces) {
    auto& curves = curves_.emplace_back();
    for (const auto& coedge : face.coedges)
      curves.push_back(coedge.curve);
    sort_all(curves);
  }
}

DOVETAIL_INLINE bool meeting_faces::operator()(local_id a, local_id b) const {
  const auto& first = curves_[a];
  const auto& second = curves_[b];
  return a == b || std::any_of(first.begin(), first.end(), [&](local_id curve) {
           return std::binary_search(second.begin(), second.end(), curve);
         });
}

} // namespace dovetail::sizing
