#include "view_picture.hpp"

#include "colours.hpp"

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "raster_render.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::app {
namespace {

constexpr rgb outline_colour{45, 50, 60};
constexpr rgb faint_outline{150, 155, 165};
constexpr rgb inside_colour{214, 208, 196}; ///< of elements where colours are of groups
constexpr double hidden_edges = 2;          ///< in pixels: elements of this size have no edges,
constexpr double full_edges = 10;           ///< and from this size on the darkest ones
constexpr double mark_radius = 5;           ///< in pixels, with the rim
constexpr double mark_rim = 1.5;
constexpr double hidden_rim = 0.7;        ///< of a mark with a hole, whose ring shows its colour
constexpr double mark_hole = 2.3;         ///< in pixels: the radius of this hole
constexpr double mark_depth_pixels = 4;   ///< so far behind the surface, in pixels or over the height of
constexpr double mark_depth_part = 0.002; ///< the picture, a mark is still on it
constexpr rgb body_colour{130, 140, 160}; ///< of the surface around elements under an angle

using polygon = std::vector<vec3>;

/// What of a convex polygon is on the side of a plane that stays.
polygon clipped(const polygon& p, const view_plane& plane) {
  polygon kept;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const vec3 a = p[k], b = p[(k + 1) % p.size()];
    const double above_a = dot(plane.normal, a) - plane.place;
    const double above_b = dot(plane.normal, b) - plane.place;
    if (above_a <= 0)
      kept.push_back(a);
    if ((above_a < 0 && above_b > 0) || (above_a > 0 && above_b < 0))
      kept.push_back(a + above_a / (above_a - above_b) * (b - a));
  }
  return kept.size() < 3 ? polygon{} : kept;
}

/// Where a plane cuts a tetrahedron: three corners, or four in their order around; none where it only
/// touches.
polygon section(const std::array<vec3, 4>& p, const view_plane& plane) {
  std::array<double, 4> above;
  std::vector<std::size_t> upper, lower;
  for (std::size_t k = 0; k < 4; ++k) {
    above[k] = dot(plane.normal, p[k]) - plane.place;
    (above[k] > 0 ? upper : lower).push_back(k);
  }
  const auto between = [&](std::size_t a, std::size_t b) {
    return p[a] + above[a] / (above[a] - above[b]) * (p[b] - p[a]);
  };
  if (upper.empty() || lower.empty())
    return {};
  if (upper.size() == 2)
    return {between(upper[0], lower[0]), between(upper[0], lower[1]), between(upper[1], lower[1]),
            between(upper[1], lower[0])};
  const bool alone = upper.size() == 1;
  const std::size_t top = alone ? upper[0] : lower[0];
  polygon corners;
  for (const std::size_t other : alone ? lower : upper)
    corners.push_back(between(top, other));
  return corners;
}

/// Its length is twice the area.
vec3 normal_of(const polygon& p) {
  vec3 normal{};
  for (std::size_t k = 2; k < p.size(); ++k)
    normal += cross(p[k - 1] - p[0], p[k] - p[0]);
  return normal;
}

template <std::size_t N>
double mean_edge(const std::array<vec3, N>& p) {
  double sum = 0;
  for (std::size_t a = 0; a < N; ++a)
    for (std::size_t b = 0; b < a; ++b)
      sum += distance(p[a], p[b]);
  return sum / (N * (N - 1) / 2);
}

/// What of a scene is in a picture.
class scene_parts {
public:
  scene_parts(const view_scene& scene, const view_wishes& wishes) : scene_(scene), wishes_(wishes) {}

  /// Calls `f(polygon, colour, size)` for each side and each cut element. `size`: the mean edge of the whole
  /// element, or of the whole triangle on the surface.
  template <class F>
  void for_each_polygon(const F& f) const {
    if (wishes_.under)
      for_each_of_elements(f);
    else
      for_each_of_surface(f);
    if (wishes_.cut)
      for_each_of_section(f);
  }
  /// The outer surface, where only elements in it are shown.
  void add_body(std::vector<raster_triangle>& triangles) const {
    for (std::size_t t = 0; wishes_.under && t < scene_.outer; ++t)
      triangles.push_back({placed(scene_.triangles[t], scene_.piece_of_triangle(t)), body_colour});
  }
  void add_outline(std::vector<raster_line>& lines) const {
    for (const auto& [ends, piece] : scene_.outline) {
      auto p = placed(ends, piece);
      if (wishes_.cut && !wishes_.under && !cut_line(p))
        continue;
      lines.push_back({p, wishes_.under ? faint_outline : outline_colour, 1.6});
    }
  }

private:
  bool is_shown(std::size_t element) const {
    return !wishes_.under || scene_.angles[element] < *wishes_.under;
  }
  vec3 displacement(local_id piece) const {
    return wishes_.explode * (scene_.centres[piece] - scene_.box.center());
  }
  template <std::size_t N>
  std::array<vec3, N> placed(const std::array<local_id, N>& vertices, local_id piece) const {
    auto p = corners(span_of(scene_.points), vertices);
    for (vec3& corner : p)
      corner += displacement(piece);
    return p;
  }
  /// Of an element, where no group is to be seen.
  rgb colour_of_element(std::size_t e) const {
    switch (wishes_.colours) {
    case view_colours::piece:
      return colour_of_number(scene_.pieces.of[e]);
    case view_colours::angle:
      return colour_of_angle(scene_.angles[e]);
    case view_colours::material:
      return colour_of_number(scene_.materials.of[e]);
    case view_colours::group:
      break;
    }
    return wishes_.under ? colour_of_angle(scene_.angles[e]) : inside_colour;
  }
  rgb colour_of_triangle(std::size_t t) const {
    return wishes_.colours == view_colours::group
               ? colour_of_number(scene_.groups.of[t])
               : colour_of_element(static_cast<std::size_t>(scene_.element_of[t]));
  }

