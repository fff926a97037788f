/// @file
/// What a picture shows, and from where: coloured triangles and lines, seen without perspective.
#pragma once

#include "dovetail/core/vector.hpp"
#include "raster_image.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace dovetail::app {

/// A triangle seen from both sides; its brightness follows its inclination to the light.
struct raster_triangle {
  std::array<vec3, 3> corners;
  rgb colour;
};

/// A line of constant width and colour, hidden by what is clearly before it.
struct raster_line {
  std::array<vec3, 2> ends;
  rgb colour = black;
  double width = 1; ///< in pixels of the finished picture
  double rank = 1;  ///< from 0 to 1: of lines at one place that of the highest rank is seen
};

struct raster_scene {
  std::vector<raster_triangle> backdrop; ///< pale, and seen only where nothing else is
  std::vector<raster_triangle> triangles;
  std::vector<raster_line> lines;
  rgb background = white;

  box3 bounds() const {
    box3 box;
    for (const auto* some : {&backdrop, &triangles})
      for (const auto& triangle : *some)
        for (const vec3 p : triangle.corners)
          box.include(p);
    for (const auto& line : lines)
      for (const vec3 p : line.ends)
        box.include(p);
    return box;
  }
};

/// An orthographic view: three orthogonal unit vectors, the point in the picture's middle, and the length in
/// space that the picture is high.
struct raster_view {
  vec3 right{1, 0, 0};
  vec3 up{0, 1, 0};
  vec3 towards{0, 0, 1}; ///< from the scene to the viewer
  vec3 center{};
  double height = 1;
};

/// To the viewer of whatever has no direction of its own: in front of it, to the right and above.
inline vec3 oblique_direction() {
  return normalized({0.8, -1, 0.65});
}

/// From where what fills a box is seen unless somebody says otherwise: what lies in a plane z = const from
/// above.
inline vec3 direction_to_viewer(const box3& box) {
  const bool flat = box.upper.z - box.lower.z <= 1e-9 * box.diagonal();
  return flat ? vec3{0, 0, 1} : oblique_direction();
}

/// The view against the direction `towards`, with the z axis pointing up where it is not seen end on. Place
/// and height are left as they are by default.
inline raster_view view_from(vec3 towards) {
  raster_view view;
  view.towards = normalized(towards);
  const vec3 sideways = cross(vec3{0, 0, 1}, view.towards);
  view.right = norm(sideways) > 1e-9 ? normalized(sideways) : vec3{1, 0, 0};
  view.up = cross(view.towards, view.right);
  return view;
}

/// `view` moved and scaled such that a picture of `width` x `height` pixels shows the whole scene, with a
/// margin as a fraction of the picture.
inline raster_view fitted(raster_view view, const raster_scene& scene, int width, int height,
                          double margin = 0.04) {
  box3 seen; // in the coordinates right, up, towards
  const auto include = [&](vec3 p) {
    seen.include({dot(p, view.right), dot(p, view.up), dot(p, view.towards)});
  };
  for (const auto* some : {&scene.backdrop, &scene.triangles})
    for (const auto& triangle : *some)
      std::for_each(triangle.corners.begin(), triangle.corners.end(), include);
  for (const auto& line : scene.lines)
    std::for_each(line.ends.begin(), line.ends.end(), include);
  if (seen.empty())
    return view;
  const vec3 middle = seen.center();
  view.center = middle.x * view.right + middle.y * view.up + middle.z * view.towards;
  const vec3 extent = seen.upper - seen.lower;
  const double needed = std::max(extent.y, extent.x * height / width);
  view.height = needed > 0 ? needed / (1 - 2 * margin) : 1;
  return view;
}

} // namespace dovetail::app
