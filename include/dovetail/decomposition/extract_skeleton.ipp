/// @file
/// What `extract_skeleton.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/extract_skeleton.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/background_mesh.hpp"
#include "dovetail/mesh/coarse_skeleton.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// The same oriented triangle, told from its smallest vertex.
inline simplex<2> from_smallest(simplex<2> t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// Surface edges with, for each, the triangles around it and its place on a curve if it has one.
class surface_edges {
public:
  explicit surface_edges(const surface_mesh& surface) : surface_(surface), sides_(build_sides(surface.mesh)) {
    curve_edge_of_.assign(sides_.size(), no_id);
    for (std::size_t i = 0; i < surface.curve_edges.size(); ++i) {
      const auto& edge = surface.curve_edges[i];
      const local_id side = find_side<2>(sides_, edge.vertices);
      if (side == no_id)
        throw mesh_error("curve " + std::to_string(edge.curve) + ": the coarse edge " +
                         std::to_string(edge.vertices[0]) + "-" + std::to_string(edge.vertices[1]) +
                         " is not an edge of the coarse surface mesh");
      curve_edge_of_[side] = static_cast<local_id>(i);
    }
  }

  const side_table<2>& sides() const { return sides_; }
  bool on_curve(std::size_t side) const { return curve_edge_of_[side] != no_id; }

  /// The line along a surface edge, with its curve or face parameters in key order.
  skeleton_line line(std::size_t side) const {
    skeleton_line result;
    result.vertices = sorted_vertices(sides_.vertices[side]);
    if (on_curve(side)) {
      const auto& edge = surface_.curve_edges[curve_edge_of_[side]];
      result.on = {1, edge.curve};
      result.t = edge.vertices == result.vertices ? edge.t : std::array{edge.t[1], edge.t[0]};
      return result;
    }
    const auto triangle = static_cast<std::size_t>(sides_.elements[side][0]);
    result.on = {2, surface_.mesh.tags[triangle]};
    for (std::size_t end = 0; end < 2; ++end)
      result.uv[end] = corner_uv(triangle, result.vertices[end]);
    return result;
  }

private:
  vec2 corner_uv(std::size_t triangle, local_id vertex) const {
    const auto& corners = surface_.mesh.elements[triangle];
    return surface_.corner_uv[triangle][std::find(corners.begin(), corners.end(), vertex) - corners.begin()];
  }

  const surface_mesh& surface_;
  side_table<2> sides_;
  std::vector<local_id> curve_edge_of_;
};

/// Whether a surface edge bounds regions: on a curve, at a change of CAD face or subdomains, or not manifold.
inline bool bounds_regions(const surface_edges& edges, std::size_t side, const surface_mesh& surface,
                           const triangle_subdomains& subdomains) {
  const auto [first, second] = edges.sides().elements[side];
  if (edges.on_curve(side) || !edges.sides().is_interior(static_cast<local_id>(side)))
    return true;
  const auto a = static_cast<std::size_t>(first), b = static_cast<std::size_t>(second);
  return subdomains[a] != subdomains[b] || surface.mesh.tags[a] != surface.mesh.tags[b];
}

inline std::vector<skeleton_region> connected_regions(const surface_mesh& surface, const surface_edges& edges,
                                                      const std::vector<bool>& is_line,
                                                      const triangle_subdomains& subdomains) {
  const auto& elements = surface.mesh.elements;
  std::vector<bool> seen(elements.size(), false);
  std::vector<skeleton_region> regions;
  for (std::size_t start = 0; start < elements.size(); ++start) {
    if (seen[start])
      continue;
    skeleton_region region{surface.mesh.tags[start], subdomains[start]};
    seen[start] = true;
    region.triangles.push_back(static_cast<local_id>(start));
    for (std::size_t next = 0; next < region.triangles.size(); ++next) {
      const local_id triangle = region.triangles[next];
      for (const local_id side : edges.sides().of_element[triangle]) {
        if (is_line[side])
          continue;
        const local_id across = edges.sides().across(side, triangle);
        if (!seen[across]) {
          seen[across] = true;
          region.triangles.push_back(across);
        }
      }
    }
    sort_all(region.triangles);
    regions.push_back(std::move(region));
  }
  return regions;
}

/// Coarse vertices that interface faces use but no line of the region ends at: they must survive in its
/// inside.
inline void find_fixed_points(std::vector<skeleton_region>& regions, const surface_mesh& surface,
                              const std::vector<skeleton_line>& lines,
                              const std::vector<skeleton_face>& faces) {
  std::vector<bool> on_line(surface.mesh.points.size(), false), on_face(surface.mesh.points.size(), false);
  const auto mark = [&](std::vector<bool>& flags, local_id v) {
    if (static_cast<std::size_t>(v) < flags.size())
      flags[v] = true;
  };
  for (const skeleton_line& line : lines)
    if (line.on.dimension < 3)
      for (const local_id v : line.vertices)
        mark(on_line, v);
  for (const skeleton_face& face : faces)
    for (const local_id v : face.vertices)
      mark(on_face, v);
  for (skeleton_region& region : regions) {
    for (const local_id triangle : region.triangles)
      for (const local_id v : surface.mesh.elements[triangle])
        if (on_face[v] && !on_line[v])
          region.fixed_points.push_back(v);
    sort_unique(region.fixed_points);
  }
}

/// The edges of interface faces.
struct edges_of_faces {
  std::vector<std::array<local_id, 2>> edges; ///< sorted, each once
  std::vector<local_id> of_face;              ///< their numbers: 3 f + i is the one behind corner i of face f
};

inline edges_of_faces face_edges(const std::vector<skeleton_face>& faces) {
  local_id last = -1;
  for (const skeleton_face& face : faces)
    last = std::max(last, *std::max_element(face.vertices.begin(), face.vertices.end()));
  edges_of_faces found;
  found.of_face.resize(3 * faces.size());
  for_each_group<2>(
      3 * faces.size(), static_cast<std::size_t>(last) + 1,
      [&](std::size_t k) {
        const simplex<2>& vertices = faces[k / 3].vertices;
        return sorted_vertices(std::array{vertices[k % 3], vertices[(k + 1) % 3]});
      },
      [&](const std::array<local_id, 2>& edge, std::span<const std::uint32_t> members) {
        for (const std::uint32_t k : members)
          found.of_face[k] = static_cast<local_id>(found.edges.size());
        found.edges.push_back(edge);
      });
  return found;
}

/// Adds those edges of interface faces that are no lines yet, as lines inside the domain, to the sorted lines
/// on the surface, and tells faces that have an edge on the surface.
inline void add_lines_inside(std::vector<skeleton_line>& lines, const edges_of_faces& of_faces,
                             std::vector<skeleton_face>& faces) {
  const std::vector<skeleton_line> on_surface = std::exchange(lines, {});
  std::vector<std::uint8_t> is_on_surface(of_faces.edges.size(), 0);
  lines.reserve(on_surface.size() + of_faces.edges.size());
  auto next = on_surface.begin();
  for (std::size_t e = 0; e < of_faces.edges.size(); ++e) {
    const std::array<local_id, 2>& edge = of_faces.edges[e];
    for (; next != on_surface.end() && next->vertices < edge; ++next)
      lines.push_back(*next);
    is_on_surface[e] = next != on_surface.end() && next->vertices == edge ? 1 : 0;
    if (is_on_surface[e] == 0)
      lines.push_back({.vertices = edge});
  }
  lines.insert(lines.end(), next, on_surface.end());
  for (std::size_t k = 0; k < of_faces.of_face.size(); ++k)
    if (is_on_surface[of_faces.of_face[k]] != 0)
      faces[k / 3].is_curved = true;
}

/// At the entry of the steps on the volume.
inline void require_volume(const background_mesh& mesh, const side_table<3>& sides,
                           const std::vector<local_id>& subdomain_of_element, mesh_state mesh_is,
                           std::string_view who) {
  if (mesh_is == mesh_state::valid)
    return;
  require_valid(mesh.volume, sides, who);
  require_one_per_element(subdomain_of_element, mesh.volume.elements.size(),
                          std::numeric_limits<local_id>::max(), who, "subdomains");
}

/// What the surface step takes for granted of the arrays beside the mesh. The mesh itself is looked at when
/// its sides are known.
inline void require_surface(const surface_mesh& surface, const triangle_subdomains& subdomains) {
  const std::size_t triangles = surface.mesh.elements.size();
  const auto one_each = [](std::size_t given, const char* what, std::size_t wanted, const char* of) {
    if (given != wanted)
      throw usage_error("extract_skeleton: " + std::to_string(given) + " " + what + " for " +
                        std::to_string(wanted) + " " + of + "; give one each");
  };
  one_each(subdomains.size(), "pairs of subdomains", triangles, "triangles");
  one_each(surface.mesh.tags.size(), "tags", triangles, "triangles");
  one_each(surface.corner_uv.size(), "corner parameters", triangles, "triangles");
  one_each(surface.vertex_hosts.size(), "hosts", surface.mesh.points.size(), "points");
  require_elements(surface.mesh, "extract_skeleton", {});
}

} // namespace detail

