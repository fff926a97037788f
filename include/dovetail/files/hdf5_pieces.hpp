/// @file
/// Adapter: a mesh in HDF5 files of whole pieces, of VTK's format, with little more than points and
/// connectivity in them: for meshes of which nobody can hold the whole.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/files/face_groups.hpp"
#include "dovetail/files/hdf5_file.hpp"
#include "dovetail/files/numbered_files.hpp"
#include "dovetail/files/piecewise_output.hpp"
#include "dovetail/files/skeleton_nodes.hpp"
#include "dovetail/files/vtk_xml_output.hpp"
#include "dovetail/files/xdmf_index.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/global_numbering.hpp"
#include "dovetail/mesh/mid_nodes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace dovetail::io {

namespace detail {

/// An HDF5 file under a temporary name until it is complete; without `commit` nothing is left.
class hdf5_part {
public:
  explicit hdf5_part(const std::filesystem::path& path) : path_(path), part_(path.string() + ".part") {
    try {
      file_.emplace(part_);
    } catch (...) {
      remove_part();
      throw;
    }
  }
  hdf5_part(const hdf5_part&) = delete;
  hdf5_part& operator=(const hdf5_part&) = delete;
  ~hdf5_part() {
    file_.reset();
    remove_part();
  }

  hdf5_file& operator*() { return *file_; }
  hdf5_file* operator->() { return &*file_; }
  /// Returns the bytes of the file.
  std::uint64_t commit() {
    file_->close();
    const auto bytes = move_file(part_, path_);
    sync_to_disk(path_.parent_path());
    return bytes;
  }

private:
  void remove_part() {
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
  }

  std::filesystem::path path_;
  std::filesystem::path part_;
  std::optional<hdf5_file> file_;
};

inline constexpr const char* vtkhdf_root = "VTKHDF/";

/// The arrays of an unstructured grid of one type of elements in partitions, not yet filled.
inline void begin_vtkhdf(hdf5_file& file, const std::vector<grid_extent>& partitions, std::uint8_t cell_type,
                         std::uint64_t corners) {
  const std::string root = vtkhdf_root;
  std::vector<std::int64_t> points, cells, ids;
  for (const grid_extent& partition : partitions) {
    points.push_back(static_cast<std::int64_t>(partition.points));
    cells.push_back(static_cast<std::int64_t>(partition.cells));
    ids.push_back(static_cast<std::int64_t>(corners * partition.cells));
  }
  const grid_extent all = sum_of(partitions);
  file.add(root + "NumberOfPoints", points);
  file.add(root + "NumberOfCells", cells);
  file.add(root + "NumberOfConnectivityIds", ids);
  file.attribute("VTKHDF", "Version", std::vector<std::int64_t>{1, 0});
  file.attribute("VTKHDF", "Type", std::string("UnstructuredGrid"));
  file.create<double>(root + "Points", all.points, 3);
  file.create<local_id>(root + "Connectivity", corners * all.cells);
  file.create_packed<local_id>(root + "Offsets", all.cells + partitions.size());
  file.create_constant<std::uint8_t>(root + "Types", all.cells, cell_type);
  file.create_packed<global_id>(root + "PointData/GlobalNodeIds", all.points);
}

/// The offsets of one partition.
inline void write_offsets(hdf5_file& file, std::uint64_t first, std::uint64_t cells, std::uint64_t corners) {
  if (corners * cells > static_cast<std::uint64_t>(std::numeric_limits<local_id>::max()))
    throw io_error("a piece would have more than 2^31 corners of elements: ask for more subdomains");
  file.write_computed<local_id>(std::string(vtkhdf_root) + "Offsets", first, cells + 1,
                                [&](std::uint64_t i) { return static_cast<local_id>(corners * i); });
}

/// Points as rows of coordinates.
inline const double* coordinates(std::span<const vec3> points) {
  static_assert(sizeof(vec3) == 3 * sizeof(double));
  return reinterpret_cast<const double*>(points.data());
}

/// What all files of a mesh are made with.
template <int D>
struct hdf5_tables {
  explicit hdf5_tables(const distributed_simplicial_mesh<D>& mesh) : numbers(number_nodes(mesh)) {
    const auto shared = count_skeleton_nodes(mesh);
    for (std::size_t p = 0; p < mesh.counts.size(); ++p)
      extents.push_back(
          {static_cast<std::uint64_t>(shared[p]) + static_cast<std::uint64_t>(inner_nodes(mesh, p)),
           static_cast<std::uint64_t>(mesh.counts[p].elements)});
  }

