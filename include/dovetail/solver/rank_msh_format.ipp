/// @file
/// What `rank_msh_format.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/files/msh_document.hpp"
#include "dovetail/solver/rank_msh_format.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::io {

namespace detail {

/// The skeleton of ranks: what lies between two subdomains of a rank and on no CAD face is not in it. Its
/// subdomains are the materials of ranks, its points and the middles of edges those of the whole skeleton.
struct rank_skeleton {
  distributed_mesh mesh;
  std::vector<std::array<local_id, 2>> volumes; ///< per subdomain: rank, material

  local_id volume(local_id rank, local_id material) const {
    return static_cast<local_id>(
        std::lower_bound(volumes.begin(), volumes.end(), std::array<local_id, 2>{rank, material}) -
        volumes.begin());
  }
};

inline rank_skeleton skeleton_of_ranks(const rank_source<3>& source) {
  const auto& from = source.mesh;
  rank_skeleton result;
  for (std::size_t p = 0; p < from.counts.size(); ++p)
    result.volumes.push_back({source.numbers.rank_of_piece[p], from.counts[p].material});
  const auto of_piece = result.volumes;
  sort_unique(result.volumes);
  for (const auto& [rank, material] : result.volumes)
    result.mesh.counts.push_back({material, 0, 0});
  auto& skeleton = result.mesh.skeleton;
  skeleton.points = from.skeleton.points;
  skeleton.point_hosts = from.skeleton.point_hosts;
  skeleton.curve_edges = from.skeleton.curve_edges;
  skeleton.curves = from.skeleton.curves;
  for (std::size_t s = 0; s < from.skeleton.sides.size(); ++s) {
    auto volumes = from.skeleton.subdomains[s];
    for (local_id& v : volumes)
      if (v != no_id) {
        const auto& [rank, material] = of_piece[v];
        v = result.volume(rank, material);
      }
    if (volumes[0] == volumes[1] && from.skeleton.side_hosts[s] == no_id)
      continue;
    skeleton.sides.own().push_back(from.skeleton.sides[s]);
    skeleton.subdomains.own().push_back(volumes);
    skeleton.side_hosts.own().push_back(from.skeleton.side_hosts[s]);
  }
  result.mesh.mid_nodes = from.mid_nodes;
  result.mesh.material_names = from.material_names;
  result.mesh.face_names = from.face_names;
  result.mesh.group_names = from.group_names;
  return result;
}

/// The file of one rank.
class rank_msh_file {
public:
  rank_msh_file(const rank_source<3>& source, const rank_mesh<3>& rank)
      : numbers_(source.numbers), rank_(rank), ranks_(skeleton_of_ranks(source)),
        unused_(number_globally(ranks_.mesh)), document_{ranks_.mesh,
                                                         unused_,
                                                         collect_face_groups(ranks_.mesh),
                                                         collect_material_names(ranks_.mesh),
                                                         {},
                                                         {},
                                                         true} {
    const point_sharers sharers(ranks_.mesh.skeleton);
    document_.cad = number_cad_entities(ranks_.mesh, sharers, document_.materials.size());
    document_.parts = number_partition_entities(ranks_.mesh, sharers, document_.cad);
    file_middles(document_.parts, ranks_.mesh, [](local_id) { return no_id; }); // all sides are in faces
    if (source.ghosts)
      for (local_id q = 0; q < numbers_.ranks(); ++q)
        document_.ghost_tags.push_back(document_.parts.tags[3].back() + 1 + q);
    for (auto& dimension : document_.parts.entities.of_dimension)
      for (auto& entity : dimension) {
        for (local_id& s : entity.sharers)
          s = ranks_.volumes[s][0];
        sort_unique(entity.sharers);
      }
    list_inner_vertices();
    elements_.resize(ranks_.volumes.size());
    for (std::size_t e = 0; e < rank.owned_elements; ++e)
      elements_[volume_of(e)].push_back(static_cast<local_id>(e));
    for (std::size_t e = rank.owned_elements; e < rank.mesh.elements.size(); ++e)
      ghosts_.push_back(static_cast<local_id>(e));
  }

  void write(const std::filesystem::path& path, bool binary) {
    output_file file(path);
    msh_encoder out(file, binary);
    out.format();
    write_physical_names(file, physical_names(document_));
    out.begin("Entities");
    write_entity_records(out, document_.cad, document_.groups, false);
    out.end("Entities");
    write_partitioned_entities(out, document_.parts, document_.groups,
                               static_cast<std::size_t>(numbers_.ranks()), document_.ghost_tags);
    write_nodes(out);
    write_elements(out);
    if (!document_.ghost_tags.empty())
      write_ghosts(out);
    file.commit();
  }

private:
  const msh_entities& parts() const { return document_.parts; }
  local_id ghost_tag() const { return document_.ghost_tags[rank_.rank]; }
  std::size_t volume_of(std::size_t element) const {
    return static_cast<std::size_t>(ranks_.volume(rank_.rank, rank_.mesh.tags[element]));
  }
  bool has_rank(const skeleton_entity& entity) const {
    return std::binary_search(entity.sharers.begin(), entity.sharers.end(), rank_.rank);
  }

