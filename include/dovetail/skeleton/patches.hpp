/// @file
/// From coarse regions and interface faces, and the remeshed lines around them, to the patches that are
/// remeshed.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/mesh/coarse_skeleton.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/remesh/patch.hpp"
#include "dovetail/remesh/triangle_surface.hpp"
#include "dovetail/skeleton/fine_lines.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// A patch, with the line that each of its segments belongs to (no_id at a pole).
struct skeleton_patch {
  patch_boundary boundary;               ///< its loops
  std::vector<local_id> line_of_segment; ///< by segment of the boundary
};

namespace detail {

/// Collects boundary vertices, one for each number and pair of parameters.
class patch_builder {
public:
  explicit patch_builder(const std::vector<vec3>& points) : points_(points) {}

  local_id vertex(local_id number, vec2 uv) {
    patch_boundary& made = patch_.boundary;
    local_id& newest = newest_.try_emplace(number, no_id).first->second;
    for (local_id v = newest; v != no_id; v = older_[v])
      if (const vec2 at = made.uv[v]; at.x == uv.x && at.y == uv.y)
        return v;
    older_.push_back(newest);
    newest = static_cast<local_id>(made.uv.size());
    made.uv.push_back(uv);
    made.points.push_back(points_[number]);
    made.labels.push_back(number);
    return newest;
  }
  void segment(local_id a, local_id b, local_id line) {
    patch_.boundary.segments.push_back({a, b});
    patch_.line_of_segment.push_back(line);
  }
  skeleton_patch take() { return std::move(patch_); }

private:
  const std::vector<vec3>& points_;
  std::map<local_id, local_id> newest_; ///< the last vertex of a number
  std::vector<local_id> older_;         ///< per vertex: the one of its number before it
  skeleton_patch patch_;
};

/// The parameters on a face of a point of one of its curves. A seam passes the face twice: the passage is the
/// one whose end is nearer to `end_uv`, the parameters that the triangle beside it has at curve parameter
/// `end_t`.
template <geometry_model Geometry>
local_id coedge_beside(const Geometry& model, local_id face, local_id curve, std::array<double, 2> end_t,
                       std::array<vec2, 2> end_uv) {
  const auto& coedges = model.topology().faces[face].coedges;
  local_id best = no_id;
  double least = 0;
  for (std::size_t k = 0; k < coedges.size(); ++k) {
    if (coedges[k].curve != curve)
      continue;
    const auto id = static_cast<local_id>(k);
    const double off = norm(model.curve_uv(face, static_cast<int>(k), end_t[0]) - end_uv[0]) +
                       norm(model.curve_uv(face, static_cast<int>(k), end_t[1]) - end_uv[1]);
    if (best == no_id || off < least) {
      best = id;
      least = off;
    }
  }
  if (best == no_id)
    throw mesh_error("face " + std::to_string(face) + " has a coarse edge on curve " + std::to_string(curve) +
                     ", which does not bound it");
  return best;
}

/// A coarse triangle of a region as the face's parameter plane sees it: counter-clockwise there.
struct plane_triangle {
  simplex<2> vertices;
  std::array<vec2, 3> uv;
};

inline plane_triangle in_parameter_plane(const surface_mesh& surface, local_id triangle, bool reversed) {
  const auto t = static_cast<std::size_t>(triangle);
  plane_triangle seen{surface.mesh.elements[t], surface.corner_uv[t]};
  if (reversed) {
    std::swap(seen.vertices[1], seen.vertices[2]);
    std::swap(seen.uv[1], seen.uv[2]);
  }
  return seen;
}

/// The trimmed representation of a region: its triangles are passed in the parameter plane, and what lines
/// have on their edges is the boundary.
template <geometry_model Geometry>
class region_boundary {
public:
  region_boundary(const Geometry& model, const surface_mesh& surface, const skeleton_region& region,
                  const numbered_lines& lines)
      : model_(model), surface_(surface), region_(region), lines_(lines), patch_(lines.points) {}

  skeleton_patch patch() {
    const bool reversed = model_.topology().faces[region_.cad_face].reversed;
    for (const local_id triangle : region_.triangles)
      pass_triangle(in_parameter_plane(surface_, triangle, reversed));
    return patch_.take();
  }

private:
  /// An edge of a coarse triangle, as the triangle passes it.
  struct passage {
    std::array<local_id, 2> ends;
    std::array<vec2, 2> uv;
  };

