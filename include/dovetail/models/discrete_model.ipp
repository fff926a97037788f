/// @file
/// What `discrete_model.hpp` declares.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/models/discrete/chart_surface.hpp"
#include "dovetail/models/discrete/merge.hpp"
#include "dovetail/models/discrete/read.hpp"
#include "dovetail/models/discrete/repair.hpp"
#include "dovetail/models/discrete/topology.hpp"
#include "dovetail/models/discrete_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

struct discrete_model::data {
  report repairs;
  charted_surface surface;
  geometry_topology topology;
  std::vector<discrete::polyline> curves;
  std::vector<box_tree> curve_trees; ///< per curve, over its segments
  std::vector<discrete::chart_surface> charts;
  std::vector<local_id> face_ids;
  box3 bounds;
};

DOVETAIL_INLINE discrete_model::discrete_model(const oriented_surfaces& surfaces,
                                               const discrete_options& options) {
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
      made->face_ids[made->surface.chart_of[t]] = surfaces.group_numbers[group];
  for (const vec3& p : made->surface.mesh.points)
    made->bounds.include(p);
  data_ = std::move(made);
}

DOVETAIL_INLINE discrete_model::discrete_model(std::vector<vec3> points, std::vector<simplex<2>> triangles,
                                               std::vector<local_id> ids, const discrete_options& options)
    : discrete_model(repaired({std::move(points), std::move(triangles), std::move(ids), {}}, "the surface",
                              {options.merge_tolerance, options.allow_sheets}),
                     options) {}

DOVETAIL_INLINE const geometry_topology& discrete_model::topology() const {
  return data_->topology;
}

DOVETAIL_INLINE box3 discrete_model::bounds() const {
  return data_->bounds;
}

DOVETAIL_INLINE const report& discrete_model::repairs() const {
  return data_->repairs;
}

DOVETAIL_INLINE local_id discrete_model::face_id(local_id f) const {
  return data_->face_ids[f];
}

DOVETAIL_INLINE const charted_surface& discrete_model::surface() const {
  return data_->surface;
}

DOVETAIL_INLINE std::optional<double> discrete_model::volume() const {
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

DOVETAIL_INLINE std::span<const double> discrete_model::lengths_along(local_id c) const {
  return span_of(data_->curves[c].lengths);
}

DOVETAIL_INLINE vec3 discrete_model::curve_point(local_id c, double t) const {
  const auto [segment, s] = place(c, t);
  const auto& curve = data_->curves[c];
  const vec3 a = mesh_point(curve.vertices[segment]);
  return a + s * (mesh_point(curve.vertices[segment + 1]) - a);
}

DOVETAIL_INLINE dovetail::curve_frame discrete_model::curve_frame(local_id c, double t) const {
  const std::size_t segment = place(c, t).first;
  const auto& curve = data_->curves[c];
  return {curve_point(c, t),
          normalized(mesh_point(curve.vertices[segment + 1]) - mesh_point(curve.vertices[segment]))};
}

DOVETAIL_INLINE vec2 discrete_model::curve_uv(local_id f, int k, double t) const {
  const local_id curve = topology().faces[f].coedges[k].curve;
  return data_->surface.frames[f].flat(curve_point(curve, t));
}

DOVETAIL_INLINE vec3 discrete_model::face_point(local_id f, vec2 uv) const {
  return data_->charts[f].point(uv);
}

DOVETAIL_INLINE surface_frame discrete_model::face_frame(local_id f, vec2 uv) const {
  return data_->charts[f].frame(uv);
}

DOVETAIL_INLINE double discrete_model::face_curvature(local_id f, vec2 uv) const {
  return data_->charts[f].curvature(uv);
}

DOVETAIL_INLINE vec2 discrete_model::project_to_face(local_id f, vec3 p, vec2) const {
  return data_->charts[f].project(p);
}

DOVETAIL_INLINE double discrete_model::project_to_curve(local_id c, vec3 p, double) const {
  const auto& curve = data_->curves[c];
  double best = std::numeric_limits<double>::infinity();
  double t = 0;
  data_->curve_trees[c].for_each_near(
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

DOVETAIL_INLINE vec3 discrete_model::mesh_point(local_id v) const {
  return data_->surface.mesh.points[v];
}

DOVETAIL_INLINE std::pair<std::size_t, double> discrete_model::place(local_id c, double t) const {
  const auto& lengths = data_->curves[c].lengths;
  const auto after = std::upper_bound(lengths.begin() + 1, lengths.end() - 1, t);
  const auto segment = static_cast<std::size_t>(after - lengths.begin()) - 1;
  const double s = (t - lengths[segment]) / (lengths[segment + 1] - lengths[segment]);
  return {segment, std::clamp(s, 0.0, 1.0)};
}

DOVETAIL_INLINE void discrete_model::add_charts(data& d) {
  const auto& s = d.surface;
  const auto curvatures = triangle_curvatures(s);
  std::vector<std::vector<std::array<vec3, 3>>> triangles(s.frames.size());
  std::vector<std::vector<double>> curvature(s.frames.size());
  for (std::size_t t = 0; t < s.mesh.elements.size(); ++t) {
    const auto& v = s.mesh.elements[t];
    const std::size_t chart = s.chart_of[t];
    triangles[chart].push_back({s.mesh.points[v[0]], s.mesh.points[v[1]], s.mesh.points[v[2]]});
    curvature[chart].push_back(curvatures[t]);
  }
  for (std::size_t f = 0; f < s.frames.size(); ++f)
    d.charts.emplace_back(s.frames[f], std::move(triangles[f]), std::move(curvature[f]));
  for (const auto& curve : d.curves) {
    std::vector<box3> boxes;
    for (std::size_t i = 0; i + 1 < curve.vertices.size(); ++i) {
      box3 box;
      box.include(s.mesh.points[curve.vertices[i]]);
      box.include(s.mesh.points[curve.vertices[i + 1]]);
      boxes.push_back(box);
    }
    d.curve_trees.emplace_back(boxes);
  }
}

DOVETAIL_INLINE std::vector<double> discrete_model::triangle_curvatures(const charted_surface& s) {
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
    return std::array<vec3, 3>{s.mesh.points[v[0]], s.mesh.points[v[1]], s.mesh.points[v[2]]};
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
      curvatures[t] = std::max(curvatures[t], angle_between(normals[t][k], normals[t][(k + 1) % 3]) / length);
    }
  }
  return curvatures;
}

DOVETAIL_INLINE discrete_model read_discrete_model(const std::filesystem::path& file,
                                                   const discrete_options& options) {
  return discrete_model(
      repaired_file(read_triangles(file), file.string(), {options.merge_tolerance, options.allow_sheets}),
      options);
}

#ifdef DOVETAIL_COMPILED
template any_geometry::any_geometry(discrete_model);
#endif

} // namespace dovetail
