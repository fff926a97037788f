/// @file
/// What `openfoam_reader.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/files/mesh_parts.hpp"
#include "dovetail/mesh/simplex.hpp"
#include "dovetail/solver/foam_text.hpp"
#include "dovetail/solver/openfoam_reader.hpp"
#include "dovetail/solver/shared_entities.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail::io {

namespace detail {

/// The mesh of a processor, or of a case in one part.
struct foam_part {
  loaded_mesh piece;
  std::vector<simplex<2>> faces;
  std::size_t inner = 0; ///< of the faces, those between two cells come first
  std::vector<foam_patch> patches;
  std::vector<std::string> zones;
};

/// Reads one folder `polyMesh`.
class foam_part_reader {
public:
  explicit foam_part_reader(std::filesystem::path folder) : folder_(std::move(folder)) {}

  foam_part read() {
    auto& mesh = part_.piece.mesh;
    mesh.points = read_foam_points(folder_ / "points");
    part_.faces = read_foam_faces(folder_ / "faces", mesh.points.size());
    read_cells();
    mesh.elements.reserve(cells_);
    for (std::size_t c = 0; c < cells_; ++c)
      mesh.elements.push_back(tetrahedron(c));
    mesh.tags.resize(cells_);
    part_.zones = read_foam_zones(folder_ / "cellZones", mesh.tags);
    for (std::size_t z = 0; z < part_.zones.size(); ++z)
      part_.piece.material_names.emplace_back(static_cast<local_id>(z), part_.zones[z]);
    read_patches();
    return std::move(part_);
  }

private:
  [[noreturn]] void fail(const char* file, const std::string& what) const {
    throw input_error((folder_ / file).string() + ": " + what + "; write the mesh anew");
  }
  /// Of a cell: a face that it has, and whether the cell is behind it.
  struct cell_face {
    local_id face = no_id;
    bool owned = false;
  };

  /// Owners and neighbours, and from these the faces of each cell.
  void read_cells() {
    foam_text owner_text(folder_ / "owner", "labelList");
    const auto owners = owner_text.labels();
    owner_text.expect_end();
    foam_text neighbour_text(folder_ / "neighbour", "labelList");
    const auto neighbours = neighbour_text.labels();
    neighbour_text.expect_end();
    const std::size_t faces = part_.faces.size();
    part_.inner = neighbours.size();
    if (owners.size() != faces)
      fail("owner",
           std::to_string(owners.size()) + " faces have an owner, and there are " + std::to_string(faces));
    if (neighbours.size() > faces || (faces + neighbours.size()) % 4 != 0)
      fail("neighbour", std::to_string(neighbours.size()) + " of " + std::to_string(faces) +
                            " faces have a neighbour: the cells cannot have four faces each");
    cells_ = (faces + neighbours.size()) / 4;
    for (const auto& [name, count] :
         {std::pair{"nPoints:", part_.piece.mesh.points.size()}, std::pair{"nCells:", cells_},
          std::pair{"nFaces:", faces}, std::pair{"nInternalFaces:", neighbours.size()}})
      check_note(owner_text.note(), name, count);
    cell_faces_.resize(4 * cells_);
    filled_.resize(cells_);
    for (std::size_t f = 0; f < faces; ++f) {
      add_face("owner", owners[f], f, true);
      if (f >= neighbours.size())
        continue;
      if (neighbours[f] <= owners[f])
        fail("neighbour", "face " + std::to_string(f) + " has the owner " + std::to_string(owners[f]) +
                              " and the neighbour " + std::to_string(neighbours[f]) +
                              ", which is not the higher one");
      if (f > 0 && std::pair(owners[f - 1], neighbours[f - 1]) >= std::pair(owners[f], neighbours[f]))
        fail("owner", "face " + std::to_string(f) +
                          " breaks the upper-triangular order, by owner and then "
                          "by neighbour");
      add_face("neighbour", neighbours[f], f, false);
    }
  }
  void check_note(const std::string& note, const std::string& name, std::size_t count) const {
    const auto begin = note.find(name);
    if (begin == std::string::npos)
      return;
    const auto first = note.find_first_not_of(' ', begin + name.size());
    const std::string said =
        first == std::string::npos ? "" : note.substr(first, note.find(' ', first) - first);
    if (said != std::to_string(count))
      fail("owner", "its note says " + name + said + ", and there are " + std::to_string(count));
  }
  void add_face(const char* file, local_id cell, std::size_t face, bool owned) {
    const auto of = [&] { return "face " + std::to_string(face) + " is of cell " + std::to_string(cell); };
    if (static_cast<std::size_t>(cell) >= cells_)
      fail(file, of() + ", and there are " + std::to_string(cells_) + " cells of four faces");
    if (filled_[cell] == 4)
      fail(file, of() + ", which has four other faces already; only tetrahedra are read");
    cell_faces_[4 * static_cast<std::size_t>(cell) + filled_[cell]++] = {static_cast<local_id>(face), owned};
  }

