/// @file
/// A proposed change of a few elements, and its execution.
#pragma once

#include "dovetail/core/predicates.hpp"
#include "dovetail/improver/tet_walks.hpp"

#include <algorithm>

namespace dovetail::improvement {

inline constexpr int max_cavity = 128;

/// The elements to take out and those to put in their place, with their values.
struct local_change {
  bounded_list<local_id, max_cavity> old;
  bounded_list<simplex<3>, max_cavity> fresh;
  bounded_list<float, max_cavity> values;
  float worst = 2; ///< the smallest of `values`

  void clear() {
    old.size = fresh.size = values.size = 0;
    worst = 2;
  }
  bool add(const simplex<3>& element, float value) {
    worst = std::min(worst, value);
    return fresh.push(element) && values.push(value);
  }
};

/// Values above this are computed from differences of coordinates with a relative error far smaller than
/// themselves, so that a positive value proves a positive orientation; below it the exact test decides.
inline constexpr float surely_positive = 1e-5F;

/// Every fresh element is positively oriented, exactly, or has the right to be what the value says: a change
/// of an inverted region may leave elements inverted, but never those that count as positive.
inline bool is_sound(const tet_complex& mesh, const local_change& change) {
  for (int i = 0; i < change.fresh.size; ++i) {
    if (change.values[i] > surely_positive || change.values[i] <= 0)
      continue;
    const auto& v = change.fresh[i];
    if (orient3d(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])) <= 0)
      return false;
  }
  return true;
}

/// The worst value among the elements.
inline float worst_value(const tet_complex& mesh, std::span<const local_id> elements) {
  float worst = 2;
  for (const local_id e : elements)
    worst = std::min(worst, mesh.value(e));
  return worst;
}

} // namespace dovetail::improvement
