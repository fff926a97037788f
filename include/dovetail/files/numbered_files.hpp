/// @file
/// Files of runs of pieces: which pieces each takes, and how they are called.
#pragma once

#include "dovetail/core/ids.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace dovetail::io {

/// Shares `pieces` out to `files` files, as evenly as whole ones can be: file f takes the pieces
/// bounds[f] .. bounds[f + 1] - 1. 0 files: one per piece; never more than pieces.
std::vector<local_id> bounds_of_files(int files, local_id pieces);

/// "<stem>_<number><extension>" with as many digits as the largest number needs, at least four.
std::vector<std::string> numbered_names(const std::string& stem, std::size_t count,
                                        const std::string& extension);

/// Removes files that an earlier mesh of more files left in the folder, so that they are not mistaken for
/// part of this one.
void remove_stale_files(const std::filesystem::path& folder, const std::string& stem,
                        const std::string& extension, const std::vector<std::string>& names);

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/files/numbered_files.ipp"
#endif
