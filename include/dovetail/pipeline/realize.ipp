/// @file
/// What `realize.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/decomposition/extract_skeleton.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/intersection/crossing_refinement.hpp"
#include "dovetail/intersection/merge_subdomains.hpp"
#include "dovetail/intersection/suppression.hpp"
#include "dovetail/pipeline/background.hpp"
#include "dovetail/pipeline/realize.hpp"
#include "dovetail/skeleton/line_skeleton.hpp"
#include "dovetail/skeleton/remesh_skeleton.hpp"

#include <set>
#include <string>

namespace dovetail {

namespace detail {

/// The rounds of `realize`.
class skeleton_rounds {
public:
  skeleton_rounds(const any_geometry& model, const background_mesh& mesh, const side_table<3>& sides,
                  std::span<const side_state> side_states, merge_account& merges, const any_sizing& size,
                  content_key field, skeleton_store& made, const any_parameters<3>& given)
      : model_(model), mesh_(mesh), sides_(sides), side_states_(side_states), merges_(merges), size_(size),
        field_(field), store_(made), given_(given) {}

  realized_skeleton run(std::vector<local_id> subdomain_of_element) {
    result_.subdomain_of_element = std::move(subdomain_of_element);
    result_.size = size_;
    result_.field = field_;
    result_.skeleton_summary.name = "skeleton";
    result_.intersection_summary.name = "intersection";
    for (;;) {
      remeshed_skeleton remeshed = remesh();
      if (merge_failed_patches(remeshed))
        continue;
      const suppression_plan plan = find_crossings(remeshed);
      if (plan.empty())
        return finish(std::move(remeshed));
      if (!plan.merges.empty())
        merge(plan.merges);
      else
        refine(plan.surface_crossings);
    }
  }

private:
  remeshed_skeleton remesh() {
    const stopwatch clock;
    result_.coarse = extract_skeleton(mesh_, sides_, result_.subdomain_of_element);
    auto remeshed = remesh_skeleton(model_, mesh_.surface, mesh_.volume.points, result_.coarse, result_.size,
                                    result_.field, given_.mesh_surface, given_.run_tasks, store_,
                                    given_.options.on_progress);
    const double before = result_.skeleton_summary.seconds;
    result_.skeleton_summary = remeshed.summary;
    result_.skeleton_summary.seconds = before + clock.seconds();
    return remeshed;
  }

  /// Lines that cross in a region's parameter plane go, with the interfaces that end on them.
  bool merge_failed_patches(const remeshed_skeleton& remeshed) {
    if (remeshed.failures.empty())
      return false;
    std::set<std::array<local_id, 2>> pairs;
    for (const patch_failure& failure : remeshed.failures) {
      std::set<std::array<local_id, 2>> here;
      for (const local_id line : failure.removable_lines) {
        const auto& ends = result_.coarse.lines[static_cast<std::size_t>(line)].vertices;
        for (const skeleton_face& face : result_.coarse.faces)
          if (std::count(face.vertices.begin(), face.vertices.end(), ends[0]) +
                  std::count(face.vertices.begin(), face.vertices.end(), ends[1]) ==
              2)
            here.insert(face.subdomains);
      }
      if (here.empty())
        throw mesher_error(failure.reason + "; give a smaller size there");
      pairs.insert(here.begin(), here.end());
    }
    merge({pairs.begin(), pairs.end()});
    return true;
  }

  /// After a merge most patches are of a skeleton that was searched before.
  suppression_plan find_crossings(const remeshed_skeleton& remeshed) {
    const stopwatch clock;
    given_.options.on_progress("intersection", 0, 0);
    std::vector<bool> planar(remeshed.fine.sides.size(), false);
    for (std::size_t f = 0; f < result_.coarse.faces.size(); ++f)
      if (!is_curved(result_.coarse.faces[f], result_.coarse.lines))
        mark(planar, remeshed, result_.coarse.regions.size() + f);
    auto plan = plan_suppression(remeshed.fine, planar, given_.run_tasks,
                                 known_from_patches(remeshed.fine, remeshed.first_triangle,
                                                    remeshed.patch_keys, store_.patches_apart));
    if (plan.empty()) {
      store_.patches_apart = remeshed.patch_keys;
      sort_unique(store_.patches_apart);
    }
    result_.intersection_summary.add("crossings", static_cast<double>(plan.crossings));
    result_.intersection_summary.add("rounds", 1);
    result_.intersection_summary.seconds += clock.seconds();
    return plan;
  }

  static void mark(std::vector<bool>& triangles, const remeshed_skeleton& remeshed, std::size_t patch) {
    std::fill(triangles.begin() + remeshed.first_triangle[patch],
              triangles.begin() + remeshed.first_triangle[patch + 1], true);
  }

