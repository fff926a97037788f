/// @file
/// Which closed shells lie in which: solids and the voids in them.
#pragma once

#include "dovetail/mesh/inside_surface.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::discrete {

/// The solids that closed shells bound, and the voids in them.
struct shell_nesting {
  std::vector<local_id> solid_of;  ///< per shell
  std::vector<bool> is_inside_out; ///< per shell: its normals point into its solid
  local_id solids = 0;             ///< how many there are
  local_id voids = 0;              ///< how many shells bound a void
};

/// Each shell with points of its own. `shell_of` is per triangle; a shell's triangles are connected, so their
/// points have one shell at a time. O(n log n).
inline std::vector<simplicial_mesh<2>> shell_meshes(const simplicial_mesh<2>& mesh,
                                                    std::span<const local_id> shell_of, local_id count) {
  std::vector<simplicial_mesh<2>> shells(static_cast<std::size_t>(count));
  std::vector<std::pair<local_id, local_id>> place_of(mesh.points.size(),
                                                      {no_id, no_id}); // shell, index in it
  std::vector<std::size_t> order(mesh.elements.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return shell_of[a] < shell_of[b]; });
  for (const std::size_t t : order) {
    auto& shell = shells[shell_of[t]];
    simplex<2> renamed = mesh.elements[t];
    for (local_id& v : renamed) {
      auto& [of_shell, index] = place_of[v];
      if (of_shell != shell_of[t]) {
        of_shell = shell_of[t];
        index = static_cast<local_id>(shell.points.size());
        shell.points.push_back(mesh.points[v]);
      }
      v = index;
    }
    shell.elements.push_back(renamed);
  }
  return shells;
}

/// A point of the shell, off symmetric places: inside the shells around it.
inline vec3 sample_of(const simplicial_mesh<2>& shell) {
  const auto& t = shell.elements.front();
  return 0.29 * shell.points[t[0]] + 0.33 * shell.points[t[1]] + 0.38 * shell.points[t[2]];
}

/// Even depth bounds a solid from outside, odd depth is a void of the solid around it. The shells are closed
/// and consistently oriented. O(s^2 + n log n) for s shells.
inline shell_nesting nested(std::span<const simplicial_mesh<2>> shells) {
  std::vector<inside_surface> inside(shells.begin(), shells.end());
  std::vector<std::vector<std::size_t>> around(shells.size());
  for (std::size_t i = 0; i < shells.size(); ++i)
    for (std::size_t j = 0; j < shells.size(); ++j)
      if (i != j && inside[j].bounds().overlaps(inside[i].bounds()) && inside[j](sample_of(shells[i])))
        around[i].push_back(j);
  const auto is_void = [&](std::size_t i) { return around[i].size() % 2 == 1; };

  shell_nesting result;
  result.solid_of.assign(shells.size(), no_id);
  for (std::size_t i = 0; i < shells.size(); ++i)
    if (!is_void(i))
      result.solid_of[i] = result.solids++;
  for (std::size_t i = 0; i < shells.size(); ++i) {
    result.is_inside_out.push_back((inside[i].signed_volume_inside() < 0) != is_void(i));
    if (!is_void(i))
      continue;
    ++result.voids;
    for (const std::size_t j : around[i]) // the innermost around it has one less around itself
      if (around[j].size() + 1 == around[i].size())
        result.solid_of[i] = result.solid_of[j];
  }
  return result;
}

} // namespace dovetail::discrete
