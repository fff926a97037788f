/// @file
/// The file formats of meshes, by name.
#pragma once

#include "dovetail/io/piecewise_output.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace dovetail::app {

/// A writer of one file format.
template <int D>
struct output_format {
  std::string name;
  double bytes_per_element; ///< about, with its share of points
  io::any_piecewise_writer<D> writer;
};

/// What `--format` may name, of that dimension; the first is the default.
std::vector<std::string> format_names(int dimension);

/// The formats of the names; the default one when there are none; none for "none". Throws
/// `command_line_error` for an unknown name and for a negative number of files.
template <int D>
std::vector<output_format<D>> make_formats(const std::vector<std::string>& names, int files);

/// Disk that a mesh takes per element, about, with its spool and in all the formats.
template <int D>
double bytes_per_element(const std::vector<output_format<D>>& formats);

/// The number of elements that there is room for on the disk of the folder.
template <int D>
double elements_with_room(const std::vector<output_format<D>>& formats, const std::filesystem::path& folder);

} // namespace dovetail::app
