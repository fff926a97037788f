/// @file
/// What `occt_triangulation.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/models/occt/brep.hpp"
#include "dovetail/models/occt/joined_triangulation.hpp"
#include "dovetail/models/occt/repair.hpp"
#include "dovetail/models/occt/triangulation.hpp"

#include <vector>

namespace dovetail {

DOVETAIL_INLINE_OCCT surface_mesh occt_triangulation(const occt_model& model,
                                                     triangulation_parameters parameters) {
  const occt::silenced quiet;
  const double deflection =
      parameters.deflection > 0 ? parameters.deflection : 1e-3 * model.bounds().diagonal();
  return occt::guarded("triangulation", [&] {
    return occt::joined_triangulation(model.data(), deflection, parameters.angle);
  });
}

DOVETAIL_INLINE_OCCT std::vector<double> occt_face_areas(const occt_model& model) {
  std::vector<double> areas;
  for (const auto& face : model.data().faces) {
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(face, properties);
    areas.push_back(properties.Mass());
  }
  return areas;
}

DOVETAIL_INLINE_OCCT std::vector<double> occt_solid_volumes(const occt_model& model) {
  std::vector<double> volumes;
  for (const auto& solid : model.data().solids)
    volumes.push_back(occt::volume_of(solid));
  return volumes;
}

} // namespace dovetail
