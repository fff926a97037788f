/// @file
/// A comparison as one page that needs nothing else: tables, plots and pictures in one HTML file.
#pragma once

#include "compare_rows.hpp"

#include "raster_image.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace dovetail::app {

/// A picture with the words below it.
struct captioned_picture {
  std::string caption;
  std::vector<std::uint8_t> png;
};

/// The pictures of a comparison; each list may be empty.
struct comparison_pictures {
  std::vector<captioned_picture> decompositions;
  std::vector<captioned_picture> interfaces;
  std::vector<captioned_picture> worst_elements;
};

/// The page, well-formed as XML as well.
std::string page_html(const comparison& compared, const comparison_pictures& pictures);

/// What was measured of the method's claim, in sentences: one each for the background mesh's interfaces, the
/// finished mesh's, the cut and the imbalance. Empty when no pair of rows went well.
std::vector<std::string> answer_to_the_claim(const comparison& compared);

} // namespace dovetail::app