  global_numbering numbers;
  std::vector<grid_extent> extents; ///< of each piece
};

/// The file of a range of pieces, each a partition of VTK's: its points as the piece has them, those of the
/// skeleton first.
template <int D>
class hdf5_piece_file {
public:
  hdf5_piece_file(const std::filesystem::path& path, const distributed_simplicial_mesh<D>& mesh,
                  std::shared_ptr<const hdf5_tables<D>> tables, local_id first, local_id last)
      : mesh_(mesh), tables_(std::move(tables)), corners_(nodes_per_element(mesh)), next_(first), last_(last),
        file_(path) {
    const std::vector<grid_extent> partitions(tables_->extents.begin() + first,
                                              tables_->extents.begin() + last);
    const grid_extent all = sum_of(partitions);
    begin_vtkhdf(*file_, partitions, vtk_cell_type(D, mesh.mid_nodes != nullptr), corners_);
    for (const char* array : {"subdomain", "region"})
      file_->create_packed<local_id>(of_cells(array), all.cells);
    const auto from = static_cast<std::size_t>(first), to = static_cast<std::size_t>(last);
    std::vector<local_id> subdomains;
    for (local_id s = first; s < last; ++s)
      subdomains.push_back(s);
    file_->add("pieces/subdomain", subdomains);
    file_->add("pieces/first_point", slice(tables_->numbers.first_point, from, to));
    file_->add("pieces/first_element", slice(tables_->numbers.first_element, from, to));
    file_->template create<local_id>("pieces/skeleton_points", to - from);
  }

  /// Pieces come in their order.
  void add(const simplicial_piece<D>& piece) {
    const std::string name = std::string("subdomain ").append(std::to_string(piece.subdomain));
    if (piece.subdomain != next_ || next_ == last_)
      throw mesh_error(name + " is not the next of its HDF5 file");
    const auto at = static_cast<std::size_t>(next_++);
    const piece_nodes<D> nodes(mesh_, piece);
    const auto shared = nodes.shared();
    const grid_extent extent = tables_->extents[at];
    if (shared.size() + nodes.own().size() != extent.points)
      throw mesh_error(name + " has other skeleton points than its skeleton sides");
    write_points(nodes, tables_->numbers.first_point[at]);
    const std::string root = vtkhdf_root;
    const auto cells = extent.cells;
    if (cells > 0)
      file_->write(root + "Connectivity", corners_ * done_.cells, corners_ * cells,
                   nodes.of_element(0).data());
    write_offsets(*file_, done_.cells + partition_, cells, corners_);
    write_constant(of_cells("subdomain"), cells, piece.subdomain);
    if constexpr (D == 3)
      write_constant(of_cells("region"), cells, mesh_.counts[at].material);
    else
      file_->write(of_cells("region"), done_.cells, piece.mesh.tags);
    const auto of_skeleton = static_cast<local_id>(shared.size());
    file_->write("pieces/skeleton_points", partition_++, 1, &of_skeleton);
    done_ += extent;
  }

  std::uint64_t close() { return file_.commit(); }

private:
  static std::string of_cells(const char* array) {
    return std::string(vtkhdf_root).append("CellData/").append(array);
  }
  static std::vector<global_id> slice(const std::vector<global_id>& all, std::size_t from, std::size_t to) {
    return {all.begin() + static_cast<std::ptrdiff_t>(from), all.begin() + static_cast<std::ptrdiff_t>(to)};
  }
  void write_points(const piece_nodes<D>& nodes, global_id first_own) {
    const std::string root = vtkhdf_root;
    std::vector<vec3> places;
    std::vector<global_id> ids;
    for (const local_id v : nodes.shared()) {
      places.push_back(skeleton_node(mesh_, v));
      ids.push_back(v);
    }
    for (std::size_t i = 0; i < nodes.own().size(); ++i)
      ids.push_back(first_own + static_cast<global_id>(i));
    file_->write(root + "Points", done_.points, places.size(), coordinates(span_of(places)), 3);
    file_->write(root + "Points", done_.points + places.size(), nodes.own().size(), coordinates(nodes.own()),
                 3);
    file_->write(root + "PointData/GlobalNodeIds", done_.points, ids);
  }
  void write_constant(const std::string& name, std::uint64_t cells, local_id value) {
    file_->template write_computed<local_id>(name, done_.cells, cells, [&](std::uint64_t) { return value; });
  }

