#include "any_mesh_file.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/core/input_file.hpp"
#include "dovetail/files/mesh_parts.hpp"
#include "dovetail/files/read_mesh.hpp"
#include "dovetail/files/zlib.hpp"
#include "dovetail/solver/mfem_reader.hpp"
#include "dovetail/solver/openfoam_reader.hpp"

#ifdef DOVETAIL_DRIVER_WITH_HDF5
#include "dovetail/files/hdf5_reader.hpp"
#include "dovetail/solver/hdf5_rank_reader.hpp"
#endif

#include <algorithm>
#include <string>
#include <system_error>

namespace dovetail::app {
namespace {

enum class other_format { none, hdf5, hdf5_ranks, mfem, openfoam };

bool is_file(const std::filesystem::path& path) {
  std::error_code failure;
  return std::filesystem::is_regular_file(path, failure);
}

std::string start_of(const std::filesystem::path& file) {
  return is_file(file) && std::filesystem::file_size(file) > 0 ? read_file(file, 256) : std::string();
}

other_format format_of(const std::filesystem::path& path) {
  const std::string start = start_of(path);
  const std::string format = io::detail::unread_format(start);
  if (format == "MFEM")
    return other_format::mfem;
  std::error_code failure;
  const bool is_folder = std::filesystem::is_directory(path, failure);
  if (format == "OpenFOAM" || (is_folder && !io::folders_of_openfoam(path).empty()))
    return other_format::openfoam;
  if (format == "HDF5")
    return path.extension() == ".h5" ? other_format::hdf5_ranks : other_format::hdf5;
  if (format == "XDMF") // its names of files end so, or in .vtkhdf
    return read_file(path).find(".h5:/") != std::string::npos ? other_format::hdf5_ranks : other_format::hdf5;
  return other_format::none;
}

void for_each_of_other(other_format format, const std::filesystem::path& path, const io::piece_visitor& f,
                       [[maybe_unused]] io::element_order elements) {
  if (format == other_format::mfem)
    return io::for_each_mfem_piece(path, f, elements);
  if (format == other_format::openfoam)
    return io::for_each_openfoam_piece(path, f);
#ifdef DOVETAIL_DRIVER_WITH_HDF5
  if (format == other_format::hdf5)
    return io::for_each_hdf5_piece(path, f, elements);
  io::loaded_mesh whole = io::read_hdf5_ranks(path, elements);
  io::detail::order_points(whole, path);
  f(whole, whole.files.front());
#else
  throw input_error(path.string() + ": this dovetail was built without HDF5, and cannot read the file");
#endif
}

/// "mesh.000001"
bool has_number(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  return extension.size() > 1 && io::detail::is_number(extension.substr(1));
}

/// Whether a file is of another format, and no index beside it names it.
bool stands_for_mesh(const std::filesystem::path& file) {
  if (has_number(file))
    return format_of(file) == other_format::mfem;
  const std::string stem = file.stem().string(), extension = file.extension().string();
  const auto has_index = [&](const std::string& name) {
    return is_file(file.parent_path() / (name + ".xdmf"));
  };
  const auto at = stem.rfind('_');
  if (extension == ".vtkhdf")
    return stem != "skeleton" && (at == std::string::npos || !has_index(stem.substr(0, at)));
  return extension == ".xdmf" || (extension == ".h5" && !has_index(stem));
}

} // namespace

std::vector<std::filesystem::path> all_meshes_in(const std::filesystem::path& folder) {
  auto found = io::mesh_files_in(folder);
  std::error_code failure;
  std::vector<std::filesystem::path> others;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure))
    if (stands_for_mesh(entry.path()))
      others.push_back(entry.path());
  std::sort(others.begin(), others.end());
  // Of the ranks' files of one mesh the first.
  const auto of_same_mesh = [](const auto& a, const auto& b) {
    return has_number(a) && has_number(b) && a.stem() == b.stem();
  };
  others.erase(std::unique(others.begin(), others.end(), of_same_mesh), others.end());
  found.insert(found.end(), others.begin(), others.end());
  if (!io::folders_of_openfoam(folder).empty())
    found.push_back(folder);
  return found;
}

std::filesystem::path find_any_mesh(const std::filesystem::path& path) {
  std::error_code failure;
  if (!std::filesystem::is_directory(path, failure) || !io::mesh_files_in(path).empty())
    return io::find_mesh_file(path);
  const auto all = all_meshes_in(path);
  return all.empty() ? io::find_mesh_file(path) : all.front(); // which says what is there instead
}

std::vector<std::filesystem::path> files_of_any_mesh(const std::filesystem::path& path) {
  const std::filesystem::path mesh = find_any_mesh(path);
  const other_format format = format_of(mesh);
  if (format == other_format::none)
    return io::files_of_mesh(path);
  std::vector<std::filesystem::path> files;
  if (format == other_format::mfem)
    return io::files_of_mfem(mesh);
  if (format == other_format::openfoam)
    for (const auto& folder : io::folders_of_openfoam(mesh))
      for (const auto& entry : std::filesystem::directory_iterator(folder))
        files.push_back(entry.path());
#ifdef DOVETAIL_DRIVER_WITH_HDF5
  if (format == other_format::hdf5 || format == other_format::hdf5_ranks) {
    files = io::files_of_hdf5(mesh);
    for (const char* beside : {"skeleton.vtkhdf", "mesh.xdmf"})
      if (files.size() > 1)
        files.push_back(mesh.parent_path() / beside);
    files.push_back(mesh);
  }
#endif
  return files;
}

bool for_each_piece_of_any(const std::filesystem::path& path, const io::piece_visitor& f,
                           io::element_order elements) {
  const other_format format = format_of(path);
  if (format == other_format::none)
    return io::for_each_piece_file(path, io::zlib_expand, f, elements);
  bool of_tetrahedra = true;
  const auto visit = [&](const io::loaded_mesh& piece, const std::filesystem::path& file) {
    of_tetrahedra = of_tetrahedra && (!piece.mesh.elements.empty() || piece.triangles.empty());
    if (of_tetrahedra && !piece.mesh.elements.empty())
      f(piece, file);
  };
  for_each_of_other(format, path, visit, elements);
  return of_tetrahedra;
}

io::loaded_mesh read_any_mesh(const std::filesystem::path& path, io::element_order elements, bool fields) {
  const other_format format = format_of(path);
  if (format == other_format::none)
    return io::read_mesh(path, io::zlib_expand, fields, elements);
  return io::detail::joined_pieces(
      path, [&](const io::piece_visitor& f) { for_each_of_other(format, path, f, elements); });
}

} // namespace dovetail::app
