/// @file
/// Files that appear under their final name only when they are complete.
#pragma once

#include "dovetail/core/error.hpp"

#include <bit>
#include <cerrno>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace dovetail {

static_assert(std::endian::native == std::endian::little,
              "binary files are written as on little-endian machines");

/// Waits until a folder's names are on the disk. What cannot be synchronised is left as it is.
void sync_to_disk(const std::filesystem::path& folder);

/// A buffered, sequential output file. It is written as `<path>.part` and gets its final name in `commit`;
/// without a commit the destructor removes it. A name is given to what is on the disk only, so that a power
/// failure leaves no half file either, unless `in_cache` says that the file can be made again. Every failure
/// throws `io_error` naming the path. (A process that wants an `io_error` at a file size limit must ignore
/// SIGXFSZ, as for any program.) What is no plain file (`/dev/null`, `/dev/stdout`, a pipe) is written to as
/// it is, since a rename would put a file in its place; a symbolic link stays, and the file it names is
/// replaced.
class output_file {
public:
  /// What is promised of a finished file: it survives a power failure (`on_disk`), or may be lost in one
  /// (`in_cache`).
  enum class lasting { on_disk, in_cache };

  explicit output_file(std::filesystem::path path, lasting how = lasting::on_disk);
  output_file(const output_file&) = delete;
  output_file& operator=(const output_file&) = delete;
  ~output_file();

  /// Writes bytes as they are.
  void bytes(const void* data, std::size_t size);
  /// The bytes of one plain value, in the order of this machine.
  template <class T>
    requires std::is_trivially_copyable_v<T>
  void value(const T& item) { bytes(&item, sizeof(T)); }
  /// Writes the items as they are in memory.
  template <class T>
    requires std::is_trivially_copyable_v<T>
  void array(std::span<const T> items) { bytes(items.data(), items.size_bytes()); }

  void text(std::string_view s) { bytes(s.data(), s.size()); } ///< writes the characters
  /// The shortest decimal form that reads back to the same number.
  template <class Number>
    requires std::integral<Number> || std::floating_point<Number>
  void number(Number value) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    bytes(digits, static_cast<std::size_t>(end - digits));
  }

  /// Goes on writing at an offset from the beginning: for arrays of known size whose values come in turns.
  void seek(std::uint64_t offset);

  /// Appends a range of another file; the system copies it.
  void copy(const std::filesystem::path& from, std::uint64_t first, std::uint64_t bytes);

  /// Bytes written so far.
  std::uint64_t size() const { return size_; }
  const std::filesystem::path& path() const { return path_; } ///< the final name of the file

  /// Writes what is buffered and closes the file, which keeps its temporary name.
  void close();
  /// Closes the file and gives it its final name, replacing an older file at once.
  void commit();

private:
  static constexpr std::size_t capacity = 1 << 18;

  static bool is_special(const std::filesystem::path& path);
  static std::string behind_links(const std::filesystem::path& path);

  void flush() { write_out(buffer_.get(), std::exchange(used_, 0)); }
  void write_out(const char* data, std::size_t size);
  [[noreturn]] void fail(const char* what) const {
    const int reason = errno;
    throw io_error(std::string(what) + " " + path_.string() + ": " + std::strerror(reason));
  }

  std::filesystem::path path_;
  std::string target_; ///< what a link names; the path itself otherwise
  bool in_place_;      ///< no plain file: neither renamed nor removed
  bool on_disk_;       ///< is synchronised before it is renamed
  std::string part_;
  int descriptor_ = -1;
  std::unique_ptr<char[]> buffer_;
  std::size_t used_ = 0;
  std::uint64_t size_ = 0;
  bool committed_ = false;
};

/// Several files that belong together: all are finished under temporary names before the first gets its
/// final one, so a failure leaves the earlier set of files as it was.
class output_batch {
public:
  /// Opens the next file; the one before it is closed. The reference stays valid.
  output_file& open(std::filesystem::path path);
  /// Gives all files their final names, in the order they were opened.
  void commit();
  std::size_t files() const { return files_.size(); } ///< how many files it has, and how many bytes (`size`)
  std::uint64_t size() const;

private:
  std::list<output_file> files_;
};

/// What is directly in a folder; nothing when it cannot be read.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder);

/// Of what is no folder, or is not empty, nothing happens.
void remove_empty_folder(const std::filesystem::path& folder);

/// Creates the folder and its parents where they are missing; throws `io_error` naming it.
void make_folder(const std::filesystem::path& folder);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/core/output_file.ipp"
#endif
