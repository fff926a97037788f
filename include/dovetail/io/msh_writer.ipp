/// @file
/// What `msh_writer.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/io/global_numbering.hpp"
#include "dovetail/io/msh_encoder.hpp"
#include "dovetail/io/msh_entities.hpp"
#include "dovetail/io/msh_writer.hpp"
#include "dovetail/io/patches.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <span>
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
  global_numbering numbers;
  boundary_patches patches;
  std::vector<std::string> materials; ///< of D = 3
  point_sharers sharers;              ///< of D = 3
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

inline msh_document<3> prepare_msh(const distributed_mesh& mesh, bool partitioned, bool ghosts) {
  msh_document<3> document{mesh,
                           number_globally(mesh),
                           collect_patches(mesh),
                           collect_material_names(mesh),
                           point_sharers(mesh.skeleton),
                           {},
                           {},
                           partitioned};
  document.cad = number_cad_entities(mesh, document.sharers, document.materials.size());
  if (partitioned)
    document.parts = number_partition_entities(mesh, document.sharers, document.cad);
  if (partitioned && ghosts)
    for (std::size_t s = 0; s < mesh.counts.size(); ++s)
      document.ghost_tags.push_back(document.parts.tags[3].back() + 1 + static_cast<local_id>(s));
  auto subdomains = document.subdomains_of_entities();
  for (std::size_t volume = 0; volume < subdomains.size(); ++volume) {
    element_block block{volume, std::move(subdomains[volume])};
    for (const local_id s : block.pieces)
      block.elements += mesh.counts[static_cast<std::size_t>(s)].elements;
    if (block.elements > 0)
      document.blocks.push_back(std::move(block));
  }
  return document;
}

inline msh_document<2> prepare_msh(const distributed_simplicial_mesh<2>& mesh, bool partitioned, bool) {
  if (partitioned)
    throw usage_error("a mesh of triangles is written to MSH whole, not partitioned");
  std::vector<std::map<local_id, global_id>> of_face(mesh.counts.size()); // per piece
  std::set<local_id> faces;
  for (std::size_t p = 0; p < mesh.counts.size(); ++p)
    for (const local_id face : load_checked(mesh, static_cast<local_id>(p)).mesh.tags) {
      ++of_face[p][face];
      faces.insert(face);
    }
  if (faces.empty())
    throw mesh_error("there are no triangles to write");
  msh_document<2> document{mesh,
                           number_globally(mesh),
                           collect_patches(mesh, static_cast<std::size_t>(*faces.rbegin()) + 1),
                           {},
                           point_sharers(fine_skeleton{}),
                           number_cad_entities(mesh, faces),
                           {}};
  for (std::size_t p = 0; p < of_face.size(); ++p)
    for (const auto& [face, triangles] : of_face[p])
      document.blocks.push_back({static_cast<std::size_t>(std::distance(faces.begin(), faces.find(face))),
                                 {static_cast<local_id>(p)},
                                 triangles});
  return document;
}

