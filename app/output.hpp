/// @file
/// Where a mesh goes: the folder, checked before any work is done, and the formats by name.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/io/piecewise_output.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace dovetail::app {

/// A writer of one file format.
template <int D>
struct output_format {
  std::string name;
  double bytes_per_element; ///< about, with its share of points
  /// Of a format in files of whole pieces.
  io::any_piecewise_writer<D> files = {};
  /// Of a format in one file. With `release`, pieces are given up when they are read for the last time.
  std::function<report(const distributed_simplicial_mesh<D>&, const std::filesystem::path& folder,
                       bool release)>
      write = {};
};

/// The formats of the names; the default one when there are none; none for "none". Throws
/// `command_line_error` for an unknown name and for a negative number of pieces.
template <int D>
std::vector<output_format<D>> make_formats(const std::vector<std::string>& names, int pieces);

/// Makes the folder, and tries to create a file in it. Folders that it made are removed again by the
/// destructor when they are still empty. Throws `io_error` naming the folder.
class output_folder {
public:
  explicit output_folder(std::filesystem::path path);
  output_folder(const output_folder&) = delete;
  output_folder& operator=(const output_folder&) = delete;
  ~output_folder() { remove_if_empty(); }

  const std::filesystem::path& path() const { return path_; }

private:
  void remove_if_empty();

  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_; ///< innermost first
};

/// What a command writes to.
struct command_outputs {
  std::vector<std::filesystem::path> files = {}; ///< outside the folder; empty names are none
  std::filesystem::path folder = {};
  bool resumable = false; ///< what it keeps in the folder is there for another run to go on from
};

/// What a command that is ended at once may leave of the files and folders that it writes to. Made before the
/// command starts.
class unfinished_output {
public:
  explicit unfinished_output(command_outputs outputs);
  /// Removes parts of files that the program itself writes, a spool in which nothing is kept, and empty
  /// folders that were not there. Returns whether another run can go on from what is left. Does not throw for
  /// what it finds on the disk.
  bool remove() const;

private:
  command_outputs outputs_;
  std::vector<std::filesystem::path> absent_; ///< innermost first
};

/// What a run of `mesh` that did not come to its end keeps in its folder.
struct kept_work {
  bool pieces = false;   ///< meshed subdomains, in the spool or as complete files
  bool anything = false; ///< these, or what was made before the first of them
};
kept_work work_kept_in(const std::filesystem::path& folder);

/// Throws `io_error` when a file cannot be created under this name. Leaves nothing.
void check_can_create(const std::filesystem::path& file);

/// Disk that a mesh takes per element, about, with its spool and in all the formats.
template <int D>
double bytes_per_element(const std::vector<output_format<D>>& formats);

/// The number of elements that there is room for on the disk of the folder.
template <int D>
double elements_with_room(const std::vector<output_format<D>>& formats, const std::filesystem::path& folder);

} // namespace dovetail::app
