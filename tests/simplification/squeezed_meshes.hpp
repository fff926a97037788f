/// @file
/// Random meshes with many bad angles.
#pragma once

#include "support/jittered_meshes.hpp"

#include <cstdint>
#include <limits>

namespace dovetail_test {

inline constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Every point moved, then squeezed.
inline dovetail::simplicial_mesh<3> squeezed_cubes(int n, std::uint64_t seed, double squeeze = 0.4) {
  auto mesh = shuffled(jittered_cubes(n, 0.14, seed), seed + 10);
  random_numbers random(seed);
  for (dovetail::vec3& p : mesh.points) {
    p += 0.01 / n * dovetail::vec3{random.signed_unit(), random.signed_unit(), random.signed_unit()};
    p.z *= squeeze;
  }
  return mesh;
}
inline dovetail::simplicial_mesh<2> squeezed_squares(int n, std::uint64_t seed) {
  auto mesh = shuffled(jittered_squares(n, 0.25, seed), seed + 10);
  random_numbers random(seed);
  for (dovetail::vec3& p : mesh.points) {
    p += 0.01 / n * dovetail::vec3{random.signed_unit(), random.signed_unit(), random.signed_unit()};
    p.y *= 0.6;
  }
  return mesh;
}

/// Two materials, cut where x = 0.5 or so.
template <int D>
void give_two_tags(dovetail::simplicial_mesh<D>& mesh) {
  for (const auto& element : mesh.elements) {
    double x = 0;
    for (const dovetail::local_id v : element)
      x += mesh.points[v].x / (D + 1);
    mesh.tags.push_back(x < 0.5 ? 7 : 3);
  }
}

} // namespace dovetail_test
