/// @file
/// What the command line asks of `view`, as plain data.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace dovetail::app {

/// How many triangles a page has at most, an element inside counted as the four around it.
inline constexpr std::int64_t default_most_triangles = 2'000'000;

/// The page and the picture may be asked for together.
struct view_options {
  std::string mesh;
  std::string out; ///< the page; empty: none
  std::int64_t most = default_most_triangles;
  std::string png;    ///< the picture; empty: none
  std::string report; ///< of the run, for marks; empty: none
  // Of the picture alone:
  std::string view = "default";  ///< a name, or azimuth,elevation in degrees
  std::string size = "1200x900"; ///< pixels
  std::string colour = "group";
  std::string cut;             ///< x, y, z, view, x=1.5, ...; empty: none
  std::optional<double> under; ///< degrees: elements with smaller angles alone
  double explode = 0;          ///< of the way from the middle of all to a piece's own
  bool no_edges = false;
};

} // namespace dovetail::app
