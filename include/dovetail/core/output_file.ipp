/// @file
/// What `output_file.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/output_file.hpp"

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <memory>
#include <string>
#include <sys/sendfile.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE void sync_to_disk(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0)
    return;
  ::fsync(descriptor);
  ::close(descriptor);
}

DOVETAIL_INLINE output_file::output_file(std::filesystem::path path, lasting how)
    : path_(std::move(path)), target_(behind_links(path_)), in_place_(is_special(path_)),
      on_disk_(how == lasting::on_disk && !in_place_), part_(in_place_ ? path_.string() : target_ + ".part") {
  descriptor_ = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0)
    fail("cannot create");
  buffer_ = std::make_unique<char[]>(capacity);
}

DOVETAIL_INLINE output_file::~output_file() {
  if (descriptor_ >= 0)
    ::close(descriptor_);
  if (!committed_ && !in_place_)
    ::unlink(part_.c_str());
}

DOVETAIL_INLINE void output_file::bytes(const void* data, std::size_t size) {
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

DOVETAIL_INLINE void output_file::seek(std::uint64_t offset) {
  flush();
  if (::lseek(descriptor_, static_cast<off_t>(offset), SEEK_SET) < 0)
    fail("cannot move in");
}

DOVETAIL_INLINE void output_file::copy(const std::filesystem::path& from, std::uint64_t first,
                                       std::uint64_t bytes) {
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

DOVETAIL_INLINE void output_file::close() {
  if (descriptor_ < 0)
    return;
  flush();
  if (on_disk_ && ::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS)
    fail("cannot write");
  if (::close(std::exchange(descriptor_, -1)) != 0)
    fail("cannot write");
  buffer_.reset();
}

DOVETAIL_INLINE void output_file::commit() {
  close();
  if (!in_place_ && ::rename(part_.c_str(), target_.c_str()) != 0)
    fail("cannot rename the finished file to");
  committed_ = true;
  if (on_disk_)
    sync_to_disk(std::filesystem::path(target_).parent_path());
}

DOVETAIL_INLINE bool output_file::is_special(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto found = std::filesystem::status(path, ignored);
  return std::filesystem::exists(found) && !std::filesystem::is_regular_file(found) &&
         !std::filesystem::is_directory(found);
}

DOVETAIL_INLINE std::string output_file::behind_links(const std::filesystem::path& path) {
  std::error_code none;
  if (!std::filesystem::is_symlink(path, none))
    return path.string();
  const auto target = std::filesystem::canonical(path, none);
  return none ? path.string() : target.string();
}

DOVETAIL_INLINE void output_file::write_out(const char* data, std::size_t size) {
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

DOVETAIL_INLINE output_file& output_batch::open(std::filesystem::path path) {
  if (!files_.empty())
    files_.back().close();
  return files_.emplace_back(std::move(path));
}

DOVETAIL_INLINE void output_batch::commit() {
  if (!files_.empty())
    files_.back().close();
  for (auto& file : files_)
    file.commit();
}

DOVETAIL_INLINE std::uint64_t output_batch::size() const {
  std::uint64_t sum = 0;
  for (const auto& file : files_)
    sum += file.size();
  return sum;
}

DOVETAIL_INLINE std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> entries;
  std::error_code failure;
  for (std::filesystem::directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure))
    entries.push_back(entry->path());
  return entries;
}

DOVETAIL_INLINE void remove_empty_folder(const std::filesystem::path& folder) {
  ::rmdir(folder.c_str());
}

DOVETAIL_INLINE void make_folder(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure || !std::filesystem::is_directory(folder, failure))
    throw io_error("cannot create the folder " + folder.string() + ": " +
                   (failure ? failure.message() : std::string("a file with that name is in the way")));
}

} // namespace dovetail
