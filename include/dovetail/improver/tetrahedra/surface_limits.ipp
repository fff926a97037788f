/// @file
/// What `surface_limits.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/improver/quality_counts.hpp"
#include "dovetail/improver/tetrahedra/surface_limits.hpp"
#include "dovetail/improver/tetrahedra/tet_complex.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dovetail::improvement {

DOVETAIL_INLINE surface_limits::surface_limits(const tet_complex& mesh)
    : is_limiting_(static_cast<std::size_t>(mesh.vertex_slots()), 0) {
  for (local_id e = 0; e < mesh.element_slots(); ++e)
    if (mesh.is_alive(e) && mesh.has_fixed_side(e))
      for (int side = 0; side < 4; ++side)
        if (mesh.is_fixed(e, side))
          examine(mesh, e, side);
}

DOVETAIL_INLINE void surface_limits::examine(const tet_complex& mesh, local_id e, int side) {
  static const double cos_triangle = std::cos(limiting_triangle_angle * std::numbers::pi / 180);
  const auto& local = numbering::sides<3>[side];
  std::array<local_id, 3> v{};
  std::array<vec3, 3> p;
  for (std::size_t k = 0; k < 3; ++k) {
    v[k] = mesh.vertex(e, local[k]);
    p[k] = mesh.point(v[k]);
  }
  bool is_sharp = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const vec3 s = p[(k + 1) % 3] - p[k], t = p[(k + 2) % 3] - p[k];
    is_sharp = is_sharp || dot(s, t) > cos_triangle * std::sqrt(norm_squared(s) * norm_squared(t));
  }
  if (is_sharp)
    for (const local_id corner : v)
      limit(corner);
  for (std::size_t k = 0; k < 3; ++k)
    if (dihedral_is_sharp(mesh, e, side, v[k], v[(k + 1) % 3])) {
      limit(v[k]);
      limit(v[(k + 1) % 3]);
    }
}

DOVETAIL_INLINE bool surface_limits::dihedral_is_sharp(const tet_complex& mesh, local_id e, int side,
                                                       local_id a, local_id b) {
  double turned = 0;
  int behind = side; // the corner opposite the side we come from
  for (;;) {
    // c lies on the side we come from, d = the vertex opposite it, on the side we leave by.
    const local_id d = mesh.vertex(e, behind);
    local_id c = no_id;
    int ahead = 0;
    for (int corner = 0; corner < 4; ++corner) {
      const local_id v = mesh.vertex(e, corner);
      if (corner != behind && v != a && v != b) {
        c = v;
        ahead = corner;
      }
    }
    turned += std::acos(cos_of_dihedral(mesh.point(a), mesh.point(b), mesh.point(c), mesh.point(d)));
    if (turned >= limiting_dihedral_angle * std::numbers::pi / 180)
      return false;
    if (mesh.is_fixed(e, ahead))
      return true;
    const half_side beyond = mesh.across(e, ahead);
    e = element_of(beyond);
    behind = side_of(beyond);
  }
}

DOVETAIL_INLINE dihedral_cosines dihedral_cosines_of(vec3 p, vec3 q, vec3 r, vec3 s) {
  const vec3 a = q - p, b = r - p, c = s - p;
  const vec3 na = cross(b, c), nb = cross(c, a), nc = cross(a, b), sum = na + nb + nc;
  const double la = 1 / norm(na), lb = 1 / norm(nb), lc = 1 / norm(nc), ls = 1 / norm(sum);
  const std::array<double, 6> cosines{-dot(na, nb) * la * lb, -dot(nb, nc) * lb * lc, -dot(nc, na) * lc * la,
                                      dot(na, sum) * la * ls, dot(nb, sum) * lb * ls, dot(nc, sum) * lc * ls};
  const auto [least, most] = std::minmax_element(cosines.begin(), cosines.end());
  return {*least, *most, dot(na, a)};
}

DOVETAIL_INLINE quality_counts count_quality(const tet_complex& mesh, const surface_limits& limits) {
  quality_counter counter(24, 12);
  for (local_id e = 0; e < mesh.element_slots(); ++e) {
    if (!mesh.is_alive(e))
      continue;
    const auto& v = mesh.vertices(e);
    const auto cosines =
        dihedral_cosines_of(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
    if (cosines.six_volumes > 0)
      counter.add(limits.limits(v), cosines.most, cosines.least);
    else
      counter.add_inverted(limits.limits(v));
  }
  return counter.result();
}

} // namespace dovetail::improvement
