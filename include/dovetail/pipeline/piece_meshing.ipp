/// @file
/// What `piece_meshing.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/meshing/subdomain_surface.hpp"
#include "dovetail/pipeline/piece_meshing.hpp"
#include "dovetail/pipeline/realize.hpp"
#include "dovetail/remesh/surfaces.hpp"
#include "dovetail/skeleton/line_skeleton.hpp"
#include "dovetail/skeleton/patches.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace dovetail::detail {

DOVETAIL_INLINE piece_source<3> source_of_pieces(const any_geometry&, const simplicial_background<3>&,
                                                 const realized<3>& skeleton,
                                                 const std::shared_ptr<const sides_of_subdomains>& sorted,
                                                 bool) {
  return [&skeleton, sorted](local_id s) {
    auto surface = boundary_of_subdomain(skeleton.fine, *sorted, s);
    piece_input<3> input;
    input.boundary = {std::move(surface.boundary), skeleton.material_of_subdomain[s]};
    input.skeleton_points = std::move(surface.skeleton_points);
    input.on_interface = std::move(surface.on_interface);
    return input;
  };
}

DOVETAIL_INLINE piece_source<2>
source_of_pieces(const any_geometry& model, const simplicial_background<2>& mesh, const realized<2>& skeleton,
                 const std::shared_ptr<const sides_of_subdomains>& sorted, bool own_model) {
  auto rule =
      std::make_shared<const chord_rule>(model, skeleton.coarse, skeleton.fine, skeleton.lines, mesh.surface);
  auto regions = std::make_shared<const std::vector<std::vector<local_id>>>(
      regions_of_subdomains(skeleton.coarse, skeleton.material_of_subdomain.size()));
  return [&model, &mesh, &skeleton, sorted, rule, regions, own_model](local_id s) {
    auto lines = boundary_of_subdomain(skeleton.fine, *sorted, s);
    const std::shared_ptr<const any_geometry> evaluated =
        own_model ? std::make_shared<const any_geometry>(model)
                  : std::shared_ptr<const any_geometry>(&model, [](const any_geometry*) {});
    const auto numbers = std::make_shared<const std::vector<local_id>>(lines.skeleton_points);
    piece_input<2> input;
    for (const local_id r : (*regions)[s]) {
      const skeleton_region& region = skeleton.coarse.regions[r];
      patch_boundary boundary = region_patch(*evaluated, mesh.surface, region, skeleton.lines).boundary;
      any_surface surface = surface_of_face(evaluated, region.cad_face);
      if (surface.plane) // the model's own parameters of curves are as good as its tolerances
        std::transform(boundary.points.begin(), boundary.points.end(), boundary.uv.begin(),
                       [&](vec3 p) { return surface.plane->project(p); });
      for (local_id& label : boundary.labels)
        label = static_cast<local_id>(
            std::lower_bound(lines.skeleton_points.begin(), lines.skeleton_points.end(), label) -
            lines.skeleton_points.begin());
      input.boundary.regions.push_back({std::move(boundary), std::move(surface), region.cad_face,
                                        model.topology().faces[region.cad_face].reversed,
                                        [rule, numbers, r](local_id a, local_id b) {
                                          return rule->forbids(r, (*numbers)[a], (*numbers)[b]);
                                        }});
    }
    input.context = rule->facts((*regions)[s], lines.skeleton_points);
    input.boundary.boundary = std::move(lines.boundary);
    input.skeleton_points = std::move(lines.skeleton_points);
    input.on_interface = std::move(lines.on_interface);
    return input;
  };
}

} // namespace dovetail::detail
