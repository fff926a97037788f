/// @file
/// Normals and frames of clusters of a triangulated surface.
#pragma once

#include "dovetail/geometry/frame.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <vector>

namespace dovetail::discrete {

inline constexpr double radians_per_degree = std::numbers::pi / 180; ///< to turn degrees into radians

/// Normals and frames of clusters of a mesh. Slivers, whose normals are rounding, do not count.
class cluster_measures {
public:
  explicit cluster_measures(const simplicial_mesh<2>& mesh) : mesh_(&mesh) {
    box3 box;
    for (const vec3& p : mesh.points)
      box.include(p);
    diagonal_ = box.diagonal();
    sliver_height_ = 1e-6 * diagonal_;
  }

  double diagonal() const { return diagonal_; }                    ///< of the mesh's box
  std::size_t point_count() const { return mesh_->points.size(); } ///< points of the mesh
  /// The vertices of a triangle.
  const simplex<2>& corners(std::size_t t) const { return mesh_->elements[t]; }
  vec3 point(local_id v) const { return mesh_->points[v]; } ///< where a vertex is
  /// Along the normal, twice the area long.
  vec3 area_vector(std::size_t t) const {
    const auto& v = mesh_->elements[t];
    return cross(point(v[1]) - point(v[0]), point(v[2]) - point(v[0]));
  }
  /// The middle of a triangle.
  vec3 centroid(std::size_t t) const {
    const auto& v = mesh_->elements[t];
    return (point(v[0]) + point(v[1]) + point(v[2])) / 3;
  }
  /// Whether a triangle is so flat that its normal is rounding.
  bool is_sliver(std::size_t t) const {
    const auto& v = mesh_->elements[t];
    const double longest = std::max({distance(point(v[0]), point(v[1])), distance(point(v[1]), point(v[2])),
                                     distance(point(v[2]), point(v[0]))});
    return norm(area_vector(t)) <= sliver_height_ * longest;
  }

  /// The frame along the mean normal, its origin at the mean point.
  chart_frame frame_of(const std::vector<std::size_t>& cluster) const {
    vec3 normal;
    vec3 center;
    double area = 0;
    for (const std::size_t t : cluster) {
      const vec3 n = area_vector(t);
      normal += n;
      area += norm(n);
      center += norm(n) * centroid(t);
    }
    return frame_along(center / area, norm(normal) > 1e-9 * area ? normal : area_vector(cluster.front()));
  }

  /// Whether no normal of the cluster is further from `axis` than the angle of that cosine; slivers do not
  /// count.
  bool within_cone(const std::vector<std::size_t>& cluster, vec3 axis, double cosine) const {
    return std::all_of(cluster.begin(), cluster.end(), [&](std::size_t t) {
      return is_sliver(t) || dot(normalized(area_vector(t)), axis) >= cosine;
    });
  }

private:
  const simplicial_mesh<2>* mesh_;
  double diagonal_ = 0;
  double sliver_height_ = 0;
};

} // namespace dovetail::discrete
