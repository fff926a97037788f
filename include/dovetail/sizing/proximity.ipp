/// @file
/// What `proximity.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/sizing/proximity.hpp"

#include <algorithm>

namespace dovetail::sizing {

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
