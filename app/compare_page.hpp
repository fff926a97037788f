/// @file
/// A comparison as one page that needs nothing else: tables, plots and pictures in one HTML file. All is
/// there without scripts; that of compare_page.html sorts tables.
#pragma once

#include "compare_rows.hpp"

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

/// The page.
std::string page_html(const comparison& compared, const comparison_pictures& pictures);

} // namespace dovetail::app
