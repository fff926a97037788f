#include "view_picture.hpp"

#include "colours.hpp"

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "raster_render.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::app {
namespace {

constexpr rgb outline_colour{45, 50, 60};
constexpr rgb faint_outline{150, 155, 165};
constexpr rgb inside{214, 208, 196}; ///< of elements where colours are of groups
constexpr double shortest_edge = 5;  ///< in pixels
constexpr double mark_radius = 5;    ///< in pixels, with the rim
constexpr double mark_rim = 1.5;

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

/// Fills a scene of the rasteriser.
class scene_filler {
public:
  scene_filler(const view_scene& scene, const view_wishes& wishes) : scene_(scene), wishes_(wishes) {}

  raster_scene filled() {
    if (wishes_.under)
      add_elements();
    else
      add_surface();
    if (wishes_.cut)
      add_section();
    add_outline();
    return std::move(filled_);
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
    return wishes_.under ? colour_of_angle(scene_.angles[e]) : inside;
  }
  rgb colour_of_triangle(std::size_t t) const {
    return wishes_.colours == view_colours::group
               ? colour_of_number(scene_.groups.of[t])
               : colour_of_element(static_cast<std::size_t>(scene_.element_of[t]));
  }

  void add_polygon(const polygon& p, rgb colour) {
    for (std::size_t k = 2; k < p.size(); ++k)
      filled_.triangles.push_back({{p[0], p[k - 1], p[k]}, colour});
    if (wishes_.edges && !p.empty())
      for (std::size_t k = 0; k < p.size(); ++k)
        filled_.lines.push_back({{p[k], p[(k + 1) % p.size()]}, darkened(colour, 0.36), 0.8});
  }
  void add_triangle(const std::array<vec3, 3>& p, rgb colour) {
    const polygon whole(p.begin(), p.end());
    add_polygon(wishes_.cut ? clipped(whole, *wishes_.cut) : whole, colour);
  }
  void add_surface() {
    const bool all = wishes_.explode > 0 || wishes_.cut;
    for (std::size_t t = 0; t < (all ? scene_.triangles.size() : scene_.outer); ++t)
      add_triangle(placed(scene_.triangles[t], scene_.piece_of_triangle(t)), colour_of_triangle(t));
  }
  void add_elements() {
    for (std::size_t e = 0; e < scene_.tetrahedra.size(); ++e)
      if (is_shown(e)) {
        const auto p = placed(scene_.tetrahedra[e], scene_.pieces.of[e]);
        for (const auto& side : numbering::sides<3>)
          add_triangle({p[side[0]], p[side[1]], p[side[2]]}, colour_of_element(e));
      }
    for (std::size_t e = 0; scene_.dimension == 2 && e < scene_.count; ++e)
      if (is_shown(e))
        add_triangle(placed(scene_.triangles[e], scene_.pieces.of[e]), colour_of_element(e));
  }
  void add_section() {
    for (std::size_t e = 0; e < scene_.tetrahedra.size(); ++e)
      if (is_shown(e))
        add_polygon(section(placed(scene_.tetrahedra[e], scene_.pieces.of[e]), *wishes_.cut),
                    colour_of_element(e));
  }
  void add_outline() {
    for (const auto& [ends, piece] : scene_.outline) {
      auto p = placed(ends, piece);
      if (wishes_.cut && !wishes_.under && !cut_line(p))
        continue;
      filled_.lines.push_back({p, wishes_.under ? faint_outline : outline_colour, 1.6});
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
  raster_scene filled_;
};

/// A disc with a dark rim, smooth at its edge; x and y in pixels.
void draw_mark(raster_image& image, double x, double y, rgb colour) {
  const double reach = mark_radius + 1;
  if (!(x > -reach && x < image.width() + reach && y > -reach && y < image.height() + reach))
    return; // also where a far place is no number of pixels
  const auto mixed = [](rgb a, rgb b, double t) {
    const auto part = [&](std::uint8_t from, std::uint8_t to) {
      return static_cast<std::uint8_t>(std::lround(from + t * (to - from)));
    };
    return rgb{part(a.red, b.red), part(a.green, b.green), part(a.blue, b.blue)};
  };
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
      pixel = mixed(pixel, outline_colour, std::clamp(mark_radius + 0.5 - away, 0.0, 1.0));
      pixel = mixed(pixel, colour, std::clamp(mark_radius - mark_rim + 0.5 - away, 0.0, 1.0));
    }
}

/// The first ones last, since they matter most.
void draw_marks(raster_image& image, const view_wishes& wishes, const raster_view& view) {
  const double scale = image.height() / view.height;
  for (auto mark = wishes.marks.all.rbegin(); mark != wishes.marks.all.rend(); ++mark) {
    if (wishes.cut && dot(wishes.cut->normal, mark->place) > wishes.cut->place)
      continue;
    const vec3 d = mark->place - view.center;
    draw_mark(image, 0.5 * image.width() + scale * dot(d, view.right),
              0.5 * image.height() - scale * dot(d, view.up), mark->colour);
  }
}

} // namespace

raster_image picture_of_view(const view_scene& scene, const view_wishes& wishes) {
  raster_scene filled = scene_filler(scene, wishes).filled();
  const raster_view view = fitted(view_from(wishes.towards), filled, wishes.width, wishes.height);
  const double least = shortest_edge * view.height / wishes.height;
  std::erase_if(filled.lines, [&](const raster_line& line) {
    return line.width < 1 && distance(line.ends[0], line.ends[1]) < least;
  });
  raster_image image = render(filled, view, wishes.width, wishes.height, 3);
  if (wishes.explode == 0)
    draw_marks(image, wishes, view);
  return image;
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
