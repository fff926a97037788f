/// @file
/// Meshes of pieces of any shape and size.
#pragma once

#include "files/stacked_cubes.hpp"

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace dovetail::testing {

/// A mesh of pieces around random places, which differ in size by factors.
inline distributed_mesh lumps(int pieces, std::uint32_t seed, double jitter = 0) {
  const stacked_cubes cubes{.cells = 12, .jitter = jitter};
  const auto whole = cubes.whole();
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<vec3> centres;
  for (int p = 0; p < pieces; ++p)
    centres.push_back({unit(random), unit(random), unit(random)});
  std::vector<local_id> parts;
  for (const auto& element : whole.elements) {
    vec3 at{};
    for (const local_id v : element)
      at += whole.points[v] / 4;
    std::size_t best = 0;
    for (std::size_t p = 0; p < centres.size(); ++p)
      if (norm(centres[p] - at) < norm(centres[best] - at))
        best = p;
    parts.push_back(static_cast<local_id>(best));
  }
  return cubes.distributed(parts);
}

} // namespace dovetail::testing
