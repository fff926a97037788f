/// @file
/// The steps of `generate` that differ between D = 2 and D = 3, as overloads: what the simplification is
/// given, and how the interfaces are measured.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/corner_angles.hpp"
#include "dovetail/decomposition/forced_angles.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/decomposition/subdomain_boundary.hpp"
#include "dovetail/pipeline/realize.hpp"
#include "dovetail/simplification/any_simplification_rule.hpp"
#include "dovetail/simplification/simplify_coupled.hpp"

namespace dovetail::detail {

inline std::span<const local_id> materials_of(const simplicial_background<3>& mesh) {
  return mesh.volume.tags;
}
/// Subsurfaces may cross CAD curves.
inline std::span<const local_id> materials_of(const simplicial_background<2>&) {
  return {};
}

inline std::vector<simplex<1>> edges_on_curves(const surface_mesh& surface) {
  std::vector<simplex<1>> edges;
  for (const auto& edge : surface.curve_edges)
    edges.push_back(edge.vertices);
  return edges;
}

template <int D>
  requires(D == 2)
simplification simplify_background(const simplicial_background<D>& mesh, const side_table<D>& sides,
                                   std::span<const double> weights, const contraction_bound& bound,
                                   const any_simplification_rule& rule, report& summary,
                                   const progress& on_progress) {
  const auto on_curves = edges_on_curves(mesh.surface);
  auto simplified = simplify<D>(
      mesh.surface.mesh, sides, rule,
      {.fixed_sides = span_of(on_curves), .element_weights = weights, .mesh_is = mesh_state::valid}, bound,
      on_progress);
  summary = simplified.summary;
  return simplified;
}

template <int D>
  requires(D == 3)
simplification simplify_background(const simplicial_background<D>& mesh, const side_table<D>& sides,
                                   std::span<const double> weights, const contraction_bound& bound,
                                   const any_simplification_rule& rule, report& summary,
                                   const progress& on_progress) {
  const auto on_curves = edges_on_curves(mesh.surface);
  auto coupled = simplify_coupled(
      mesh.surface.mesh, mesh.volume, sides, rule,
      {.curve_edges = span_of(on_curves), .element_weights = weights, .meshes_are = mesh_state::valid}, bound,
      on_progress);
  summary = std::move(coupled.summary);
  return std::move(coupled.volume);
}

inline interface_angles coarse_interface_angles(const simplicial_background<3>& mesh,
                                                const side_table<3>& sides,
                                                std::span<const side_state> side_states,
                                                std::span<const local_id> subdomain_of_element,
                                                const any_sizing& size, const generate_options& options) {
  const auto boundary = subdomain_boundary<3>(mesh.volume, sides, subdomain_of_element, mesh_state::valid);
  const auto origins = triangle_origins(boundary, side_states);
  auto angles = measure_interface_angles({.points = span_of(mesh.volume.points),
                                          .triangles = span_of(boundary.sides),
                                          .subdomains = span_of(boundary.subdomains),
                                          .origins = span_of(origins),
                                          .mesh_is = mesh_state::valid},
                                         options.interface_angle_deg);
  const auto on_curves = edges_on_curves(mesh.surface);
  std::vector<local_id> curves;
  for (const auto& edge : mesh.surface.curve_edges)
    curves.push_back(edge.curve);
  find_forced(angles, boundary.sides,
              {mesh.volume.points, mesh.surface.mesh.elements, mesh.surface.mesh.tags, on_curves, curves},
              size, options.interface_angle_deg);
  return angles;
}

inline interface_angles coarse_interface_angles(const simplicial_background<2>& mesh,
                                                const side_table<2>& sides,
                                                std::span<const side_state> side_states,
                                                std::span<const local_id> subdomain_of_element,
                                                const any_sizing&, const generate_options& options) {
  return measure_corner_angles(
      {mesh.surface.mesh, sides, side_states, subdomain_of_element, {}, mesh_state::valid},
      options.surface_angle_deg);
}

/// Of the edges at which a wedge may be small: not those inside of a plane interface face, nor those inside
/// of a CAD face.
inline std::vector<std::uint32_t> half_edges_that_matter(const realized<3>& skeleton) {
  const auto& first = skeleton.patches.first_triangle;
  const std::size_t regions = skeleton.coarse.regions.size();
  std::vector<std::uint32_t> matter;
  for (std::size_t p = 0; p + 1 < first.size(); ++p) {
    const bool all = p >= regions && is_curved(skeleton.coarse.faces[p - regions], skeleton.coarse.lines);
    for (local_id t = first[p]; t < first[p + 1]; ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto ends = pick(skeleton.fine.sides[static_cast<std::size_t>(t)], numbering::sides<2>[k]);
        if (all || std::max(ends[0], ends[1]) < skeleton.patches.line_points)
          matter.push_back(static_cast<std::uint32_t>(3 * static_cast<std::size_t>(t) + k));
      }
  }
  return matter;
}

inline interface_angles fine_interface_angles(const realized<3>& skeleton, const simplicial_background<3>&,
                                              const side_table<3>& sides,
                                              std::span<const side_state> side_states, const any_sizing& size,
                                              const generate_options& options) {
  const auto& first = skeleton.patches.first_triangle;
  std::vector<triangle_origin> origins(skeleton.fine.sides.size(), triangle_origin::cad);
  for (std::size_t f = 0; f < skeleton.coarse.faces.size(); ++f) {
    const auto side = static_cast<std::size_t>(find_side<3>(sides, skeleton.coarse.faces[f].vertices));
    const std::size_t patch = skeleton.coarse.regions.size() + f;
    std::fill(origins.begin() + first[patch], origins.begin() + first[patch + 1],
              side_states[side] == side_state::refused ? triangle_origin::refused : triangle_origin::kept);
  }
  const fine_skeleton& fine = skeleton.fine;
  const std::vector<std::uint32_t> half_edges = half_edges_that_matter(skeleton);
  auto angles = measure_interface_angles({span_of(fine.points), span_of(fine.sides), span_of(fine.subdomains),
                                          span_of(origins), span_of(half_edges), mesh_state::valid},
                                         options.interface_angle_deg);
  find_forced(angles, fine.sides, {fine.points, fine.sides, fine.side_hosts, fine.curve_edges, fine.curves},
              size, options.interface_angle_deg);
  return angles;
}

/// The corners are those between the first edges of the lines at each vertex; the faces are all edges of the
/// lines between subdomains that are on no CAD curve.
inline interface_angles fine_interface_angles(const realized<2>& skeleton,
                                              const simplicial_background<2>& mesh,
                                              const side_table<2>& sides,
                                              std::span<const side_state> side_states, const any_sizing&,
                                              const generate_options& options) {
  const auto leaves = [&](local_id side, local_id vertex) {
    const auto& ends = sides.vertices[static_cast<std::size_t>(side)];
    const local_id line = find_line(skeleton.lines.keys, ends[0], ends[1]);
    const auto along = skeleton.lines.along(line, vertex);
    const auto& points = skeleton.lines.points;
    return points[static_cast<std::size_t>(along[1])] - points[static_cast<std::size_t>(along[0])];
  };
  auto angles = measure_corner_angles(
      {mesh.surface.mesh, sides, side_states, skeleton.subdomain_of_element, leaves, mesh_state::valid},
      options.surface_angle_deg);
  const auto& fine = skeleton.fine;
  angles.interface_faces = 0;
  for (std::size_t e = 0; e < fine.sides.size(); ++e)
    if (fine.side_hosts[e] == no_id && fine.subdomains[e][1] != no_id)
      ++angles.interface_faces;
  return angles;
}

/// For each small angle of a realized decomposition that is not forced: the coarse sides that it is of.
inline std::vector<std::vector<local_id>> places_of_small_angles(const realized<3>& skeleton,
                                                                 const side_table<3>& sides,
                                                                 const interface_angles& angles) {
  const auto& first = skeleton.patches.first_triangle;
  const auto regions = static_cast<std::ptrdiff_t>(skeleton.coarse.regions.size());
  std::vector<std::vector<local_id>> places;
  for (const angle_violation& v : angles.violations)
    if (v.cause != violation_cause::forced) {
      places.emplace_back();
      for (const local_id triangle : v.sides)
        if (const auto face =
                std::upper_bound(first.begin(), first.end(), triangle) - first.begin() - 1 - regions;
            face >= 0)
          places.back().push_back(
              find_side<3>(sides, skeleton.coarse.faces[static_cast<std::size_t>(face)].vertices));
    }
  return places;
}
/// None that interfaces could keep clear of.
inline std::vector<std::vector<local_id>> places_of_small_angles(const realized<2>&, const side_table<2>&,
                                                                 const interface_angles&) {
  return {};
}

} // namespace dovetail::detail
