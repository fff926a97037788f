/// @file
/// What `patches.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/skeleton/patches.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE simplex<2> key_order(const skeleton_face& face) {
  return sorted_vertices(face.vertices);
}

DOVETAIL_INLINE std::array<local_id, 3> lines_of(const skeleton_face& face,
                                                 const std::vector<skeleton_line>& lines) {
  const simplex<2> key = key_order(face);
  return {find_line(lines, key[1], key[2]), find_line(lines, key[2], key[0]),
          find_line(lines, key[0], key[1])};
}

DOVETAIL_INLINE std::vector<std::array<local_id, 3>> lines_of_faces(const coarse_skeleton& skeleton) {
  const line_index index(skeleton.lines);
  std::vector<std::array<local_id, 3>> lines;
  lines.reserve(skeleton.faces.size());
  for (const skeleton_face& face : skeleton.faces) {
    const simplex<2> key = key_order(face);
    lines.push_back({index.find(key[1], key[2]), index.find(key[2], key[0]), index.find(key[0], key[1])});
  }
  return lines;
}

DOVETAIL_INLINE compressed_rows<local_id>
faces_of_lines(std::span<const std::array<local_id, 3>> lines_of_face, std::size_t lines) {
  return sorted_into_rows<local_id>(lines, [&](const auto& put) {
    for (std::size_t f = 0; f < lines_of_face.size(); ++f)
      for (const local_id line : lines_of_face[f])
        put(line, static_cast<local_id>(f));
  });
}

namespace detail {

/// The sides of an interface face in its key order, point by point.
struct interface_sides {
  std::array<local_id, 3> lines;
  std::array<std::vector<vec3>, 3> points;
  std::array<std::vector<local_id>, 3> labels;
};

inline interface_sides sides_of(const skeleton_face& face, const numbered_lines& lines) {
  const simplex<2> key = key_order(face);
  interface_sides sides{.lines = lines_of(face, lines.keys), .points = {}, .labels = {}};
  for (std::size_t i = 0; i < 3; ++i) {
    sides.labels[i] = lines.along(sides.lines[i], key[(i + 1) % 3]);
    sides.points[i].reserve(sides.labels[i].size());
    for (const local_id number : sides.labels[i])
      sides.points[i].push_back(lines.points[number]);
  }
  return sides;
}

} // namespace detail

DOVETAIL_INLINE patch_boundary interface_outline(const skeleton_face& face,
                                                 const std::array<local_id, 3>& lines_of_face,
                                                 const numbered_lines& lines) {
  const simplex<2> key = key_order(face);
  patch_boundary outline;
  std::size_t points = 0;
  for (const local_id line : lines_of_face)
    points += lines.lines[line].points.size() + 2;
  outline.labels.reserve(points);
  for (std::size_t i = 0; i < 3; ++i) { // the last point starts the next side
    append(outline.labels, lines.along(lines_of_face[i], key[(i + 1) % 3]));
    outline.labels.pop_back();
  }
  outline.segments = remesh::segments_around(outline.labels.size());
  return outline;
}

DOVETAIL_INLINE interface_face_patch interface_patch(const skeleton_face& face,
                                                     std::span<const vec3> coarse_points,
                                                     const numbered_lines& lines) {
  std::array<vec3, 3> corners;
  const simplex<2> key = key_order(face);
  for (std::size_t i = 0; i < 3; ++i)
    corners[i] = coarse_points[key[i]];
  const auto sides = detail::sides_of(face, lines);
  remesh::triangle_surface surface(corners, sides.points);
  skeleton_patch patch;
  patch.boundary = remesh::triangle_boundary(surface, sides.points, sides.labels);
  for (std::size_t i = 0; i < 3; ++i)
    patch.line_of_segment.insert(patch.line_of_segment.end(), sides.labels[i].size() - 1, sides.lines[i]);
  return {std::move(surface), std::move(patch)};
}

} // namespace dovetail
