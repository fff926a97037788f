/// @file
/// Distributed meshes for tests, cut by hand: the unit cube on a grid, made of solids stacked in z, cut into
/// equal boxes. Every cell of the grid is six tetrahedra around its diagonal, so the mesh conforms.
#pragma once

#include "files/distribute.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace dovetail::testing {

struct stacked_cubes {
  int cells = 8;     ///< per axis; a multiple of cuts and solids
  int cuts = 2;      ///< boxes per axis, each a subdomain
  int solids = 1;    ///< a divisor or a multiple of cuts, so that no subdomain has two materials
  double jitter = 0; ///< of inner points, in cells

  using grid_place = std::array<int, 3>; ///< in sixths of a cell, so that centroids are whole too

  int point_index(int i, int j, int k) const { return (k * (cells + 1) + j) * (cells + 1) + i; }

  /// CAD: level l (0 .. solids) is face l with curves 4l .. 4l+3 and vertices 4l .. 4l+3; solid m has the
  /// side faces solids+1+4m .. and the vertical curves 4(solids+1)+4m .. .
  host host_of(grid_place at) const {
    const int end = 6 * cells;
    const int layer = end / solids;
    const bool level = at[2] % layer == 0;
    const int l = at[2] / layer;
    const int m = std::min(l, solids - 1);
    const bool on_x = at[0] == 0 || at[0] == end;
    const bool on_y = at[1] == 0 || at[1] == end;
    const int corner = (at[0] == end ? 1 : 0) + (at[1] == end ? 2 : 0);
    if (level && on_x && on_y)
      return {0, 4 * l + corner};
    if (level && on_x)
      return {1, 4 * l + (at[0] == end ? 1 : 0)};
    if (level && on_y)
      return {1, 4 * l + (at[1] == end ? 3 : 2)};
    if (on_x && on_y)
      return {1, 4 * (solids + 1) + 4 * m + corner};
    if (level)
      return {2, l};
    if (on_x)
      return {2, solids + 1 + 4 * m + (at[0] == end ? 1 : 0)};
    if (on_y)
      return {2, solids + 1 + 4 * m + (at[1] == end ? 3 : 2)};
    return {3, m};
  }

  /// The whole mesh; tags are the solids.
  simplicial_mesh<3> whole() const;
  /// The whole mesh cut into cuts^3 subdomains; the pieces are held by the result's `load`.
  distributed_mesh distributed() const;
  /// The whole mesh with the given subdomain of each element; no subdomain may have two materials.
  distributed_mesh distributed(const std::vector<local_id>& parts) const;
  /// With one piece changed.
  distributed_mesh spoilt(local_id which, const std::function<void(mesh_piece&)>& spoil) const;

  grid_place place_of(local_id v) const {
    const int side = cells + 1;
    return {6 * (v % side), 6 * (v / side % side), 6 * (v / side / side)};
  }
  vec3 position(grid_place at) const {
    const double scale = 1.0 / (6 * cells);
    vec3 p{scale * at[0], scale * at[1], scale * at[2]};
    if (host_of(at).dimension == 3)
      for (int axis = 0; axis < 3; ++axis)
        p[axis] +=
            jitter / cells * (((at[0] * 7 + at[1] * 13 + at[2] * 29 + axis * 5) / 6 % 11) / 11.0 - 0.5);
    return p;
  }
  template <std::size_t N>
  grid_place centroid(const std::array<local_id, N>& entity) const {
    grid_place sum{0, 0, 0};
    for (const auto v : entity)
      for (std::size_t axis = 0; axis < 3; ++axis)
        sum[axis] += place_of(v)[axis];
    for (auto& s : sum)
      s /= static_cast<int>(N);
    return sum;
  }
  local_id subdomain_of(const simplex<3>& element) const {
    const auto at = centroid(element);
    const int box = 6 * cells / cuts;
    return ((at[2] / box) * cuts + at[1] / box) * cuts + at[0] / box;
  }
};

inline simplicial_mesh<3> stacked_cubes::whole() const {
  simplicial_mesh<3> mesh;
  const local_id side = cells + 1;
  for (local_id v = 0; v < side * side * side; ++v)
    mesh.points.push_back(position(place_of(v)));
  constexpr std::array<std::array<int, 3>, 6> orders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (int k = 0; k < cells; ++k)
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i)
        for (std::size_t o = 0; o < orders.size(); ++o) {
          std::array<int, 3> step{i, j, k};
          simplex<3> element;
          element[0] = point_index(i, j, k);
          for (std::size_t s = 0; s < 3; ++s) {
            ++step[orders[o][s]];
            element[s + 1] = point_index(step[0], step[1], step[2]);
          }
          if (o >= 3)
            std::swap(element[2], element[3]);
          mesh.elements.push_back(element);
          mesh.tags.push_back(k * solids / cells);
        }
  return mesh;
}

inline distributed_mesh stacked_cubes::distributed() const {
  const auto mesh = whole();
  std::vector<local_id> parts;
  for (const auto& element : mesh.elements)
    parts.push_back(subdomain_of(element));
  return distributed(parts);
}

inline distributed_mesh stacked_cubes::distributed(const std::vector<local_id>& parts) const {
  auto result = distribute(whole(), parts, [this](const auto& entity) { return host_of(centroid(entity)); });
  for (int m = 0; m < solids; ++m)
    result.material_names.push_back("solid \"" + std::to_string(m) + "\" <&>");
  const int faces = solids + 1 + 4 * solids;
  for (int f = 0; f < faces; ++f) {
    result.face_names.push_back("cad face " + std::to_string(f));
    result.group_names.push_back(f == 0 ? "floor" : f == solids ? "roof" : f < solids ? "" : "side walls");
  }
  return result;
}

inline distributed_mesh stacked_cubes::spoilt(local_id which,
                                              const std::function<void(mesh_piece&)>& spoil) const {
  auto mesh = distributed();
  mesh.load = [load = mesh.load, which, spoil](local_id p) {
    auto piece = load(p);
    if (p == which)
      spoil(piece);
    return piece;
  };
  return mesh;
}

inline const stacked_cubes cubes_in_eight{.cells = 8, .cuts = 2, .solids = 2, .jitter = 0.3};
inline const stacked_cubes coarse_cubes_in_eight{.cells = 6, .cuts = 2, .solids = 2, .jitter = 0.3};
inline const stacked_cubes cubes_in_27{.cells = 6, .cuts = 3, .solids = 3, .jitter = 0.3};

} // namespace dovetail::testing
