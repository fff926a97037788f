/// @file
/// A triangulated surface as a geometry model.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/models/discrete/chart_surface.hpp"
#include "dovetail/models/discrete/merge.hpp"
#include "dovetail/models/discrete/read.hpp"
#include "dovetail/models/discrete/repair.hpp"
#include "dovetail/models/discrete/topology.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
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
  explicit discrete_model(const oriented_surfaces& surfaces, const discrete_options& options = {}) {
    auto made = std::make_shared<data>();
    made->repairs = surfaces.repairs;
    made->surface = charted(surfaces, {.feature_angle_deg = options.feature_angle_deg});
    auto network =
        discrete::topology_builder(made->surface, surfaces.group_names, options.feature_angle_deg).run();
    made->topology = std::move(network.topology);
    made->curves = std::move(network.curves);
    add_charts(*made);
    made->face_ids.assign(made->topology.faces.size(), no_id);
    for (std::size_t t = 0; t < made->surface.chart_of.size(); ++t)
      if (const local_id group = made->surface.group_of[t]; group != no_id)
        made->face_ids[index(made->surface.chart_of[t])] = surfaces.group_numbers[index(group)];
    for (const vec3& p : made->surface.mesh.points)
      made->bounds.include(p);
    data_ = std::move(made);
  }

  /// From arrays of one's own: triangles on points, in any orientation, and per triangle a number that comes
  /// back as `face_id`, and in files as the name of a group (empty: none). An edge between two numbers is a
  /// feature. Throws `geometry_error` for arrays that do not fit together and for a surface that `repaired`
  /// refuses.
  discrete_model(std::vector<vec3> points, std::vector<simplex<2>> triangles, std::vector<local_id> ids = {},
                 const discrete_options& options = {})
      : discrete_model(repaired({std::move(points), std::move(triangles), std::move(ids), {}}, "the surface",
                                {options.merge_tolerance, options.allow_sheets}),
                       options) {}

  const geometry_topology& topology() const { return data_->topology; }
  box3 bounds() const { return data_->bounds; }
  bool thread_safe() const { return true; }
  /// What was done to the triangles, with warnings.
  const report& repairs() const { return data_->repairs; }
  /// The number that came with the triangles of face f: one's own, or the index of a name; or no_id.
  local_id face_id(local_id f) const { return data_->face_ids[index(f)]; }
  /// The triangles, split where charts end; `chart_of` is the face of each.
  const charted_surface& surface() const { return data_->surface; }

  /// The volume of all solids, exactly.
  std::optional<double> volume() const {
    const charted_surface& s = data_->surface;
    const vec3 origin = data_->bounds.center();
    double sum = 0;
    for (std::size_t t = 0; t < s.mesh.elements.size(); ++t) {
      const auto& v = s.mesh.elements[t];
      const double cone = signed_volume(origin, mesh_point(v[0]), mesh_point(v[1]), mesh_point(v[2]));
      sum += (s.solid_of[t] != no_id ? cone : 0) - (s.front_of[t] != no_id ? cone : 0);
    }
    return sum;
  }

  /// The parameters of a curve's corners, where edges of triangles meet: ascending.
  std::span<const double> lengths_along(local_id c) const { return span_of(data_->curves[index(c)].lengths); }

  vec3 curve_point(local_id c, double t) const {
    const auto [segment, s] = place(c, t);
    const auto& curve = data_->curves[index(c)];
    const vec3 a = mesh_point(curve.vertices[segment]);
    return a + s * (mesh_point(curve.vertices[segment + 1]) - a);
  }
  dovetail::curve_frame curve_frame(local_id c, double t) const {
    const std::size_t segment = place(c, t).first;
    const auto& curve = data_->curves[index(c)];
    return {curve_point(c, t),
            normalized(mesh_point(curve.vertices[segment + 1]) - mesh_point(curve.vertices[segment]))};
  }
  vec2 curve_uv(local_id f, int k, double t) const {
    const local_id curve = topology().faces[index(f)].coedges[static_cast<std::size_t>(k)].curve;
    return data_->surface.frames[index(f)].flat(curve_point(curve, t));
  }

  vec3 face_point(local_id f, vec2 uv) const { return data_->charts[index(f)].point(uv); }
  surface_frame face_frame(local_id f, vec2 uv) const { return data_->charts[index(f)].frame(uv); }
  double face_curvature(local_id f, vec2 uv) const { return data_->charts[index(f)].curvature(uv); }
  vec2 project_to_face(local_id f, vec3 p, vec2) const { return data_->charts[index(f)].project(p); }

  double project_to_curve(local_id c, vec3 p, double) const {
    const auto& curve = data_->curves[index(c)];
    double best = std::numeric_limits<double>::infinity();
    double t = 0;
    data_->curve_trees[index(c)].for_each_near(
        p, [&](const box3& box, std::size_t) { return distance_squared(box, p) <= best; },
        [&](local_id id) {
          const auto segment = static_cast<std::size_t>(id);
          const vec3 a = mesh_point(curve.vertices[segment]);
          const vec3 b = mesh_point(curve.vertices[segment + 1]);
          const double s = nearest_on_segment(a, b, p)[1];
          const double away = norm_squared(a + s * (b - a) - p);
          const double here =
              curve.lengths[segment] + s * (curve.lengths[segment + 1] - curve.lengths[segment]);
          if (away < best || (away == best && here < t)) {
            best = away;
            t = here;
          }
        });
    return t;
  }

