/// @file
/// Distributed meshes for tests, cut by hand: the unit cube on a grid, made of solids stacked in z, cut into
/// equal boxes. Every cell of the grid is six tetrahedra around its diagonal, so the mesh conforms.
#pragma once

#include "dovetail/mesh/distributed_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
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
            ++step[static_cast<std::size_t>(orders[o][s])];
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
  struct owned_side {
    simplex<2> key;  ///< ascending
    simplex<2> side; ///< outwards of its element
    local_id subdomain;
  };
  std::vector<owned_side> sides;
  for (const auto& element : mesh.elements)
    for (const auto& local : numbering::sides<3>) {
      simplex<2> side;
      for (std::size_t k = 0; k < 3; ++k)
        side[k] = element[static_cast<std::size_t>(local[k])];
      auto key = side;
      std::sort(key.begin(), key.end());
      sides.push_back({key, side, subdomain_of(element)});
    }
  std::sort(sides.begin(), sides.end(), [](const owned_side& a, const owned_side& b) {
    return std::tie(a.key, a.subdomain) < std::tie(b.key, b.subdomain);
  });

  distributed_mesh result;
  auto& skeleton = result.skeleton;
  std::vector<local_id> skeleton_point(mesh.points.size(), no_id);
  std::vector<simplex<1>> edges;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool paired = i + 1 < sides.size() && sides[i + 1].key == sides[i].key;
    const auto& first = sides[i];
    const auto other = paired ? sides[++i].subdomain : no_id;
    if (first.subdomain == other)
      continue;
    simplex<2> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      auto& s = skeleton_point[static_cast<std::size_t>(first.side[k])];
      if (s == no_id) {
        s = static_cast<local_id>(skeleton.points.size());
        skeleton.points.push_back(mesh.points[static_cast<std::size_t>(first.side[k])]);
        skeleton.point_hosts.push_back(host_of(place_of(first.side[k])));
      }
      triangle[k] = s;
      edges.push_back({first.key[k == 2 ? 1 : 0], first.key[k == 0 ? 1 : 2]});
    }
    skeleton.triangles.push_back(triangle);
    skeleton.subdomains.push_back({first.subdomain, other});
    const auto on = host_of(centroid(first.side));
    skeleton.cad_faces.push_back(on.dimension == 2 ? on.id : no_id);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const auto& edge : edges)
    if (const auto on = host_of(centroid(edge)); on.dimension == 1) {
      skeleton.curve_edges.push_back({skeleton_point[static_cast<std::size_t>(edge[0])],
                                      skeleton_point[static_cast<std::size_t>(edge[1])]});
      skeleton.curves.push_back(on.id);
    }

  const auto subdomains = static_cast<local_id>(cuts * cuts * cuts);
  auto pieces = std::make_shared<std::vector<mesh_piece>>(static_cast<std::size_t>(subdomains));
  std::vector<std::vector<simplex<3>>> elements(pieces->size());
  std::vector<local_id> materials(pieces->size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto s = static_cast<std::size_t>(subdomain_of(mesh.elements[e]));
    elements[s].push_back(mesh.elements[e]);
    materials[s] = mesh.tags[e];
  }
  for (std::size_t p = 0; p < pieces->size(); ++p) {
    auto& piece = (*pieces)[p];
    piece.subdomain = static_cast<local_id>(p);
    piece.material = materials[p];
    std::vector<local_id> vertices;
    for (const auto& element : elements[p])
      vertices.insert(vertices.end(), element.begin(), element.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::stable_partition(vertices.begin(), vertices.end(),
                          [&](local_id v) { return skeleton_point[static_cast<std::size_t>(v)] != no_id; });
    std::vector<local_id> place(mesh.points.size(), no_id);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const auto v = static_cast<std::size_t>(vertices[i]);
      place[v] = static_cast<local_id>(i);
      piece.mesh.points.push_back(mesh.points[v]);
      if (skeleton_point[v] != no_id)
        piece.skeleton_points.push_back(skeleton_point[v]);
    }
    for (auto element : elements[p]) {
      for (auto& v : element)
        v = place[static_cast<std::size_t>(v)];
      piece.mesh.elements.push_back(element);
      piece.mesh.tags.push_back(piece.material);
    }
    result.counts.push_back({piece.material,
                             static_cast<global_id>(vertices.size() - piece.skeleton_points.size()),
                             static_cast<global_id>(piece.mesh.elements.size())});
  }
  result.load = [pieces](local_id p) { return (*pieces)[static_cast<std::size_t>(p)]; };

  for (int m = 0; m < solids; ++m)
    result.material_names.push_back("solid \"" + std::to_string(m) + "\" <&>");
  const int faces = solids + 1 + 4 * solids;
  for (int f = 0; f < faces; ++f) {
    result.face_names.push_back("cad face " + std::to_string(f));
    result.patch_names.push_back(f == 0 ? "floor" : f == solids ? "roof" : f < solids ? "" : "side walls");
  }
  return result;
}

} // namespace dovetail::testing
