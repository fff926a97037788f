/// @file
/// Does a mesh fill what its model encloses?
///
/// Between a mesh and its model lies no more than the gap: the volume between the triangles of the boundary
/// and the faces that they are meshes of, which is summed up where those are made (`surface_deviation`), and
/// which finer sizes close. A volume that differs by more than that says that a part of the boundary is not
/// where the model has it, however small each triangle's own distance is.
#pragma once

#include "dovetail/core/number_text.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <cmath>
#include <cstddef>
#include <optional>

namespace dovetail {

/// The volume inside the boundary of a mesh. Linear in the sides of its skeleton.
inline double volume_inside(const simplicial_skeleton<3>& skeleton) {
  const auto point = [&](local_id v) { return skeleton.points[static_cast<std::size_t>(v)]; };
  box3 box;
  for (const vec3& p : skeleton.points)
    box.include(p);
  const vec3 origin = box.center(); // near the mesh, for the sake of rounding
  double sum = 0;
  for (std::size_t s = 0; s < skeleton.sides.size(); ++s)
    if (const auto& side = skeleton.sides[s]; skeleton.subdomains[s][1] == no_id)
      sum += signed_volume(origin, point(side[0]), point(side[1]), point(side[2]));
  return sum;
}

/// The mesh of a model of tetrahedra fills the volume that the model has: or else there is a warning in
/// `summary`, the report of the run, which gets the counters "volume" and "model_volume". What is allowed is
/// twice the gap, which is measured at the centres of triangles, and a millionth of the volume, which is
/// rounding and the tolerances that CAD faces meet with. Nothing is done where the model does not know its
/// volume.
inline void compare_volume(const simplicial_skeleton<3>& skeleton, const std::optional<double>& of_model,
                           report& summary) {
  if (!of_model || !std::isfinite(*of_model))
    return;
  const double volume = volume_inside(skeleton);
  const double gap = summary.find("skeleton").find("deviation").get("gap");
  summary.set("volume", volume);
  summary.set("model_volume", *of_model);
  if (std::abs(volume - *of_model) > 2 * gap + 1e-6 * std::abs(*of_model))
    summary.warnings.push_back("the mesh fills a volume of " + number_text(volume) + ", and the model has " +
                               number_text(*of_model) + "; the distance between their surfaces explains " +
                               number_text(gap, 2) +
                               " of that: a part of the boundary is not where the "
                               "model has it, so look at the mesh before using it");
}

} // namespace dovetail
