/// @file
/// Interface angles as bytes: they decide which detours interfaces make, so all ranks need them.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/decomposition/interface_angles.hpp"

#include <cstddef>
#include <cstdint>

namespace dovetail {

inline void encode(byte_writer& to, const interface_angles& angles) {
  to.value<std::uint64_t>(angles.interface_faces);
  to.value(angles.face_angle);
  to.value(angles.interface_wedge);
  to.value(angles.surface_wedge);
  to.value<std::uint64_t>(angles.violations.size());
  for (const angle_violation& v : angles.violations) {
    to.value(v.angle_deg);
    to.value(v.cause);
    to.value(v.sides);
    to.value(v.edge);
    to.value(v.subdomain);
    to.value(v.place);
    to.array(v.cad);
  }
}

/// Throws `input_error` when the data end early.
inline interface_angles decode_interface_angles(byte_reader& from) {
  interface_angles angles;
  angles.interface_faces = static_cast<std::size_t>(from.value<std::uint64_t>());
  angles.face_angle = from.value<least_angle>();
  angles.interface_wedge = from.value<least_angle>();
  angles.surface_wedge = from.value<least_angle>();
  for (auto left = from.value<std::uint64_t>(); left > 0; --left) {
    angle_violation& v = angles.violations.emplace_back();
    v.angle_deg = from.value<double>();
    v.cause = from.value<violation_cause>();
    v.sides = from.value<std::array<local_id, 2>>();
    v.edge = from.value<std::array<local_id, 2>>();
    v.subdomain = from.value<local_id>();
    v.place = from.value<vec3>();
    v.cad = from.array<host>();
  }
  return angles;
}

} // namespace dovetail
