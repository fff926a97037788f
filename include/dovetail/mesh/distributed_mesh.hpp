/// @file
/// The result of the pipeline: the fine skeleton, held once, and pieces that are loaded one at a time.
///
/// Global numbers follow from counts alone (one exclusive scan): point s of the skeleton has global id s;
/// inner point i of piece p has id skeleton.points.size() + (inner points of pieces before p) + i; element e
/// of piece p has id (elements of pieces before p) + e.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/core/shared_array.hpp"
#include "dovetail/mesh/piece_quality.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace dovetail {

/// The remeshed boundaries of all pieces, held once. A side between two pieces is stored once, oriented
/// outwards of `subdomains[0]`; `subdomains[1]` is the piece on its other side, or no_id on the boundary of
/// the domain.
///
/// In D = 2 the sides are the edges of the lines between subsurfaces and on CAD curves. An edge passed with
/// the piece on its left is oriented outwards of it. An edge of other than two triangles is stored once per
/// triangle; one on a CAD curve inside a piece names that piece twice.
template <int D>
struct simplicial_skeleton {
  shared_array<vec3> points; ///< by their number in the skeleton
  /// The lowest-dimensional CAD entity of each point: {3, solid} on inner interfaces, {2, CAD face} on lines
  /// that are not on CAD curves.
  shared_array<host> point_hosts;
  shared_array<simplex<D - 1>> sides;               ///< each once, as said above
  shared_array<std::array<local_id, 2>> subdomains; ///< per side
  shared_array<local_id> side_hosts;   ///< per side: its CAD face (D = 3) or curve (D = 2), or no_id inside
  std::vector<simplex<1>> curve_edges; ///< mesh edges on CAD curves (D = 3; in D = 2 they are sides)
  std::vector<local_id> curves;        ///< the CAD curve of each such edge
};

using fine_skeleton = simplicial_skeleton<3>; ///< that of tetrahedral meshes

/// The mesh of one subdomain. Its first `skeleton_points.size()` points are skeleton points, the others its
/// own. In D = 2 the elements' tags are CAD faces.
template <int D>
struct simplicial_piece {
  local_id subdomain = no_id;            ///< the number of the subdomain
  local_id material = 0;                 ///< of all its elements; in D = 2 it has none of its own
  simplicial_mesh<D> mesh;               ///< points and elements
  std::vector<local_id> skeleton_points; ///< index in the skeleton of each of the first points

  /// As bytes (`core/encoding.hpp`): tags only where they differ from the material.
  void encode(byte_writer& to) const {
    to.value(subdomain);
    to.value(material);
    to.array(skeleton_points);
    to.array(mesh.points);
    to.array(mesh.elements);
    const auto& tags = mesh.tags;
    const bool one_material =
        std::all_of(tags.begin(), tags.end(), [&](local_id tag) { return tag == material; });
    to.value(tags.empty() ? tags_kept::none : one_material ? tags_kept::material : tags_kept::each);
    if (!one_material)
      to.array(tags);
  }
  /// The piece that was encoded. Throws `input_error` when the data end early.
  static simplicial_piece decode(byte_reader& from) {
    simplicial_piece piece;
    piece.subdomain = from.value<local_id>();
    piece.material = from.value<local_id>();
    piece.skeleton_points = from.array<local_id>();
    piece.mesh.points = from.array<vec3>();
    piece.mesh.elements = from.array<simplex<D>>();
    const auto kept = from.value<tags_kept>();
    if (kept == tags_kept::material)
      piece.mesh.tags.assign(piece.mesh.elements.size(), piece.material);
    else if (kept == tags_kept::each)
      piece.mesh.tags = from.array<local_id>();
    return piece;
  }

private:
  enum class tags_kept : std::uint8_t { none, material, each };
};

using mesh_piece = simplicial_piece<3>; ///< a piece of tetrahedra