template <int D>
std::vector<physical_name> physical_names(const msh_document<D>& document) {
  std::vector<physical_name> names;
  for (const auto& name : document.patches.names)
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

/// The tag of a node or element with a global number.
inline std::uint64_t msh_tag(global_id id) {
  return static_cast<std::uint64_t>(id) + 1;
}

/// The nodes of one entity: skeleton points, then the inner points of subdomains. MSH lists a block's tags
/// before its coordinates; tags follow from the counts, so pieces are loaded for the coordinates only.
template <int D>
void write_node_block(msh_encoder& out, const msh_document<D>& document, int dimension, std::size_t entity,
                      const std::vector<local_id>& subdomains) {
  const auto& mesh = document.mesh;
  const auto& filing = document.filing();
  const auto d = static_cast<std::size_t>(dimension);
  const auto& shared = filing.points[d][entity];
  auto count = static_cast<global_id>(shared.size());
  for (const auto s : subdomains)
    count += mesh.counts[static_cast<std::size_t>(s)].inner_points;
  if (count == 0)
    return;
  write_block_head(out, dimension, filing.tags[d][entity], 0, count);
  const auto node_tag = [&](global_id id) {
    out.count(msh_tag(id));
    out.line();
  };
  const auto coordinates = [&](vec3 p) {
    out.point(p);
    out.line();
  };
  for (const auto v : shared)
    node_tag(v);
  for (const auto s : subdomains)
    for (auto id = document.numbers.first_point[static_cast<std::size_t>(s)];
         id < document.numbers.first_point[static_cast<std::size_t>(s) + 1]; ++id)
      node_tag(id);
  for (const auto v : shared)
    coordinates(mesh.skeleton.points[static_cast<std::size_t>(v)]);
  for (const auto s : subdomains) {
    const auto piece = load_checked(mesh, s);
    for (auto i = piece.skeleton_points.size(); i < piece.mesh.points.size(); ++i)
      coordinates(piece.mesh.points[i]);
  }
}

template <int D>
void write_nodes(msh_encoder& out, const msh_document<D>& document) {
  const auto& filing = document.filing();
  const auto subdomains = document.subdomains_of_entities();
  const auto inner = [&](std::size_t entity) {
    global_id count = 0;
    for (const auto s : subdomains[entity])
      count += document.mesh.counts[static_cast<std::size_t>(s)].inner_points;
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
      write_node_block(out, document, static_cast<int>(d), i,
                       d == D ? subdomains[i] : std::vector<local_id>{});
  out.end("Nodes");
}

template <std::size_t N>
void write_element(msh_encoder& out, std::uint64_t tag, const std::array<global_id, N>& vertices) {
  out.count(tag);
  for (const auto v : vertices)
    out.count(msh_tag(v));
  out.line();
}

/// One point element per vertex, then the line and triangle elements of the entities. Returns the next tag.
template <int D>
std::uint64_t write_skeleton_elements(msh_encoder& out, const msh_document<D>& document, std::uint64_t tag) {
  const auto& filing = document.filing();
  for (std::size_t i = 0; i < filing.tags[0].size(); ++i) {
    write_block_head(out, 0, filing.tags[0][i], static_cast<int>(msh_type::point), 1);
    write_element<1>(out, tag++, {filing.points[0][i].front()});
  }
  for (std::size_t i = 0; i < filing.tags[1].size(); ++i) {
    const auto& edges = filing.simplices[1][i];
    if (edges.empty())
      continue;
    write_block_head(out, 1, filing.tags[1][i], static_cast<int>(msh_type::line),
                     static_cast<global_id>(edges.size()));
    for (const auto e : edges) {
      const auto& v = filing.entities.edges[static_cast<std::size_t>(e)].vertices;
      write_element<2>(out, tag++, {v[0], v[1]});
    }
  }
  for (std::size_t i = 0; D == 3 && i < filing.tags[2].size(); ++i) {
    const auto& triangles = filing.simplices[2][i];
    if (triangles.empty())
      continue;
    write_block_head(out, 2, filing.tags[2][i], static_cast<int>(msh_type::triangle),
                     static_cast<global_id>(triangles.size()));
    for (const auto t : triangles) {
      const auto& v = filing.entities.triangles[static_cast<std::size_t>(t)];
      write_element<3>(out, tag++, {v[0], v[1], v[2]});
    }
  }
  return tag;
}

/// Elements that touch another subdomain in a point, and which subdomains they touch.
struct ghost_elements {
  struct entry {
    global_id element;
    local_id owner;
    std::uint32_t first; ///< in `partitions`
    std::uint32_t count;
  };
  std::vector<entry> entries;
  std::vector<local_id> partitions;

  void collect(const mesh_piece& piece, const point_sharers& sharers, global_id first_element) {
    std::vector<local_id> touched;
    for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e) {
      touched.clear();
      for (const auto v : piece.mesh.elements[e])
        if (static_cast<std::size_t>(v) < piece.skeleton_points.size())
          for (const auto s : sharers[piece.skeleton_points[static_cast<std::size_t>(v)]])
            if (s != piece.subdomain)
              touched.push_back(s);
      if (touched.empty())
        continue;
      std::sort(touched.begin(), touched.end());
      touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
      entries.push_back({first_element + static_cast<global_id>(e), piece.subdomain,
                         static_cast<std::uint32_t>(partitions.size()),
                         static_cast<std::uint32_t>(touched.size())});
      partitions.insert(partitions.end(), touched.begin(), touched.end());
    }
  }
};

/// Returns the ghosts, if they are wanted: they are collected on the way. This is the last reading of a
/// piece.
template <int D>
ghost_elements write_elements(msh_encoder& out, const msh_document<D>& document, bool release) {
  const auto& mesh = document.mesh;
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
  ghost_elements ghosts;
  simplicial_piece<D> piece;
  for (const element_block& block : document.blocks) {
    write_block_head(out, D, filing.tags[D][block.entity],
                     static_cast<int>(D == 2 ? msh_type::triangle : msh_type::tetrahedron), block.elements);
    for (const local_id s : block.pieces) {
      if (piece.subdomain != s) {
        piece = {}; // not two at a time
        piece = load_checked(mesh, s);
        if (release && mesh.release)
          mesh.release(s, {});
      }
      const global_id first = document.numbers.first_element[static_cast<std::size_t>(s)];
      if constexpr (D == 3)
        if (!document.ghost_tags.empty())
          ghosts.collect(piece, document.sharers, first);
      for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e) {
        if (D == 2 && cad_tag(piece.mesh.tags[e]) != filing.tags[D][block.entity])
          continue;
        std::array<global_id, D + 1> vertices;
        for (std::size_t k = 0; k <= D; ++k)
          vertices[k] = global_point(piece, document.numbers, piece.mesh.elements[e][k]);
        write_element(out, msh_tag(first + static_cast<global_id>(e)), vertices);
      }
    }
  }
  out.end("Elements");
  return ghosts;
}

