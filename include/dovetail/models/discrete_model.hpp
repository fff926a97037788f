/// @file
/// A triangulated surface as a geometry model.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/models/discrete/charted_surface.hpp"
#include "dovetail/models/discrete/oriented_surfaces.hpp"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// How triangles become a model.
struct discrete_options {
  double feature_angle_deg = 40; ///< an edge whose triangles turn by more is a feature curve
  double merge_tolerance =
      1e-6; ///< of the diagonal; points this near are one where the surface is open otherwise
  bool allow_sheets = false; ///< surfaces may be open, for meshes of triangles
};

/// A model of `geometry_model` made of triangles. Smooth areas between feature edges are cut into charts
/// whose normals lie in a cone, so that each is the graph of a height over its mean plane: a face of the
/// model, whose parameters are coordinates in that plane, in the unit of length. Charts end at extra curves
/// that are no features. Immutable and shared: copies are cheap. Queries are thread-safe, O(log n);
/// projection to a face finds the nearest point of the chart and needs no seed.
class discrete_model {
public:
  /// Throws `geometry_error` when charts cannot be made.
  explicit discrete_model(const oriented_surfaces& surfaces, const discrete_options& options = {});

  /// From arrays of one's own: triangles on points, in any orientation, and per triangle a number that comes
  /// back as `face_id`, and in files as the name of a group (empty: none). An edge between two numbers is a
  /// feature. Throws `geometry_error` for arrays that do not fit together and for a surface that `repaired`
  /// refuses.
  discrete_model(std::vector<vec3> points, std::vector<simplex<2>> triangles, std::vector<local_id> ids = {},
                 const discrete_options& options = {});

  const geometry_topology& topology() const;
  box3 bounds() const;
  bool thread_safe() const { return true; }
  /// What was done to the triangles, with warnings.
  const report& repairs() const;
  /// The number that came with the triangles of face f: one's own, or the index of a name; or no_id.
  local_id face_id(local_id f) const;
  /// The triangles, split where charts end; `chart_of` is the face of each.
  const charted_surface& surface() const;

  /// The volume of all solids, exactly.
  std::optional<double> volume() const;

  /// The parameters of a curve's corners, where edges of triangles meet: ascending.
  std::span<const double> lengths_along(local_id c) const;

  vec3 curve_point(local_id c, double t) const;
  dovetail::curve_frame curve_frame(local_id c, double t) const;
  vec2 curve_uv(local_id f, int k, double t) const;

  vec3 face_point(local_id f, vec2 uv) const;
  surface_frame face_frame(local_id f, vec2 uv) const;
  double face_curvature(local_id f, vec2 uv) const;
  vec2 project_to_face(local_id f, vec3 p, vec2) const;

  double project_to_curve(local_id c, vec3 p, double) const;

private:
  struct data;

  vec3 mesh_point(local_id v) const;

  /// The segment of a polyline at arc length t, and the share of it that lies before t.
  std::pair<std::size_t, double> place(local_id c, double t) const;

  static void add_charts(data& d);

  /// Per triangle, the largest turn of the smooth area's vertex normals along an edge, over the edge's
  /// length.
  static std::vector<double> triangle_curvatures(const charted_surface& s);

  std::shared_ptr<const data> data_;
};

static_assert(geometry_model<discrete_model>);

#ifdef DOVETAIL_COMPILED
extern template any_geometry::any_geometry(discrete_model);
#endif

/// Reads an STL, OBJ, OFF or PLY file and makes a model of it; its repairs warn of triangles that were listed
/// twice or the wrong way round. Throws `input_error` for a bad file and
/// `geometry_error` for a surface that is not manifold, one-sided, crosses itself or, unless sheets are
/// allowed, is open; both name the file.
/// About n log n in the triangles, per round in which charts are cut or merged.
/// \param file an STL (ASCII or binary), OBJ, OFF or PLY file
/// \param options feature angle, merge tolerance, whether sheets may be open
discrete_model read_discrete_model(const std::filesystem::path& file, const discrete_options& options = {});

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/discrete_model.ipp"
#endif
