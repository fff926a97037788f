/// @file
/// Adapter: reads HDF5 files of VTK's format as `hdf5_writer` and `vtkhdf_format` write them.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/files/hdf5_partitions.hpp"
#include "dovetail/files/hdf5_skeleton.hpp"
#include "dovetail/files/mesh_parts.hpp"
#include "dovetail/files/piece_visitor.hpp"
#include "dovetail/files/xdmf_input.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace dovetail::io {

namespace detail {

/// Where the rows of a grid must be.
inline void check_slabs(const hdf5_input& file, const std::filesystem::path& index, const xdmf_grid& grid,
                        std::uint64_t first_point, std::uint64_t points, std::uint64_t first_cell,
                        std::uint64_t nodes) {
  for (const xdmf_slab& slab : grid.arrays) {
    file.require(slab.dataset, {slab.all, slab.columns});
    const bool of_points = slab.dataset.find("Point") != std::string::npos;
    const std::uint64_t each = slab.dataset.ends_with("Connectivity") ? nodes : 1;
    if (slab.file != file.path() || slab.first != (of_points ? first_point : each * first_cell) ||
        slab.rows != (of_points ? points : each * grid.elements))
      throw input_error(index.string() + ": the rows " + std::to_string(slab.first) + " and on of " +
                        slab.file.filename().string() + ":/" + slab.dataset +
                        " are not those of the piece whose grid names them; write the mesh anew");
  }
}

/// The pieces of a mesh in files of whole pieces, which an XDMF file names.
class hdf5_piece_files {
public:
  hdf5_piece_files(std::filesystem::path index, std::vector<std::filesystem::path> files,
                   std::vector<xdmf_grid> grids, element_order elements)
      : index_(std::move(index)), files_(std::move(files)), grids_(std::move(grids)), elements_(elements) {}

  void for_each(const piece_visitor& f) {
    std::optional<hdf5_skeleton> skeleton;
    for (const auto& path : files_) {
      const hdf5_partitions input(path, elements_);
      if (input.has_tetrahedra() && !skeleton)
        skeleton.emplace(index_.parent_path() / "skeleton.vtkhdf", grids_.size(), input.has_middles());
      const auto& file = input.file();
      const auto subdomains = file.read_list<local_id>("pieces/subdomain");
      const auto shared = file.read_list<local_id>("pieces/skeleton_points");
      const auto first_point = file.read_list<global_id>("pieces/first_point");
      const auto first_element = file.read_list<global_id>("pieces/first_element");
      for (const std::size_t size :
           {subdomains.size(), shared.size(), first_point.size(), first_element.size()})
        if (size != input.partitions())
          file.fail("pieces/subdomain", "it or another one beside it has not one number per partition");
      for (std::size_t p = 0; p < subdomains.size(); ++p, ++next_) {
        if (static_cast<std::size_t>(subdomains[p]) != next_ || next_ >= grids_.size())
          file.fail("pieces/subdomain", "partition " + std::to_string(p) + " is subdomain " +
                                            std::to_string(subdomains[p]) + ", not " + std::to_string(next_) +
                                            " of the " + std::to_string(grids_.size()) + " in " +
                                            index_.string());
        const auto cells = input.first_cell(p + 1) - input.first_cell(p);
        if (grids_[next_].elements != cells)
          throw input_error(index_.string() + ": subdomain " + std::to_string(next_) + " has " +
                            std::to_string(grids_[next_].elements) + " elements, and " +
                            std::to_string(cells) + " in " + path.string());
        check_slabs(file, index_, grids_[next_], input.first_point(p),
                    input.first_point(p + 1) - input.first_point(p), input.first_cell(p), input.nodes());
        if (first_element[p] != element_)
          file.fail("pieces/first_element", "partition " + std::to_string(p) + " begins with " +
                                                std::to_string(first_element[p]) + ", not with " +
                                                std::to_string(element_));
        element_ += static_cast<global_id>(cells);
        loaded_mesh piece = input.read(p);
        piece.pass_over(names_in_hdf5);
        check_numbers(file, piece, subdomains[p], shared[p], first_point[p]);
        if (skeleton)
          skeleton->check(piece, subdomains[p], static_cast<std::size_t>(shared[p]), path);
        order_points(piece, path);
        f(piece, path);
      }
    }
    if (next_ != grids_.size())
      throw input_error(index_.string() + ": it has " + std::to_string(grids_.size()) +
                        " grids, and its files have " + std::to_string(next_) + " pieces");
  }

private:
  static void check_numbers(const hdf5_input& file, const loaded_mesh& piece, local_id number,
                            local_id shared, global_id first_point) {
    const std::size_t points = piece.node_ids.size();
    if (shared < 0 || static_cast<std::size_t>(shared) > points)
      file.fail("pieces/skeleton_points", "subdomain " + std::to_string(number) + " has " +
                                              std::to_string(points) + " points, not " +
                                              std::to_string(shared) + " or more");
    for (std::size_t v = static_cast<std::size_t>(shared); v < points; ++v)
      if (piece.node_ids[v] != first_point + static_cast<global_id>(v) - shared)
        file.fail("VTKHDF/PointData/GlobalNodeIds", "the own points of subdomain " + std::to_string(number) +
                                                        " do not follow each other from " +
                                                        std::to_string(first_point));
    for (const local_id subdomain : piece.subdomains)
      if (subdomain != number)
        file.fail("VTKHDF/CellData/subdomain", "an element of subdomain " + std::to_string(number) +
                                                   " says that it is of " + std::to_string(subdomain));
    for (const local_id region : piece.mesh.tags)
      if (region != piece.mesh.tags[0] || region < 0)
        file.fail("VTKHDF/CellData/region",
                  "subdomain " + std::to_string(number) + " has more than one material");
  }

