/// What the examples of the paper's sections (p1 to p6) work on: the model of a file, or without a file a
/// square plate with a round hole (D = 2) and the block with a hole of which it is the section (D = 3),
/// neither of them from CAD.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/models/discrete/read.hpp"
#include "dovetail/models/discrete_model.hpp"
#include "dovetail/models/plane/svg_path.hpp"
#include "dovetail/models/plane_domain.hpp"
#ifdef EXAMPLE_HAS_OCCT
#include "dovetail/models/occt_model.hpp"
#endif

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

namespace paper {

/// A body around the z axis, of radii by direction: four rings of n points, inner and outer at the bottom and
/// outer and inner at the top, with quadrangles of two triangles from each ring to the next.
inline dovetail::discrete_model ring(int n, double inner, const auto& outer) {
  std::vector<dovetail::vec3> points;
  std::vector<dovetail::simplex<2>> triangles;
  for (int r = 0; r < 4; ++r)
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * i / n, x = std::cos(angle), y = std::sin(angle);
      const double radius = r == 0 || r == 3 ? inner : outer(x, y);
      points.push_back({radius * x, radius * y, r < 2 ? 0.0 : 0.8});
      const int j = (i + 1) % n, next = (r + 1) % 4;
      triangles.push_back({r * n + i, r * n + j, next * n + j});
      triangles.push_back({r * n + i, next * n + j, next * n + i});
    }
  return {points, triangles};
}
inline dovetail::discrete_model block_with_hole() {
  return ring(32, 0.5, [](double x, double y) { return 1 / std::max(std::abs(x), std::abs(y)); });
}
/// So thin that coarse chords of one side may come out of the other.
inline dovetail::discrete_model thin_pipe() {
  return ring(96, 0.97, [](double, double) { return 1.0; });
}

/// The model of the first argument, if there is one.
template <int D>
dovetail::any_geometry model(int argc, char** argv) {
  if (argc < 2) {
    if constexpr (D == 3)
      return block_with_hole();
    else
      return dovetail::plane_domain(
          dovetail::drawing_from_svg_path("M-1 -1 H1 V1 H-1 Z M-.5 0 a.5 .5 0 1 0 1 0 a.5 .5 0 1 0 -1 0 Z"));
  }
  if (!dovetail::triangle_format_of(argv[1]).empty())
    return dovetail::read_discrete_model(argv[1], {.allow_sheets = D == 2});
#ifdef EXAMPLE_HAS_OCCT
  return dovetail::read_occt_model(argv[1]).model;
#else
  throw dovetail::input_error(std::string(argv[1]) + ": CAD files need Open CASCADE");
#endif
}

/// The second argument, or what makes some ten thousand elements.
template <int D>
double size(int argc, char** argv, const dovetail::any_geometry& model) {
  return argc > 2 ? std::atof(argv[2]) : model.bounds().diagonal() / (D == 2 ? 80 : 32);
}

} // namespace paper