  void pass_triangle(const plane_triangle& seen) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      pass_edge({{seen.vertices[i], seen.vertices[j]}, {seen.uv[i], seen.uv[j]}});
    }
    for (std::size_t i = 0; i < 3; ++i)
      if (std::binary_search(region_.fixed_points.begin(), region_.fixed_points.end(), seen.vertices[i]))
        patch_.vertex(lines_.number_of(seen.vertices[i]), seen.uv[i]);
  }

  void pass_edge(const passage& edge) {
    if (const local_id line = find_line(lines_.keys, edge.ends[0], edge.ends[1]); line != no_id) {
      pass_line(line, edge);
      return;
    }
    const auto [found, is_new] = inner_.try_emplace(sorted_vertices(edge.ends), edge);
    if (!is_new)
      close_pole(found->second, edge);
  }

  void pass_line(local_id line, const passage& edge) {
    const auto l = static_cast<std::size_t>(line);
    const skeleton_line& key = lines_.keys[l];
    const bool forward = edge.ends[0] == key.vertices[0];
    const auto numbers = lines_.along(line, edge.ends[0]);
    const std::array key_uv = forward ? edge.uv : std::array{edge.uv[1], edge.uv[0]};
    const local_id coedge =
        key.on.dimension == 1 ? coedge_beside(model_, region_.cad_face, key.on.id, key.t, key_uv) : no_id;
    const auto inner_uv = [&](std::size_t i) { // i counts in key order
      return coedge == no_id
                 ? lines_.lines[l].uv[i]
                 : model_.curve_uv(region_.cad_face, static_cast<int>(coedge), lines_.lines[l].t[i]);
    };
    const std::size_t inner = numbers.size() - 2;
    local_id before = patch_.vertex(numbers.front(), edge.uv[0]);
    for (std::size_t i = 0; i < inner; ++i) {
      const local_id next = patch_.vertex(numbers[i + 1], inner_uv(forward ? i : inner - 1 - i));
      patch_.segment(before, next, line);
      before = next;
    }
    patch_.segment(before, patch_.vertex(numbers.back(), edge.uv[1]), line);
  }

  /// Two triangles on an inner edge that see an end of it at different parameters meet at a pole: the gap
  /// between these is boundary.
  void close_pole(const passage& first, const passage& second) {
    for (std::size_t end = 0; end < 2; ++end) {
      const vec2 one = first.uv[end], other = second.uv[1 - end];
      if (one == other)
        continue;
      const local_id number = lines_.number_of(first.ends[end]);
      if (number == no_id)
        throw mesh_error("face " + std::to_string(region_.cad_face) +
                         ": the parameters of a coarse point inside a region differ between triangles");
      const local_id a = patch_.vertex(number, one), b = patch_.vertex(number, other);
      if (end == 1) // the first triangle runs into the pole here, the second out of it
        patch_.segment(b, a, no_id);
      else
        patch_.segment(a, b, no_id);
    }
  }

  const Geometry& model_;
  const surface_mesh& surface_;
  const skeleton_region& region_;
  const numbered_lines& lines_;
  patch_builder patch_;
  std::map<std::array<local_id, 2>, passage> inner_; ///< edges on no line, by their ends, as first passed
};

} // namespace detail

/// The patch of a region: its lines, passed with the region on the left in the face's parameter plane, and
/// poles.
template <geometry_model Geometry>
skeleton_patch region_patch(const Geometry& model, const surface_mesh& surface, const skeleton_region& region,
                            const numbered_lines& lines) {
  return detail::region_boundary(model, surface, region, lines).patch();
}

/// The corners of an interface face in the order of its key, so that every subdomain meshes the same patch.
simplex<2> key_order(const skeleton_face& face);

/// An interface face as a patch: the straight triangle, with the edges that lie on the CAD surface curved.
struct interface_face_patch {
  remesh::triangle_surface surface; ///< the curved triangle
  skeleton_patch patch;             ///< its boundary
};

/// The lines of an interface face: of each side of its key order, from corner i + 1 to corner i + 2.
std::array<local_id, 3> lines_of(const skeleton_face& face, const std::vector<skeleton_line>& lines);

/// The lines of all interface faces. About linear.
std::vector<std::array<local_id, 3>> lines_of_faces(const coarse_skeleton& skeleton);

/// The interface faces at each line, growing. Linear.
/// \param lines_of_face the three lines of each face
/// \param lines how many there are
compressed_rows<local_id> faces_of_lines(std::span<const std::array<local_id, 3>> lines_of_face,
                                         std::size_t lines);

/// The boundary of an interface face by labels alone: its points are a function of its corners and lines.
patch_boundary interface_outline(const skeleton_face& face, const std::array<local_id, 3>& lines_of_face,
                                 const numbered_lines& lines);

/// Builds the patch of an interface face.
interface_face_patch interface_patch(const skeleton_face& face, std::span<const vec3> coarse_points,
                                     const numbered_lines& lines);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/skeleton/patches.ipp"
#endif
