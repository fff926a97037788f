/// @file
/// A proposed change of a few elements, and its execution.
#pragma once

#include "dovetail/core/predicates.hpp"
#include "dovetail/improver/tetrahedra/cavity_topology.hpp"
#include "dovetail/improver/tetrahedra/tet_walks.hpp"

#include <algorithm>

namespace dovetail::improvement {

/// The elements to take out and those to put in their place, with their values.
struct local_change {
  bounded_list<local_id, max_cavity> old;     ///< elements to take out
  bounded_list<simplex<3>, max_cavity> fresh; ///< elements to put in
  bounded_list<float, max_cavity> values;
  float worst = 2; ///< the smallest of `values`

  void clear() {
    old.size = fresh.size = values.size = 0;
    worst = 2;
  }
  /// Puts in an element of that value; false when there is no room.
  bool add(const simplex<3>& element, float value) {
    worst = std::min(worst, value);
    return fresh.push(element) && values.push(value);
  }
};

/// Every fresh element is positively oriented, exactly: values are rounded, and that of an element with
/// angles of 1e-8 degrees says nothing. In a tangled mesh one may stay inverted, but not count as positive
/// and be inverted.
inline bool is_sound(const tet_complex& mesh, const local_change& change) {
  for (int i = 0; i < change.fresh.size; ++i) {
    if (mesh.is_tangled() && change.values[i] <= 0)
      continue;
    const auto& v = change.fresh[i];
    if (orient3d(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])) <= 0)
      return false;
  }
  return !mesh.is_tangled() || fills_a_ball(mesh, change.old.view(), change.fresh.view());
}

/// Replaces the old elements by the fresh ones.
inline void execute(tet_complex& mesh, const local_change& change) {
  std::array<local_id, static_cast<std::size_t>(max_cavity)> ids;
  mesh.replace(change.old.view(), change.fresh.view(), change.values.view(),
               {ids.data(), static_cast<std::size_t>(change.fresh.size)});
}

/// The worst value among the elements.
inline float worst_value(const tet_complex& mesh, std::span<const local_id> elements) {
  float worst = 2;
  for (const local_id e : elements)
    worst = std::min(worst, mesh.value(e));
  return worst;
}

} // namespace dovetail::improvement