  /// A face of a cell as it is turned out of the cell.
  simplex<2> outwards(const cell_face& from) const {
    simplex<2> face = part_.faces[from.face];
    if (!from.owned)
      std::swap(face[1], face[2]);
    return face;
  }
  simplex<3> tetrahedron(std::size_t cell) const {
    const cell_face* const faces = &cell_faces_[4 * cell];
    const auto first = outwards(faces[0]);
    simplex<3> element{no_id, first[0], first[1], first[2]}; // side 0 has the vertices 1, 2, 3
    for (const local_id v : part_.faces[faces[1].face])
      if (std::find(first.begin(), first.end(), v) == first.end())
        element[0] = v;
    bool closed = element[0] != no_id && first[0] != first[1] && first[1] != first[2] && first[2] != first[0];
    std::array<bool, 4> found{true, false, false, false};
    for (std::size_t k = 1; k < 4 && closed; ++k) {
      const auto face = outwards(faces[k]);
      const auto side =
          std::find_if(numbering::sides<3>.begin(), numbering::sides<3>.end(), [&](const auto& s) {
            simplex<2> vertices;
            for (std::size_t i = 0; i < 3; ++i)
              vertices[i] = element[s[i]];
            return same_turn(face, vertices);
          });
      closed = side != numbering::sides<3>.end() &&
               !std::exchange(found[side - numbering::sides<3>.begin()], true);
    }
    if (!closed) {
      std::string list;
      for (std::size_t k = 0; k < 4; ++k)
        list += " " + std::to_string(faces[k].face);
      fail("faces", "cell " + std::to_string(cell) + " is no tetrahedron: its faces" + list +
                        " do not close it, or one is not turned from its owner to its neighbour");
    }
    return element;
  }

  void read_patches() {
    auto& piece = part_.piece;
    part_.patches = read_foam_boundary(folder_ / "boundary");
    auto next = static_cast<std::int64_t>(part_.inner);
    for (const foam_patch& patch : part_.patches) {
      const auto faces = static_cast<std::int64_t>(part_.faces.size());
      if (patch.first != next || patch.faces > faces - next)
        fail("boundary", "patch " + patch.name + " has the faces from " + std::to_string(patch.first) + ", " +
                             std::to_string(patch.faces) + " of them; it should begin with " +
                             std::to_string(next) + " and end before " + std::to_string(faces));
      next += patch.faces;
      if (patch.is_of_processor())
        continue;
      const auto tag = static_cast<local_id>(piece.triangle_names.size());
      piece.triangle_names.emplace_back(tag, patch.name);
      for (std::int64_t f = patch.first; f < next; ++f) {
        piece.triangles.push_back(part_.faces[f]);
        piece.triangle_tags.push_back(tag);
      }
    }
    if (static_cast<std::size_t>(next) != part_.faces.size())
      fail("boundary", "the faces from " + std::to_string(next) + " on are in no patch");
  }

  std::filesystem::path folder_;
  foam_part part_;
  std::size_t cells_ = 0;
  std::vector<cell_face> cell_faces_; ///< four per cell
  std::vector<std::uint8_t> filled_;  ///< per cell: how many are known
};

/// Numbers the points of processors, and compares what these say of what is between them.
class foam_joint {
public:
  explicit foam_joint(const std::vector<std::filesystem::path>& folders) : folders_(folders) {}

