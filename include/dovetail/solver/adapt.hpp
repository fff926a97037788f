/// @file
/// A mesh made anew in other sizes, on the boundary that it has: the step between an estimate of the error
/// and the next solution.
#pragma once

#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/models/discrete/mesh_boundary.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/erased.hpp"
#include "dovetail/solver/adaptation_options.hpp"

#include <concepts>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace dovetail {

/// A mesh with what has to outlast an adaptation. Numbers of materials and ids are one's own.
template <int D>
struct adaptable_mesh {
  simplicial_mesh<D> mesh; ///< tags: materials (D = 3), ids of surfaces (D = 2); none: all are 0
  /// Sides with ids, in any orientation: on the boundary or between materials (D = 3), or between ids (D =
  /// 2). Edges between two ids (D = 3), and points between two (D = 2), stay where they are. Sides that are
  /// not listed have none.
  std::vector<simplex<D - 1>> sides = {};
  std::vector<local_id> side_ids = {}; ///< by side: its id
  /// Per element: the part of the adaptation that made it, for solvers in parallel; not looked at.
  std::vector<local_id> subdomains = {};
};

/// How large a mesh is, and by how much its chords cut it short.
struct mesh_extent {
  double volume = 0; ///< D = 3
  double area = 0;   ///< of the boundary and of interfaces (D = 3), of all triangles (D = 2)
  /// What a smooth surface through the boundary's points encloses more, as the angles between triangles tell
  /// (D = 3); how much larger it is (D = 2).
  double chord_gap = 0;
};

/// A generated mesh, with the model that it was made on: the one given, or that of the old one's boundary.
/// Its summary's part "adaptation" has "volume_before" and "volume_after" (D = 3), "area_before",
/// "area_after", and "explained_change", of the volume (D = 3) or area, by chords that are shorter or longer
/// than they were; a warning tells of more.
template <int D>
struct adapted : generated<D> {
  any_geometry model;               ///< the model that the mesh is on
  std::vector<local_id> id_of_face; ///< per face of the model, which side_hosts and tags (D = 2) refer to
  std::vector<local_id>
      material_of_solid;                  ///< per solid of the model: `material` of pieces is a solid (D = 3)
  std::vector<local_id> id_of_curve = {}; ///< per curve of the model: that of the edges on it (D = 2)
};

/// What a mesh is meshed again on. Of the mesh's own boundary: smooth between its points as its normals tell,
/// so that boundaries hardly shrink from one adaptation to the next.
template <int D>
struct boundary_model {
  any_geometry model;                      ///< what is meshed
  std::vector<local_id> id_of_face;        ///< by face of the model: the id of the mesh
  std::vector<local_id> material_of_solid; ///< by solid of the model: the material of the mesh
  std::vector<std::string> warnings;       ///< what the report is to tell
  std::vector<local_id> id_of_curve = {};  ///< D = 2
  mesh_extent before = {};                 ///< of the mesh
  /// Of a model that was given: the mesh's boundary, by which ids and materials are found as soon as the
  /// model is triangulated; the three lists are empty until then.
  std::optional<std::conditional_t<D == 3, mesh_boundary, adaptable_mesh<2>>> named_by = {};
};

/// Throws `mesh_error` for a mesh without elements or with faults, and when there is not one id per side.
template <int D>
boundary_model<D> model_of_boundary(const adaptable_mesh<D>& old,
                                    double feature_angle_deg = adaptation_options{}.feature_angle_deg);

/// The model that a mesh is a mesh of. Throws what `model_of_boundary` throws.
template <int D>
boundary_model<D> model_of_mesh(const any_geometry& model, const adaptable_mesh<D>& old);

/// The field of sizes at the points of a mesh: linear in its elements, with limited growth. Throws
/// `sizing_error` when there is not one positive, finite size per point.
template <int D>
erased_sizing sizes_at_points(const simplicial_mesh<D>& mesh, std::vector<double> sizes, double growth);

