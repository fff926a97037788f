/// @file
/// What is found where interface angles are measured.
#pragma once

#include "dovetail/core/fields.hpp"
#include "dovetail/core/ids.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace dovetail {

/// Why an angle is too small.
enum class violation_cause : std::uint8_t {
  forced,    ///< what is fixed forces it: no interface that ends there can have a larger one
  refused,   ///< one of its sides is, or lies on, a coarse side that the bound refused to remove
  remeshing, ///< neither: it came up by curving or refining, or the rule did not want it away
};

/// An angle that is too small.
struct angle_violation {
  double angle_deg = 0;                             ///< the angle
  violation_cause cause = violation_cause::refused; ///< why it is there
  std::array<local_id, 2> sides{no_id, no_id}; ///< the face itself, or the two sides that make the dihedral
  std::array<local_id, 2> edge{no_id, no_id};  ///< a dihedral's ridge, in D = 2 a vertex; no_id for a face
  local_id subdomain = no_id;                  ///< the subdomain a dihedral lies in
  vec3 place;                                  ///< the middle of the face or ridge
  std::vector<host> cad = {}; ///< the entities that force it; if none do, the faces that it touches

  using fields = field_list<&angle_violation::angle_deg, &angle_violation::cause, &angle_violation::sides,
                            &angle_violation::edge, &angle_violation::subdomain, &angle_violation::place,
                            &angle_violation::cad>;

  /// Whether it is between two sides, and not inside one.
  bool is_dihedral() const { return edge[0] != no_id; }
};

/// A minimum and where it occurs.
struct least_angle {
  double angle_deg = 360;                      ///< 360 when there is nothing to measure
  std::array<local_id, 2> sides{no_id, no_id}; ///< the side that has it, or the two that include it
  std::array<local_id, 2> edge{no_id, no_id};  ///< the edge at which it is, if it is a dihedral

  /// The angle, or nothing.
  std::optional<double> measured() const { return angle_deg < 360 ? std::optional(angle_deg) : std::nullopt; }
};

/// The smallest angles of a decomposition's interfaces.
struct interface_angles {
  std::size_t interface_faces = 0;         ///< how many there are
  least_angle face_angle;                  ///< of interface faces; none in D = 2
  least_angle interface_dihedral;          ///< between two interface faces
  least_angle surface_dihedral;            ///< between an interface face and a fixed side
  std::vector<angle_violation> violations; ///< by growing angle

  using fields = field_list<&interface_angles::interface_faces, &interface_angles::face_angle,
                            &interface_angles::interface_dihedral, &interface_angles::surface_dihedral,
                            &interface_angles::violations>;

  /// The smaller one of both kinds of dihedrals, and where it is.
  const least_angle& min_dihedral() const {
    return surface_dihedral.angle_deg < interface_dihedral.angle_deg ? surface_dihedral : interface_dihedral;
  }
  /// How large it is; 360 when there is nothing to measure.
  double min_dihedral_deg() const { return min_dihedral().angle_deg; }
  /// How many violations have a cause.
  std::size_t count(violation_cause cause) const {
    return static_cast<std::size_t>(
        std::count_if(violations.begin(), violations.end(), [&](const auto& v) { return v.cause == cause; }));
  }
};

} // namespace dovetail
