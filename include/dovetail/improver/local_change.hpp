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

/// A side between two fresh elements is already in the mesh outside the cavity. Possible in a tangled mesh
/// only.
inline bool repeats_a_side(const tet_complex& mesh, const local_change& change) {
  const auto is_old = [&](local_id e) {
    return std::find(change.old.begin(), change.old.end(), e) != change.old.end();
  };
  const auto has = [&](local_id e, const std::array<local_id, 3>& side) {
    const auto& v = mesh.vertices(e);
    return std::all_of(side.begin(), side.end(),
                       [&v](local_id s) { return std::find(v.begin(), v.end(), s) != v.end(); });
  };
  for (int i = 0; i < change.fresh.size; ++i)
    for (int side = 0; side < 4; ++side) {
      const auto key = sorted_side(change.fresh[i], side);
      bool is_inner = false;
      for (int j = 0; j < change.fresh.size && !is_inner; ++j)
        for (int other = 0; other < 4 && j != i; ++other)
          is_inner = is_inner || sorted_side(change.fresh[j], other) == key;
      if (!is_inner || !mesh.is_used(key[0]))
        continue;
      // All elements at the side's first vertex, without marks: this is rare.
      bounded_list<local_id, 4 * max_star> star;
      star.push(mesh.element_at(key[0]));
      for (int k = 0; k < star.size; ++k) {
        if (!is_old(star[k]) && has(star[k], key))
          return true;
        for (int s = 0; s < 4; ++s) {
          const half_side beyond = mesh.across(star[k], s);
          if (mesh.vertex(star[k], s) != key[0] && beyond != no_id &&
              std::find(star.begin(), star.end(), element_of(beyond)) == star.end() &&
              !star.push(element_of(beyond)))
            return true;
        }
      }
    }
  return false;
}

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
  return !mesh.is_tangled() || !repeats_a_side(mesh, change);
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