DOVETAIL_INLINE std::vector<skeleton_face> interface_faces(const background_mesh& mesh,
                                                           const side_table<3>& sides,
                                                           const std::vector<local_id>& subdomain_of_element,
                                                           mesh_state mesh_is) {
  detail::require_volume(mesh, sides, subdomain_of_element, mesh_is, "interface_faces");
  std::vector<skeleton_face> faces;
  for (std::size_t side = 0; side < sides.size(); ++side) {
    const auto [first, second] = sides.elements[side];
    if (second == no_id)
      continue;
    const local_id a = subdomain_of_element[first];
    const local_id b = subdomain_of_element[second];
    const bool one_material = mesh.volume.tags.empty() || mesh.volume.tags[first] == mesh.volume.tags[second];
    if (a == b || !one_material)
      continue;
    simplex<2> outwards_of_a = sides.vertices[side];
    if (a > b)
      std::swap(outwards_of_a[1], outwards_of_a[2]);
    faces.push_back({detail::from_smallest(outwards_of_a),
                     {std::min(a, b), std::max(a, b)},
                     static_cast<local_id>(side)});
  }
  return faces;
}

DOVETAIL_INLINE elements_at_triangles elements_beside_surface(const background_mesh& mesh,
                                                              const side_table<3>& sides) {
  elements_at_triangles beside;
  beside.reserve(mesh.surface.mesh.elements.size());
  for (const simplex<2>& triangle : mesh.surface.mesh.elements) {
    const local_id side = find_side<3>(sides, triangle);
    if (side == no_id)
      throw mesh_error("surface triangle " + std::to_string(beside.size()) +
                       " is not a side of the coarse volume mesh");
    const auto& [first, second] = sides.elements[side];
    const bool first_is_behind = same_turn(triangle, sides.vertices[side]);
    beside.push_back(first_is_behind ? std::array{first, second} : std::array{second, first});
  }
  return beside;
}

