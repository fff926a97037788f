/// @file
/// Files that appear under their final name only when they are complete.
#pragma once

#include "dovetail/core/error.hpp"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <sys/sendfile.h>
#include <type_traits>
#include <unistd.h>
#include <utility>
#include <vector>

namespace dovetail {

static_assert(std::endian::native == std::endian::little,
              "binary files are written as on little-endian machines");

/// Waits until a folder's names are on the disk. What cannot be synchronised is left as it is.
inline void sync_to_disk(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0)
    return;
  ::fsync(descriptor);
  ::close(descriptor);
}

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

  explicit output_file(std::filesystem::path path, lasting how = lasting::on_disk)
      : path_(std::move(path)), target_(behind_links(path_)), in_place_(is_special(path_)),
        on_disk_(how == lasting::on_disk && !in_place_),
        part_(in_place_ ? path_.string() : target_ + ".part") {
    descriptor_ = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor_ < 0)
      fail("cannot create");
    buffer_ = std::make_unique<char[]>(capacity);
  }
  output_file(const output_file&) = delete;
  output_file& operator=(const output_file&) = delete;
  ~output_file() {
    if (descriptor_ >= 0)
      ::close(descriptor_);
    if (!committed_ && !in_place_)
      ::unlink(part_.c_str());
  }

  /// Writes bytes as they are.
  void bytes(const void* data, std::size_t size) {
    size_ += size;
    if (size > capacity - used_) {
      flush();
      if (size >= capacity)
        return write_out(static_cast<const char*>(data), size);
    }
    if (size > 0)
      std::memcpy(buffer_.get() + used_, data, size);
    used_ += size;
  }
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
  void seek(std::uint64_t offset) {
    flush();
    if (::lseek(descriptor_, static_cast<off_t>(offset), SEEK_SET) < 0)
      fail("cannot move in");
  }

  /// Appends a range of another file; the system copies it.
  void copy(const std::filesystem::path& from, std::uint64_t first, std::uint64_t bytes) {
    flush();
    errno = 0;
    const int source = ::open(from.c_str(), O_RDONLY | O_CLOEXEC);
    auto at = static_cast<off_t>(first);
    auto left = static_cast<std::size_t>(bytes);
    while (source >= 0 && left > 0) {
      const auto copied = ::sendfile(descriptor_, source, &at, left);
      if (copied > 0)
        left -= static_cast<std::size_t>(copied);
      else if (copied == 0 || errno != EINTR)
        break;
    }
    const int reason = errno;
    if (source >= 0)
      ::close(source);
    if (source < 0 || left > 0)
      throw io_error("cannot copy " + from.string() + " to " + path_.string() + ": " +
                     (reason != 0 ? std::strerror(reason) : "it is too short"));
    size_ += bytes;
  }

  /// Bytes written so far.
  std::uint64_t size() const { return size_; }
  const std::filesystem::path& path() const { return path_; } ///< the final name of the file

  /// Writes what is buffered and closes the file, which keeps its temporary name.
  void close() {
    if (descriptor_ < 0)
      return;
    flush();
    if (on_disk_ && ::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS)
      fail("cannot write");
    if (::close(std::exchange(descriptor_, -1)) != 0)
      fail("cannot write");
    buffer_.reset();
  }
  /// Closes the file and gives it its final name, replacing an older file at once.
  void commit() {
    close();
    if (!in_place_ && ::rename(part_.c_str(), target_.c_str()) != 0)
      fail("cannot rename the finished file to");
    committed_ = true;
    if (on_disk_)
      sync_to_disk(std::filesystem::path(target_).parent_path());
  }

private:
  static constexpr std::size_t capacity = 1 << 18;

  static bool is_special(const std::filesystem::path& path) {
    std::error_code ignored;
    const auto found = std::filesystem::status(path, ignored);
    return std::filesystem::exists(found) && !std::filesystem::is_regular_file(found) &&
           !std::filesystem::is_directory(found);
  }
  static std::string behind_links(const std::filesystem::path& path) {
    std::error_code none;
    if (!std::filesystem::is_symlink(path, none))
      return path.string();
    const auto target = std::filesystem::canonical(path, none);
    return none ? path.string() : target.string();
  }

  void flush() { write_out(buffer_.get(), std::exchange(used_, 0)); }
  void write_out(const char* data, std::size_t size) {
    while (size > 0) {
      const auto written = ::write(descriptor_, data, size);
      if (written < 0 && errno == EINTR)
        continue;
      if (written <= 0)
        fail("cannot write");
      data += written;
      size -= static_cast<std::size_t>(written);
    }
  }
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
  output_file& open(std::filesystem::path path) {
    if (!files_.empty())
      files_.back().close();
    return files_.emplace_back(std::move(path));
  }
  /// Gives all files their final names, in the order they were opened.
  void commit() {
    if (!files_.empty())
      files_.back().close();
    for (auto& file : files_)
      file.commit();
  }
  std::size_t files() const { return files_.size(); } ///< how many files it has, and how many bytes (`size`)
  std::uint64_t size() const {
    std::uint64_t sum = 0;
    for (const auto& file : files_)
      sum += file.size();
    return sum;
  }

private:
  std::list<output_file> files_;
};

/// What is directly in a folder; nothing when it cannot be read.
inline std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> entries;
  std::error_code failure;
  for (std::filesystem::directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure))
    entries.push_back(entry->path());
  return entries;
}

/// Of what is no folder, or is not empty, nothing happens.
inline void remove_empty_folder(const std::filesystem::path& folder) {
  ::rmdir(folder.c_str());
}

/// Creates the folder and its parents where they are missing; throws `io_error` naming it.
inline void make_folder(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure || !std::filesystem::is_directory(folder, failure))
    throw io_error("cannot create the folder " + folder.string() + ": " +
                   (failure ? failure.message() : std::string("a file with that name is in the way")));
}

} // namespace dovetail
