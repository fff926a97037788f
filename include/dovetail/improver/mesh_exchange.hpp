/// @file
/// From a mesh to the improver's data and back, with frozen entities.
#pragma once

#include "dovetail/improver/concepts.hpp"
#include "dovetail/improver/shape_measure.hpp"
#include "dovetail/improver/tet_complex.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::improvement {

namespace detail {

/// Fixes the sides that have nothing behind them or another tag, and the frozen ones.
inline void fix_sides(tet_complex& mesh, const frozen_entities<3>& frozen) {
  std::vector<std::array<local_id, 3>> keys(frozen.sides.size());
  std::transform(frozen.sides.begin(), frozen.sides.end(), keys.begin(), [](simplex<2> side) {
    std::sort(side.begin(), side.end());
    return side;
  });
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  std::vector<std::uint8_t> on_frozen_side(static_cast<std::size_t>(mesh.vertex_slots()), 0);
  for (const auto& key : keys)
    for (const local_id v : key)
      if (v >= 0 && v < mesh.vertex_slots())
        on_frozen_side[static_cast<std::size_t>(v)] = 1;
  const auto may_be_frozen = [&](const std::array<local_id, 3>& key) { // spares most sides the search
    return std::all_of(key.begin(), key.end(),
                       [&](local_id v) { return on_frozen_side[static_cast<std::size_t>(v)] != 0; });
  };
  std::vector<bool> found(keys.size(), false);
  for (local_id e = 0; e < mesh.element_slots(); ++e)
    for (int side = 0; side < 4; ++side) {
      const half_side other = mesh.across(e, side);
      bool is_fixed = other == no_id || mesh.tag(element_of(other)) != mesh.tag(e);
      if (const auto key = sorted_side(mesh.vertices(e), side); may_be_frozen(key)) {
        const auto at = std::lower_bound(keys.begin(), keys.end(), key);
        if (at != keys.end() && *at == key) {
          found[static_cast<std::size_t>(at - keys.begin())] = true;
          is_fixed = true;
        }
      }
      if (is_fixed)
        mesh.fix_side(e, side);
    }
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (!found[k])
      throw mesh_error("frozen side (" + std::to_string(keys[k][0]) + ", " + std::to_string(keys[k][1]) +
                       ", " + std::to_string(keys[k][2]) + ") is not a side of the mesh");
}

/// Fixes the vertices of fixed sides, and the caller's frozen points.
inline void fix_vertices(tet_complex& mesh, const frozen_entities<3>& frozen) {
  for (local_id e = 0; e < mesh.element_slots(); ++e)
    if (mesh.has_fixed_side(e))
      for (int side = 0; side < 4; ++side)
        if (mesh.is_fixed(e, side))
          for (const int corner : numbering::sides<3>[static_cast<std::size_t>(side)])
            mesh.set_kind(mesh.vertex(e, corner), vertex_kind::fixed);
  for (local_id v = 0; v < std::min(frozen.points, mesh.vertex_slots()); ++v)
    if (mesh.kind(v) != vertex_kind::unused)
      mesh.set_kind(v, vertex_kind::fixed);
  mesh.finish_kinds();
}

} // namespace detail

/// Takes the mesh's arrays over. Throws `mesh_error` when they are not a mesh or a frozen side is not in it;
/// the mesh is then left empty.
inline tet_complex take_mesh(simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen) {
  if (!mesh.tags.empty() && mesh.tags.size() != mesh.elements.size())
    throw mesh_error("the mesh has " + std::to_string(mesh.elements.size()) + " elements but " +
                     std::to_string(mesh.tags.size()) + " tags");
  tet_complex complex(std::move(mesh.points), std::move(mesh.elements), std::move(mesh.tags));
  detail::fix_sides(complex, frozen);
  detail::fix_vertices(complex, frozen);
  return complex;
}

/// Gives the arrays back without gaps: the order of the elements is kept; fixed points keep their numbers,
/// and gaps that removed points left are filled with the last free points.
inline void give_back(tet_complex& complex, simplicial_mesh<3>& mesh) {
  auto& elements = complex.elements();
  auto& tags = complex.tags();
  std::size_t kept = 0;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (elements[e][0] == no_id)
      continue;
    elements[kept] = elements[e];
    if (!tags.empty())
      tags[kept] = tags[e];
    ++kept;
  }
  elements.resize(kept);
  if (!tags.empty())
    tags.resize(kept);

  auto& points = complex.points();
  std::vector<local_id> renamed; // new number of each point; empty while nothing is renamed
  local_id end = complex.vertex_slots();
  for (local_id hole = 0; hole < end; ++hole) {
    if (!complex.is_gap(hole))
      continue;
    while (end > hole && complex.is_gap(end - 1))
      --end;
    if (end <= hole || !complex.is_free(end - 1))
      break;
    if (renamed.empty())
      renamed.assign(points.size(), no_id);
    --end;
    points[static_cast<std::size_t>(hole)] = points[static_cast<std::size_t>(end)];
    renamed[static_cast<std::size_t>(end)] = hole;
    complex.set_kind(hole, vertex_kind::free);
  }
  while (end > 0 && complex.is_gap(end - 1))
    --end;
  points.resize(static_cast<std::size_t>(end));
  if (!renamed.empty())
    for (auto& element : elements)
      for (auto& v : element)
        if (renamed[static_cast<std::size_t>(v)] != no_id)
          v = renamed[static_cast<std::size_t>(v)];
  mesh.points = std::move(points);
  mesh.elements = std::move(elements);
  mesh.tags = std::move(tags);
}

} // namespace dovetail::improvement