DOVETAIL_INLINE triangle_subdomains induced_subdomains(const elements_at_triangles& beside,
                                                       const std::vector<local_id>& subdomain_of_element) {
  triangle_subdomains subdomains;
  subdomains.reserve(beside.size());
  const auto subdomain = [&](local_id e) { return e == no_id ? no_id : subdomain_of_element[e]; };
  for (const auto& [behind, in_front] : beside)
    subdomains.push_back({subdomain(behind), subdomain(in_front)});
  return subdomains;
}

DOVETAIL_INLINE triangle_subdomains own_subdomains(const std::vector<local_id>& part_of_triangle) {
  triangle_subdomains subdomains;
  subdomains.reserve(part_of_triangle.size());
  for (const local_id part : part_of_triangle)
    subdomains.push_back({part, no_id});
  return subdomains;
}

DOVETAIL_INLINE coarse_skeleton extract_skeleton(const surface_mesh& surface,
                                                 const triangle_subdomains& subdomains,
                                                 std::vector<skeleton_face> faces, mesh_state mesh_is) {
  if (mesh_is == mesh_state::unknown)
    detail::require_surface(surface, subdomains);
  const detail::surface_edges edges(surface);
  detail::require_valid_unless(mesh_is, surface.mesh, edges.sides(), "extract_skeleton");
  const auto face_edges = detail::face_edges(faces);
  coarse_skeleton skeleton;
  std::vector<bool> is_line(edges.sides().size());
  for (std::size_t side = 0; side < is_line.size(); ++side) {
    const auto key = sorted_vertices(edges.sides().vertices[side]);
    is_line[side] = detail::bounds_regions(edges, side, surface, subdomains) ||
                    std::binary_search(face_edges.edges.begin(), face_edges.edges.end(), key);
    if (is_line[side])
      skeleton.lines.push_back(edges.line(side));
  }
  sort_all(skeleton.lines, [](const auto& a, const auto& b) { return a.vertices < b.vertices; });
  detail::add_lines_inside(skeleton.lines, face_edges, faces);

  skeleton.regions = detail::connected_regions(surface, edges, is_line, subdomains);
  detail::find_fixed_points(skeleton.regions, surface, skeleton.lines, faces);
  skeleton.faces = std::move(faces);
  return skeleton;
}

DOVETAIL_INLINE coarse_skeleton extract_skeleton(const background_mesh& mesh, const side_table<3>& sides,
                                                 const std::vector<local_id>& subdomain_of_element,
                                                 mesh_state mesh_is) {
  detail::require_volume(mesh, sides, subdomain_of_element, mesh_is, "extract_skeleton");
  return extract_skeleton(mesh.surface,
                          induced_subdomains(elements_beside_surface(mesh, sides), subdomain_of_element),
                          interface_faces(mesh, sides, subdomain_of_element, mesh_state::valid), mesh_is);
}

} // namespace dovetail
