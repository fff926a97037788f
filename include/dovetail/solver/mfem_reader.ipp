/// @file
/// What `mfem_reader.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/files/mesh_parts.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/solver/mfem_reader.hpp"
#include "dovetail/solver/mfem_text.hpp"
#include "dovetail/solver/shared_entities.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace dovetail::io {

namespace detail {

/// Numbers what ranks share, and compares what they say of it. Parts come in the order of their ranks.
class mfem_joint {
public:
  explicit mfem_joint(const std::vector<std::filesystem::path>& files) : files_(files) {}

  /// Gives the points of a part their numbers.
  void add(mfem_part& part) {
    rank_ = part.piece.first_part;
    const auto table = build_sides(part.piece.mesh);
    number(part);
    for (const mfem_shared& shared : part.groups)
      compare(part.piece, shared, table);
    add_entities(part, table);
    add_boundary(part.piece, table);
    number_middles(part);
  }

  /// When all parts are there.
  void finish() {
    for (const auto& [ranks, known] : groups_)
      if (known.listed != ranks.size()) {
        rank_ = ranks[known.listed];
        fail(name_of(ranks) + " is listed by rank " + std::to_string(ranks.front()) + " and not here");
      }
    require_listed(edges_, "edge");
    require_listed(faces_, "face");
    sort_all(boundary_);
    for (std::size_t i = 1; i < boundary_.size(); ++i)
      if (boundary_[i].first == boundary_[i - 1].first) {
        rank_ = boundary_[i].second;
        fail("a boundary element with " + place_of(boundary_[i].first) + " is also one of rank " +
             std::to_string(boundary_[i - 1].second));
      }
  }

private:
  /// What the first rank of a group says of it.
  struct group {
    std::size_t listed = 0; ///< by how many of its ranks
    std::vector<global_id> vertices{};
    std::vector<vec3> places{};
    std::vector<std::pair<global_id, vec3>> middles{}; ///< of the edges, and where each is
    std::vector<std::array<global_id, 2>> edges{};
    std::vector<std::array<global_id, 3>> faces{};
  };

  [[noreturn]] void fail(const std::string& what) const {
    throw input_error(files_[rank_].string() + ": " + what + "; write all files anew");
  }
  static std::string name_of(const std::vector<local_id>& ranks) {
    std::string text = "the group of ranks";
    for (const local_id r : ranks)
      text += " " + std::to_string(r);
    return text;
  }
  template <std::size_t N>
  std::array<global_id, N> ids_of(const loaded_mesh& piece, const std::array<local_id, N>& vertices) const {
    std::array<global_id, N> ids;
    for (std::size_t k = 0; k < N; ++k)
      ids[k] = piece.node_ids[vertices[k]];
    return ids;
  }
  template <std::size_t N>
  std::string place_of(const std::array<global_id, N>& ids) const {
    const auto found = shared_places_.find(ids[0]);
    std::string text = "vertex " + std::to_string(ids[0]);
    if (found != shared_places_.end())
      text = "a vertex at " + std::to_string(found->second.x) + " " + std::to_string(found->second.y) + " " +
             std::to_string(found->second.z);
    return text;
  }

  void number(mfem_part& part) {
    auto& ids = part.piece.node_ids;
    ids.assign(part.piece.mesh.points.size(), -1);
    for (const auto& shared : part.groups) {
      const auto [found, first] = groups_.try_emplace(shared.ranks);
      group& known = found->second;
      if (first && shared.ranks.front() != rank_)
        fail(name_of(shared.ranks) + " is not one of rank " + std::to_string(shared.ranks.front()) +
             ", whose file should list it");
      if (known.listed !=
          static_cast<std::size_t>(std::lower_bound(shared.ranks.begin(), shared.ranks.end(), rank_) -
                                   shared.ranks.begin()))
        fail(name_of(shared.ranks) + " is listed twice, or not by all ranks before this one");
      if (!first && shared.vertices.size() != known.vertices.size())
        fail(name_of(shared.ranks) + " shares " + std::to_string(shared.vertices.size()) +
             " vertices here, and " + std::to_string(known.vertices.size()) + " in the file of rank " +
             std::to_string(shared.ranks.front()));
      for (std::size_t i = 0; i < shared.vertices.size(); ++i) {
        const local_id v = shared.vertices[i];
        if (ids[v] >= 0)
          fail("vertex " + std::to_string(v) + " is shared twice");
        const vec3 place = part.piece.mesh.points[v];
        if (first) {
          known.vertices.push_back(next_++);
          known.places.push_back(place);
          shared_places_[known.vertices.back()] = place;
        } else if (known.places[i] != place) {
          fail("shared vertex " + std::to_string(i) + " of " + name_of(shared.ranks) + " is not where rank " +
               std::to_string(shared.ranks.front()) + " has it");
        }
        ids[v] = known.vertices[i];
      }
      ++known.listed;
    }
    number_rest(ids, ids.size() - part.middles.size());
  }

