/// @file
/// Adapter: the skeleton beside HDF5 files of pieces, and whether it is that of the pieces.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/files/hdf5_partitions.hpp"
#include "dovetail/files/piece_visitor.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"
#include "dovetail/mesh/quadratic_element.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail::io::detail {

/// The skeleton of tetrahedra. Throws `input_error` naming the file and what in it is wrong. Memory: the
/// skeleton.
class hdf5_skeleton {
public:
  /// `second_order`: whether the pieces have nodes in the middle of edges, which the skeleton has not.
  hdf5_skeleton(const std::filesystem::path& path, std::size_t pieces, bool second_order) : input_(path) {
    const auto& file = input_.file();
    if (input_.nodes() != 3 || input_.partitions() != 1)
      throw input_error(path.string() + ": this is no skeleton of tetrahedra: it has not one partition of "
                                        "triangles");
    sides_ = input_.read(0);
    for (std::size_t v = 0; v < sides_.node_ids.size(); ++v)
      if (sides_.node_ids[v] != static_cast<global_id>(v))
        file.fail("VTKHDF/PointData/GlobalNodeIds",
                  "point " + std::to_string(v) + " has the number " + std::to_string(sides_.node_ids[v]));
    const auto array = [&](const char* name, std::int64_t least, std::uint64_t end) {
      const std::string full = std::string("VTKHDF/CellData/") + name;
      file.require(full, {sides_.triangles.size(), 1});
      auto values = file.read<local_id>(full, 0, sides_.triangles.size());
      for (std::size_t t = 0; t < values.size(); ++t)
        if (values[t] < least || values[t] >= static_cast<std::int64_t>(end))
          file.fail(full, "side " + std::to_string(t) + " has the number " + std::to_string(values[t]) +
                              ", and there are " + std::to_string(end));
      return values;
    };
    const auto behind = array("subdomain", 0, pieces), front = array("front_subdomain", -1, pieces);
    const auto face = array("cad_face", -1, file.extent_of("names/faces").rows);
    const auto patch = array("patch", -1, file.extent_of("names/patches").rows);
    for (std::size_t t = 0; t < face.size(); ++t) {
      if ((face[t] < 0) != (patch[t] < 0))
        file.fail("VTKHDF/CellData/patch", "side " + std::to_string(t) +
                                               " has a CAD face and no patch, or the "
                                               "other way round");
      add(t, behind[t], false);
      if (front[t] >= 0)
        add(t, front[t], true);
    }
    sort_all(halves_);
    regions_ = file.extent_of("names/regions").rows;
    first_point_ = file.read_list<global_id>("pieces/first_point");
    first_element_ = file.read_list<global_id>("pieces/first_element");
    for (const auto* first : {&first_point_, &first_element_})
      if (first->size() != pieces + 1 || !std::is_sorted(first->begin(), first->end()))
        file.fail("pieces/first_point", "there are not the numbers of " + std::to_string(pieces) + " pieces");
    std::size_t nodes = sides_.node_ids.size();
    if (second_order)
      nodes += build_edges<2>(span_of(sides_.triangles), nodes).vertices.size();
    if (first_point_[0] != static_cast<global_id>(nodes))
      file.fail("pieces/first_point", "the first is not the number of points of the skeleton");
  }

  /// Compares a piece, before its points are put into another order. `shared` of them are the skeleton's.
  void check(const loaded_mesh& piece, local_id number, std::size_t shared,
             const std::filesystem::path& file) const {
    const std::string name = file.string() + ": subdomain " + std::to_string(number) + ": ";
    const std::string anew = "; write the mesh anew";
    const auto p = static_cast<std::size_t>(number);
    const auto own = piece.node_ids.size() - shared;
    if (static_cast<global_id>(own) != first_point_[p + 1] - first_point_[p] ||
        static_cast<global_id>(piece.mesh.elements.size()) != first_element_[p + 1] - first_element_[p])
      throw input_error(name + "it has other points or elements than the skeleton says" + anew);
    for (std::size_t v = 0; v < piece.node_ids.size(); ++v) {
      const global_id id = piece.node_ids[v];
      if (v < shared ? id >= first_point_[0] : id != first_point_[p] + static_cast<global_id>(v - shared))
        throw input_error(name + "point " + std::to_string(v) + " has the number " + std::to_string(id) +
                          ", which is not that of its place" + anew);
      const bool is_middle = static_cast<std::size_t>(id) >= sides_.mesh.points.size();
      if (v < shared && !is_middle && sides_.mesh.points[id] != piece.mesh.points[v])
        throw input_error(name + "point " + std::to_string(v) + " is not where the skeleton has it" + anew);
    }
    for (const local_id region : piece.mesh.tags)
      if (static_cast<std::uint64_t>(region) >= regions_)
        throw input_error(name + "it has the material " + std::to_string(region) +
                          ", and the skeleton has names of " + std::to_string(regions_) + anew);
    std::vector<half> found;
    const auto table = build_sides(piece.mesh);
    for (std::size_t s = 0; s < table.size(); ++s)
      if (table.is_boundary(static_cast<local_id>(s)))
        found.push_back(half_of(ids_of(piece, table.vertices[s]), number, false));
    sort_all(found);
    const auto begin = std::lower_bound(halves_.begin(), halves_.end(), half{number, {-1, -1, -1}, false});
    const auto end = std::lower_bound(begin, halves_.end(), half{number + 1, {-1, -1, -1}, false});
    if (!std::equal(begin, end, found.begin(), found.end()))
      throw input_error(
          name + "its sides are not those that the skeleton has of it: " + std::to_string(found.size()) +
          ", turned outwards, and " + std::to_string(end - begin) + " there" + anew);
  }

private:
  /// A side as one of its pieces has it: its piece, ascending numbers, whether these are turned inwards.
  using half = std::tuple<local_id, std::array<global_id, 3>, bool>;

  static std::array<global_id, 3> ids_of(const loaded_mesh& mesh, const simplex<2>& side) {
    std::array<global_id, 3> ids;
    for (std::size_t k = 0; k < 3; ++k)
      ids[k] = mesh.node_ids[side[k]];
    return ids;
  }
  static half half_of(std::array<global_id, 3> ids, local_id piece, bool from_front) {
    const auto sorted = ascending(ids);
    return {piece, sorted, same_turn(sorted, ids) == from_front};
  }
  void add(std::size_t t, local_id piece, bool from_front) {
    halves_.push_back(half_of(ids_of(sides_, sides_.triangles[t]), piece, from_front));
  }

  hdf5_partitions input_;
  loaded_mesh sides_;
  std::vector<half> halves_;
  std::vector<global_id> first_point_, first_element_;
  std::uint64_t regions_ = 0; ///< materials that have names
};

} // namespace dovetail::io::detail
