/// @file
/// The entities of an MSH 4.1 file with their numbers, boxes and nodes, and the sections that list them.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/files/face_groups.hpp"
#include "dovetail/files/msh_encoder.hpp"
#include "dovetail/files/partition_entities.hpp"
#include "dovetail/files/skeleton_entities.hpp"
#include "dovetail/mesh/quadratic_element.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::io::detail {

/// Entities by dimension, as the file numbers them.
struct msh_entities {
  skeleton_entities entities;
  std::array<std::vector<local_id>, 4> tags; ///< per dimension and entity: its number in the file
  std::array<std::vector<box3>, 4> boxes;    ///< per dimension and entity
  std::array<std::vector<std::vector<local_id>>, 4> points; ///< the skeleton's nodes per dimension and entity
  std::array<std::vector<std::vector<local_id>>, 3> simplices; ///< of dimension 1: edges, 2: triangles
};

/// The number in the file of an entity of the CAD model.
inline local_id cad_tag(local_id id) {
  return id + 1;
}
inline local_id partition_tag(local_id subdomain) {
  return subdomain + 1;
}

/// Collects boxes, points, edges and triangles per entity. O(skeleton).
inline void collect_members(msh_entities& out, std::span<const vec3> points) {
  const auto& entities = out.entities;
  for (std::size_t d = 0; d < 4; ++d) {
    out.boxes[d].resize(entities.of_dimension[d].size());
    out.points[d].resize(entities.of_dimension[d].size());
  }
  out.simplices[1].resize(entities.of_dimension[1].size());
  out.simplices[2].resize(entities.of_dimension[2].size());
  const auto include = [&](int dimension, local_id entity, local_id point) {
    out.boxes[dimension][entity].include(points[point]);
  };
  for (std::size_t v = 0; v < entities.of_point.size(); ++v)
    if (const auto at = entities.of_point[v]; at.id != no_id) {
      const auto point = static_cast<local_id>(v);
      out.points[at.dimension][at.id].push_back(point);
      include(at.dimension, at.id, point);
    }
  for (std::size_t e = 0; e < entities.edges.size(); ++e) {
    const auto& edge = entities.edges[e];
    out.simplices[1][edge.line].push_back(static_cast<local_id>(e));
    for (const auto v : edge.vertices)
      include(1, edge.line, v);
  }
  for (std::size_t t = 0; t < entities.triangles.size(); ++t)
    if (const auto face = entities.of_triangle[t]; face != no_id) {
      out.simplices[2][face].push_back(static_cast<local_id>(t));
      for (const auto v : entities.triangles[t])
        include(2, face, v);
    }
  for (std::size_t i = 0; i < entities.of_dimension[3].size(); ++i)
    for (const auto& face : entities.of_dimension[3][i].boundary) {
      const auto& box = out.boxes[2][face.entity];
      out.boxes[3][i].include(box.lower);
      out.boxes[3][i].include(box.upper);
    }
}

/// Files the middles of the skeleton's edges, where there are any, under the entities that the edges are in:
/// a line, else a face, else the inside; `inside_of(subdomain)` is that of a subdomain, of dimension D. Edges
/// of sides that the skeleton does not have are left out.
template <int D, class Function>
void file_middles(msh_entities& out, const distributed_simplicial_mesh<D>& mesh, Function inside_of) {
  if (!mesh.mid_nodes)
    return;
  const auto& skeleton = mesh.skeleton;
  std::vector<host> of_edge(mesh.mid_nodes->edges.size(), host{D + 1, no_id});
  const auto lower = [&](const simplex<1>& edge, host entity) {
    auto& filed = of_edge[find_edge(mesh.mid_nodes->edges, edge)];
    filed = std::min(filed, entity);
  };
  for (const auto& edge : out.entities.edges)
    lower(edge.vertices, {1, edge.line});
  for (std::size_t t = 0; t < skeleton.sides.size(); ++t) {
    const local_id face = D == 3 ? out.entities.of_triangle[t] : no_id;
    const host entity = face != no_id ? host{2, face} : host{D, inside_of(skeleton.subdomains[t][0])};
    for (const auto& local : numbering::edges<D - 1>)
      lower(vertices_of_edge(skeleton.sides[t], local), entity);
  }
  for (std::size_t e = 0; e < of_edge.size(); ++e)
    if (of_edge[e].id != no_id)
      out.points[of_edge[e].dimension][of_edge[e].id].push_back(
          static_cast<local_id>(skeleton.points.size() + e));
}

/// The entities of the CAD model, numbered by their index in the model.
inline msh_entities number_cad_entities(const distributed_mesh& mesh, const point_sharers& sharers,
                                        std::size_t materials) {
  msh_entities out;
  out.entities = cad_entities(mesh, sharers, materials);
  for (std::size_t d = 0; d < 4; ++d)
    for (const auto& entity : out.entities.of_dimension[d])
      out.tags[d].push_back(cad_tag(entity.on.id));
  collect_members(out, mesh.skeleton.points);
  return out;
}

