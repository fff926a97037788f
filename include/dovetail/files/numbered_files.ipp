/// @file
/// What `numbered_files.hpp` declares.
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/files/numbered_files.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace dovetail::io {

DOVETAIL_INLINE std::vector<local_id> bounds_of_files(int files, local_id pieces) {
  const auto count = files <= 0 ? pieces : std::min<local_id>(files, pieces);
  std::vector<local_id> bounds;
  for (local_id f = 0; f <= count; ++f)
    bounds.push_back(
        static_cast<local_id>(static_cast<global_id>(f) * pieces / std::max<local_id>(count, 1)));
  return bounds;
}

DOVETAIL_INLINE std::vector<std::string> numbered_names(const std::string& stem, std::size_t count,
                                                        const std::string& extension) {
  const auto width = std::max<std::size_t>(4, std::to_string(std::max<std::size_t>(count, 1) - 1).size());
  std::vector<std::string> names;
  for (std::size_t f = 0; f < count; ++f) {
    const auto digits = std::to_string(f);
    names.push_back(stem + "_" + std::string(width - digits.size(), '0') + digits + extension);
  }
  return names;
}

DOVETAIL_INLINE void remove_stale_files(const std::filesystem::path& folder, const std::string& stem,
                                        const std::string& extension, const std::vector<std::string>& names) {
  std::error_code ignored;
  const std::size_t around = stem.size() + 1 + extension.size();
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const auto name = entry.path().filename().string();
    const auto digits = name.size() > around && name.starts_with(stem + "_") && name.ends_with(extension)
                            ? name.substr(stem.size() + 1, name.size() - around)
                            : std::string();
    if (!digits.empty() && digits.find_first_not_of("0123456789") == std::string::npos &&
        !std::binary_search(names.begin(), names.end(), name))
      std::filesystem::remove(entry.path(), ignored);
  }
}

} // namespace dovetail::io
