/// @file
/// Cuts a mesh held in memory into a distributed one, for tests.
#pragma once

#include "dovetail/mesh/distributed_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <tuple>
#include <vector>

namespace dovetail::testing {

namespace detail {

struct owned_side {
  simplex<2> key;  ///< ascending
  simplex<2> side; ///< outwards of its element
  local_id subdomain;
};

/// All sides of all elements, those of the same points next to each other, the lower subdomain first.
inline std::vector<owned_side> sorted_sides(const simplicial_mesh<3>& mesh,
                                            const std::vector<local_id>& parts) {
  std::vector<owned_side> sides;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (const auto& local : numbering::sides<3>) {
      simplex<2> side;
      for (std::size_t k = 0; k < 3; ++k)
        side[k] = mesh.elements[e][local[k]];
      auto key = side;
      std::sort(key.begin(), key.end());
      sides.push_back({key, side, parts[e]});
    }
  std::sort(sides.begin(), sides.end(), [](const owned_side& a, const owned_side& b) {
    return std::tie(a.key, a.subdomain) < std::tie(b.key, b.subdomain);
  });
  return sides;
}

/// The skeleton, and for each point of the mesh its place in the skeleton or no_id.
template <class HostOf>
std::vector<local_id> cut_skeleton(const simplicial_mesh<3>& mesh, const std::vector<local_id>& parts,
                                   HostOf host_of, fine_skeleton& skeleton) {
  std::vector<local_id> skeleton_point(mesh.points.size(), no_id);
  std::vector<simplex<1>> edges;
  const auto sides = sorted_sides(mesh, parts);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool paired = i + 1 < sides.size() && sides[i + 1].key == sides[i].key;
    const auto& first = sides[i];
    const auto other = paired ? sides[++i].subdomain : no_id;
    if (first.subdomain == other)
      continue;
    simplex<2> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      auto& s = skeleton_point[first.side[k]];
      if (s == no_id) {
        s = static_cast<local_id>(skeleton.points.size());
        skeleton.points.own().push_back(mesh.points[first.side[k]]);
        skeleton.point_hosts.own().push_back(host_of(simplex<0>{first.side[k]}));
      }
      triangle[k] = s;
      edges.push_back({first.key[k == 2 ? 1 : 0], first.key[k == 0 ? 1 : 2]});
    }
    skeleton.sides.own().push_back(triangle);
    skeleton.subdomains.own().push_back({first.subdomain, other});
    const auto on = host_of(first.side);
    skeleton.side_hosts.own().push_back(on.dimension == 2 ? on.id : no_id);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const auto& edge : edges)
    if (const auto on = host_of(edge); on.dimension == 1) {
      skeleton.curve_edges.push_back({skeleton_point[edge[0]], skeleton_point[edge[1]]});
      skeleton.curves.push_back(on.id);
    }
  return skeleton_point;
}

/// The piece of one subdomain: its skeleton points, then the others, each in the order of the whole mesh.
inline mesh_piece cut_piece(const simplicial_mesh<3>& mesh, const std::vector<local_id>& parts,
                            const std::vector<local_id>& skeleton_point, local_id subdomain) {
  mesh_piece piece;
  piece.subdomain = subdomain;
  std::vector<local_id> vertices;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (parts[e] == subdomain) {
      piece.material = mesh.tags[e];
      piece.mesh.elements.push_back(mesh.elements[e]);
      piece.mesh.tags.push_back(mesh.tags[e]);
      vertices.insert(vertices.end(), mesh.elements[e].begin(), mesh.elements[e].end());
    }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::stable_partition(vertices.begin(), vertices.end(),
                        [&](local_id v) { return skeleton_point[v] != no_id; });
  std::vector<local_id> place(mesh.points.size(), no_id);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto v = static_cast<std::size_t>(vertices[i]);
    place[v] = static_cast<local_id>(i);
    piece.mesh.points.push_back(mesh.points[v]);
    if (skeleton_point[v] != no_id)
      piece.skeleton_points.push_back(skeleton_point[v]);
  }
  for (auto& element : piece.mesh.elements)
    for (auto& v : element)
      v = place[v];
  return piece;
}

} // namespace detail

/// Cuts a tagged mesh by the subdomain of each element (all of 0, 1, ... must occur). `host_of` gives the CAD
/// entity of a vertex, edge or triangle. The pieces are held by the result's `load`; names are left empty.
template <class HostOf>
distributed_mesh distribute(const simplicial_mesh<3>& mesh, const std::vector<local_id>& parts,
                            HostOf host_of) {
  distributed_mesh result;
  const auto skeleton_point = detail::cut_skeleton(mesh, parts, host_of, result.skeleton);
  const auto subdomains = 1 + *std::max_element(parts.begin(), parts.end());
  auto pieces = std::make_shared<std::vector<mesh_piece>>();
  for (local_id s = 0; s < subdomains; ++s) {
    pieces->push_back(detail::cut_piece(mesh, parts, skeleton_point, s));
    const auto& piece = pieces->back();
    result.counts.push_back({piece.material,
                             static_cast<global_id>(piece.mesh.points.size() - piece.skeleton_points.size()),
                             static_cast<global_id>(piece.mesh.elements.size())});
  }
  result.load = [pieces](local_id p) { return (*pieces)[p]; };
  return result;
}

} // namespace dovetail::testing