  /// Gives the points of a part their numbers. Parts come in the order of processors.
  void add(foam_part& part) {
    here_ = part.piece.first_part;
    number(part);
    compare_names(part);
    for (const foam_patch& patch : part.patches) {
      const bool between = patch.is_of_processor();
      std::vector<std::array<global_id, 3>> faces;
      for (std::int64_t f = patch.first; f < patch.first + patch.faces; ++f) {
        std::array<global_id, 3> ids;
        for (std::size_t k = 0; k < 3; ++k)
          ids[k] = part.piece.node_ids[part.faces[f][k]];
        faces_.add({ascending(ids), here_, between ? 2 : 1});
        if (between)
          faces.push_back(ids);
      }
      if (between)
        compare(patch, std::move(faces));
    }
  }

  /// When all parts are there.
  void finish() {
    for (const auto& [processors, faces] : open_)
      fail(static_cast<local_id>(processors.second),
           "it has no patch to processor " + std::to_string(processors.first) + ", which has one to it");
    const auto found = faces_.find_unlisted();
    if (found.rank == no_id)
      return;
    if (found.other != found.rank)
      fail(found.rank, "a face of a patch that is not between processors is also one of processor " +
                           std::to_string(found.other));
    fail(found.rank, "a face of a processor patch is none of the other processor");
  }

private:
  [[noreturn]] void fail(local_id processor, const std::string& what) const {
    throw input_error((folders_[processor] / "boundary").string() + ": " + what +
                      "; write the meshes of all processors anew");
  }

  /// Points at the end of the part have the number of the place, whichever part had it first.
  void number(foam_part& part) {
    const auto& points = part.piece.mesh.points;
    const bool several = folders_.size() > 1;
    std::vector<bool> at_end(points.size(), false);
    for (std::size_t f = part.inner; f < part.faces.size() && several; ++f)
      for (const local_id v : part.faces[f])
        at_end[v] = true;
    std::vector<global_id> taken;
    for (std::size_t v = 0; v < points.size(); ++v) {
      global_id id = next_;
      if (at_end[v]) {
        const vec3 p = points[v];
        id = places_.try_emplace(std::tuple(p.x, p.y, p.z), next_).first->second;
        taken.push_back(id);
      }
      next_ += id == next_ ? 1 : 0;
      part.piece.node_ids.push_back(id);
    }
    sort_all(taken);
    if (std::adjacent_find(taken.begin(), taken.end()) != taken.end())
      throw input_error((folders_[here_] / "points").string() +
                        ": two points are at the same place; write the mesh anew");
  }

  void compare_names(const foam_part& part) {
    std::vector<std::string> names;
    for (const auto& [tag, name] : part.piece.triangle_names)
      names.push_back(name);
    if (here_ == 0) {
      patches_ = names;
      zones_ = part.zones;
    }
    if (names != patches_)
      fail(here_, "its patches are not those of processor 0, but for those between processors");
    if (part.zones != zones_)
      throw input_error((folders_[here_] / "cellZones").string() +
                        ": the zones are not those of processor 0; write the meshes of all processors anew");
  }

  void compare(const foam_patch& patch, std::vector<std::array<global_id, 3>> faces) {
    if (patch.here != here_ || static_cast<std::size_t>(patch.there) >= folders_.size())
      fail(here_, "patch " + patch.name + " is between processors " + std::to_string(patch.here) + " and " +
                      std::to_string(patch.there) + ", of " + std::to_string(folders_.size()));
    const auto key = std::minmax(patch.here, patch.there);
    const std::pair<std::int64_t, std::int64_t> processors(key.first, key.second);
    if (patch.there > patch.here) {
      if (!open_.try_emplace(processors, std::move(faces)).second)
        fail(here_, "there are two patches to processor " + std::to_string(patch.there));
      return;
    }
    const auto other = open_.find(processors);
    const std::string there = "processor " + std::to_string(patch.there);
    if (other == open_.end())
      fail(here_, "patch " + patch.name + " has no counterpart in " + there + ", or is there twice");
    if (other->second.size() != faces.size())
      fail(here_, "patch " + patch.name + " has " + std::to_string(faces.size()) + " faces, and " + there +
                      " has " + std::to_string(other->second.size()));
    for (std::size_t f = 0; f < faces.size(); ++f) {
      std::swap(faces[f][1], faces[f][2]);
      if (faces[f] != other->second[f])
        fail(here_, "face " + std::to_string(f) + " of patch " + patch.name +
                        (ascending(faces[f]) == ascending(other->second[f])
                             ? " does not begin with the same point there, or is not turned against it"
                             : " is not where " + there + " has it"));
    }
    open_.erase(other);
  }

