/// @file
/// Pictures as plain data: rows of pixels.
#pragma once

#include "dovetail/core/error.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dovetail::app {

/// A colour, as a screen shows it (sRGB).
struct rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend constexpr bool operator==(const rgb&, const rgb&) = default;
};

inline constexpr rgb white{255, 255, 255};
inline constexpr rgb black{0, 0, 0};

/// `colour` with its brightness multiplied by a factor from 0 to 1.
inline rgb darkened(rgb colour, double factor) {
  const auto scaled = [&](std::uint8_t part) {
    return static_cast<std::uint8_t>(std::lround(factor * part));
  };
  return {scaled(colour.red), scaled(colour.green), scaled(colour.blue)};
}

/// The colour between two, of which `t` says how much is the second one, from 0 to 1.
inline rgb mixed(rgb a, rgb b, double t) {
  const auto part = [&](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + t * (to - from)));
  };
  return {part(a.red, b.red), part(a.green, b.green), part(a.blue, b.blue)};
}

/// width x height pixels, the top row first. Throws `usage_error` for a size that is not positive.
class raster_image {
public:
  raster_image(int width, int height, rgb filling = white) : width_(width), height_(height) {
    if (width < 1 || height < 1)
      throw usage_error("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                        " pixels; give positive numbers");
    pixels_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), filling);
  }

  int width() const { return width_; }
  int height() const { return height_; }
  rgb& at(int x, int y) { return pixels_[index(x, y)]; }
  rgb at(int x, int y) const { return pixels_[index(x, y)]; }
  const rgb* data() const { return pixels_.data(); }

private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_;
  int height_;
  std::vector<rgb> pixels_;
};

/// The picture whose pixels are the means of squares of `factor` x `factor` pixels; what is left over at the
/// right and at the bottom is dropped.
inline raster_image reduced(const raster_image& image, int factor) {
  raster_image small(image.width() / factor, image.height() / factor);
  const auto mean = [&](int sum) {
    return static_cast<std::uint8_t>((sum + factor * factor / 2) / (factor * factor));
  };
  for (int y = 0; y < small.height(); ++y)
    for (int x = 0; x < small.width(); ++x) {
      int red = 0;
      int green = 0;
      int blue = 0;
      for (int row = y * factor; row < (y + 1) * factor; ++row)
        for (int column = x * factor; column < (x + 1) * factor; ++column) {
          const rgb pixel = image.at(column, row);
          red += pixel.red;
          green += pixel.green;
          blue += pixel.blue;
        }
      small.at(x, y) = {mean(red), mean(green), mean(blue)};
    }
  return small;
}

} // namespace dovetail::app
