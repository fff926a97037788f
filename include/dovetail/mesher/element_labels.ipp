/// @file
/// What `element_labels.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesher/boundary_sides.hpp"
#include "dovetail/mesher/element_labels.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace dovetail::detail {

inline constexpr local_id unlabelled = -2;

/// Labels of the elements that touch the boundary; `unlabelled` elsewhere.
inline std::vector<local_id> seed_labels(const simplicial_mesh<3>& mesh, const boundary_sides& boundary,
                                         std::span<const local_id> labels) {
  std::vector<local_id> label_of(mesh.elements.size(), unlabelled);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (const auto& local : numbering::sides<3>) {
      const auto found = boundary.find(pick(mesh.elements[e], local));
      if (!found)
        continue;
      const local_id triangle = boundary.listed(found);
      const local_id label = triangle == no_id ? no_id : labels.empty() ? 0 : labels[triangle];
      if (label_of[e] != unlabelled && label_of[e] != label)
        throw mesher_error("element " + std::to_string(e) + " lies on sides " + std::to_string(label_of[e]) +
                           " and " + std::to_string(label) +
                           " of the boundary at once; check the orientation of the boundary");
      label_of[e] = label;
    }
  return label_of;
}

/// Spreads labels across sides that are not part of the boundary.
inline void spread_labels(const simplicial_mesh<3>& mesh, const boundary_sides& boundary,
                          std::vector<local_id>& label_of) {
  const auto neighbours = element_neighbours<3>(build_sides(mesh));
  std::vector<std::size_t> front;
  for (std::size_t e = 0; e < label_of.size(); ++e)
    if (label_of[e] != unlabelled)
      front.push_back(e);
  while (!front.empty()) {
    const std::size_t e = front.back();
    front.pop_back();
    for (std::size_t i = 0; i < 4; ++i) {
      const local_id next = neighbours[e][i];
      if (next == no_id || boundary.find(pick(mesh.elements[e], numbering::sides<3>[i])))
        continue;
      local_id& label = label_of[next];
      if (label == unlabelled) {
        label = label_of[e];
        front.push_back(static_cast<std::size_t>(next));
      } else if (label != label_of[e]) {
        throw mesher_error("the boundary does not separate side " + std::to_string(label) + " from side " +
                           std::to_string(label_of[e]) + "; check that it is closed");
      }
    }
  }
}

} // namespace dovetail::detail

namespace dovetail {

DOVETAIL_INLINE std::vector<local_id> label_elements(const simplicial_mesh<3>& mesh,
                                                     std::span<const simplex<2>> triangles,
                                                     std::span<const local_id> labels) {
  const boundary_sides boundary(triangles);
  std::vector<local_id> label_of = detail::seed_labels(mesh, boundary, labels);
  // When only one label occurs there is nothing to separate, and the adjacency need not be built.
  local_id only = detail::unlabelled;
  bool several = false;
  for (const local_id label : label_of)
    if (label != detail::unlabelled) {
      several = several || (only != detail::unlabelled && only != label);
      only = label;
    }
  if (several)
    detail::spread_labels(mesh, boundary, label_of);
  for (std::size_t e = 0; e < label_of.size(); ++e)
    if (label_of[e] == detail::unlabelled) {
      if (several || only == detail::unlabelled)
        throw mesher_error("element " + std::to_string(e) + " is not connected to the boundary");
      label_of[e] = only;
    }
  return label_of;
}

DOVETAIL_INLINE void drop_outside(simplicial_mesh<3>& mesh, std::span<const local_id> labels,
                                  std::size_t kept_points) {
  std::size_t kept = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (labels[e] != no_id) {
      mesh.elements[kept] = mesh.elements[e];
      if (!mesh.tags.empty())
        mesh.tags[kept] = mesh.tags[e];
      ++kept;
    }
  if (kept == mesh.elements.size())
    return;
  mesh.elements.resize(kept);
  if (!mesh.tags.empty())
    mesh.tags.resize(kept);

  std::vector<local_id> renumbered(mesh.points.size(), no_id);
  for (const auto& element : mesh.elements)
    for (const local_id v : element)
      renumbered[v] = 0;
  std::size_t next = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (v < kept_points || renumbered[v] != no_id) {
      mesh.points[next] = mesh.points[v];
      renumbered[v] = static_cast<local_id>(next++);
    }
  mesh.points.resize(next);
  for (auto& element : mesh.elements)
    for (local_id& v : element)
      v = renumbered[v];
}

} // namespace dovetail
