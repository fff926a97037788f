/// @file
/// Where a command writes: its folder, checked before any work is done, and what is left of it when it is
/// ended.
#pragma once

#include "command_files.hpp"
#include "options.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace dovetail::app {

/// Makes the folder, and tries to create a file in it. Folders that it made are removed again by the
/// destructor when they are still empty. Throws `io_error` naming the folder.
class output_folder {
public:
  explicit output_folder(std::filesystem::path path);
  output_folder(const output_folder&) = delete;
  output_folder& operator=(const output_folder&) = delete;
  ~output_folder() { remove_if_empty(); }

  const std::filesystem::path& path() const { return path_; }
  /// It stays, empty or not: it is somebody else's too.
  void keep() { made_.clear(); }

private:
  void remove_if_empty();

  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_; ///< innermost first
};

/// What a command writes to.
struct command_outputs {
  std::vector<named_file> files = {};            ///< besides those in the folder; empty names are none
  std::filesystem::path folder = {};             ///< of `--out`, where that is a folder; empty: there is none
  std::vector<std::string> names_in_folder = {}; ///< of what it writes there, as `matches` has them
  std::filesystem::path spool = {}; ///< of what it keeps for another run to go on from; empty: nothing
  bool has_own_spool = false;       ///< which is that of this rank, and not of all
};

/// What a command that is stopped or ended may leave of the files and folders that it writes to. Made before
/// the command starts.
class unfinished_output {
public:
  explicit unfinished_output(command_outputs outputs);
  /// Removes parts of files that the program itself writes, a spool in which nothing is kept, and empty
  /// folders that were not there. Returns whether another run can go on from what is left. Does not throw for
  /// what it finds on the disk.
  bool remove() const;
  /// On each of several ranks: the same of its own spool.
  void remove_of_rank() const;

private:
  command_outputs outputs_;
  std::vector<std::filesystem::path> absent_; ///< innermost first
};

/// What a run of `mesh` that did not come to its end keeps in its folder.
struct kept_work {
  bool pieces = false;   ///< meshed subdomains, in the spool or as complete files
  bool anything = false; ///< these, or what was made before the first of them
};
kept_work work_kept_in(const std::filesystem::path& folder, const std::filesystem::path& spooled);

/// The spool of a run, in the folder of its mesh or, of each rank its own, where the options say.
std::filesystem::path spool_folder(const mesh_options& options);

/// What an earlier run has left in the spools of ranks that wait for this one now, which has all they had.
void remove_spools_of_waiting(const mesh_options& options);

/// Throws `io_error` when a file cannot be created under this name. Leaves nothing.
void check_can_create(const std::filesystem::path& file);

} // namespace dovetail::app