  void number_rest(std::vector<global_id>& ids, std::size_t end) {
    for (std::size_t v = 0; v < end; ++v)
      if (ids[v] < 0)
        ids[v] = next_++;
  }

  /// The middles of edges, of which those that are shared have been compared.
  void number_middles(mfem_part& part) {
    auto& ids = part.piece.node_ids;
    for (const auto& shared : part.groups) {
      group& known = groups_.at(shared.ranks);
      for (std::size_t i = 0; !part.middles.empty() && i < shared.edges.size(); ++i) {
        const local_id v = part.middles[find_edge(part.edges, shared.edges[i])];
        const vec3 place = part.piece.mesh.points[v];
        if (known.listed == 1)
          known.middles.emplace_back(next_++, place);
        else if (i >= known.middles.size() || known.middles[i].second != place)
          fail("the middle of shared edge " + std::to_string(i) + " of " + name_of(shared.ranks) +
               " is not where rank " + std::to_string(shared.ranks.front()) + " has it");
        ids[v] = known.middles[i].first;
      }
    }
    number_rest(ids, ids.size());
  }

  void compare(const loaded_mesh& piece, const mfem_shared& shared, const side_table<3>& table) {
    group& known = groups_.at(shared.ranks);
    const bool first = known.listed == 1;
    const auto compare_lists = [&](auto& there, const auto& here, const std::string& what) {
      if (!first && here.size() != there.size())
        fail(name_of(shared.ranks) + " shares " + std::to_string(here.size()) + " " + what + "s here, and " +
             std::to_string(there.size()) + " in the file of rank " + std::to_string(shared.ranks.front()));
      for (std::size_t i = 0; i < here.size(); ++i) {
        const auto ids = ids_of(piece, here[i]);
        if (first)
          there.push_back(ids);
        else if (there[i] != ids)
          fail("shared " + what + " " + std::to_string(i) + " of " + name_of(shared.ranks) +
               " is not that of rank " + std::to_string(shared.ranks.front()));
      }
    };
    compare_lists(known.edges, shared.edges, "edge");
    compare_lists(known.faces, shared.faces, "face");
    for (std::size_t i = 0; i < shared.faces.size(); ++i) {
      const auto& face = shared.faces[i];
      const local_id side = find_side<3>(table, face);
      const std::string name = "shared face " + std::to_string(i) + " of " + name_of(shared.ranks);
      if (side == no_id || !table.is_boundary(side))
        fail(name + " is no side where the elements of the rank end");
      if (same_turn(table.vertices[side], face) != (shared.ranks.front() == rank_))
        fail(name + " is turned the wrong way");
    }
  }

  /// The edges and sides where the elements of the rank end.
  void add_entities(const mfem_part& part, const side_table<3>& table) {
    std::map<std::array<global_id, 2>, local_id> shared_edges;
    std::map<std::array<global_id, 3>, local_id> shared_faces;
    const auto note = [&](auto& sharers, const auto& entities, const std::vector<local_id>& ranks) {
      for (const auto& each : entities)
        if (!sharers.try_emplace(ascending(ids_of(part.piece, each)), static_cast<local_id>(ranks.size()))
                 .second)
          fail("an edge or a face is shared twice, in " + name_of(ranks));
    };
    for (const auto& shared : part.groups) {
      note(shared_edges, shared.edges, shared.ranks);
      note(shared_faces, shared.faces, shared.ranks);
    }
    std::vector<std::array<global_id, 2>> edges;
    for (std::size_t s = 0; s < table.size(); ++s)
      if (table.is_boundary(static_cast<local_id>(s))) {
        const auto ids = ascending(ids_of(part.piece, table.vertices[s]));
        const auto found = shared_faces.find(ids);
        faces_.add({ids, rank_, found == shared_faces.end() ? 1 : found->second});
      }
    for (const auto& element : part.piece.mesh.elements)
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = a + 1; b < 4; ++b)
          if (const auto ids = ascending(ids_of(part.piece, simplex<1>{element[a], element[b]}));
              shared_places_.contains(ids[0]) && shared_places_.contains(ids[1]))
            edges.push_back(ids);
    sort_unique(edges);
    for (const auto& ids : edges) {
      const auto found = shared_edges.find(ids);
      edges_.add({ids, rank_, found == shared_edges.end() ? 1 : found->second});
      if (found != shared_edges.end())
        shared_edges.erase(found);
    }
    if (!shared_edges.empty())
      fail("a shared edge with " + place_of(shared_edges.begin()->first) + " is none of an element");
  }

