/// @file
/// What `crossings.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/geometry/coplanar.hpp"
#include "dovetail/intersection/suppression.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/pipeline/crossings.hpp"
#include "dovetail/skeleton/patches.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <vector>

namespace dovetail::detail {

DOVETAIL_INLINE bool lies_in_one_plane(const any_geometry& model) {
  std::optional<surface_frame> first;
  for (std::size_t f = 0; f < model.topology().faces.size(); ++f) {
    const auto plane = model.plane_of_face(static_cast<local_id>(f));
    if (!plane)
      return false;
    if (!first)
      first = plane;
    constexpr double of_one_plane = 1e-9; // then nothing at all is tested for crossings
    if (!are_coplanar(*first, *plane, model.bounds().diagonal(), of_one_plane))
      return false;
  }
  return true;
}

DOVETAIL_INLINE simplicial_mesh<2> joined_pieces(const simplicial_skeleton<2>& skeleton,
                                                 const meshed_pieces<2>& meshed) {
  std::size_t points = skeleton.points.size(), elements = 0;
  for (const piece_summary& piece : meshed.pieces) {
    points += static_cast<std::size_t>(piece.counts.inner_points);
    elements += static_cast<std::size_t>(piece.counts.elements);
  }
  simplicial_mesh<2> whole;
  whole.points.reserve(points);
  whole.elements.reserve(elements);
  whole.tags.reserve(elements);
  append(whole.points, skeleton.points);
  for (std::size_t s = 0; s < meshed.pieces.size(); ++s)
    append_piece(whole, meshed.load(static_cast<local_id>(s)));
  return whole;
}

DOVETAIL_INLINE suppression_plan plan_for_failed_patches(const coarse_skeleton& coarse,
                                                         const std::vector<patch_failure>& failures) {
  suppression_plan plan;
  std::set<std::array<local_id, 2>> pairs;
  const auto faces_at = faces_of_lines(lines_of_faces(coarse), coarse.lines.size());
  for (const patch_failure& failure : failures) {
    if (!failure.folded.empty() && failure.region != no_id) {
      const local_id face = coarse.regions[failure.region].cad_face;
      for (const auto& [a, b, c] : failure.folded)
        plan.surface_crossings.push_back(
            {{face, face}, (a + b + c) / 3.0, (distance(a, b) + distance(b, c) + distance(c, a)) / 3});
      plan.folds = failure.reason;
      continue;
    }
    bool can_go = failure.face != no_id;
    if (can_go)
      pairs.insert(coarse.faces[failure.face].subdomains);
    for (const local_id line : failure.removable_lines) {
      for (const local_id face : faces_at[line])
        pairs.insert(coarse.faces[face].subdomains);
      can_go = can_go || !faces_at[line].empty();
    }
    for (const size_ball& edge : failure.edges)
      plan.interface_crossings.push_back({{no_id, no_id}, edge.center, edge.size});
    const bool is_first_to_go = can_go && plan.lines_at_fault.empty() && !failure.edges.empty();
    const bool is_first_to_stay = !can_go && plan.merges_suffice; // told before one that can go
    if (is_first_to_go || is_first_to_stay)
      plan.lines_at_fault = failure.reason;
    plan.merges_suffice = plan.merges_suffice && can_go;
  }
  plan.merges.assign(pairs.begin(), pairs.end());
  return plan;
}

} // namespace dovetail::detail