private:
  struct data {
    report repairs;
    charted_surface surface;
    geometry_topology topology;
    std::vector<discrete::polyline> curves;
    std::vector<box_tree> curve_trees; ///< per curve, over its segments
    std::vector<discrete::chart_surface> charts;
    std::vector<local_id> face_ids;
    box3 bounds;
  };

  static std::size_t index(local_id id) { return static_cast<std::size_t>(id); }
  vec3 mesh_point(local_id v) const { return data_->surface.mesh.points[index(v)]; }

  /// The segment of a polyline at arc length t, and the share of it that lies before t.
  std::pair<std::size_t, double> place(local_id c, double t) const {
    const auto& lengths = data_->curves[index(c)].lengths;
    const auto after = std::upper_bound(lengths.begin() + 1, lengths.end() - 1, t);
    const auto segment = static_cast<std::size_t>(after - lengths.begin()) - 1;
    const double s = (t - lengths[segment]) / (lengths[segment + 1] - lengths[segment]);
    return {segment, std::clamp(s, 0.0, 1.0)};
  }

  static void add_charts(data& d) {
    const auto& s = d.surface;
    const auto curvatures = triangle_curvatures(s);
    std::vector<std::vector<std::array<vec3, 3>>> triangles(s.frames.size());
    std::vector<std::vector<double>> curvature(s.frames.size());
    for (std::size_t t = 0; t < s.mesh.elements.size(); ++t) {
      const auto& v = s.mesh.elements[t];
      const auto chart = index(s.chart_of[t]);
      triangles[chart].push_back(
          {s.mesh.points[index(v[0])], s.mesh.points[index(v[1])], s.mesh.points[index(v[2])]});
      curvature[chart].push_back(curvatures[t]);
    }
    for (std::size_t f = 0; f < s.frames.size(); ++f)
      d.charts.emplace_back(s.frames[f], std::move(triangles[f]), std::move(curvature[f]));
    for (const auto& curve : d.curves) {
      std::vector<box3> boxes;
      for (std::size_t i = 0; i + 1 < curve.vertices.size(); ++i) {
        box3 box;
        box.include(s.mesh.points[index(curve.vertices[i])]);
        box.include(s.mesh.points[index(curve.vertices[i + 1])]);
        boxes.push_back(box);
      }
      d.curve_trees.emplace_back(boxes);
    }
  }

  /// Per triangle, the largest turn of the smooth area's vertex normals along an edge, over the edge's
  /// length.
  static std::vector<double> triangle_curvatures(const charted_surface& s) {
    struct corner {
      local_id group;
      local_id vertex;
      std::size_t triangle;
      std::size_t which;
    };
    std::vector<corner> corners;
    for (std::size_t t = 0; t < s.mesh.elements.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i)
        corners.push_back({s.smooth_of[t], s.mesh.elements[t][i], t, i});
    std::sort(corners.begin(), corners.end(), [](const corner& a, const corner& b) {
      return std::tie(a.group, a.vertex, a.triangle) < std::tie(b.group, b.vertex, b.triangle);
    });
    const auto corner_points = [&](std::size_t t) {
      const auto& v = s.mesh.elements[t];
      return std::array<vec3, 3>{s.mesh.points[index(v[0])], s.mesh.points[index(v[1])],
                                 s.mesh.points[index(v[2])]};
    };
    std::vector<std::array<vec3, 3>> normals(s.mesh.elements.size());
    for (std::size_t i = 0; i < corners.size();) {
      std::size_t end = i;
      vec3 normal;
      for (; end < corners.size() && corners[end].group == corners[i].group &&
             corners[end].vertex == corners[i].vertex;
           ++end) {
        const auto p = corner_points(corners[end].triangle);
        const std::size_t k = corners[end].which;
        const vec3 a = p[(k + 1) % 3] - p[k];
        const vec3 b = p[(k + 2) % 3] - p[k];
        normal += angle_between(a, b) * normalized(cross(a, b));
      }
      for (; i < end; ++i)
        normals[corners[i].triangle][corners[i].which] = normalized(normal);
    }
    std::vector<double> curvatures(s.mesh.elements.size(), 0);
    for (std::size_t t = 0; t < curvatures.size(); ++t) {
      const auto p = corner_points(t);
      double longest = 0;
      for (std::size_t k = 0; k < 3; ++k)
        longest = std::max(longest, distance(p[k], p[(k + 1) % 3]));
      for (std::size_t k = 0; k < 3; ++k) {
        const double length =
            std::max(distance(p[k], p[(k + 1) % 3]), 1e-2 * longest); // slivers have no curvature
        curvatures[t] =
            std::max(curvatures[t], angle_between(normals[t][k], normals[t][(k + 1) % 3]) / length);
      }
    }
    return curvatures;
  }

  std::shared_ptr<const data> data_;
};

static_assert(geometry_model<discrete_model>);

/// Reads an STL, OBJ, OFF or PLY file and makes a model of it; its repairs warn of triangles that were listed
/// twice or the wrong way round. Throws `input_error` for a bad file and
/// `geometry_error` for a surface that is not manifold, one-sided, crosses itself or, unless sheets are
/// allowed, is open; both name the file.
inline discrete_model read_discrete_model(const std::filesystem::path& file,
                                          const discrete_options& options = {}) {
  return discrete_model(
      repaired_file(read_triangles(file), file.string(), {options.merge_tolerance, options.allow_sheets}),
      options);
}

} // namespace dovetail