  std::filesystem::path index_;
  std::vector<std::filesystem::path> files_;
  std::vector<xdmf_grid> grids_;
  element_order elements_;
  std::size_t next_ = 0;  ///< piece
  global_id element_ = 0; ///< its first one
};

/// The XDMF file that names a file of pieces; empty for a file of another mesh.
inline std::filesystem::path index_of_pieces(const std::filesystem::path& file) {
  if (file.extension() == ".xdmf")
    return file;
  if (!hdf5_input(file).has("pieces/subdomain"))
    return {};
  const std::string stem = file.stem().string();
  const auto at = stem.rfind('_');
  const auto index = file.parent_path() / (stem.substr(0, at) + ".xdmf");
  std::error_code failure;
  if (at == std::string::npos || !std::filesystem::exists(index, failure))
    throw input_error(file.string() + ": this has pieces of a mesh, and the file that names all of them, " +
                      index.string() + ", is not there; copy it and the files that it names");
  return index;
}

inline std::vector<std::filesystem::path> files_of_grids(const std::vector<xdmf_grid>& grids) {
  std::vector<std::filesystem::path> files;
  for (const xdmf_grid& grid : grids)
    for (const xdmf_slab& slab : grid.arrays)
      if (std::find(files.rbegin(), files.rend(), slab.file) == files.rend()) // the last one, mostly
        files.push_back(slab.file);
  return files;
}

} // namespace detail

/// The HDF5 files of a mesh: those that an XDMF file names, of one file of pieces those of the XDMF file
/// beside it, otherwise the file itself. Linear in the files. Throws `input_error`.
/// \param file of the format `hdf5`, `vtkhdf` or `xdmf`
inline std::vector<std::filesystem::path> files_of_hdf5(const std::filesystem::path& file) {
  const auto index = detail::index_of_pieces(file);
  return index.empty() ? std::vector{file} : detail::files_of_grids(detail::xdmf_input(index).read());
}

/// Calls `f(piece, file)` for each partition of files of VTK's HDF format: pieces that `hdf5_writer` wrote,
/// by their XDMF file or one of them, or ranks, skeletons and others in a file of their own. A piece has
/// tetrahedra, or triangles with CAD faces as tags. Ghosts are left out.
///
/// Of pieces their numbers must be those of their place, rows those that the XDMF file names, and the sides
/// where tetrahedra end those that `skeleton.vtkhdf` has of them, in number, place and turn.
///
/// Throws `input_error` naming the file and the dataset, partition or piece, for whatever is not so, and for
/// elements of second order unless they are asked for. About linear; memory: a piece, and the skeleton.
/// \param file XDMF or VTK's HDF format
/// \param f takes the pieces
/// \param elements whether elements of second order are taken
inline void for_each_hdf5_piece(const std::filesystem::path& file, const piece_visitor& f,
                                element_order elements = element_order::first) {
  if (const auto index = detail::index_of_pieces(file); !index.empty()) {
    auto grids = detail::xdmf_input(index).read();
    auto files = detail::files_of_grids(grids);
    detail::hdf5_piece_files(index, std::move(files), std::move(grids), elements).for_each(f);
    return;
  }
  const detail::hdf5_partitions input(file, elements);
  for (std::size_t p = 0; p < input.partitions(); ++p) {
    loaded_mesh piece = input.read(p);
    detail::order_points(piece, file);
    f(piece, file);
  }
}

/// The whole mesh of these files. Throws what `for_each_hdf5_piece` throws. n log n.
/// \param file XDMF or VTK's HDF format
inline loaded_mesh read_hdf5(const std::filesystem::path& file) {
  return detail::joined_pieces(file, [&](const piece_visitor& f) { for_each_hdf5_piece(file, f); });
}

} // namespace dovetail::io
