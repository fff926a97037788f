/// @file
/// The colours by which pictures and pages tell numbered things apart.
#pragma once

#include "dovetail/core/ids.hpp"
#include "raster_image.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>

namespace dovetail::app {

/// Soft colours, neighbours in number far apart in hue: hues go round by the golden ratio.
inline rgb colour_of_number(local_id s) {
  const double turn = 0.58 + 0.6180339887498949 * s;
  const double hue = 6 * (turn - std::floor(turn));
  const double light = 0.85 + 0.1 * (s % 2);
  const auto part = [&](double offset) {
    const double k = std::fmod(offset + hue, 6.0);
    const double saturation = 0.5 * std::clamp(std::min(k, 4 - k), 0.0, 1.0);
    return static_cast<std::uint8_t>(255 * light * (1 - saturation));
  };
  return {part(5), part(3), part(1)};
}

/// A place on the scale of angles.
struct angle_stop {
  int degrees;
  double red, green, blue;
  const char* name; ///< of the colour
};
inline constexpr angle_stop angle_stops[] = {{0, 190, 20, 40, "dark red"}, {10, 225, 70, 45, "red"},
                                             {20, 245, 160, 60, "orange"}, {30, 250, 225, 120, "yellow"},
                                             {40, 150, 205, 140, "green"}, {55, 80, 160, 190, "blue-green"},
                                             {70, 55, 105, 185, "blue"}};

/// The scale in words.
inline std::string text_of_angle_colours() {
  std::string text;
  for (const angle_stop& stop : angle_stops)
    text += (text.empty() ? "" : ", ") + std::to_string(stop.degrees) + "° " + stop.name;
  return text + " (and above)";
}

/// Of an element's least angle: red, orange, yellow, then green to blue for those that are as good as it
/// gets.
inline rgb colour_of_angle(double degrees) {
  constexpr auto& stops = angle_stops;
  const auto mixed = [](double a, double b, double t) {
    return static_cast<std::uint8_t>(std::lround(a + t * (b - a)));
  };
  for (std::size_t k = 1; k < std::size(stops); ++k) {
    const auto& [from, red, green, blue, name] = stops[k - 1];
    const auto& to = stops[k];
    if (degrees > to.degrees && k + 1 < std::size(stops))
      continue;
    const double t = std::clamp((degrees - from) / (to.degrees - from), 0.0, 1.0);
    return {mixed(red, to.red, t), mixed(green, to.green, t), mixed(blue, to.blue, t)};
  }
  return {};
}

} // namespace dovetail::app
