/// @file
/// What `spool.hpp` declares.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/hash.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/core/version.hpp"
#include "dovetail/parallel/spool.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <ios>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE spool spool::start(const std::filesystem::path& folder, const run_identity& identity) {
  make_folder(folder);
  remove_blobs(folder);
  const std::string manifest = manifest_text(identity);
  output_file file(folder / manifest_name);
  file.text(manifest);
  file.commit();
  return {folder, manifest};
}

DOVETAIL_INLINE bool spool::is_started(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(folder / manifest_name, ignored);
}

DOVETAIL_INLINE spool spool::resume(const std::filesystem::path& folder, const run_identity& identity) {
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

DOVETAIL_INLINE std::filesystem::path spool::path_of(std::string_view name) const {
  return folder_ / (std::string(name) + blob_suffix);
}

DOVETAIL_INLINE void spool::write(std::string_view name, const byte_buffer& blob) const {
  output_file file(path_of(name), output_file::lasting::in_cache); // its checksum tells
  file.value(header{magic, blob.size(), checksum(name, blob)});
  file.bytes(blob.data(), blob.size());
  file.commit();
}

DOVETAIL_INLINE std::optional<byte_buffer> spool::read(std::string_view name) const {
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

DOVETAIL_INLINE bool spool::has(std::string_view name) const {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path_of(name), ignored);
}

DOVETAIL_INLINE std::vector<std::string> spool::names() const {
  std::vector<std::string> found;
  for (const auto& path : entries_of(folder_))
    if (path.extension() == blob_suffix)
      found.push_back(path.stem().string());
  return found;
}

DOVETAIL_INLINE void spool::remove(std::string_view name) const {
  std::error_code ignored;
  std::filesystem::remove(path_of(name), ignored);
}

DOVETAIL_INLINE void spool::clear() const {
  std::error_code ignored;
  remove_blobs(folder_);
  std::filesystem::remove(folder_ / manifest_name, ignored);
  std::filesystem::remove(folder_, ignored); // fails, as it should, when the folder is not empty
}

DOVETAIL_INLINE spool::spool(std::filesystem::path folder, const std::string& manifest)
    : folder_(std::move(folder)) {
  content_hash hash;
  hash.text(manifest);
  identity_ = hash.value();
}

DOVETAIL_INLINE void spool::remove_blobs(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const auto& path : entries_of(folder)) {
    const std::string name = path.filename().string();
    if (name.ends_with(blob_suffix) || name.ends_with(std::string(blob_suffix) + ".part"))
      std::filesystem::remove(path, ignored);
  }
}

DOVETAIL_INLINE std::uint64_t spool::checksum(std::string_view name, const byte_buffer& blob) const {
  content_hash hash;
  hash.word(identity_);
  hash.text(name);
  hash.bytes(span_of(blob));
  return hash.value();
}

DOVETAIL_INLINE std::string spool::manifest_text(const run_identity& identity) {
  std::string text = "dovetail " + std::string(version) + "\n";
  for (const auto& [what, value] : identity)
    text += what + " " + value + "\n";
  return text;
}

DOVETAIL_INLINE std::optional<byte_buffer> spool::read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file)
    return std::nullopt;
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return byte_buffer(first, first + text.size());
}

DOVETAIL_INLINE std::string spool::difference(const std::string& earlier, const std::string& present) {
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

} // namespace dovetail