  /// What a section leaves of a triangle.
  template <class F>
  void visit(const std::array<vec3, 3>& p, rgb colour, double size, const F& f) const {
    const polygon whole(p.begin(), p.end());
    if (const polygon left = wishes_.cut ? clipped(whole, *wishes_.cut) : whole; !left.empty())
      f(left, colour, size);
  }
  template <class F>
  void for_each_of_surface(const F& f) const {
    const bool all = wishes_.explode > 0 || wishes_.cut;
    for (std::size_t t = 0; t < (all ? scene_.triangles.size() : scene_.outer); ++t) {
      const auto p = placed(scene_.triangles[t], scene_.piece_of_triangle(t));
      visit(p, colour_of_triangle(t), mean_edge(p), f);
    }
  }
  template <class F>
  void for_each_of_elements(const F& f) const {
    for (std::size_t e = 0; e < scene_.tetrahedra.size(); ++e)
      if (is_shown(e)) {
        const auto p = placed(scene_.tetrahedra[e], scene_.pieces.of[e]);
        for (const auto& side : numbering::sides<3>)
          visit({p[side[0]], p[side[1]], p[side[2]]}, colour_of_element(e), mean_edge(p), f);
      }
    for (std::size_t e = 0; scene_.dimension == 2 && e < scene_.count; ++e)
      if (is_shown(e)) {
        const auto p = placed(scene_.triangles[e], scene_.pieces.of[e]);
        visit(p, colour_of_element(e), mean_edge(p), f);
      }
  }
  template <class F>
  void for_each_of_section(const F& f) const {
    for (std::size_t e = 0; e < scene_.tetrahedra.size(); ++e)
      if (is_shown(e)) {
        const auto p = placed(scene_.tetrahedra[e], scene_.pieces.of[e]);
        if (const polygon cut = section(p, *wishes_.cut); !cut.empty())
          f(cut, colour_of_element(e), mean_edge(p));
      }
  }
  /// Leaves of a line what is on the side that stays; false: nothing.
  bool cut_line(std::array<vec3, 2>& p) const {
    const double above_a = dot(wishes_.cut->normal, p[0]) - wishes_.cut->place;
    const double above_b = dot(wishes_.cut->normal, p[1]) - wishes_.cut->place;
    if (above_a > 0 && above_b > 0)
      return false;
    if (above_a > 0 || above_b > 0)
      p[above_a > 0 ? 0 : 1] = p[0] + above_a / (above_a - above_b) * (p[1] - p[0]);
    return true;
  }

  const view_scene& scene_;
  const view_wishes& wishes_;
};

void add_triangles(std::vector<raster_triangle>& triangles, const polygon& p, rgb colour) {
  for (std::size_t k = 2; k < p.size(); ++k)
    triangles.push_back({{p[0], p[k - 1], p[k]}, colour});
}

/// How dark the edges of an element are, from 0 to 1: by its size alone, so that none of them is lost by
/// itself. Linear, so that small and large elements, with many and few edges, are about as dark as a whole.
double darkness_of_edges(double pixels) {
  return std::clamp((pixels - hidden_edges) / (full_edges - hidden_edges), 0.0, 1.0);
}

/// The edges of a polygon. Between two elements the darker ones are seen, and the outline before them.
/// \param pixels the size of its element where that is seen from the front
void add_edges(std::vector<raster_line>& lines, const polygon& p, rgb colour, double pixels,
               const raster_view& view) {
  const vec3 normal = normalized(normal_of(p));
  const double darkness = darkness_of_edges(pixels * std::sqrt(std::abs(dot(normal, view.towards))));
  if (darkness == 0)
    return;
  const rgb dark = mixed(lit(colour, normal, view), darkened(colour, 0.36), darkness);
  for (std::size_t k = 0; k < p.size(); ++k)
    lines.push_back({{p[k], p[(k + 1) % p.size()]}, dark, 0.8, 0.9 * darkness});
}

