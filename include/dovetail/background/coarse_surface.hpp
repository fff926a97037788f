/// @file
/// The coarse surface mesh of a CAD model: closed, conforming, oriented, every vertex on its CAD entity.
///
/// Curves are spaced first, once for all faces at them; then every face is meshed as one region
/// (`mesh_regions`). What is wrong with a face after that (loops that cross in its parameter plane, folds,
/// triangles that two faces have in common) refines the curves concerned, and the faces at them are done
/// again; so does a caller who wants the whole finer at some places.
#pragma once

#include "dovetail/core/progress.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/remesh/mesh_regions.hpp"
#include "dovetail/sizing/concepts.hpp"
#include "dovetail/sizing/size_balls.hpp"

#include <functional>
#include <vector>

namespace dovetail::background {

/// A coarse surface mesh.
struct coarse_surface_result {
  surface_mesh surface; ///< with the faces and curves of the model that its entities lie on
  /// Where the surface needs smaller sizes than given: its curvature, and the places refined. Meant with
  /// `coarse_surface_parameters::growth`.
  std::vector<size_ball> bounds;
  report summary; ///< what was counted on the way
};

/// What is counted of a coarse surface.
struct coarse_surface_counts {
  std::size_t triangles = 0;     ///< how many there are
  std::size_t points = 0;        ///< how many there are
  double min_angle_deg = 0;      ///< the smallest of all
  double mean_min_angle_deg = 0; ///< of the smallest angles of triangles
  int rounds = 0;                ///< of refinement where faces failed
  std::size_t size_balls = 0;    ///< of `coarse_surface_result::bounds`
  int refinement_rounds = 0;     ///< by `coarse_surface_parameters::finer_at`

  using fields = field_list<&coarse_surface_counts::triangles, &coarse_surface_counts::points,
                            &coarse_surface_counts::min_angle_deg, &coarse_surface_counts::mean_min_angle_deg,
                            &coarse_surface_counts::rounds, &coarse_surface_counts::size_balls,
                            &coarse_surface_counts::refinement_rounds>;
};

/// Parameters of `coarse_surface`.
struct coarse_surface_parameters {
  double turn = 0.785398163397448; ///< largest turn of curve and surface per edge, in radians (45 degrees)
  double growth = 0.3;             ///< growth of the size away from curvature, per unit of length
  double smallest_fraction = 0.1;  ///< curvature refines to no less than this times the given size
  int rounds = 10;                 ///< most rounds of refinement where faces fail
  /// Looks at each surface that is whole: the places where it must be finer, such as where two sheets are
  /// near; none when it will do. Faces out of reach of new places are not meshed again.
  std::function<std::vector<size_ball>(const coarse_surface_result&)> finer_at = {};
  progress on_progress = {}; ///< told how faces come along
};

namespace detail {

/// Meshes regions of the model at a size.
template <geometry_model Geometry>
using regions_mesher = std::function<meshed_regions(region_set<Geometry>&, const refined_sizing&,
                                                    region_memo&, const mesh_regions_options&)>;

/// `coarse_surface` by such a function.
template <geometry_model Geometry, sizing_field Size>
coarse_surface_result coarse_surface_by(const Geometry& model, const Size& sizing,
                                        const coarse_surface_parameters& parameters,
                                        const regions_mesher<Geometry>& mesh_them);

} // namespace detail

/// Meshes the surface of `model` with edges of about min(`sizing`, curvature bound, diagonal / 4). Triangles
/// are oriented as `surface_mesh` says. Complexity: about linear in the number of triangles; faces run
/// through the executor. Throws `geometry_error` or `mesher_error` naming the face that cannot be meshed, and
/// what `finer_at` throws.
/// \param model whose faces are meshed
/// \param sizing edge lengths, in the model's unit
/// \param parameters growth of sizes, curvature, and what looks at the surface
/// \param run_tasks meshes curves and faces, a task each; the result does not depend on it
/// \param mesher meshes a face between its curves
template <geometry_model Geometry, sizing_field Size, executor Executor, surface_mesher Mesher>
coarse_surface_result coarse_surface(const Geometry& model, const Size& sizing,
                                     const coarse_surface_parameters& parameters, const Executor& run_tasks,
                                     const Mesher& mesher) {
  const auto mesh_them = [&](region_set<Geometry>& faces, const refined_sizing& size, region_memo& made,
                             const mesh_regions_options& options) {
    return mesh_regions(model, faces, mesher, size, run_tasks, made, options);
  };
  return detail::coarse_surface_by<Geometry>(model, sizing, parameters, mesh_them);
}

} // namespace dovetail::background

#include "dovetail/background/coarse_surface_maker.hpp"
