/// @file
/// What the vertices of a triangulation stay on while it is improved.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/ids.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace dovetail {

/// A point of a surface: its place, the unit normal there (along the normals of the mesh's triangles; zero
/// where the surface is singular) and its parameters.
struct host_point {
  vec3 point;  ///< on the surface
  vec3 normal; ///< of unit length
  vec2 uv;     ///< of the surface
};

/// The surface under a mesh of triangles, any kind of surface behind two functions. An empty one stands for
/// the triangles themselves: vertices then stay on the mesh that was given, exactly in its planes where it is
/// plane. See `host_on_model` for CAD faces.
struct surface_host {
  /// The point of face `face` (the triangle's tag; 0 without tags) nearest `p`, searched from parameters
  /// `near`.
  std::function<host_point(local_id face, vec3 p, vec2 near)> project;
  /// The point of a face at known parameters; needed only together with `corner_uv`.
  std::function<host_point(local_id face, vec2 uv)> evaluate = {};
  /// Parameters per triangle and corner to start from; empty when unknown: searches then start from (0, 0).
  std::vector<std::array<vec2, 3>> corner_uv = {};
  /// The unit normal of a face that is a plane, along those of its triangles; zero for others; may be empty.
  /// Vertices move in planes without calls, and keep the parameters they started from.
  std::function<vec3(local_id face)> plane_normal = {};

  explicit operator bool() const { return static_cast<bool>(project); } ///< whether there is a surface
};

/// Whether every face that is named is known to be a plane, or there is no host.
inline bool is_plane_throughout(const surface_host& host, const std::vector<local_id>& faces) {
  if (!host)
    return true;
  if (!host.plane_normal || faces.empty())
    return false;
  for (std::size_t t = 0; t < faces.size(); ++t)
    if ((t == 0 || faces[t] != faces[t - 1]) && !(norm_squared(host.plane_normal(faces[t])) > 0))
      return false;
  return true;
}

/// The sides of all triangles at poles: there parameters belong to a corner and not to a vertex, so these
/// triangles are left alone.
inline std::vector<simplex<1>> sides_at_poles(const simplicial_mesh<2>& mesh,
                                              const std::vector<bool>& is_pole) {
  std::vector<simplex<1>> sides;
  for (const auto& [a, b, c] : mesh.elements)
    if (is_pole[static_cast<std::size_t>(a)] || is_pole[static_cast<std::size_t>(b)] ||
        is_pole[static_cast<std::size_t>(c)])
      for (const simplex<1> side : {simplex<1>{a, b}, {b, c}, {c, a}})
        sides.push_back(side);
  return sides;
}

namespace improvement {

/// A triangulation as the host of its own improvement: nearest points are found by walking downhill from a
/// triangle nearby, never across a fixed side, as triangles know each other through vertices of one patch.
class triangle_host {
public:
  triangle_host() = default;
  /// `normals` are per vertex. Vertices on both sides of a fixed side must be different ones.
  triangle_host(std::vector<vec3> points, std::vector<simplex<2>> triangles, std::vector<vec3> normals)
      : points_(std::move(points)), triangles_(std::move(triangles)), normals_(std::move(normals)),
        around_(sorted_into_rows<local_id>(points_.size(), [this](const auto& put) {
          for (std::size_t t = 0; t < triangles_.size(); ++t)
            for (const local_id v : triangles_[t])
              put(v, static_cast<local_id>(t));
        })) {}

  /// The point near p on the triangles around `on`, which becomes the triangle it lies on. O(steps taken).
  host_point project(vec3 p, local_id& on) const {
    found best = nearest(on, p);
    for (int step = 0; step < most_steps; ++step) {
      const auto& inside = best.weights;
      if (inside[0] > 0 && inside[1] > 0 && inside[2] > 0)
        break;
      const local_id from = on;
      for (const local_id v : triangles_[at(from)])
        for (const local_id t : around_[v])
          if (const found other = nearest(t, p); other.distance_squared < best.distance_squared) {
            best = other;
            on = t;
          }
      if (on == from)
        break;
    }
    const auto& [a, b, c] = triangles_[at(on)];
    const auto& w = best.weights;
    return {
        best.point, normalized(w[0] * normals_[at(a)] + w[1] * normals_[at(b)] + w[2] * normals_[at(c)]), {}};
  }

private:
  static constexpr int most_steps = 100;
  struct found {
    std::array<double, 3> weights;
    vec3 point;
    double distance_squared;
  };
  static std::size_t at(local_id i) { return static_cast<std::size_t>(i); }
  found nearest(local_id t, vec3 p) const {
    const auto& [a, b, c] = triangles_[at(t)];
    const auto w = nearest_on_triangle(points_[at(a)], points_[at(b)], points_[at(c)], p);
    const vec3 q = w[0] * points_[at(a)] + w[1] * points_[at(b)] + w[2] * points_[at(c)];
    return {w, q, norm_squared(q - p)};
  }

  std::vector<vec3> points_;
  std::vector<simplex<2>> triangles_;
  std::vector<vec3> normals_;
  compressed_rows<local_id> around_; ///< per vertex: its triangles
};

} // namespace improvement
} // namespace dovetail
