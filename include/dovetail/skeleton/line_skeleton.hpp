/// @file
/// The fine skeleton of D = 2: the edges of the remeshed lines, with the subsurfaces beside them.
#pragma once

#include "dovetail/geometry/concepts.hpp"
#include "dovetail/geometry/coplanar.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/coarse_skeleton.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/skeleton/fine_lines.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dovetail {

/// The fine skeleton of a decomposed surface from its lines. `sides` is `build_sides(surface.mesh)`. Linear
/// in the edges made.
/// Throws nothing but for a lack of memory.
/// \param surface the coarse surface
/// \param sides `build_sides(surface.mesh)`
/// \param subdomain_of_triangle per triangle its subdomain, from 0
/// \param lines the remeshed lines
simplicial_skeleton<2> skeleton_of_lines(const surface_mesh& surface, const side_table<2>& sides,
                                         const std::vector<local_id>& subdomain_of_triangle,
                                         const numbered_lines& lines);

/// Which chords (inner edges of a region that join two points of lines) must not be: those that coincide with
/// an edge of a line, and those that another region beside the same CAD curve might have too. Of the regions
/// that might, the first may; a flat one before those that are curved, which must not have chords in the
/// plane of a face beside them: a triangle at such a chord may lie in that face as a whole, as the one at the
/// tip of half a cone. A pure function of the skeleton, so that regions need not wait for each other.
class chord_rule {
public:
  /// \param model has the planes of flat faces; it is not needed later
  template <geometry_model Geometry>
  chord_rule(const Geometry& model, const coarse_skeleton& skeleton, const simplicial_skeleton<2>& fine,
             const numbered_lines& lines, const surface_mesh& surface)
      : chord_rule(skeleton, fine, lines, surface) {
    std::vector<std::optional<surface_frame>> planes;
    planes.reserve(skeleton.regions.size());
    for (const skeleton_region& region : skeleton.regions)
      planes.push_back(plane_of_face(model, region.cad_face));
    plane_of_ = plane_numbers(planes, model.bounds().diagonal(), coplanar_tolerance);
  }

  /// Whether a region must not have the chord between two points.
  bool forbids(local_id region, local_id a, local_id b) const;

  /// All that the answers for some regions and the points on their boundaries depend on. `points` are
  /// growing. The numbers of regions and points elsewhere are no part of it, since a merge changes these.
  std::vector<std::int64_t> facts(std::span<const local_id> regions, std::span<const local_id> points) const;

private:
  /// Without the planes.
  chord_rule(const coarse_skeleton& skeleton, const simplicial_skeleton<2>& fine, const numbered_lines& lines,
             const surface_mesh& surface);

  /// Whether a region may have chords that another one must not have then.
  bool comes_before(local_id region, local_id other) const;

  /// By what a curved region tells others apart: flat ones by their plane.
  local_id told_apart_by(local_id region, local_id other) const;

  /// Of each point the regions before this one that are at another of the points too, numbered in the order
  /// of their appearance, behind their count; for a curved region those in one plane have one number.
  std::vector<std::int64_t> earlier_regions(local_id region, std::span<const local_id> points) const;

  /// Points of the CAD curves that a coarse triangle touches.
  void add_region(local_id region, const simplex<2>& triangle, const numbered_lines& lines);

  std::vector<simplex<1>> edges_;                 ///< of all lines, sorted
  std::vector<std::vector<local_id>> regions_at_; ///< per point; empty for points on no CAD curve
  std::vector<local_id> plane_of_;                ///< per region the number of its plane; of curved ones none
};

/// The regions of each subsurface, growing.
std::vector<std::vector<local_id>> regions_of_subdomains(const coarse_skeleton& skeleton,
                                                         std::size_t subdomains);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/skeleton/line_skeleton.ipp"
#endif
