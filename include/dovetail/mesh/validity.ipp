/// @file
/// What `validity.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/predicates.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/validity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE std::string_view name_of(mesh_fault kind) {
  constexpr std::array<std::string_view, 12> names{"missing point",   "tags mismatch",     "non-finite point",
                                                   "repeated vertex", "duplicate element", "inverted element",
                                                   "flat element",    "non-manifold side", "misoriented side",
                                                   "open boundary",   "coincident point",  "isolated point"};
  return names[static_cast<std::size_t>(kind)];
}

DOVETAIL_INLINE std::int64_t validity::count(mesh_fault kind) const {
  for (const fault_count& fault : faults)
    if (fault.kind == kind)
      return fault.count;
  return 0;
}

DOVETAIL_INLINE std::string validity::text() const {
  std::string line;
  for (const fault_count& fault : faults) {
    line +=
        (line.empty() ? "" : "; ") + std::to_string(fault.count) + " x " + std::string(name_of(fault.kind));
    for (std::size_t k = 0; k < fault.examples.size(); ++k)
      line += (k == 0 ? " (" : ", ") + std::to_string(fault.examples[k]);
    if (!fault.examples.empty())
      line += static_cast<std::size_t>(fault.count) > fault.examples.size() ? ", ...)" : ")";
  }
  return line;
}

namespace detail {

DOVETAIL_INLINE validity fault_collector::result() const {
  validity found;
  for (const fault_count& fault : counts_)
    if (fault.count > 0)
      found.faults.push_back(fault);
  return found;
}

template <int D>
void check_references(const simplicial_mesh<D>& mesh, fault_collector& faults) {
  const auto count = static_cast<local_id>(mesh.points.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (std::any_of(mesh.elements[e].begin(), mesh.elements[e].end(),
                    [&](local_id v) { return v < 0 || v >= count; }))
      faults.add(mesh_fault::missing_point, static_cast<local_id>(e));
  if (!mesh.tags.empty() && mesh.tags.size() != mesh.elements.size())
    faults.add(mesh_fault::tags_mismatch);
}

/// The points at a place where one of a lower number is, growing.
DOVETAIL_INLINE std::vector<local_id> repeated_points(std::span<const vec3> points) {
  // By x first, without looking at the points; few have the same.
  std::vector<std::pair<double, local_id>> order(points.size());
  for (std::size_t v = 0; v < points.size(); ++v)
    order[v] = {points[v].x, static_cast<local_id>(v)};
  sort_all(order);
  const auto rest_of = [&](const auto& one) {
    const vec3& p = points[one.second];
    return std::pair(p.y, p.z);
  };
  std::vector<local_id> repeated;
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    while (last < order.size() && order[last].first == order[first].first)
      ++last;
    const auto same_x = std::span(order).subspan(first, last - first);
    if (same_x.size() > 1)
      std::stable_sort(same_x.begin(), same_x.end(),
                       [&](const auto& a, const auto& b) { return rest_of(a) < rest_of(b); });
    for (std::size_t k = 1; k < same_x.size(); ++k)
      if (rest_of(same_x[k]) == rest_of(same_x[k - 1]))
        repeated.push_back(same_x[k].second);
  }
  sort_all(repeated);
  return repeated;
}

template <int D>
void check_points(const simplicial_mesh<D>& mesh, const validity_options& allowed, fault_collector& faults) {
  const auto& points = mesh.points;
  std::vector<bool> used(points.size(), false);
  for (const auto& element : mesh.elements)
    for (const local_id v : element)
      used[v] = true;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!std::isfinite(points[v].x) || !std::isfinite(points[v].y) || !std::isfinite(points[v].z))
      faults.add(mesh_fault::non_finite_point, static_cast<local_id>(v));
    if (!used[v] && !allowed.isolated_points)
      faults.add(mesh_fault::isolated_point, static_cast<local_id>(v));
  }
  if (faults.has(mesh_fault::non_finite_point))
    return;
  for (const local_id v : repeated_points(points))
    faults.add(mesh_fault::coincident_point, v);
}