  const std::vector<std::filesystem::path>& folders_;
  local_id here_ = 0; ///< the processor that is looked at
  global_id next_ = 0;
  std::map<std::tuple<double, double, double>, global_id> places_;
  std::vector<std::string> patches_, zones_; ///< of processor 0
  /// Of pairs of processors, the lower first, of which only the lower has been seen.
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::array<global_id, 3>>> open_;
  shared_entities<3> faces_;
};

} // namespace detail

DOVETAIL_INLINE std::vector<std::filesystem::path> folders_of_openfoam(const std::filesystem::path& path) {
  std::error_code failure;
  auto folder = std::filesystem::absolute(path, failure).lexically_normal();
  if (!folder.has_filename()) // "case/"
    folder = folder.parent_path();
  if (!std::filesystem::is_directory(folder, failure))
    folder = folder.parent_path();
  if (folder.filename() == "constant" && std::filesystem::is_directory(folder / "polyMesh", failure))
    folder /= "polyMesh";
  const bool is_given = folder.filename() == "polyMesh";
  if (is_given)
    folder = folder.parent_path().parent_path();
  const std::string processor = "processor";
  const auto is_processor = [&](const std::string& name) {
    return name.starts_with(processor) && detail::is_number(name.substr(processor.size()));
  };
  const bool of_processor = is_processor(folder.filename().string());
  if (of_processor)
    folder = folder.parent_path();
  // As the path was given, where it was the case or something in it.
  const auto relative = std::filesystem::relative(folder, std::filesystem::absolute(".", failure), failure);
  const auto root = path.is_absolute() || failure ? folder : relative;
  std::vector<std::filesystem::path> folders;
  const auto mesh_of = [&](const std::filesystem::path& of) { return of / "constant" / "polyMesh"; };
  if (of_processor || !is_given)
    for (std::size_t p = 0;; ++p) {
      const auto next = mesh_of(root / (processor + std::to_string(p)));
      if (!std::filesystem::is_directory(next, failure))
        break;
      folders.push_back(next);
    }
  const auto processors = [&] {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(root, failure))
      count += is_processor(entry.path().filename().string()) &&
               std::filesystem::is_directory(mesh_of(entry.path()), failure);
    return count;
  };
  if (!folders.empty() && processors() > folders.size())
    throw input_error((root / (processor + std::to_string(folders.size()))).string() +
                      ": there is no mesh of this processor, and there is one of a later one");
  if (folders.empty() && !of_processor && std::filesystem::is_directory(mesh_of(root), failure))
    folders.push_back(mesh_of(root));
  return folders;
}

DOVETAIL_INLINE void for_each_openfoam_piece(const std::filesystem::path& path, const piece_visitor& f) {
  const auto folders = folders_of_openfoam(path);
  if (folders.empty())
    throw input_error(path.string() + ": this is no case of OpenFOAM: it has neither constant/polyMesh nor "
                                      "processor0/constant/polyMesh");
  detail::foam_joint joint(folders);
  for (std::size_t p = 0; p < folders.size(); ++p) {
    detail::foam_part part = detail::foam_part_reader(folders[p]).read();
    part.piece.parts = static_cast<local_id>(folders.size());
    part.piece.parts_here = 1;
    part.piece.first_part = static_cast<local_id>(p);
    joint.add(part);
    if (folders.size() > 1)
      part.piece.subdomains.assign(part.piece.mesh.elements.size(), static_cast<local_id>(p));
    detail::order_points(part.piece, folders[p]);
    f(part.piece, folders[p]);
  }
  joint.finish();
}

DOVETAIL_INLINE loaded_mesh read_openfoam(const std::filesystem::path& path) {
  return detail::joined_pieces(path, [&](const piece_visitor& f) { for_each_openfoam_piece(path, f); });
}

} // namespace dovetail::io