  /// Vertices that lie on no entity of the skeleton of ranks, by the volume of an element.
  void list_inner_vertices() {
    std::vector<bool> on_skeleton(skeleton_nodes(ranks_.mesh), false);
    for (std::size_t d = 0; d < 3; ++d)
      for (const auto& nodes : parts().points[d])
        for (const local_id node : nodes)
          on_skeleton[node] = true;
    inner_.resize(ranks_.volumes.size());
    std::vector<bool> listed(rank_.held_vertices, false);
    for (std::size_t e = 0; e < rank_.owned_elements; ++e)
      for_each_node(rank_, e, [&](local_id v) {
        const std::size_t number = rank_.vertex_numbers[v];
        if (listed[v] || (number < on_skeleton.size() && on_skeleton[number]))
          return;
        listed[v] = true;
        inner_[volume_of(e)].push_back(v);
      });
  }

  /// Calls `visit(dimension, entity, count)` for the entities of the rank that have nodes.
  template <class Visit>
  void for_each_node_block(const Visit& visit) const {
    for (std::size_t d = 0; d < 4; ++d)
      for (std::size_t i = 0; i < parts().tags[d].size(); ++i)
        if (const std::size_t count = d == 3 ? inner_[i].size() : parts().points[d][i].size();
            count > 0 && has_rank(parts().entities.of_dimension[d][i]))
          visit(d, i, count);
  }
  void write_nodes(msh_encoder& out) const {
    std::uint64_t blocks = 0, nodes = 0;
    for_each_node_block([&](std::size_t, std::size_t, std::size_t count) { ++blocks, nodes += count; });
    const auto& ids = rank_.vertex_ids;
    const std::size_t of_ghosts = ids.size() - rank_.held_vertices;
    const auto place = [&](local_id v) { return rank_.mesh.points[v]; };
    out.begin("Nodes");
    out.count(blocks + (of_ghosts > 0 ? 1 : 0));
    out.count(nodes + of_ghosts);
    out.count(ids.empty() ? 0 : msh_tag(*std::min_element(ids.begin(), ids.end())));
    out.count(ids.empty() ? 0 : msh_tag(*std::max_element(ids.begin(), ids.end())));
    out.line();
    for_each_node_block([&](std::size_t d, std::size_t i, std::size_t count) {
      write_block_head(out, static_cast<int>(d), parts().tags[d][i], 0, static_cast<global_id>(count));
      if (d == 3)
        write_node_list(out, inner_[i], ids, place);
      else
        write_node_list(out, parts().points[d][i], numbers_.point_ids,
                        [&](local_id node) { return skeleton_node(ranks_.mesh, node); });
    });
    if (of_ghosts > 0) {
      write_block_head(out, 3, ghost_tag(), 0, static_cast<global_id>(of_ghosts));
      std::vector<local_id> members(of_ghosts);
      std::iota(members.begin(), members.end(), static_cast<local_id>(rank_.held_vertices));
      write_node_list(out, members, ids, place);
    }
    out.end("Nodes");
  }
  template <class Place>
  static void write_node_list(msh_encoder& out, const std::vector<local_id>& members,
                              const std::vector<global_id>& ids, const Place& place) {
    for (const local_id v : members) {
      out.count(msh_tag(ids[v]));
      out.line();
    }
    for (const local_id v : members) {
      out.point(place(v));
      out.line();
    }
  }

