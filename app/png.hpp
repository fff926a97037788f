/// @file
/// Pictures as PNG files: 8-bit RGB.
#pragma once

#include "raster_image.hpp"

#include <cstdint>
#include <vector>

namespace dovetail::app {

/// The bytes of a PNG file. Throws `io_error` when libpng cannot make them.
std::vector<std::uint8_t> encode_png(const raster_image& image);

} // namespace dovetail::app