/// Adds a piece's own points and its elements, with the piece's tags or else its material, to a mesh that
/// starts with the points of the skeleton. O(size of the piece).
/// Throws nothing but for a lack of memory.
/// \param mesh starts with the points of the skeleton; grows
/// \param piece as `pieces` of a distributed mesh load it
template <int D>
void append_piece(simplicial_mesh<D>& mesh, const simplicial_piece<D>& piece) {
  const auto shared = static_cast<local_id>(piece.skeleton_points.size());
  const auto first_own = static_cast<local_id>(mesh.points.size());
  append(mesh.points, span_of(piece.mesh.points).subspan(piece.skeleton_points.size()));
  for (simplex<D> element : piece.mesh.elements) {
    for (local_id& v : element)
      v = v < shared ? piece.skeleton_points[v] : first_own + v - shared;
    mesh.elements.push_back(element);
  }
  if (piece.mesh.tags.empty())
    mesh.tags.resize(mesh.elements.size(), piece.material);
  else
    append(mesh.tags, piece.mesh.tags);
}

/// Known of a piece without loading it.
struct piece_counts {
  local_id material = 0;      ///< of its elements
  global_id inner_points = 0; ///< its points that are none of the skeleton
  global_id elements = 0;     ///< how many elements it has

  using fields = field_list<&piece_counts::material, &piece_counts::inner_points, &piece_counts::elements>;
};

/// What is kept in place of a piece that was given up.
struct piece_note {
  /// A file of the piece.
  struct file {
    std::string path;        ///< absolute
    std::uint64_t bytes = 0; ///< its size

    using fields = field_list<&file::path, &file::bytes>;
  };
  std::vector<file> files; ///< where the piece is now; when one of them is missing, so is the piece
  byte_buffer text;        ///< for whoever gave the piece up

  /// Whether all files are there, as long as they were.
  bool is_whole() const {
    return std::all_of(files.begin(), files.end(), [](const file& each) {
      std::error_code missing;
      return std::filesystem::file_size(each.path, missing) == each.bytes && !missing;
    });
  }

  using fields = field_list<&piece_note::files, &piece_note::text>;
};

template <int D>
struct mid_edge_nodes;

/// A whole mesh without holding it: what writers, checks and statistics stream over.
template <int D>
struct distributed_simplicial_mesh {
  simplicial_skeleton<D> skeleton;                   ///< what is between the pieces
  std::vector<piece_counts> counts;                  ///< by piece
  std::vector<piece_quality> quality = {};           ///< of each piece; empty where nobody has measured it
  std::function<simplicial_piece<D>(local_id)> load; ///< loads piece p; pure
  /// Gives up the storage of piece p, which is not loaded again. A resumed run takes the files of the note
  /// for the piece; without any, it makes the piece again. May be called in a worker; empty: not possible.
  std::function<void(local_id, const piece_note&)> release = {};
  /// The note of a piece that was given up and is in its files; may be empty.
  std::function<std::optional<piece_note>(local_id)> released = {};

  /// Where there are any (`add_mid_nodes`), writers write second-order elements.
  std::shared_ptr<const mid_edge_nodes<D>> mid_nodes = {};

  std::vector<std::string> material_names; ///< per material
  std::vector<std::string> face_names;     ///< per CAD face; may be empty strings
  std::vector<std::string> group_names;    ///< per CAD face: the group of faces it belongs to; may be empty
};

using distributed_mesh = distributed_simplicial_mesh<3>; ///< a mesh of tetrahedra in pieces

/// Which sides of a skeleton bound which subdomain, growing. A side with one subdomain on both of its sides
/// is listed twice in a row.
using sides_of_subdomains = compressed_rows<local_id>;

/// Sorts the skeleton's sides by subdomain. Linear. Throws nothing but for a lack of memory.
/// \param skeleton names no other subdomains than these
/// \param subdomains how many there are
template <int D>
sides_of_subdomains sort_by_subdomain(const simplicial_skeleton<D>& skeleton, std::size_t subdomains) {
  return sorted_into_rows<local_id>(subdomains, [&](const auto& put) {
    for (std::size_t t = 0; t < skeleton.subdomains.size(); ++t)
      for (const local_id s : skeleton.subdomains[t])
        if (s != no_id)
          put(s, static_cast<local_id>(t));
  });
}

} // namespace dovetail
