/// @file
/// A folder of finished results, so that a run killed at any time can be resumed and memory stays bounded.
#pragma once

#include "dovetail/core/bytes.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dovetail {

/// What a run was started with: everything its result depends on, as (what, value) lines. A hash, a file name
/// or a number will do for a value; neither holds a line break, nor a name a space. The library's version is
/// added by the spool.
using run_identity = std::vector<std::pair<std::string, std::string>>;

/// Named blobs in a folder, each complete under its name or not there at all. A blob carries its name, the
/// identity of its run and a checksum; one that is truncated, altered or of another run counts as absent.
/// Copyable and cheap; several processes may write different names at once.
class spool {
public:
  /// Starts a spool: makes the folder, removes what an earlier run left in it, writes the manifest. Throws
  /// `io_error` when the folder cannot be written.
  static spool start(const std::filesystem::path& folder, const run_identity& identity);

  /// Whether there is a spool in a folder, of whatever run.
  static bool is_started(const std::filesystem::path& folder);

  /// Opens the spool of an earlier run of the same identity. Throws `usage_error` naming what differs, or
  /// that there is nothing to resume.
  static spool resume(const std::filesystem::path& folder, const run_identity& identity);

  /// The same, of a rank whose disk the others may not see: what it misses they give it
  /// (`spool_exchange.hpp`).
  spool of_one_rank() const {
    spool own = *this;
    own.is_common_ = false;
    return own;
  }
  /// Whether all ranks of a run have this spool.
  bool is_common() const { return is_common_; }

  const std::filesystem::path& folder() const { return folder_; } ///< where the blobs are
  /// The file of a blob, there or not.
  std::filesystem::path path_of(std::string_view name) const;

  /// Stores a blob, replacing an earlier one at once. Throws `io_error`, for example when the disk is full,
  /// and then leaves nothing under the name.
  void write(std::string_view name, const byte_buffer& blob) const;

  /// The blob, if it is there and whole.
  std::optional<byte_buffer> read(std::string_view name) const;

  /// Whether there is a blob of this name, whole or damaged.
  bool has(std::string_view name) const;
  /// Of all blobs, in no order.
  std::vector<std::string> names() const;

  /// Forgets a blob.
  void remove(std::string_view name) const;

  /// Removes the spool's files, and the folder when nothing else is in it.
  void clear() const;

private:
  struct header {
    std::uint64_t magic_number;
    std::uint64_t size;
    std::uint64_t check;
  };
  static constexpr std::uint64_t magic = 0x31304c4f4f505344; // "DSPOOL01"
  static constexpr const char* manifest_name = "manifest.txt";
  static constexpr const char* blob_suffix = ".blob";

  spool(std::filesystem::path folder, const std::string& manifest);

  /// Blobs, whole ones and those of writers that were killed; other files are not ours.
  static void remove_blobs(const std::filesystem::path& folder);

  std::uint64_t checksum(std::string_view name, const byte_buffer& blob) const;

  static std::string manifest_text(const run_identity& identity);

  static std::optional<byte_buffer> read_file(const std::filesystem::path& path);

  /// The first line in which two manifests differ, in words.
  static std::string difference(const std::string& earlier, const std::string& present);

  std::filesystem::path folder_;
  std::uint64_t identity_;
  bool is_common_ = true;
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/parallel/spool.ipp"
#endif