inline void write_ghosts(msh_encoder& out, const ghost_elements& ghosts) {
  out.begin("GhostElements");
  out.count(ghosts.entries.size());
  out.line();
  for (const auto& ghost : ghosts.entries) {
    out.count(msh_tag(ghost.element));
    out.integer(partition_tag(ghost.owner));
    out.count(ghost.count);
    for (const auto s : std::span(ghosts.partitions).subspan(ghost.first, ghost.count))
      out.integer(partition_tag(s));
    out.line();
  }
  out.end("GhostElements");
}

} // namespace detail

template <int D>
report msh_writer::operator()(const distributed_simplicial_mesh<D>& mesh,
                              const std::filesystem::path& folder) const {
  const stopwatch clock;
  make_folder(folder);
  sides_by_subdomain<D>{mesh}; // checks the skeleton's references; everything after indexes freely
  const auto document = detail::prepare_msh(mesh, partitioned, ghosts);
  output_file file(folder / (stem + ".msh"));
  msh_encoder out(file, binary);
  write_physical_names(file, detail::physical_names(document));
  out.begin("Entities");
  detail::write_entity_records(out, document.cad, document.patches, false);
  out.end("Entities");
  if (partitioned)
    detail::write_partitioned_entities(out, document.parts, document.patches, mesh.counts.size(),
                                       document.ghost_tags);
  detail::write_nodes(out, document);
  const auto ghost_layer = detail::write_elements(out, document, release);
  if (!document.ghost_tags.empty())
    detail::write_ghosts(out, ghost_layer);
  file.commit();

  report summary{"msh", clock.seconds(), {}, {}, {}, {stem + ".msh"}};
  summary.set("elements", static_cast<double>(document.numbers.elements()));
  summary.set("bytes", static_cast<double>(file.size()));
  summary.set("files", 1);
  return summary;
}

#ifdef DOVETAIL_COMPILED
template report msh_writer::operator()<2>(const distributed_simplicial_mesh<2>& mesh,
                                          const std::filesystem::path& folder) const;
template report msh_writer::operator()<3>(const distributed_simplicial_mesh<3>& mesh,
                                          const std::filesystem::path& folder) const;
#endif

} // namespace dovetail::io
