/// @file
/// How far the mesh of a region is from the surface that it is a mesh of.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/remesh/patch.hpp"
#include "dovetail/remesh/surfaces.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <string>

namespace dovetail {

/// Largest distances from a surface, in units of the local size.
struct surface_deviation {
  double points = 0;  ///< of the points from where their parameters are: lines belong to two faces
  double centres = 0; ///< of the triangles' centres along the normal: what the size leaves of curvature
  double cut_off = 0; ///< likewise of those triangles that step over an edge: no curvature explains it
  double gap = 0;     ///< the volume between the triangles and the surface, in the unit of the model

  using fields = field_list<&surface_deviation::points, &surface_deviation::centres,
                            &surface_deviation::cut_off, &surface_deviation::gap>;
};

/// A triangle whose centre is further from the surface than this, in sizes, is searched for an edge.
inline constexpr double noticed_distance = 0.1;
/// A surface that turns by more than this within `narrowest_turn` of a triangle has an edge there, to that
/// triangle: on a surface that the size resolves, a triangle turns by less altogether.
inline constexpr double turn_of_edge_deg = 45;
/// The smallest part of the way across a triangle on which a turn is looked for.
inline constexpr double narrowest_turn = 1.0 / 64;
/// No mesh of a surface, however coarse, is as far from it as this, in sizes.
inline constexpr double far_distance = 1;

/// A report "deviation" of the largest "points", "centres" and "cut_off" and the sum of "gap", and a child
/// with the same for each face.
void note_deviation(report& to, const std::string& face, const surface_deviation& found);

/// What the report of a region's mesh says of it.
inline surface_deviation deviation_in(const report& noted) {
  return noted.as<surface_deviation>();
}

/// Adds what another such report says.
void merge_deviations(report& to, const report& from);

/// What `to` is to warn of: faces that their meshes are further from than sizes explain.
void warn_of_deviations(report& to, const report& deviation);

/// Measures the mesh of a region, which must have its parameters; one evaluation of the surface per point and
/// triangle.
/// Linear. Throws what the surface throws.
/// \param surface the surface that the region is on
/// \param boundary of the region
/// \param made its mesh
/// \param size edge lengths, which distances are compared with
surface_deviation measure_deviation(const any_surface& surface, const patch_boundary& boundary,
                                    const patch_mesh& made, const any_sizing& size);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/remesh/surface_deviation.ipp"
#endif