/// Meshes the model of a boundary: what `adapt` does when it has made it. Throws what `generate` throws, and
/// `mesh_error` when the mesh is not one of a model that was given, or has ids or materials on parts of its
/// faces or solids.
/// Complexity: that of `generate`.
/// \param boundary the boundary and its model
/// \param size a sizing field
/// \param given policies and options
template <int D, bound_parameters<D> Parameters>
adapted<D> mesh_again(boundary_model<D> boundary, const erased_sizing& size, const Parameters& given);

namespace detail {

/// Whether there are sizes; where not, the compiler's first error says what was expected.
template <class Sizes>
consteval bool checked_sizes() {
  constexpr bool are_sizes = sizing_field<Sizes> || std::convertible_to<Sizes, std::vector<double>>;
  static_assert(are_sizes, "adapt<D> takes a size for each point, or a sizing_field (sizing/concepts.hpp)");
  return are_sizes;
}

template <int D, class Sizes>
erased_sizing sizes_to_adapt_to(const adaptable_mesh<D>& old, const Sizes& sizes,
                                const adaptation_options& options) {
  if constexpr (sizing_field<Sizes>)
    return erased_sizing(sizes);
  else
    return sizes_at_points(old.mesh, sizes, options.growth);
}

} // namespace detail

/// Makes a mesh of what `old` is a mesh of, sized by `sizes`: values at its points, or a sizing field. The
/// boundary is that of `old`, made smooth between its points; features, interfaces of materials and edges
/// between ids stay where they are, and materials and ids are the same again. The old elements are not used.
///
///     auto next = adapt<3>(old, sizes, parameters<>{}.with_mesher(mesher::tetgen{}));
///     adaptable_mesh<3> mesh = whole_mesh(next);
///
/// Where a boundary is coarse for its curvature it loses volume bit by bit, finer sizes or not, and a warning
/// tells; on a model it does not. Throws what `model_of_boundary`, `sizes_at_points` and `generate` throw.
/// Complexity: that of `generate`.
/// \param old elements with materials, and sides with ids
/// \param sizes one edge length per point of `old`, or a sizing field
/// \param policies policies and options, as for `generate`
/// \param options feature angle and growth of sizes
template <int D, class Sizes, class Parameters>
adapted<D> adapt(const adaptable_mesh<D>& old, const Sizes& sizes, const Parameters& policies,
                 const adaptation_options& options = {}) {
  if constexpr (detail::checked_sizes<Sizes>() && detail::checked_parameters<D, Parameters>()) {
    const auto& given = bind_parameters<D>(policies);
    const auto size = detail::sizes_to_adapt_to(old, sizes, options);
    return mesh_again<D>(model_of_boundary(old, options.feature_angle_deg), size, given);
  }
}

/// The same on the model that `old` is a mesh of: the geometry is the model's, and nothing drifts, however
/// often. Ids of sides are found again by place: of faces (D = 3), or of faces and curves (D = 2), each of
/// which must have one as a whole, and materials as those of solids.
///
///     mesh = whole_mesh(adapt<3>(model, mesh, sizes, policies));
///
/// Where there is no model, that of the first adaptation, `adapted::model`, serves all the others. Throws
/// what the first form throws, and what `mesh_again` does.
/// \param model the model that `old` is a mesh of; without it one is made of its boundary
template <int D, class G, class Sizes, class Parameters>
adapted<D> adapt(const G& model, const adaptable_mesh<D>& old, const Sizes& sizes, const Parameters& policies,
                 const adaptation_options& options = {}) {
  constexpr bool is_model = geometry_model<G>;
  static_assert(is_model,
                "adapt<D>(model, mesh, sizes, policies) takes a geometry_model (geometry/concepts.hpp)");
  if constexpr (is_model && detail::checked_sizes<Sizes>() && detail::checked_parameters<D, Parameters>()) {
    const auto& given = bind_parameters<D>(policies);
    const auto size = detail::sizes_to_adapt_to(old, sizes, options);
    return mesh_again<D>(model_of_mesh<D>(any_geometry(model), old), size, given);
  }
}

/// An adapted mesh in one piece, with the old numbers of materials and ids: to be solved on, and adapted
/// again. Throws what `io::gather` throws.
/// Linear.
/// \param made what `adapt` gives
template <int D>
adaptable_mesh<D> whole_mesh(const adapted<D>& made);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/solver/adapt.ipp"
#endif