  const distributed_simplicial_mesh<D>& mesh_;
  std::shared_ptr<const hdf5_tables<D>> tables_;
  const std::uint64_t corners_; ///< nodes per element
  local_id next_;
  local_id last_;               ///< one past the last subdomain
  std::uint64_t partition_ = 0; ///< number of the next piece in the file
  grid_extent done_;            ///< of the pieces before it
  hdf5_part file_;
};

/// The sides of the skeleton on its points, each side once; of second-order elements the straight ones.
template <int D>
void write_hdf5_skeleton(const std::filesystem::path& path, const distributed_simplicial_mesh<D>& mesh,
                         const global_numbering& numbers) {
  const auto& skeleton = mesh.skeleton;
  const grid_extent extent{skeleton.points.size(), skeleton.sides.size()};
  const std::string root = vtkhdf_root, of_cells = root + "CellData/";
  hdf5_part file(path);
  begin_vtkhdf(*file, {extent}, vtk_cell_type(D - 1, false), D);
  file->write(root + "Points", 0, extent.points, coordinates(span_of(skeleton.points)), 3);
  file->template write_computed<global_id>(root + "PointData/GlobalNodeIds", 0, extent.points,
                                           [](std::uint64_t i) { return static_cast<global_id>(i); });
  if (extent.cells > 0)
    file->write(root + "Connectivity", 0, D * extent.cells, skeleton.sides.front().data());
  write_offsets(*file, 0, extent.cells, D);
  const auto add = [&](const char* array, const auto& of_side) {
    file->template create_packed<local_id>(of_cells + array, extent.cells);
    file->template write_computed<local_id>(of_cells + array, 0, extent.cells, [&](std::uint64_t t) {
      return of_side(static_cast<std::size_t>(t));
    });
  };
  add(D == 3 ? "cad_face" : "cad_curve", [&](std::size_t t) { return skeleton.side_hosts[t]; });
  add("subdomain", [&](std::size_t t) { return skeleton.subdomains[t][0]; });
  add("front_subdomain", [&](std::size_t t) { return skeleton.subdomains[t][1]; });
  if constexpr (D == 3) {
    const auto groups = collect_face_groups(mesh);
    add("patch", [&](std::size_t t) {
      const auto face = skeleton.side_hosts[t];
      return face == no_id ? no_id : groups.of_face[face];
    });
    file->add("names/patches", groups.names);
  }
  file->add("names/faces", mesh.face_names);
  file->add("names/regions", names_of_tags(mesh));
  file->add("pieces/first_point", numbers.first_point);
  file->add("pieces/first_element", numbers.first_element);
  file.commit();
}

} // namespace detail

/// Writes `<stem>_0000.vtkhdf`, ..., each with the pieces of a run of subdomains, `skeleton.vtkhdf` (the
/// boundary and the faces between subdomains; in D = 2 the edges of lines) and `<stem>.xdmf`, which names the
/// pieces. About 21 bytes per tetrahedron. See docs/formats.md for the arrays.
struct hdf5_writer {
  int files = 0;             ///< number of files of pieces; 0: one per subdomain, never more than subdomains
  std::string stem = "mesh"; ///< what the names of the files begin with

  /// A model of `piecewise_mesh_writer`. Memory: the skeleton, a number per point of it, and one loaded
  /// subdomain.
  template <int D>
  report operator()(const distributed_simplicial_mesh<D>& mesh, const std::filesystem::path& folder) const {
    return write_piecewise<D>(mesh, *this, folder);
  }

  /// The files as tasks for `finish_mesh`: a file takes the pieces of its subdomains.
  template <int D>
  piecewise_output<D> begin(const distributed_simplicial_mesh<D>& mesh,
                            const std::filesystem::path& unfinished) const {
    const std::string skeleton = "skeleton.vtkhdf", index = stem + ".xdmf", extension = ".vtkhdf";
    const auto tables = std::make_shared<const detail::hdf5_tables<D>>(mesh);
    piecewise_output<D> output;
    output.bounds = bounds_of_files(files, static_cast<local_id>(mesh.counts.size()));
    output.names = numbered_names(stem, output.bounds.size() - 1, extension);
    output.open = [&mesh, unfinished, tables, bounds = output.bounds, names = output.names](std::size_t f) {
      const auto file = std::make_shared<detail::hdf5_piece_file<D>>(unfinished / names[f], mesh, tables,
                                                                     bounds[f], bounds[f + 1]);
      return piece_file<D>{[file](const simplicial_piece<D>& piece) { file->add(piece); },
                           [file] { return file->close(); }};
    };
    output.others.push_back({skeleton, [&mesh, tables, path = unfinished / skeleton] {
                               detail::write_hdf5_skeleton(path, mesh, tables->numbers);
                             }});
    output.complete = [&mesh, tables, path = unfinished / index, bounds = output.bounds,
                       names = output.names] {
      output_file file(path);
      detail::write_xdmf_index(file, detail::xdmf_topology<D>(mesh.mid_nodes != nullptr),
                               nodes_per_element(mesh), tables->extents, bounds, names);
      file.commit();
    };
    output.finish = [tables, unfinished, stem = stem, index, skeleton, extension,
                     sources = output.names](const std::filesystem::path& folder) {
      // Between these lines the folder has no index, rather than one that names files of two meshes.
      std::error_code ignored;
      std::filesystem::remove(folder / index, ignored);
      report summary{"hdf5", 0, {}, {}, {}, sources};
      summary.files.push_back(skeleton);
      summary.files.push_back(index);
      std::uint64_t bytes = 0;
      for (const auto& name : summary.files)
        bytes += move_file(unfinished / name, folder / name);
      remove_stale_files(folder, stem, extension, sources);
      sync_to_disk(folder);
      summary.set(written_counts{tables->numbers.elements(), bytes, summary.files.size()});
      return summary;
    };
    return output;
  }
};

} // namespace dovetail::io