  void merge(const std::vector<std::array<local_id, 2>>& pairs) {
    if (const std::string refused = merges_.merge(result_.subdomain_of_element, pairs); !refused.empty())
      throw intersection_error(refused + ": their interfaces cross the surface; give a smaller size or fewer "
                                         "subdomains");
  }

  void refine(const std::vector<surface_crossing>& crossings) {
    result_.size = refinement_.refine(crossings, model_.topology());
    ++refinements_;
    result_.field = refinement_.key(field_);
  }

  realized_skeleton finish(remeshed_skeleton remeshed) {
    result_.material_of_subdomain.assign(static_cast<std::size_t>(merges_.subdomains()), 0);
    for (std::size_t e = 0; e < result_.subdomain_of_element.size(); ++e)
      result_.material_of_subdomain[static_cast<std::size_t>(result_.subdomain_of_element[e])] =
          mesh_.volume.tags[e];
    result_.fine = std::move(remeshed.fine);
    name_inner_hosts();
    result_.origins = origins_of(remeshed.first_triangle);
    result_.intersection_summary.set("refinements", refinements_);
    return std::move(result_);
  }

  /// Points of inner interfaces lie in the solid of the subdomains beside them.
  void name_inner_hosts() {
    fine_skeleton& fine = result_.fine;
    for (std::size_t t = 0; t < fine.sides.size(); ++t)
      for (const local_id v : fine.sides[t])
        if (host& on = fine.point_hosts[static_cast<std::size_t>(v)]; on.dimension == 3)
          on.id = result_.material_of_subdomain[static_cast<std::size_t>(fine.subdomains[t][0])];
  }

  /// What the simplification decided about the coarse face that each fine triangle lies on.
  std::vector<triangle_origin> origins_of(const std::vector<local_id>& first_triangle) const {
    std::vector<triangle_origin> origins(static_cast<std::size_t>(first_triangle.back()),
                                         triangle_origin::cad);
    for (std::size_t f = 0; f < result_.coarse.faces.size(); ++f) {
      const auto side = static_cast<std::size_t>(find_side<3>(sides_, result_.coarse.faces[f].vertices));
      const std::size_t patch = result_.coarse.regions.size() + f;
      std::fill(origins.begin() + first_triangle[patch], origins.begin() + first_triangle[patch + 1],
                side_states_[side] == side_state::refused ? triangle_origin::refused : triangle_origin::kept);
    }
    return origins;
  }

  const any_geometry& model_;
  const background_mesh& mesh_;
  const side_table<3>& sides_;
  std::span<const side_state> side_states_;
  merge_account& merges_;
  any_sizing size_;
  content_key field_;
  skeleton_store& store_;
  const any_parameters<3>& given_;
  crossing_refinement refinement_{size_, given_.options.refinement_rounds};
  int refinements_ = 0;
  realized_skeleton result_;
};

} // namespace detail

DOVETAIL_INLINE realized<2> realize(const any_geometry& model, const simplicial_background<2>& mesh,
                                    const side_table<2>& sides, std::span<const side_state>,
                                    std::vector<local_id> subdomain_of_element, merge_account& merges,
                                    const any_sizing& size, content_key field, skeleton_store& made,
                                    const any_parameters<2>& given) {
  const stopwatch clock;
  realized<2> result;
  result.coarse = extract_skeleton(mesh.surface, own_subdomains(subdomain_of_element));
  result.lines = realize_lines(model, mesh.surface, result.coarse, mesh.surface.mesh.points, size, field,
                               given.run_tasks, made.lines, given.options.on_progress);
  result.fine = skeleton_of_lines(mesh.surface, sides, subdomain_of_element, result.lines);
  result.regions = regions_of_subdomains(result.coarse, static_cast<std::size_t>(merges.subdomains()));
  result.subdomain_of_element = std::move(subdomain_of_element);
  result.material_of_subdomain.assign(static_cast<std::size_t>(merges.subdomains()), 0);
  result.size = size;
  result.field = field;
  result.intersection_summary.name = "intersection";
  report& summary = result.skeleton_summary;
  summary.name = "skeleton";
  summary.set("lines", static_cast<double>(result.coarse.lines.size()));
  summary.set("regions", static_cast<double>(result.coarse.regions.size()));
  summary.set("edges", static_cast<double>(result.fine.sides.size()));
  summary.set("points", static_cast<double>(result.fine.points.size()));
  summary.seconds = clock.seconds();
  return result;
}

DOVETAIL_INLINE realized_skeleton realize(const any_geometry& model, const background_mesh& mesh,
                                          const side_table<3>& sides, std::span<const side_state> side_states,
                                          std::vector<local_id> subdomain_of_element, merge_account& merges,
                                          const any_sizing& size, content_key field, skeleton_store& made,
                                          const any_parameters<3>& given) {
  return detail::skeleton_rounds(model, mesh, sides, side_states, merges, size, field, made, given)
      .run(std::move(subdomain_of_element));
}

} // namespace dovetail