  bool quadratic() const { return ranks_.mesh.mid_nodes != nullptr; }
  /// A line or triangle of the skeleton.
  template <std::size_t N>
  void write_simplex(msh_encoder& out, std::uint64_t tag, const std::array<local_id, N>& points) const {
    std::vector<global_id> nodes = nodes_of(document_, points);
    for (global_id& node : nodes)
      node = numbers_.point_ids[node];
    write_element(out, tag, nodes);
  }
  /// Elements of the skeleton in one entity: `members(i)` of them, numbered over all ranks.
  template <class Write>
  std::uint64_t write_shared_block(msh_encoder& out, std::size_t d, std::size_t i, std::size_t count,
                                   std::uint64_t first_tag, const Write& write) const {
    if (parts().entities.of_dimension[d][i].sharers.front() == rank_.rank && count > 0) {
      const int dimension = static_cast<int>(d);
      write_block_head(out, dimension, parts().tags[d][i], msh_type_of(dimension, quadratic()),
                       static_cast<global_id>(count));
      for (std::size_t k = 0; k < count; ++k)
        write(k, first_tag + k);
    }
    return first_tag + count;
  }
  std::size_t shared_count(std::size_t d, std::size_t i) const {
    return d == 0 ? 1 : parts().simplices[d][i].size();
  }
  void write_elements(msh_encoder& out) const {
    const std::uint64_t first_shared = msh_tag(numbers_.first_element.back()); // after those of dimension 3
    std::uint64_t blocks = 0, total = rank_.owned_elements, next = first_shared;
    std::uint64_t least = total > 0 ? msh_tag(rank_.element_ids.front()) : next;
    std::uint64_t last = total > 0 ? least + total - 1 : 0;
    for (const local_id e : ghosts_) {
      const std::uint64_t tag = msh_tag(rank_.element_ids[e]);
      ++total, least = std::min(least, tag), last = std::max(last, tag);
    }
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t i = 0; i < parts().tags[d].size(); ++i, next += shared_count(d, i - 1))
        if (shared_count(d, i) > 0 && parts().entities.of_dimension[d][i].sharers.front() == rank_.rank) {
          ++blocks, total += shared_count(d, i);
          least = std::min(least, next);
          last = next + shared_count(d, i) - 1;
        }
    for (const auto& elements : elements_)
      blocks += elements.empty() ? 0 : 1;
    blocks += ghosts_.empty() ? 0 : 1;
    out.begin("Elements");
    out.count(blocks);
    out.count(total);
    out.count(least);
    out.count(last);
    out.line();
    std::uint64_t tag = first_shared;
    const auto& skeleton = parts().entities;
    for (std::size_t i = 0; i < parts().tags[0].size(); ++i)
      tag = write_shared_block(out, 0, i, 1, tag, [&](std::size_t, std::uint64_t t) {
        write_element(out, t, std::array{numbers_.point_ids[parts().points[0][i].front()]});
      });
    for (std::size_t i = 0; i < parts().tags[1].size(); ++i)
      tag = write_shared_block(out, 1, i, shared_count(1, i), tag, [&](std::size_t k, std::uint64_t t) {
        const local_id e = parts().simplices[1][i][k];
        write_simplex(out, t, skeleton.edges[e].vertices);
      });
    for (std::size_t i = 0; i < parts().tags[2].size(); ++i)
      tag = write_shared_block(out, 2, i, shared_count(2, i), tag, [&](std::size_t k, std::uint64_t t) {
        const local_id s = parts().simplices[2][i][k];
        write_simplex(out, t, skeleton.triangles[s]);
      });
    for (std::size_t volume = 0; volume < elements_.size(); ++volume)
      write_tetrahedra(out, parts().tags[3][volume], elements_[volume]);
    if (!ghosts_.empty())
      write_tetrahedra(out, ghost_tag(), ghosts_);
    out.end("Elements");
  }
  void write_tetrahedra(msh_encoder& out, local_id entity, const std::vector<local_id>& elements) const {
    if (elements.empty())
      return;
    write_block_head(out, 3, entity, msh_type_of(3, quadratic()), static_cast<global_id>(elements.size()));
    std::vector<global_id> ids;
    for (const local_id e : elements) {
      ids.clear();
      for_each_node(rank_, static_cast<std::size_t>(e),
                    [&](local_id v) { ids.push_back(rank_.vertex_ids[v]); });
      write_element(out, msh_tag(rank_.element_ids[e]), ids);
    }
  }
  /// Tag, partition of the owner, and the one partition that has it as a ghost in this file.
  void write_ghosts(msh_encoder& out) const {
    out.begin("GhostElements");
    out.count(ghosts_.size());
    out.line();
    for (const local_id e : ghosts_) {
      out.count(msh_tag(rank_.element_ids[e]));
      out.integer(partition_tag(rank_.element_owners[e]));
      out.count(1);
      out.integer(partition_tag(rank_.rank));
      out.line();
    }
    out.end("GhostElements");
  }

  const rank_numbering& numbers_;
  const rank_mesh<3>& rank_;
  const rank_skeleton ranks_;
  const global_numbering unused_; ///< a document has one
  msh_document<3> document_;
  std::vector<std::vector<local_id>> inner_;    ///< per volume: vertices of the rank
  std::vector<std::vector<local_id>> elements_; ///< per volume: of the rank
  std::vector<local_id> ghosts_;
};

} // namespace detail

DOVETAIL_INLINE void rank_msh_format::write(const rank_source<3>& source, const rank_mesh<3>& rank,
                                            const std::vector<std::filesystem::path>& paths) const {
  detail::rank_msh_file(source, rank).write(paths.front(), binary);
}

} // namespace dovetail::io