/// A disc with a dark rim, smooth at its edge; what is hidden has a hole. x and y in pixels.
void draw_mark(raster_image& image, double x, double y, rgb colour, bool is_hidden) {
  const double reach = mark_radius + 1, rim = is_hidden ? hidden_rim : mark_rim;
  if (!(x > -reach && x < image.width() + reach && y > -reach && y < image.height() + reach))
    return; // also where a far place is no number of pixels
  const auto range = [&](double middle, int size) {
    return std::pair(std::max(0, static_cast<int>(middle - reach)),
                     std::min(size - 1, static_cast<int>(middle + reach)));
  };
  const auto [left, right] = range(x, image.width());
  const auto [top, bottom] = range(y, image.height());
  for (int row = top; row <= bottom; ++row)
    for (int column = left; column <= right; ++column) {
      const double away = std::hypot(column + 0.5 - x, row + 0.5 - y);
      rgb& pixel = image.at(column, row);
      const rgb before = pixel;
      pixel = mixed(pixel, outline_colour, std::clamp(mark_radius + 0.5 - away, 0.0, 1.0));
      pixel = mixed(pixel, colour, std::clamp(mark_radius - rim + 0.5 - away, 0.0, 1.0));
      if (is_hidden)
        pixel = mixed(pixel, before, std::clamp(mark_hole + 0.5 - away, 0.0, 1.0));
    }
}

/// Whether what is at a pixel and at those around it is before a place. On a steep surface one of them is
/// not.
bool is_hidden(const raster_picture& picture, double x, double y, double depth) {
  const auto column = static_cast<int>(std::clamp(x, -2.0, picture.image.width() + 2.0));
  const auto row = static_cast<int>(std::clamp(y, -2.0, picture.image.height() + 2.0));
  bool found = false;
  for (int v = std::max(0, row - 1); v <= std::min(picture.image.height() - 1, row + 1); ++v)
    for (int u = std::max(0, column - 1); u <= std::min(picture.image.width() - 1, column + 1); ++u) {
      found = true;
      if (picture.depths[static_cast<std::size_t>(v) * static_cast<std::size_t>(picture.image.width()) +
                         static_cast<std::size_t>(u)] <= depth)
        return false;
    }
  return found;
}

/// The first ones last, since they matter most.
void draw_marks(raster_picture& picture, const view_wishes& wishes, const raster_view& view) {
  raster_image& image = picture.image;
  const double scale = image.height() / view.height;
  const double tolerance = std::max(mark_depth_pixels / scale, mark_depth_part * view.height);
  for (auto mark = wishes.marks.all.rbegin(); mark != wishes.marks.all.rend(); ++mark) {
    if (wishes.cut && dot(wishes.cut->normal, mark->place) > wishes.cut->place)
      continue;
    const vec3 d = mark->place - view.center;
    const double x = 0.5 * image.width() + scale * dot(d, view.right);
    const double y = 0.5 * image.height() - scale * dot(d, view.up);
    draw_mark(image, x, y, mark->colour, is_hidden(picture, x, y, dot(d, view.towards) + tolerance));
  }
}

} // namespace

raster_image picture_of_view(const view_scene& scene, const view_wishes& wishes) {
  const scene_parts parts(scene, wishes);
  raster_scene filled;
  parts.for_each_polygon(
      [&](const polygon& p, rgb colour, double) { add_triangles(filled.triangles, p, colour); });
  parts.add_body(filled.backdrop);
  parts.add_outline(filled.lines);
  const raster_view view = fitted(view_from(wishes.towards), filled, wishes.width, wishes.height);
  if (wishes.edges)
    parts.for_each_polygon([&](const polygon& p, rgb colour, double size) {
      add_edges(filled.lines, p, colour, size * wishes.height / view.height, view);
    });
  raster_picture picture = render_with_depths(filled, view, wishes.width, wishes.height, 3);
  if (wishes.explode == 0)
    draw_marks(picture, wishes, view);
  return std::move(picture.image);
}

bool is_drawn(const view_wishes& wishes, float angle, const std::array<vec3, 4>& corners) {
  if (wishes.under)
    return angle < *wishes.under;
  return wishes.cut && !section(corners, *wishes.cut).empty();
}

namespace {

std::span<const float> angles_of_elements(const view_scene& scene) {
  return std::span(scene.angles).first(scene.dimension == 3 ? scene.tetrahedra.size() : scene.count);
}

} // namespace

std::size_t elements_under(const view_scene& scene, double degrees) {
  const auto angles = angles_of_elements(scene);
  return static_cast<std::size_t>(
      std::count_if(angles.begin(), angles.end(), [&](float angle) { return angle < degrees; }));
}

double angle_of_worst(const view_scene& scene, double degrees, std::size_t most) {
  if (elements_under(scene, degrees) <= most)
    return degrees;
  const auto all = angles_of_elements(scene);
  std::vector<float> angles(all.begin(), all.end());
  std::nth_element(angles.begin(), angles.begin() + static_cast<std::ptrdiff_t>(most), angles.end());
  return angles[most];
}

} // namespace dovetail::app
