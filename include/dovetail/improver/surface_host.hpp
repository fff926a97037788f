/// @file
/// What the vertices of a triangulation stay on while it is improved.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/ids.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <array>
#include <cstddef>
#include <functional>
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
bool is_plane_throughout(const surface_host& host, const std::vector<local_id>& faces);

/// The sides of all triangles at poles: there parameters belong to a corner and not to a vertex, so these
/// triangles are left alone.
std::vector<simplex<1>> sides_at_poles(const simplicial_mesh<2>& mesh, const std::vector<bool>& is_pole);

namespace improvement {

/// A triangulation as the host of its own improvement: nearest points are found by walking downhill from a
/// triangle nearby, never across a fixed side, as triangles know each other through vertices of one patch.
class triangle_host {
public:
  triangle_host() = default;
  /// `normals` are per vertex. Vertices on both sides of a fixed side must be different ones.
  triangle_host(std::vector<vec3> points, std::vector<simplex<2>> triangles, std::vector<vec3> normals);

  /// The point near p on the triangles around `on`, which becomes the triangle it lies on. O(steps taken).
  host_point project(vec3 p, local_id& on) const;

private:
  static constexpr int most_steps = 100;
  struct found {
    std::array<double, 3> weights;
    vec3 point;
    double distance_squared;
  };
  found nearest(local_id t, vec3 p) const;

  std::vector<vec3> points_;
  std::vector<simplex<2>> triangles_;
  std::vector<vec3> normals_;
  compressed_rows<local_id> around_; ///< per vertex: its triangles
};

} // namespace improvement
} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/improver/surface_host.ipp"
#endif
