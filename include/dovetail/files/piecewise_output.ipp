/// @file
/// What `piecewise_output.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/files/piecewise_output.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>

namespace dovetail::io {

DOVETAIL_INLINE unfinished_folder::~unfinished_folder() {
  std::error_code ignored;
  if (kept_ || !own_)
    return;
  if (was_there_)
    remove(path_.parent_path());
  else
    std::filesystem::remove_all(path_, ignored);
}

DOVETAIL_INLINE void unfinished_folder::remove(const std::filesystem::path& folder) {
  for (const auto& of_format : entries_of(folder / "unfinished")) {
    const std::string name = of_format.filename().string();
    std::error_code ignored;
    if (name.find_first_not_of("0123456789") != std::string::npos ||
        !std::filesystem::is_directory(std::filesystem::symlink_status(of_format, ignored)))
      continue;
    for (const auto& file : entries_of(of_format))
      if (const auto ending = file.extension();
          ending == ".part" || ending == ".vtu" || ending == ".vtp" || ending == ".pvtu" ||
          ending == ".msh_piece" || ending == ".vtkhdf" || ending == ".xdmf" || ending == ".rank_file")
        std::filesystem::remove(file, ignored);
    remove_empty_folder(of_format);
  }
  remove_empty_folder(folder / "unfinished");
}

DOVETAIL_INLINE std::uint64_t move_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code failure;
  const auto bytes = std::filesystem::file_size(from, failure);
  if (!failure)
    std::filesystem::rename(from, to, failure);
  if (failure)
    throw io_error("cannot rename the finished file to " + to.string() + ": " + failure.message());
  return bytes;
}

} // namespace dovetail::io
