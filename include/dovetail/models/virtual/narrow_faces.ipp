/// @file
/// What `narrow_faces.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/models/virtual/narrow_faces.hpp"
#include "dovetail/models/virtual/strip_collapse.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace dovetail::virtual_topology {

DOVETAIL_INLINE std::size_t collapse_narrow_ends(editable_topology& topology, const limits& allowed,
                                                 std::vector<suppressed_detail>& found) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < topology.face_count(); ++k) {
    const auto f = static_cast<local_id>(k);
    for (std::size_t i = 0; i < turns_of_face(topology, allowed, f).size(); ++i) {
      const turn_back turn = turns_of_face(topology, allowed, f)[i];
      editable_topology trial = topology;
      const auto narrow = narrow_end(trial, allowed, f, turn);
      if (!narrow)
        continue;
      const auto width = width_of(trial, allowed, *narrow);
      if (!width)
        continue;
      auto collapsed = detail::collapsed(trial, allowed, f, *narrow, *width);
      if (!collapsed)
        continue;
      found.push_back(
          {suppressed_detail::kind::narrow_end, f, trial.middle(narrow->sides[0].front().curve), *width});
      topology = std::move(*collapsed);
      ++count;
    }
  }
  return count;
}

namespace detail {

/// Makes curves of the narrow faces of which `is_wanted(face, strip, width)`.
template <class Wanted>
std::size_t collapse_strips(editable_topology& topology, const limits& allowed,
                            std::vector<suppressed_detail>& found, const Wanted& is_wanted) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < topology.face_count(); ++k) {
    const auto f = static_cast<local_id>(k);
    const auto narrow = strip_of_face(topology, allowed, f);
    if (!narrow)
      continue;
    const auto width = width_of(topology, allowed, *narrow);
    if (!width || !is_wanted(f, *narrow, *width) || topology.is_last_of_group(f))
      continue;
    auto made = collapsed(topology, allowed, f, *narrow, *width);
    if (!made)
      continue;
    found.push_back(
        {suppressed_detail::kind::narrow_face, f, topology.middle(narrow->sides[0].front().curve), *width});
    topology = std::move(*made);
    ++count;
  }
  return count;
}

/// Whether a face goes back along a strip, from one of the strip's curves on: within 10 degrees, and no
/// further from where that face's surface goes on than a tenth of the strip's width.
inline bool turns_back(const editable_topology& topology, local_id f, const side_curve& passed,
                       const side& opposite, double width) {
  constexpr double along_deg = 10, apart = 0.1;
  const any_geometry& model = topology.model();
  const auto passages = topology.passages_of(passed.curve);
  const auto goes_back_along = [&](const passage& own, const passage& other, double share) {
    const virtual_coedge &here = topology.at(own), &there = topology.at(other);
    const double there_share = here.reversed == there.reversed ? share : 1 - share;
    if (angle_between(topology.inward(f, here, share), topology.inward(other.face, there, there_share)) >
        along_deg / degrees_per_radian)
      return false;
    const auto& t = topology.curve(passed.curve).t;
    const double at = t[0] + (here.reversed ? 1 - share : share) * (t[1] - t[0]);
    const place_on_side across = nearest_on(topology, opposite, topology.point(passed.curve, at));
    const vec3 end = topology.point(opposite[across.curve].curve, across.t);
    const vec2 foot = model.project_to_face(other.face, end, topology.uv(there, at));
    return distance(model.face_point(other.face, foot), end) <= apart * width;
  };
  for (const passage& own : passages)
    for (const passage& other : passages)
      if (own.face == f && other.face != f) {
        int count = 0;
        for (const double share : {0.1, 0.5, 0.9})
          count += goes_back_along(own, other, share) ? 1 : 0;
        if (count == 3)
          return true;
      }
  return false;
}

/// Whether faces behind both sides of a strip go back along it, along most of each side: a step drawn twice.
/// Of a rib or a groove only one does, and of teeth they go on far from each other.
inline bool is_fold(const editable_topology& topology, local_id f, const strip& narrow, double width) {
  constexpr double most = 0.9; // of its length
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    double length = 0, turned = 0;
    for (const side_curve& passed : narrow.sides[k]) {
      const double own = topology.length(passed.curve);
      length += own;
      turned += turns_back(topology, f, passed, narrow.sides[1 - k], width) ? own : 0;
    }
    if (turned < most * length)
      return false;
  }
  return true;
}

} // namespace detail

DOVETAIL_INLINE std::size_t collapse_narrow_faces(editable_topology& topology, const limits& allowed,
                                                  std::vector<suppressed_detail>& found) {
  return detail::collapse_strips(topology, allowed, found,
                                 [](local_id, const strip&, double) { return true; });
}

DOVETAIL_INLINE std::size_t collapse_folded_faces(editable_topology& topology, const limits& allowed,
                                                  std::vector<suppressed_detail>& found) {
  return detail::collapse_strips(topology, allowed, found,
                                 [&](local_id f, const strip& narrow, double width) {
                                   return detail::is_fold(topology, f, narrow, width);
                                 });
}

} // namespace dovetail::virtual_topology
