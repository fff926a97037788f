/// @file
/// The sections of MSH files, whoever writes them: names, entities, nodes, elements.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/files/face_groups.hpp"
#include "dovetail/files/msh_encoder.hpp"
#include "dovetail/files/msh_entities.hpp"
#include "dovetail/files/msh_piece_file.hpp"
#include "dovetail/files/piecewise_output.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/global_numbering.hpp"

#include <array>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::io {

namespace detail {

/// A block of elements: all of some pieces, or in D = 2 those of a piece on one CAD face.
struct element_block {
  std::size_t entity = 0; ///< of dimension D
  std::vector<local_id> pieces = {};
  global_id elements = 0;
};

/// Everything but the pieces: what the sections of one MSH file are written from.
template <int D>
struct msh_document {
  const distributed_simplicial_mesh<D>& mesh;
  const global_numbering& numbers;
  face_groups groups;
  std::vector<std::string> materials; ///< of D = 3
  msh_entities cad;
  msh_entities parts; ///< only of a partitioned file
  bool partitioned = false;
  std::vector<local_id> ghost_tags = {}; ///< per subdomain; empty without ghosts
  std::vector<element_block> blocks = {};

  /// The entities that nodes and elements are filed under.
  const msh_entities& filing() const { return partitioned ? parts : cad; }
  /// The subdomains whose inner points are filed under each entity of dimension D, ascending.
  std::vector<std::vector<local_id>> subdomains_of_entities() const {
    std::vector<std::vector<local_id>> result(filing().tags[D].size());
    for (std::size_t s = 0; s < mesh.counts.size(); ++s)
      result[D == 2        ? 0
             : partitioned ? s
                           : static_cast<std::size_t>(mesh.counts[s].material)]
          .push_back(static_cast<local_id>(s));
    return result;
  }
};

enum class msh_partitions { none, plain, with_ghosts };

inline msh_document<3> prepare_msh(const distributed_mesh& mesh, const global_numbering& numbers,
                                   const std::vector<msh_piece_table>&, msh_partitions partitions) {
  const bool partitioned = partitions != msh_partitions::none;
  msh_document<3> document{mesh, numbers,    collect_face_groups(mesh), collect_material_names(mesh), {},
                           {},   partitioned};
  const point_sharers sharers(mesh.skeleton);
  document.cad = number_cad_entities(mesh, sharers, document.materials.size());
  if (partitioned)
    document.parts = number_partition_entities(mesh, sharers, document.cad);
  file_middles(partitioned ? document.parts : document.cad, mesh,
               [&](local_id s) { return partitioned ? s : material_of(mesh, s); });
  if (partitions == msh_partitions::with_ghosts)
    for (std::size_t s = 0; s < mesh.counts.size(); ++s)
      document.ghost_tags.push_back(document.parts.tags[3].back() + 1 + static_cast<local_id>(s));
  auto subdomains = document.subdomains_of_entities();
  for (std::size_t volume = 0; volume < subdomains.size(); ++volume) {
    element_block block{volume, std::move(subdomains[volume])};
    for (const local_id s : block.pieces)
      block.elements += mesh.counts[s].elements;
    if (block.elements > 0)
      document.blocks.push_back(std::move(block));
  }
  return document;
}

inline msh_document<2> prepare_msh(const distributed_simplicial_mesh<2>& mesh,
                                   const global_numbering& numbers,
                                   const std::vector<msh_piece_table>& pieces, msh_partitions) {
  std::set<local_id> faces;
  for (const msh_piece_table& piece : pieces)
    for (const auto& block : piece.blocks)
      faces.insert(static_cast<local_id>(block.face));
  if (faces.empty())
    throw mesh_error("there are no triangles to write");
  msh_document<2> document{mesh,
                           numbers,
                           collect_face_groups(mesh, static_cast<std::size_t>(*faces.rbegin()) + 1),
                           {},
                           number_cad_entities(mesh, faces),
                           {}};
  file_middles(document.cad, mesh, [](local_id) { return 0; });
  for (std::size_t p = 0; p < pieces.size(); ++p)
    for (const auto& block : pieces[p].blocks)
      document.blocks.push_back({static_cast<std::size_t>(std::distance(
                                     faces.begin(), faces.find(static_cast<local_id>(block.face)))),
                                 {static_cast<local_id>(p)},
                                 block.elements});
  return document;
}

template <int D>
std::vector<physical_name> physical_names(const msh_document<D>& document) {
  std::vector<physical_name> names;
  for (const auto& name : document.groups.names)
    names.push_back({2, static_cast<local_id>(names.size() + 1), name});
  local_id tag = 1;
  for (const auto& name : document.materials)
    names.push_back({3, tag++, name});
  return names;
}

inline void write_block_head(msh_encoder& out, int dimension, local_id entity, int what, global_id count) {
  out.integer(dimension);
  out.integer(entity);
  out.integer(what);
  out.count(static_cast<std::uint64_t>(count));
  out.line();
}

/// The nodes of one entity: the skeleton's, then the inner ones of subdomains. MSH lists a block's tags
/// before its coordinates; the tags follow from the counts.
template <int D>
void write_node_block(output_file& file, msh_encoder& out, const msh_document<D>& document,
                      const msh_piece_files& pieces, int dimension, std::size_t entity,
                      const std::vector<local_id>& subdomains) {
  const auto& mesh = document.mesh;
  const auto& filing = document.filing();
  const auto d = static_cast<std::size_t>(dimension);
  const auto& shared = filing.points[d][entity];
  auto count = static_cast<global_id>(shared.size());
  for (const auto s : subdomains)
    count += inner_nodes(mesh, static_cast<std::size_t>(s));
  if (count == 0)
    return;
  write_block_head(out, dimension, filing.tags[d][entity], 0, count);
  const auto node_tag = [&](global_id id) {
    out.count(msh_tag(id));
    out.line();
  };
  for (const auto v : shared)
    node_tag(v);
  for (const auto s : subdomains)
    for (auto id = document.numbers.first_point[s];
         id < document.numbers.first_point[static_cast<std::size_t>(s) + 1]; ++id)
      node_tag(id);
  for (const auto v : shared) {
    out.point(skeleton_node(mesh, v));
    out.line();
  }
  for (const auto s : subdomains)
    pieces.copy_points(file, s);
}

template <int D>
void write_nodes(output_file& file, msh_encoder& out, const msh_document<D>& document,
                 const msh_piece_files& pieces) {
  const auto& filing = document.filing();
  const auto subdomains = document.subdomains_of_entities();
  const auto inner = [&](std::size_t entity) {
    global_id count = 0;
    for (const auto s : subdomains[entity])
      count += inner_nodes(document.mesh, static_cast<std::size_t>(s));
    return count;
  };
  std::uint64_t blocks = 0;
  auto nodes = static_cast<std::uint64_t>(document.numbers.points());
  for (std::size_t d = 0; d < 4; ++d)
    for (std::size_t i = 0; i < filing.points[d].size(); ++i)
      if (!filing.points[d][i].empty() || (d == D && inner(i) > 0))
        ++blocks;
  for (const auto& at : filing.entities.of_point)
    if (at.id == no_id)
      --nodes; // a skeleton point without triangles belongs to no entity
  out.begin("Nodes");
  out.count(blocks);
  out.count(nodes);
  out.count(1);
  out.count(static_cast<std::uint64_t>(document.numbers.points()));
  out.line();
  for (std::size_t d = 0; d < 4; ++d)
    for (std::size_t i = 0; i < filing.points[d].size(); ++i)
      write_node_block(file, out, document, pieces, static_cast<int>(d), i,
                       d == D ? subdomains[i] : std::vector<local_id>{});
  out.end("Nodes");
}

/// The nodes of a line or triangle of the skeleton.
template <int D, std::size_t N>
std::vector<global_id> nodes_of(const msh_document<D>& document, const std::array<local_id, N>& vertices) {
  std::vector<global_id> nodes(vertices.begin(), vertices.end());
  const auto& middles = document.mesh.mid_nodes;
  if (middles)
    for (const auto& local : numbering::edges<static_cast<int>(N) - 1>)
      nodes.push_back(static_cast<global_id>(document.mesh.skeleton.points.size()) +
                      find_edge(middles->edges, vertices_of_edge(vertices, local)));
  return nodes;
}

/// One point element per vertex, then the line and triangle elements of the entities. Returns the next tag.
template <int D>
std::uint64_t write_skeleton_elements(msh_encoder& out, const msh_document<D>& document, std::uint64_t tag) {
  const auto& filing = document.filing();
  const bool quadratic = document.mesh.mid_nodes != nullptr;
  for (std::size_t i = 0; i < filing.tags[0].size(); ++i) {
    write_block_head(out, 0, filing.tags[0][i], msh_type_of(0, quadratic), 1);
    write_element(out, tag++, std::array{global_id{filing.points[0][i].front()}});
  }
  for (std::size_t i = 0; i < filing.tags[1].size(); ++i) {
    const auto& edges = filing.simplices[1][i];
    if (edges.empty())
      continue;
    write_block_head(out, 1, filing.tags[1][i], msh_type_of(1, quadratic),
                     static_cast<global_id>(edges.size()));
    for (const auto e : edges)
      write_element(out, tag++, nodes_of(document, filing.entities.edges[e].vertices));
  }
  for (std::size_t i = 0; D == 3 && i < filing.tags[2].size(); ++i) {
    const auto& triangles = filing.simplices[2][i];
    if (triangles.empty())
      continue;
    write_block_head(out, 2, filing.tags[2][i], msh_type_of(2, quadratic),
                     static_cast<global_id>(triangles.size()));
    for (const auto t : triangles)
      write_element(out, tag++, nodes_of(document, filing.entities.triangles[t]));
  }
  return tag;
}

template <int D>
void write_elements(output_file& file, msh_encoder& out, const msh_document<D>& document,
                    msh_piece_files& pieces) {
  const auto& filing = document.filing();
  std::uint64_t blocks = filing.tags[0].size() + document.blocks.size();
  std::uint64_t total = static_cast<std::uint64_t>(document.numbers.elements()) + filing.tags[0].size();
  for (std::size_t d = 1; d < D; ++d)
    for (const auto& simplices : filing.simplices[d]) {
      blocks += simplices.empty() ? 0 : 1;
      total += simplices.size();
    }
  out.begin("Elements");
  out.count(blocks);
  out.count(total);
  out.count(1);
  out.count(total);
  out.line();
  // Elements of dimension D carry their global numbers; the others are numbered after them.
  write_skeleton_elements(out, document, msh_tag(document.numbers.elements()));
  for (const element_block& block : document.blocks) {
    write_block_head(out, D, filing.tags[D][block.entity], msh_type_of(D, document.mesh.mid_nodes != nullptr),
                     block.elements);
    for (const local_id s : block.pieces)
      pieces.copy_next_block(file, s);
  }
  out.end("Elements");
}

inline void write_ghosts(output_file& file, msh_encoder& out, msh_piece_files& pieces) {
  std::uint64_t ghosts = 0;
  for (const msh_piece_table& piece : pieces.tables())
    ghosts += piece.ghosts;
  out.begin("GhostElements");
  out.count(ghosts);
  out.line();
  pieces.copy_ghosts(file);
  out.end("GhostElements");
}

/// Puts the file together.
template <int D>
void write_msh_file(const std::filesystem::path& path, const msh_document<D>& document,
                    msh_piece_files& pieces, bool binary) {
  output_file file(path);
  msh_encoder out(file, binary);
  out.format();
  write_physical_names(file, physical_names(document));
  out.begin("Entities");
  write_entity_records(out, document.cad, document.groups, false);
  out.end("Entities");
  if (document.partitioned)
    write_partitioned_entities(out, document.parts, document.groups, document.mesh.counts.size(),
                               document.ghost_tags);
  write_nodes(file, out, document, pieces);
  write_elements(file, out, document, pieces);
  if (!document.ghost_tags.empty())
    write_ghosts(file, out, pieces);
  file.commit();
}

} // namespace detail

} // namespace dovetail::io
