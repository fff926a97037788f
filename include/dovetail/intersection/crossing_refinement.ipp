/// @file
/// What `crossing_refinement.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/geometry/error_of_faces.hpp"
#include "dovetail/intersection/crossing_refinement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE void throw_crossing_faces(const geometry_topology& topology, std::array<local_id, 2> faces) {
  const auto name = [&](local_id f) { return entity_name("face", f, topology.faces[f].name); };
  throw error_of_faces<intersection_error>(
      (faces[0] == faces[1] ? "the surface of " + name(faces[0]) + " crosses itself or stays folded over"
                            : "the surfaces of " + name(faces[0]) + " and " + name(faces[1]) + " cross") +
          ", also when refined; repair the model there or give a smaller size",
      {faces[0], faces[1]});
}

DOVETAIL_INLINE std::vector<surface_crossing> one_of_each_place(std::span<const surface_crossing> crossings) {
  using cell = std::array<double, 3>;
  std::map<int, std::map<cell, std::vector<std::size_t>>> cells_of_scale;
  const auto cell_of = [](vec3 p, int scale) {
    return cell{std::floor(std::ldexp(p.x, -scale)), std::floor(std::ldexp(p.y, -scale)),
                std::floor(std::ldexp(p.z, -scale))};
  };
  std::vector<surface_crossing> places;
  for (const surface_crossing& crossing : crossings) {
    const auto covers = [&](std::size_t place) {
      return places[place].size <= 1.2 * crossing.size &&
             distance(places[place].center, crossing.center) < places[place].size;
    };
    const auto is_covered_at = [&](const auto& scale_and_cells) {
      const auto& [scale, cells] = scale_and_cells;
      const cell middle = cell_of(crossing.center, scale);
      for (int k = 0; k < 27; ++k)
        if (const auto found =
                cells.find({middle[0] + k % 3 - 1, middle[1] + k / 3 % 3 - 1, middle[2] + k / 9 - 1});
            found != cells.end() && std::any_of(found->second.begin(), found->second.end(), covers))
          return true;
      return false;
    };
    if (std::any_of(cells_of_scale.begin(), cells_of_scale.end(), is_covered_at))
      continue;
    if (crossing.size > 0) {
      const int scale = std::ilogb(crossing.size) + 1; // cells at least as large as the place
      cells_of_scale[scale][cell_of(crossing.center, scale)].push_back(places.size());
    }
    places.push_back(crossing);
  }
  return places;
}

DOVETAIL_INLINE std::vector<size_ball> balls_around(std::span<const surface_crossing> crossings) {
  std::vector<size_ball> balls;
  for (const surface_crossing& crossing : crossings)
    balls.push_back({crossing.center, 2 * crossing.size, 0.5 * crossing.size});
  return balls;
}

} // namespace dovetail
