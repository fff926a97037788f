/// @file
/// Keeps edge lengths near the sizing field while elements change.
#pragma once

#include "dovetail/improver/local_change.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <algorithm>
#include <cmath>

namespace dovetail::improvement {

/// Squared lengths of the shortest and longest of some edges, and the sum of all.
struct edge_lengths {
  double shortest = 1e300, longest = 0, sum = 0;
  int count = 0;

  void add(vec3 a, vec3 b) {
    const double squared = norm_squared(b - a);
    shortest = std::min(shortest, squared);
    longest = std::max(longest, squared);
    sum += squared;
    ++count;
  }
  void add(const tet_complex& mesh, const simplex<3>& v) {
    for (const auto& edge : numbering::ridges<3>)
      add(mesh.point(v[static_cast<std::size_t>(edge[0])]), mesh.point(v[static_cast<std::size_t>(edge[1])]));
  }
};

/// A change may not make an edge that leaves the band [shortest, longest] x size and is also shorter or
/// longer than all edges that were there before. The size is that of the field at the place of the change or,
/// without a field, the root mean square length of the edges before the change.
struct size_band {
  const any_sizing* field = nullptr; ///< null or empty: no field
  double shortest = 0.4, longest = 2;

  bool admits(const edge_lengths& before, const edge_lengths& after, vec3 place) const {
    if (after.shortest >= before.shortest && after.longest <= before.longest)
      return true;
    const double size = field != nullptr && *field ? (*field)(place) : std::sqrt(before.sum / before.count);
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
    return admits(before, after, mesh.point(change.fresh[0][0]));
  }
};

} // namespace dovetail::improvement
