/// @file
/// Draws scenes of triangles and lines: flat shading, hidden parts by a depth per sample, smooth edges by
/// several samples per pixel.
#pragma once

#include "raster_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::app {

/// A colour as a surface with this normal shows it. The light comes from the viewer's side, above and a
/// little from the left, so that it reaches nearly all that is seen; both sides of a surface are alike.
inline rgb lit(rgb colour, vec3 normal, const raster_view& view) {
  constexpr double ambient = 0.55; // brightness of what the light does not reach
  const vec3 light = normalized(view.towards + 0.45 * view.up - 0.2 * view.right);
  const vec3 facing = dot(normal, view.towards) < 0 ? -normal : normal;
  return darkened(colour, ambient + (1 - ambient) * std::max(0.0, dot(facing, light)));
}

namespace raster {

/// A canvas of samples with depths.
class raster_canvas {
public:
  raster_canvas(int width, int height, const raster_view& view, rgb background)
      : image_(width, height, background), background_(background), view_(view), scale_(height / view.height),
        depths_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), nothing_there) {}

  /// \param strength from 0, the background, to 1
  void draw(const raster_triangle& triangle, double strength = 1) {
    const auto& p = triangle.corners;
    const vec3 normal = normalized(cross(p[1] - p[0], p[2] - p[0]));
    fill({on_canvas(p[0]), on_canvas(p[1]), on_canvas(p[2])},
         mixed(background_, lit(triangle.colour, normal, view_), strength));
  }
  /// What is drawn from now on hides all that is there.
  void forget_depths() { std::fill(depths_.begin(), depths_.end(), nothing_there); }

  /// A line is two triangles across the view, a little before its place so that the triangles it bounds do
  /// not hide it, and by its rank before other lines there.
  void draw(const raster_line& line, double samples_per_pixel) {
    vec3 a = on_canvas(line.ends[0]);
    vec3 b = on_canvas(line.ends[1]);
    const double lift = line_lift * (0.5 + 0.5 * line.rank) * view_.height;
    a.z += lift;
    b.z += lift;
    const vec3 along = normalized({b.x - a.x, b.y - a.y, 0});
    const vec3 aside = 0.5 * line.width * samples_per_pixel * vec3{-along.y, along.x, 0};
    fill({a - aside, b - aside, b + aside}, line.colour);
    fill({a - aside, b + aside, a + aside}, line.colour);
  }

  const raster_image& image() const { return image_; }
  /// Of the middle samples of pixels of `samples` x `samples`.
  std::vector<float> depths_of_pixels(int samples) const {
    std::vector<float> depths;
    for (int y = samples / 2; y < image_.height(); y += samples)
      for (int x = samples / 2; x < image_.width(); x += samples)
        depths.push_back(depths_[index(x, y)]);
    return depths;
  }

private:
  static constexpr float nothing_there = -std::numeric_limits<float>::infinity();
  static constexpr double line_lift = 0.002; ///< of the picture's height

  /// x to the right and y down in samples; z towards the viewer in lengths.
  vec3 on_canvas(vec3 p) const {
    const vec3 d = p - view_.center;
    return {0.5 * image_.width() + scale_ * dot(d, view_.right),
            0.5 * image_.height() - scale_ * dot(d, view_.up), dot(d, view_.towards)};
  }

  /// Colours the samples whose centers are in a triangle of canvas points and not hidden.
  void fill(const std::array<vec3, 3>& p, rgb colour) {
    const auto doubled_area = [](vec3 a, vec3 b, double x, double y) {
      return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
    };
    const double whole = doubled_area(p[0], p[1], p[2].x, p[2].y);
    if (whole == 0)
      return;
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
    const int first_x = static_cast<int>(std::max(0.0, std::ceil(left - 0.5)));
    const int last_x = static_cast<int>(std::min(image_.width() - 1.0, std::floor(right - 0.5)));
    const int first_y = static_cast<int>(std::max(0.0, std::ceil(top - 0.5)));
    const int last_y = static_cast<int>(std::min(image_.height() - 1.0, std::floor(bottom - 0.5)));
    for (int y = first_y; y <= last_y; ++y)
      for (int x = first_x; x <= last_x; ++x) {
        const double u = doubled_area(p[1], p[2], x + 0.5, y + 0.5) / whole;
        const double v = doubled_area(p[2], p[0], x + 0.5, y + 0.5) / whole;
        const double w = 1 - u - v;
        if (u >= 0 && v >= 0 && w >= 0)
          colour_sample(x, y, u * p[0].z + v * p[1].z + w * p[2].z, colour);
      }
  }

  void colour_sample(int x, int y, double depth, rgb colour) {
    float& nearest = depths_[index(x, y)];
    if (static_cast<float>(depth) <= nearest)
      return;
    nearest = static_cast<float>(depth);
    image_.at(x, y) = colour;
  }

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width()) +
           static_cast<std::size_t>(x);
  }

  raster_image image_;
  rgb background_;
  raster_view view_;
  double scale_; ///< samples per unit of length
  std::vector<float> depths_;
};

} // namespace raster

/// A picture, and how near to the viewer its triangles are.
struct raster_picture {
  raster_image image;
  std::vector<float> depths; ///< per pixel: length towards the viewer from the view's centre; or -infinity
};

/// A picture of a scene. `samples` x `samples` samples make a pixel. Of things at the same depth the first
/// drawn is seen: triangles before lines, each in their order. Time grows with the area of all triangles.
/// Throws `usage_error` when a number of pixels or samples is not positive.
inline raster_picture render_with_depths(const raster_scene& scene, const raster_view& view, int width,
                                         int height, int samples = 3) {
  constexpr double pale = 0.3;
  if (samples < 1)
    throw usage_error("a picture with " + std::to_string(samples) + " samples a pixel; give at least 1");
  raster::raster_canvas canvas(samples * width, samples * height, view, scene.background);
  for (const auto& triangle : scene.backdrop)
    canvas.draw(triangle, pale);
  canvas.forget_depths();
  for (const auto& triangle : scene.triangles)
    canvas.draw(triangle);
  std::vector<float> depths = canvas.depths_of_pixels(samples);
  for (const auto& line : scene.lines)
    canvas.draw(line, samples);
  return {samples == 1 ? canvas.image() : reduced(canvas.image(), samples), std::move(depths)};
}

/// The picture alone.
inline raster_image render(const raster_scene& scene, const raster_view& view, int width, int height,
                           int samples = 3) {
  return render_with_depths(scene, view, width, height, samples).image;
}

} // namespace dovetail::app
