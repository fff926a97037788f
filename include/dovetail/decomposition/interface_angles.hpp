/// @file
/// The interface angles: no small face angle on an interface, no small wedge beside one. Measured on the
/// coarse or on the fine skeleton; what is below the threshold is listed with its cause.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/subdomain_boundary.hpp"

#include "dovetail/mesh/require_valid.hpp"
#include "dovetail/mesh/side_state.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace dovetail {

/// Why an angle is below the threshold.
enum class violation_cause : std::uint8_t {
  forced,    ///< the CAD itself forces it (`find_forced`)
  refused,   ///< one of its triangles lies on a coarse side that the bound refused to remove
  remeshing, ///< neither: it came up after the coarse decomposition, by curving or refining
};

/// What an interface triangle comes from; the CAD's own triangles are `cad`.
enum class triangle_origin : std::uint8_t {
  cad,     ///< on a CAD face: boundary or material face
  kept,    ///< on an interface inside a solid
  refused, ///< the same, on a coarse side that ought to have been removed
};

/// The triangles of all subdomain boundaries, each held once; spans of equal length but `points`.
struct interface_angles_input {
  std::span<const vec3> points;
  std::span<const simplex<2>> triangles;
  std::span<const std::array<local_id, 2>> subdomains; ///< oriented outwards of [0]; [1] may be no_id
  std::span<const triangle_origin> origins;
  /// Of the edges whose wedges are measured: 3 t + k for side k of triangle t, all of an edge or none. All
  /// edges when it is empty.
  std::span<const std::uint32_t> half_edges = {};
  mesh_state mesh_is = mesh_state::unknown; ///< `valid`: the triangles need not be looked at
};

/// An angle under the threshold.
struct angle_violation {
  double angle_deg = 0;
  violation_cause cause = violation_cause::refused;
  std::array<local_id, 2> sides{no_id, no_id}; ///< the triangle itself, or the two that make the wedge
  std::array<local_id, 2> edge{no_id, no_id};  ///< a wedge's ridge; no_id for the angle of a face
  local_id subdomain = no_id;                  ///< the subdomain a wedge lies in
  vec3 place;                                  ///< the middle of the triangle or ridge
  std::vector<host> cad = {}; ///< the entities that force it; if none do, the faces that it touches

  bool is_wedge() const { return edge[0] != no_id; }
};

/// A minimum and where it occurs.
struct least_angle {
  double angle_deg = 360; ///< 360 when there is nothing to measure
  std::array<local_id, 2> sides{no_id, no_id};
  std::array<local_id, 2> edge{no_id, no_id};
};

struct interface_angles {
  std::size_t interface_faces = 0;
  least_angle face_angle;                  ///< of interface triangles
  least_angle interface_wedge;             ///< between two interface triangles
  least_angle surface_wedge;               ///< between an interface triangle and one of the CAD
  std::vector<angle_violation> violations; ///< by growing angle

  double min_wedge_deg() const { return std::min(interface_wedge.angle_deg, surface_wedge.angle_deg); }
  std::size_t count(violation_cause cause) const {
    return static_cast<std::size_t>(
        std::count_if(violations.begin(), violations.end(), [&](const auto& v) { return v.cause == cause; }));
  }
};

namespace detail {

inline void sort_by_angle(std::vector<angle_violation>& violations) {
  sort_all(violations, [](const angle_violation& a, const angle_violation& b) {
    return std::tuple(a.angle_deg, a.sides, a.edge) < std::tuple(b.angle_deg, b.sides, b.edge);
  });
}

} // namespace detail

/// The origins of the sides of a decomposed coarse mesh, from what the simplification decided about them.
std::vector<triangle_origin> triangle_origins(const subdomain_boundary_sides<3>& boundary,
                                              std::span<const side_state> side_states);

/// Measures the interface angles. About linear in the number of triangles. Throws `usage_error` when the
/// spans do not match, and `mesh_error` for points that do not exist or are not finite, for a triangle that
/// is flat or there twice, and where the subdomains around an edge contradict each other since a triangle is
/// turned over.
interface_angles measure_interface_angles(const interface_angles_input& input, double threshold_deg = 30);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/decomposition/interface_angles.ipp"
#endif