template <int D>
void check_elements(const simplicial_mesh<D>& mesh, fault_collector& faults) {
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto id = static_cast<local_id>(e);
    const auto key = sorted_vertices(mesh.elements[e]);
    if (std::adjacent_find(key.begin(), key.end()) != key.end()) {
      faults.add(mesh_fault::repeated_vertex, id);
      continue;
    }
    const auto at = [&](std::size_t k) { return mesh.points[mesh.elements[e][k]]; };
    if constexpr (D == 3) {
      const double sign = orient3d(at(0), at(1), at(2), at(3));
      if (sign < 0)
        faults.add(mesh_fault::inverted_element, id);
      else if (sign == 0)
        faults.add(mesh_fault::flat_element, id);
    } else if (collinear(at(0), at(1), at(2))) {
      faults.add(mesh_fault::flat_element, id);
    }
  }
}

template <int D>
void check_duplicates(const simplicial_mesh<D>& mesh, fault_collector& faults) {
  std::vector<local_id> repeated;
  for_each_group<static_cast<std::size_t>(D + 1)>(
      mesh.elements.size(), mesh.points.size(),
      [&](std::size_t e) { return sorted_vertices(mesh.elements[e]); },
      [&](const auto&, std::span<const std::uint32_t> members) {
        for (std::size_t k = 1; k < members.size(); ++k)
          repeated.push_back(static_cast<local_id>(members[k]));
      });
  sort_all(repeated);
  for (const local_id e : repeated)
    faults.add(mesh_fault::duplicate_element, e);
}

DOVETAIL_INLINE void check_closed(const simplicial_mesh<3>& mesh, const side_table<3>& sides,
                                  fault_collector& faults) {
  std::vector<std::array<local_id, 2>> edges;
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (sides.is_boundary(static_cast<local_id>(s)))
      for (const auto& local : numbering::sides<2>)
        edges.push_back(sorted_vertices(pick(sides.vertices[s], local)));
  local_id edge = 0;
  for_each_group<2>(
      edges.size(), mesh.points.size(), [&](std::size_t k) { return edges[k]; },
      [&](const auto&, std::span<const std::uint32_t> members) {
        if (members.size() % 2 == 1)
          faults.add(mesh_fault::open_boundary, edge);
        ++edge;
      });
}

template <int D>
void check_each(const simplicial_mesh<D>& mesh, const validity_options& allowed, fault_collector& faults) {
  check_references(mesh, faults);
  if (faults.has(mesh_fault::missing_point))
    return;
  check_points(mesh, allowed, faults);
  if (!faults.has(mesh_fault::non_finite_point))
    check_elements(mesh, faults);
}

template <int D>
bool each_is_valid(const simplicial_mesh<D>& mesh, const validity_options& allowed) {
  fault_collector faults;
  check_each(mesh, allowed, faults);
  return faults.result().valid();
}

/// `sides()` is called when references are known to be right.
template <int D, class Sides>
validity check_all(const simplicial_mesh<D>& mesh, const Sides& sides, const validity_options& allowed) {
  fault_collector faults;
  check_each(mesh, allowed, faults);
  if (faults.has(mesh_fault::missing_point))
    return faults.result();
  if (faults.has(mesh_fault::repeated_vertex)) {
    check_duplicates(mesh, faults);
    return faults.result();
  }
  const side_table<D>& table = sides();
  check_sides(mesh, table, allowed, faults);
  // A tetrahedron that is listed twice is inverted once, or at fault at each of its sides.
  if (D == 2 || !faults.result().valid())
    check_duplicates(mesh, faults);
  if constexpr (D == 3)
    if (allowed.closed_boundary)
      check_closed(mesh, table, faults);
  return faults.result();
}

} // namespace detail

template <int D>
validity check_validity(const simplicial_mesh<D>& mesh, const validity_options& allowed) {
  side_table<D> sides;
  return detail::check_all(
      mesh,
      [&]() -> const side_table<D>& {
        sides = build_sides(mesh);
        return sides;
      },
      allowed);
}

template <int D>
validity check_validity(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                        const validity_options& allowed) {
  return detail::check_all(
      mesh, [&]() -> const side_table<D>& { return sides; }, allowed);
}

#ifdef DOVETAIL_COMPILED
template bool detail::each_is_valid<3>(const simplicial_mesh<3>& mesh, const validity_options& allowed);
template validity check_validity<2>(const simplicial_mesh<2>& mesh, const validity_options& allowed);
template validity check_validity<2>(const simplicial_mesh<2>& mesh, const side_table<2>& sides,
                                    const validity_options& allowed);
template validity check_validity<3>(const simplicial_mesh<3>& mesh, const validity_options& allowed);
template validity check_validity<3>(const simplicial_mesh<3>& mesh, const side_table<3>& sides,
                                    const validity_options& allowed);
#endif

} // namespace dovetail