/// The curves and faces of a mesh of triangles, of which `faces` have some; what bounds them is not said.
inline msh_entities number_cad_entities(const distributed_simplicial_mesh<2>& mesh,
                                        const std::set<local_id>& faces) {
  msh_entities out;
  const auto add = [&](int dimension, local_id id) {
    out.entities.of_dimension[dimension].push_back({{dimension, id}, {}, {}});
    out.tags[dimension].push_back(cad_tag(id));
  };
  const auto& skeleton = mesh.skeleton;
  std::vector<std::pair<local_id, simplex<1>>>
      edges; // one of other than two triangles is there several times
  for (std::size_t e = 0; e < skeleton.sides.size(); ++e)
    if (skeleton.side_hosts[e] != no_id)
      edges.emplace_back(skeleton.side_hosts[e], sorted_vertices(skeleton.sides[e]));
  sort_unique(edges);
  for (const auto& [curve, ends] : edges) {
    if (out.tags[1].empty() || out.tags[1].back() != cad_tag(curve))
      add(1, curve);
    out.entities.edges.push_back({ends, static_cast<local_id>(out.tags[1].size() - 1)});
  }
  for (const local_id face : faces)
    add(2, face);
  collect_members(out, skeleton.points);
  box3 whole;
  for (std::size_t v = 0; v < skeleton.points.size(); ++v) {
    whole.include(skeleton.points[v]);
    out.points[2].front().push_back(static_cast<local_id>(v));
  }
  out.boxes[2].assign(faces.size(), whole);
  return out;
}

/// The entities of the partition, numbered after those of the CAD model.
inline msh_entities number_partition_entities(const distributed_mesh& mesh, const point_sharers& sharers,
                                              const msh_entities& cad) {
  msh_entities out;
  out.entities = partition_entities(mesh, sharers);
  for (std::size_t d = 0; d < 4; ++d) {
    local_id next = 1;
    for (const auto tag : cad.tags[d])
      next = std::max(next, tag + 1);
    for (std::size_t i = 0; i < out.entities.of_dimension[d].size(); ++i)
      out.tags[d].push_back(next++);
  }
  collect_members(out, mesh.skeleton.points);
  return out;
}

/// Writes the physical group of an entity: the group of a face of the model, the material of a volume.
inline void write_physical_tag(msh_encoder& out, const face_groups& groups, int dimension, host on) {
  const bool on_face = dimension == 2 && on.dimension == 2;
  if (!on_face && dimension != 3)
    return out.count(0);
  out.count(1);
  out.integer(1 + (on_face ? groups.of_face[on.id] : on.id));
}

/// Writes the counts and the records of all entities. Records of a partition also name parent and sharers.
inline void write_entity_records(msh_encoder& out, const msh_entities& all, const face_groups& groups,
                                 bool partitioned) {
  for (const auto& dimension : all.tags)
    out.count(dimension.size());
  out.line();
  for (std::size_t d = 0; d < 4; ++d)
    for (std::size_t i = 0; i < all.tags[d].size(); ++i) {
      const auto& entity = all.entities.of_dimension[d][i];
      out.integer(all.tags[d][i]);
      if (partitioned) {
        out.integer(entity.on.dimension);
        out.integer(cad_tag(entity.on.id));
        out.count(entity.sharers.size());
        for (const auto s : entity.sharers)
          out.integer(partition_tag(s));
      }
      const auto box = all.boxes[d][i].empty() ? box3{{}, {}} : all.boxes[d][i];
      out.point(box.lower);
      if (d > 0)
        out.point(box.upper);
      write_physical_tag(out, groups, static_cast<int>(d), entity.on);
      if (d > 0) {
        out.count(entity.boundary.size());
        for (const auto& side : entity.boundary) {
          const auto tag = all.tags[d - 1][side.entity];
          out.integer(side.reversed ? -tag : tag);
        }
      }
      out.line();
    }
}

/// The section $PartitionedEntities; `ghost_tags` per partition, or empty.
inline void write_partitioned_entities(msh_encoder& out, const msh_entities& parts, const face_groups& groups,
                                       std::size_t partitions, const std::vector<local_id>& ghost_tags) {
  out.begin("PartitionedEntities");
  out.count(partitions);
  out.line();
  out.count(ghost_tags.size());
  out.line();
  for (std::size_t s = 0; s < ghost_tags.size(); ++s) {
    out.integer(ghost_tags[s]);
    out.integer(partition_tag(static_cast<local_id>(s)));
    out.line();
  }
  write_entity_records(out, parts, groups, true);
  out.end("PartitionedEntities");
}

} // namespace dovetail::io::detail
