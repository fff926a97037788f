/// @file
/// The file formats of meshes, by name.
#pragma once

#include "options.hpp"

#include "dovetail/distributed/any_redistributor.hpp"
#include "dovetail/files/piecewise_output.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace dovetail::app {

/// A writer of one file format.
template <int D>
struct output_format {
  std::string name;
  double bytes_per_element; ///< about, with its share of nodes
  io::any_piecewise_writer<D> writer;
  bool by_ranks = false;    ///< has files of its own for each rank of a solver
  bool second_order = true; ///< whether it has elements of second order
  bool ghosts = false;      ///< whether it has elements of other ranks
  int meshes_in_spool = 0;  ///< while it is written; 0: these go as the files grow
};

/// To be called once, before any file is written.
void prepare_formats();

/// What `--format` may name, of that dimension; the first is the default. Either for files that say nothing
/// of ranks, or for files by ranks.
std::vector<std::string> format_names(int dimension, bool by_ranks);
/// What `--redistribute` may name; the first is the default.
std::vector<std::string> redistributor_names();
/// The one of these that makes other pieces, one or more for each rank.
inline constexpr const char* by_elements = "by-elements";

/// By which strategy what ranks have is improved: by default what was at the interfaces of pieces, and is
/// inside now, where pieces were improved.
std::string improvement_of_ranks(const mesh_options& options, int dimension);

/// The formats that were chosen; the default one when none was; none for "none". Throws `command_line_error`
/// for an unknown name, for a negative number of files, and for ranks that do not fit the formats or the
/// subdomains.
template <int D>
std::vector<output_format<D>> make_formats(const mesh_options& options);
/// The same, whatever redistributor the options name.
template <int D>
std::vector<output_format<D>> make_formats(const mesh_options& options,
                                           const any_redistributor<D>& redistribute);

/// What a run may write in its folder, as `matches` has names; what formats that are not known would write is
/// not among it.
std::vector<std::string> names_in_folder(const mesh_options& options);

/// Disk that a mesh takes per element, about, with its spool and in all the formats.
template <int D>
double bytes_per_element(const std::vector<output_format<D>>& formats);

/// The number of elements that there is room for on the disk of the folder, and on that of a spool which is
/// not in it; empty: it is.
template <int D>
double elements_with_room(const std::vector<output_format<D>>& formats, const std::filesystem::path& folder,
                          const std::filesystem::path& own_spool);

} // namespace dovetail::app
