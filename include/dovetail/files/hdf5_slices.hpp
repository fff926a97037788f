/// @file
/// Adapter: one HDF5 file that several processes fill at once.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/files/hdf5_file.hpp"

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

namespace dovetail::io::detail {

/// A file that `hdf5_file` has made and closed. Writes rows of the datasets that were created in place, while
/// others, perhaps on other machines, write other rows. HDF5 only says where these lie: it holds the file
/// open for reading, locked as all readers do, and the values are written past it. Throws `io_error` naming
/// the file.
class hdf5_slices {
public:
  explicit hdf5_slices(const std::filesystem::path& path)
      : path_(path), laid_out_(path, hdf5_file::access::read),
        descriptor_(::open(path.c_str(), O_WRONLY | O_CLOEXEC)) {
    if (descriptor_ < 0)
      fail();
  }
  hdf5_slices(const hdf5_slices&) = delete;
  hdf5_slices& operator=(const hdf5_slices&) = delete;
  ~hdf5_slices() {
    if (descriptor_ >= 0)
      ::close(descriptor_);
  }

  /// A dataset that was written before.
  template <class T>
  std::vector<T> read(const std::string& name) const {
    return laid_out_.read<T>(name);
  }
  /// Writes rows from `first` on.
  template <class T>
  void write(const std::string& name, std::uint64_t first, std::uint64_t rows, const T* values,
             std::uint64_t columns = 1) {
    if (rows == 0)
      return;
    const auto [offset, bytes] = laid_out_.place_of(name);
    const std::uint64_t row = columns * sizeof(T);
    if ((first + rows) * row > bytes)
      throw io_error("cannot write " + path_.string() + ": " + name + " has no room for rows " +
                     std::to_string(first) + " to " + std::to_string(first + rows - 1));
    write_at(offset + first * row, reinterpret_cast<const char*>(values), rows * row);
  }
  template <class T>
  void write(const std::string& name, std::uint64_t first, const std::vector<T>& values,
             std::uint64_t columns = 1) {
    write(name, first, values.size() / columns, values.data(), columns);
  }
  /// To the disk.
  void close() {
    if (::fsync(descriptor_) != 0 || ::close(std::exchange(descriptor_, -1)) != 0)
      fail();
  }

private:
  void write_at(std::uint64_t offset, const char* data, std::size_t size) {
    while (size > 0) {
      const auto written = ::pwrite(descriptor_, data, size, static_cast<off_t>(offset));
      if (written < 0 && errno == EINTR)
        continue;
      if (written <= 0)
        fail();
      data += written;
      offset += static_cast<std::uint64_t>(written);
      size -= static_cast<std::size_t>(written);
    }
  }
  [[noreturn]] void fail() const {
    const int reason = errno;
    throw io_error("cannot write " + path_.string() + ": " + std::strerror(reason));
  }

  std::filesystem::path path_;
  hdf5_file laid_out_;
  int descriptor_;
};

} // namespace dovetail::io::detail
