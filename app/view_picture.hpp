/// @file
/// Pictures of a mesh without a display: of its surface, a section, or its worst elements.
#pragma once

#include "raster_image.hpp"
#include "raster_scene.hpp"
#include "view_marks.hpp"
#include "view_scene.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace dovetail::app {

enum class view_colours { group, piece, material, angle };

/// The points p with dot(normal, p) = place.
struct view_plane {
  vec3 normal;
  double place;
};

struct view_wishes {
  vec3 towards = oblique_direction(); ///< from the mesh to the viewer
  int width = 1200;                   ///< pixels
  int height = 900;
  view_colours colours = view_colours::group;
  std::optional<view_plane> cut = {}; ///< what is on the side of its normal is taken away
  std::optional<double> under = {};   ///< degrees: only elements with smaller angles, in the outline
  double explode = 0;                 ///< how far pieces are moved, over their distance from the middle
  bool edges = true;                  ///< of elements; those of the outline are always drawn
  view_marks marks = {};              ///< hollow where hidden; none where pieces are moved away from them
};

/// Whether colours are of angles: where elements are asked for by their angle, groups do not tell them apart.
inline bool shows_angles(const view_wishes& wishes) {
  return wishes.colours == view_colours::angle || (wishes.under && wishes.colours == view_colours::group);
}

/// Elements seen in part where a section cuts them. The edges of small elements fade, all of an element
/// alike, since they would hide the colours: from ten pixels on, to nothing at two.
raster_image picture_of_view(const view_scene& scene, const view_wishes& wishes);

/// Whether an element by itself is in the picture, and not only a side of it that is seen anyway: a scene may
/// lack all others.
/// \param corners where the picture has them, with pieces apart
bool is_drawn(const view_wishes& wishes, float angle, const std::array<vec3, 4>& corners);

/// More elements than this are not drawn one by one: each takes a kilobyte, and they hide each other.
inline constexpr std::size_t most_elements_drawn = 1'000'000;

/// The angle, up to `degrees`, under which there are at most so many elements of a scene.
double angle_of_worst(const view_scene& scene, double degrees, std::size_t most = most_elements_drawn);

/// How many elements that a scene has have a smaller angle.
std::size_t elements_under(const view_scene& scene, double degrees);

} // namespace dovetail::app