  void add_boundary(const loaded_mesh& piece, const side_table<3>& table) {
    for (std::size_t t = 0; t < piece.triangles.size(); ++t) {
      const auto& triangle = piece.triangles[t];
      const local_id side = find_side<3>(table, triangle);
      if (side == no_id)
        fail("boundary element " + std::to_string(t) + " is no side of an element");
      if (table.is_boundary(side) && !same_turn(table.vertices[side], triangle))
        fail("boundary element " + std::to_string(t) + " is turned inwards");
      boundary_.emplace_back(ascending(ids_of(piece, triangle)), rank_);
    }
  }

  template <std::size_t N>
  void require_listed(shared_entities<N>& entities, const std::string& what) {
    const auto found = entities.find_unlisted();
    if (found.rank == no_id)
      return;
    rank_ = found.rank;
    fail("it does not list all ranks that share the " + what + " with " + place_of(found.ids) +
         (found.other == found.rank ? "" : ", rank " + std::to_string(found.other) + " among them"));
  }

  const std::vector<std::filesystem::path>& files_;
  local_id rank_ = 0; ///< which is looked at
  global_id next_ = 0;
  std::map<std::vector<local_id>, group> groups_;
  std::map<global_id, vec3> shared_places_;
  shared_entities<2> edges_;
  shared_entities<3> faces_;
  std::vector<std::pair<std::array<global_id, 3>, local_id>> boundary_; ///< with the rank that lists it
};

} // namespace detail

DOVETAIL_INLINE std::vector<std::filesystem::path> files_of_mfem(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  const std::string digits = extension.substr(extension.empty() ? 0 : 1);
  if (!detail::is_number(digits))
    throw input_error(file.string() + ": the files of the other ranks are not found, since it is not called "
                                      "NAME.000000 as files of MFEM's ranks are");
  const auto of_rank = [&](std::size_t rank) {
    std::string number = std::to_string(rank);
    number.insert(0, digits.size() - std::min(digits.size(), number.size()), '0');
    return file.parent_path() / (file.stem().string() + "." + number);
  };
  std::error_code failure;
  std::vector<std::filesystem::path> files;
  while (std::filesystem::exists(of_rank(files.size()), failure))
    files.push_back(of_rank(files.size()));
  if (files.size() <= std::stoul(digits))
    throw input_error(of_rank(files.size()).string() + ": there is no such file, and " +
                      file.filename().string() + " is that of rank " + std::to_string(std::stoul(digits)));
  return files;
}

DOVETAIL_INLINE void for_each_mfem_piece(const std::filesystem::path& file, const piece_visitor& f,
                                         element_order elements) {
  const auto files = files_of_mfem(file);
  detail::mfem_joint joint(files);
  for (std::size_t rank = 0; rank < files.size(); ++rank) {
    detail::mfem_part part =
        detail::read_mfem_part(files[rank], static_cast<local_id>(rank), files.size(), elements);
    joint.add(part);
    if (files.size() > 1)
      part.piece.subdomains.assign(part.piece.mesh.elements.size(), static_cast<local_id>(rank));
    detail::order_points(part.piece, files[rank]);
    f(part.piece, files[rank]);
  }
  joint.finish();
}

DOVETAIL_INLINE loaded_mesh read_mfem(const std::filesystem::path& file) {
  return detail::joined_pieces(file, [&](const piece_visitor& f) { for_each_mfem_piece(file, f); });
}

} // namespace dovetail::io
