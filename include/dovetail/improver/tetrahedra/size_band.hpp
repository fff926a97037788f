/// @file
/// Keeps edge lengths near the sizing field while elements change.
#pragma once

#include "dovetail/improver/tetrahedra/local_change.hpp"
#include "dovetail/sizing/checked_size.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace dovetail::improvement {

/// Squared lengths of the shortest and longest of some edges.
struct edge_lengths {
  double shortest = 1e300, longest = 0; ///< squared

  /// Takes in the edge between two points.
  void add(vec3 a, vec3 b) {
    const double squared = norm_squared(b - a);
    shortest = std::min(shortest, squared);
    longest = std::max(longest, squared);
  }
  void add(const tet_complex& mesh, const simplex<3>& v) {
    for (const auto& edge : numbering::ridges<3>)
      add(mesh.point(v[edge[0]]), mesh.point(v[edge[1]]));
  }
};

/// The root mean square length of the edges at each vertex. O(elements).
inline std::vector<float> present_sizes(const tet_complex& mesh) {
  std::vector<float> sums(static_cast<std::size_t>(mesh.vertex_slots()), 0.0F);
  std::vector<std::int32_t> counts(sums.size(), 0);
  for (local_id e = 0; e < mesh.element_slots(); ++e) {
    if (!mesh.is_alive(e))
      continue;
    const auto& v = mesh.vertices(e);
    for (const auto& edge : numbering::ridges<3>) {
      const local_id a = v[edge[0]], b = v[edge[1]];
      const auto squared = static_cast<float>(norm_squared(mesh.point(b) - mesh.point(a)));
      for (const local_id end : {a, b}) {
        sums[end] += squared;
        ++counts[end];
      }
    }
  }
  for (std::size_t v = 0; v < sums.size(); ++v)
    sums[v] = counts[v] > 0 ? std::sqrt(sums[v] / static_cast<float>(counts[v])) : 0.0F;
  return sums;
}

/// A change may not make an edge that leaves the band [shortest, longest] x size and is also shorter or
/// longer than all edges that were there before. The size is that of the field at the place of the change or,
/// without a field, the mean of the mesh's sizes at the change's first element: the lengths of the mesh as it
/// was before the first change, so that changes of changes do not drift away.
struct size_band {
  const any_sizing* field = nullptr;  ///< null or empty: no field
  double shortest = 0.4, longest = 2; ///< in sizes: the shortest and the longest edge that a change may make

  /// Whether there is a sizing field.
  bool has_field() const { return field != nullptr && static_cast<bool>(*field); }
  /// The size at the place of a change.
  double size_at(const tet_complex& mesh, const simplex<3>& element, vec3 place) const {
    if (has_field())
      return checked_size(*field, place);
    double sum = 0;
    for (const local_id v : element)
      sum += static_cast<double>(mesh.size_at(v));
    return sum / 4;
  }
  /// Whether a change may be made, by its edges before and after.
  bool admits(const tet_complex& mesh, const edge_lengths& before, const edge_lengths& after,
              const simplex<3>& element, vec3 place) const {
    if (after.shortest >= before.shortest && after.longest <= before.longest)
      return true;
    const double size = size_at(mesh, element, place);
    const double low = shortest * size, high = longest * size;
    return after.shortest >= std::min(before.shortest, low * low) &&
           after.longest <= std::max(before.longest, high * high);
  }
  bool admits(const tet_complex& mesh, const local_change& change) const {
    edge_lengths before, after;
    for (const local_id e : change.old)
      before.add(mesh, mesh.vertices(e));
    for (const auto& v : change.fresh)
      after.add(mesh, v);
    return admits(mesh, before, after, change.fresh[0], mesh.point(change.fresh[0][0]));
  }
};

} // namespace dovetail::improvement
