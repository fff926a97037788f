/// @file
/// What `tiny_faces.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/models/virtual/strip.hpp"
#include "dovetail/models/virtual/tiny_faces.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace dovetail::virtual_topology {

namespace detail {

/// The edges of a face that is one loop of short edges, each of them passed once; none of another face.
inline std::vector<local_id> edges_of_tiny_face(const editable_topology& topology, const limits& allowed,
                                                local_id f) {
  std::vector<local_id> edges;
  if (topology.loops(f).size() != 1)
    return edges;
  for (const virtual_coedge& coedge : topology.loops(f)[0]) {
    if (topology.curve(coedge.curve).degenerate || !is_short(topology, allowed, coedge.curve) ||
        std::find(edges.begin(), edges.end(), coedge.curve) != edges.end())
      return {};
    edges.push_back(coedge.curve);
  }
  return edges;
}

/// Whether each other face at the edges may lose them. Narrow ones that go the same way, as along a bar whose
/// end the face is, would meet in a needle's point.
inline bool faces_around_allow(const editable_topology& topology, const limits& allowed, local_id f,
                               const std::vector<local_id>& edges) {
  constexpr double middle = 0.5; // of an edge
  std::vector<vec3> along;       // narrow faces
  for (const local_id c : edges)
    for (const passage& p : topology.passages_of(c)) {
      if (p.face == f || can_be_dropped(topology, allowed, p))
        continue;
      if (!has_narrow_end_at(topology, allowed, p.face, c))
        return false;
      along.push_back(topology.inward(p.face, topology.at(p), middle));
    }
  for (std::size_t i = 0; i < along.size(); ++i)
    for (std::size_t j = i + 1; j < along.size(); ++j)
      if (degrees_per_radian * angle_between(along[i], along[j]) < allowed.least_angle_deg)
        return false;
  return true;
}

} // namespace detail

DOVETAIL_INLINE std::size_t collapse_tiny_faces(editable_topology& topology, const limits& allowed,
                                                std::vector<suppressed_detail>& found) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < topology.face_count(); ++k) {
    const auto f = static_cast<local_id>(k);
    const auto edges = detail::edges_of_tiny_face(topology, allowed, f);
    if (edges.size() < 2 || topology.is_last_of_group(f) ||
        !detail::faces_around_allow(topology, allowed, f, edges))
      continue;
    const local_id kept = topology.curve(edges.front()).vertices[0];
    const vec3 place = topology.vertex(kept).point;
    editable_topology trial = topology;
    trial.remove_face(f);
    double longest = 0;
    for (const local_id c : edges) {
      longest = std::max(longest, topology.length(c));
      trial.drop_all(c, kept);
    }
    if (trial.deviation_of_vertex(kept) > furthest_vertex * allowed.length(place) ||
        !trial.has_closed_loops() || !trial.has_long_curves() || !keeps_faces(topology, trial, allowed))
      continue;
    found.push_back({suppressed_detail::kind::narrow_face, f, place, longest});
    topology = std::move(trial);
    ++count;
  }
  return count;
}

} // namespace dovetail::virtual_topology
