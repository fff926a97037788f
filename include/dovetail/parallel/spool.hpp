/// @file
/// A folder of finished results, so that a run killed at any time can be resumed and memory stays bounded.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/hash.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/core/version.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
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
  static spool start(const std::filesystem::path& folder, const run_identity& identity) {
    make_folder(folder);
    remove_blobs(folder);
    const std::string manifest = manifest_text(identity);
    output_file file(folder / manifest_name);
    file.text(manifest);
    file.commit();
    return {folder, manifest};
  }

  /// Whether there is a spool in a folder, of whatever run.
  static bool is_started(const std::filesystem::path& folder) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(folder / manifest_name, ignored);
  }

  /// Opens the spool of an earlier run of the same identity. Throws `usage_error` naming what differs, or
  /// that there is nothing to resume.
  static spool resume(const std::filesystem::path& folder, const run_identity& identity) {
    const auto found = read_file(folder / manifest_name);
    if (!found)
      throw usage_error("there is no run to resume in " + folder.string() + "; start it without resume");
    const std::string present = manifest_text(identity);
    const std::string earlier(reinterpret_cast<const char*>(found->data()), found->size());
    if (!earlier.starts_with("dovetail ") || !earlier.ends_with('\n') ||
        std::any_of(earlier.begin(), earlier.end(), [](unsigned char c) { return c < ' ' && c != '\n'; }))
      throw usage_error("the run in " + folder.string() +
                        " cannot be resumed: its manifest.txt is damaged; start it without resume");
    if (earlier != present)
      throw usage_error("the run in " + folder.string() +
                        " cannot be resumed: " + difference(earlier, present) + "; start it without resume");
    return {folder, present};
  }

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
  std::filesystem::path path_of(std::string_view name) const {
    return folder_ / (std::string(name) + blob_suffix);
  }

  /// Stores a blob, replacing an earlier one at once. Throws `io_error`, for example when the disk is full,
  /// and then leaves nothing under the name.
  void write(std::string_view name, const byte_buffer& blob) const {
    output_file file(path_of(name), output_file::lasting::in_cache); // its checksum tells
    file.value(header{magic, blob.size(), checksum(name, blob)});
    file.bytes(blob.data(), blob.size());
    file.commit();
  }

  /// The blob, if it is there and whole.
  std::optional<byte_buffer> read(std::string_view name) const {
    std::ifstream file(path_of(name), std::ios::binary);
    header head{};
    if (!file.read(reinterpret_cast<char*>(&head), sizeof(head)) || head.magic_number != magic)
      return std::nullopt;
    std::error_code failed;
    const auto size = std::filesystem::file_size(path_of(name), failed);
    if (failed || size != sizeof(head) + head.size)
      return std::nullopt;
    byte_buffer blob(static_cast<std::size_t>(head.size));
    if (!file.read(reinterpret_cast<char*>(blob.data()), static_cast<std::streamsize>(blob.size())) ||
        checksum(name, blob) != head.check)
      return std::nullopt;
    return blob;
  }

  /// Whether there is a blob of this name, whole or damaged.
  bool has(std::string_view name) const {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path_of(name), ignored);
  }
  /// Of all blobs, in no order.
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& path : entries_of(folder_))
      if (path.extension() == blob_suffix)
        found.push_back(path.stem().string());
    return found;
  }

  /// Forgets a blob.
  void remove(std::string_view name) const {
    std::error_code ignored;
    std::filesystem::remove(path_of(name), ignored);
  }

  /// Removes the spool's files, and the folder when nothing else is in it.
  void clear() const {
    std::error_code ignored;
    remove_blobs(folder_);
    std::filesystem::remove(folder_ / manifest_name, ignored);
    std::filesystem::remove(folder_, ignored); // fails, as it should, when the folder is not empty
  }

private:
  struct header {
    std::uint64_t magic_number;
    std::uint64_t size;
    std::uint64_t check;
  };
  static constexpr std::uint64_t magic = 0x31304c4f4f505344; // "DSPOOL01"
  static constexpr const char* manifest_name = "manifest.txt";
  static constexpr const char* blob_suffix = ".blob";

  spool(std::filesystem::path folder, const std::string& manifest) : folder_(std::move(folder)) {
    content_hash hash;
    hash.text(manifest);
    identity_ = hash.value();
  }

  /// Blobs, whole ones and those of writers that were killed; other files are not ours.
  static void remove_blobs(const std::filesystem::path& folder) {
    std::error_code ignored;
    for (const auto& path : entries_of(folder)) {
      const std::string name = path.filename().string();
      if (name.ends_with(blob_suffix) || name.ends_with(std::string(blob_suffix) + ".part"))
        std::filesystem::remove(path, ignored);
    }
  }

  std::uint64_t checksum(std::string_view name, const byte_buffer& blob) const {
    content_hash hash;
    hash.word(identity_);
    hash.text(name);
    hash.bytes(span_of(blob));
    return hash.value();
  }

  static std::string manifest_text(const run_identity& identity) {
    std::string text = "dovetail " + std::string(version) + "\n";
    for (const auto& [what, value] : identity)
      text += what + " " + value + "\n";
    return text;
  }

  static std::optional<byte_buffer> read_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file)
      return std::nullopt;
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    return byte_buffer(first, first + text.size());
  }

  /// The first line in which two manifests differ, in words.
  static std::string difference(const std::string& earlier, const std::string& present) {
    const auto split = [](const std::string& text) {
      std::vector<std::string> lines;
      for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        lines.push_back(text.substr(begin, end - begin));
        begin = end + 1;
      }
      return lines;
    };
    const auto before = split(earlier);
    const auto now = split(present);
    for (std::size_t k = 0; k < std::max(before.size(), now.size()); ++k) {
      const std::string a = k < before.size() ? before[k] : "nothing";
      const std::string b = k < now.size() ? now[k] : "nothing";
      if (a != b)
        return "it was started with '" + a + "', not '" + b + "'";
    }
    return "its manifest differs";
  }

  std::filesystem::path folder_;
  std::uint64_t identity_;
  bool is_common_ = true;
};

} // namespace dovetail
