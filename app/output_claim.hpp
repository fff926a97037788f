/// @file
/// What a run writes to is there, can be written, and is this run's alone until it ends.
#pragma once

#include "output.hpp"

#include "dovetail/parallel/owned_descriptor.hpp"

#include <filesystem>
#include <list>
#include <vector>

namespace dovetail::app {

/// Makes the folders that a command writes to, finds out whether its files can be written there, and locks
/// all of these: the folders themselves, and the files by their temporary names. The locks are of the system
/// (flock) and end with the process and those that it forks, however they end. Files that are not written in
/// the end and folders that stay empty are removed by the destructor.
class output_claim {
public:
  /// Of several ranks one `leads`; others only claim spools of their own. Throws `io_error` for what cannot
  /// be written, or is being written by another process, which the message names.
  output_claim(const command_outputs& outputs, bool leads);
  output_claim(const output_claim&) = delete;
  output_claim& operator=(const output_claim&) = delete;
  ~output_claim();

private:
  struct held_file {
    std::filesystem::path part;
    detail::owned_descriptor lock;
  };

  void take_folder(const char* option, const std::filesystem::path& folder);
  void take_file(const named_file& output);
  void release();

  std::list<output_folder> folders_;
  std::vector<detail::owned_descriptor> locks_; ///< of folders
  std::vector<held_file> files_;
};

} // namespace dovetail::app
