/// @file
/// Where a name leads, however it is spelled: to tell whether two names are of one file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <sys/types.h>

namespace dovetail::app {

/// What a name leads to: the file or folder that is there, or the nearest folder around it that is, by their
/// numbers on the disk, and the rest of the name. Links of both kinds and `..` make no difference.
struct file_place {
  dev_t device = 0;
  ino_t number = 0;
  std::filesystem::path rest = {}; ///< below what is there; empty: it is there itself

  bool operator==(const file_place& other) const {
    return device == other.device && number == other.number && rest == other.rest;
  }
};

/// Nothing for what is no place of data: a terminal, `/dev/null`, a socket.
std::optional<file_place> place_of(const std::filesystem::path& name);

/// How a file is called below a folder, "." if it is the folder itself; nothing where it is not in it.
std::optional<std::string> name_below(const std::filesystem::path& file, const std::filesystem::path& folder);

/// The temporary name of a file while it is written, which is beside what a link names; nothing where it is
/// written to as it is (`/dev/stdout`, a pipe). As `output_file` has it.
std::optional<std::filesystem::path> temporary_name(const std::filesystem::path& file);

/// Whether a name is of a pattern, in which # stands for one or more digits and * for any text.
bool matches(const char* pattern, const char* name);

} // namespace dovetail::app
