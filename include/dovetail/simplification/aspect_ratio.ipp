/// @file
/// What `aspect_ratio.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/simplification/aspect_ratio.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace dovetail::simplifier {

DOVETAIL_INLINE side_judgement aspect_ratio::operator()(const simplicial_mesh<3>& mesh,
                                                        const side_table<3>& sides) const {
  side_judgement judged{std::vector<double>(sides.size()), volume_ratio, volume_dihedral_deg};
  for (std::size_t s = 0; s < sides.size(); ++s)
    judged.quality[s] = ratio(corners(span_of(mesh.points), sides.vertices[s]));
  return judged;
}

DOVETAIL_INLINE side_judgement aspect_ratio::operator()(const simplicial_mesh<2>& mesh,
                                                        const side_table<2>& sides) const {
  side_judgement judged{std::vector<double>(sides.size(), 1.0), surface_ratio, surface_dihedral_deg};
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (const local_id side : sides.of_element[e]) {
      double& quality = judged.quality[side];
      quality = std::min(quality, ratio(corners(span_of(mesh.points), mesh.elements[e])));
    }
  return judged;
}

DOVETAIL_INLINE double aspect_ratio::ratio(const std::array<vec3, 3>& p) {
  const double a = norm(p[2] - p[1]);
  const double b = norm(p[0] - p[2]);
  const double c = norm(p[1] - p[0]);
  const double product = a * b * c;
  return product > 0 ? std::max(0.0, (b + c - a) * (c + a - b) * (a + b - c) / product) : 0;
}

} // namespace dovetail::simplifier
