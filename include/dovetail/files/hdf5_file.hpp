/// @file
/// Adapter: an HDF5 file in the making.
#pragma once

#include "dovetail/core/error.hpp"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <mutex>
#include <string>
#include <unistd.h>
#include <vector>

namespace dovetail::io {

/// For programs that close all HDF5 files they open, before their first: at its end HDF5 does not look for
/// files that are open still. HDF5 1.10 counts a file among these that it could not write to its end, on a
/// full disk say, and crashes over it after all is done.
/// Constant time. Throws nothing.
inline void let_hdf5_close_nothing_at_exit() {
  H5dont_atexit();
}

} // namespace dovetail::io

namespace dovetail::io::detail {

template <class T>
hid_t hdf5_type() {
  if constexpr (std::same_as<T, double>)
    return H5T_NATIVE_DOUBLE;
  else if constexpr (std::same_as<T, std::int64_t>)
    return H5T_NATIVE_INT64;
  else if constexpr (std::same_as<T, std::int32_t>)
    return H5T_NATIVE_INT32;
  else
    return H5T_NATIVE_UINT8;
}

/// While it lives, other threads wait, since the library may know of one only, and it prints no errors.
class hdf5_use {
public:
  hdf5_use() : lock_(in_use()) {
    H5Eget_auto2(H5E_DEFAULT, &print_, &print_data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  hdf5_use(const hdf5_use&) = delete;
  hdf5_use& operator=(const hdf5_use&) = delete;
  ~hdf5_use() { H5Eset_auto2(H5E_DEFAULT, print_, print_data_); }

private:
  static std::recursive_mutex& in_use() {
    static std::recursive_mutex mutex;
    return mutex;
  }

  std::lock_guard<std::recursive_mutex> lock_;
  H5E_auto2_t print_ = nullptr; ///< whatever printed HDF5's errors before
  void* print_data_ = nullptr;
};

/// What has just failed: what the system says of it where it says something, otherwise what HDF5 does.
inline std::string hdf5_failure() {
  std::string innermost = "HDF5 reports a failure";
  const auto take = [](unsigned depth, const H5E_error2_t* error, void* to) -> herr_t {
    if (depth == 0 && error->desc != nullptr)
      *static_cast<std::string*>(to) = std::string("HDF5: ").append(error->desc);
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take, &innermost);
  const std::string begin = "error message = '";
  const auto at = innermost.find(begin);
  if (at == std::string::npos)
    return innermost;
  const auto first = at + begin.size();
  return std::string("HDF5: ").append(innermost, first, innermost.find('\'', first) - first);
}

/// Datasets have their full sizes from the beginning and are filled in turns. The bytes of the file depend on
/// what is written alone. Throws `io_error` naming the file when HDF5 fails.
class hdf5_file {
public:
  enum class access { create, read };

  explicit hdf5_file(const std::filesystem::path& path, access how = access::create) : path_(path) {
    const hdf5_use use;
    if (how == access::read) {
      file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
      if (file_ < 0)
        fail("open");
    } else {
      require_room();
      // The oldest form of groups, which HDF5 2 makes only when told to: newer ones say when they were made.
      const handle oldest(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, *this);
      require(H5Pset_libver_bounds(oldest.id, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST));
      file_ = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, oldest.id);
      if (file_ < 0)
        fail("create");
    }
  }
  hdf5_file(const hdf5_file&) = delete;
  hdf5_file& operator=(const hdf5_file&) = delete;
  ~hdf5_file() {
    const hdf5_use use;
    if (file_ >= 0 && is_flushed(file_))
      H5Fclose(file_);
  }

  /// A dataset of `rows` rows of `columns` values (1: of one dimension), and the groups around it.
  template <class T>
  void create(const std::string& name, std::uint64_t rows, std::uint64_t columns = 1) {
    const hdf5_use use;
    const layout plain(*this);
    create(name, hdf5_type<T>(), rows, columns, plain);
  }
  /// One of numbers that repeat or count up, deflated where this HDF5 can.
  template <class T>
  void create_packed(const std::string& name, std::uint64_t rows) {
    const hdf5_use use;
    const layout packed(*this);
    const hsize_t chunk = std::clamp<hsize_t>(rows, 1, 1 << 16);
    require(H5Pset_chunk(packed.id, 1, &chunk));
    require(H5Pset_shuffle(packed.id));
    if (H5Zfilter_avail(H5Z_FILTER_DEFLATE) > 0)
      require(H5Pset_deflate(packed.id, 1));
    create(name, hdf5_type<T>(), rows, 1, packed);
  }
  /// One of a value that all rows have, which takes no room.
  template <class T>
  void create_constant(const std::string& name, std::uint64_t rows, T value) {
    const hdf5_use use;
    const layout filled(*this);
    require(H5Pset_fill_value(filled.id, hdf5_type<T>(), &value));
    create(name, hdf5_type<T>(), rows, 1, filled);
  }
  /// One whose place in the file is known before anything is written to it (`place_of`).
  template <class T>
  void create_in_place(const std::string& name, std::uint64_t rows, std::uint64_t columns = 1) {
    const hdf5_use use;
    const layout placed(*this);
    require(H5Pset_alloc_time(placed.id, H5D_ALLOC_TIME_EARLY));
    require(H5Pset_fill_time(placed.id, H5D_FILL_TIME_NEVER));
    create(name, hdf5_type<T>(), rows, columns, placed);
  }
  /// Writes rows from `first` on.
  template <class T>
  void write(const std::string& name, std::uint64_t first, std::uint64_t rows, const T* values,
             std::uint64_t columns = 1) {
    if (rows == 0)
      return;
    const hdf5_use use;
    const std::array<hsize_t, 2> start{first, 0}, extent{rows, columns};
    const int rank = columns == 1 ? 1 : 2;
    const handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, *this);
    const handle there(H5Dget_space(set.id), H5Sclose, *this);
    const handle here(H5Screate_simple(rank, extent.data(), nullptr), H5Sclose, *this);
    require(H5Sselect_hyperslab(there.id, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr));
    require(H5Dwrite(set.id, hdf5_type<T>(), here.id, there.id, H5P_DEFAULT, values));
  }
  template <class T>
  void write(const std::string& name, std::uint64_t first, const std::vector<T>& values) {
    write(name, first, values.size(), values.data());
  }
  /// Writes rows from `first` on that are computed, row i being `of_row(i)`; memory is bounded.
  template <class T, class Function>
  void write_computed(const std::string& name, std::uint64_t first, std::uint64_t rows, Function of_row) {
    std::vector<T> values;
    for (std::uint64_t begin = 0; begin < rows; begin += values.size()) {
      values.resize(std::min<std::uint64_t>(rows - begin, 1 << 18));
      for (std::uint64_t i = 0; i < values.size(); ++i)
        values[i] = of_row(begin + i);
      write(name, first + begin, values);
    }
  }
  /// A whole dataset at once.
  template <class T>
  void add(const std::string& name, const std::vector<T>& values) {
    create<T>(name, values.size());
    write(name, 0, values);
  }
  /// A dataset of texts.
  void add(const std::string& name, const std::vector<std::string>& texts) {
    const hdf5_use use;
    const handle type(H5Tcopy(H5T_C_S1), H5Tclose, *this);
    require(H5Tset_size(type.id, H5T_VARIABLE));
    require(H5Tset_cset(type.id, H5T_CSET_UTF8));
    const layout plain(*this);
    create(name, type.id, texts.size(), 1, plain);
    std::vector<const char*> begins;
    for (const auto& text : texts)
      begins.push_back(text.c_str());
    const handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, *this);
    if (!begins.empty())
      require(H5Dwrite(set.id, type.id, H5S_ALL, H5S_ALL, H5P_DEFAULT, begins.data()));
  }
  /// An attribute of a group or dataset: whole numbers, or a text.
  void attribute(const std::string& of, const std::string& name, const std::vector<std::int64_t>& values) {
    const hdf5_use use;
    const std::array<hsize_t, 1> extent{values.size()};
    const handle space(H5Screate_simple(1, extent.data(), nullptr), H5Sclose, *this);
    add_attribute(of, name, H5T_NATIVE_INT64, space.id, values.data());
  }
  void attribute(const std::string& of, const std::string& name, const std::string& text) {
    const hdf5_use use;
    const handle space(H5Screate(H5S_SCALAR), H5Sclose, *this);
    const handle type(H5Tcopy(H5T_C_S1), H5Tclose, *this);
    require(H5Tset_size(type.id, text.size()));
    require(H5Tset_strpad(type.id, H5T_STR_NULLPAD));
    add_attribute(of, name, type.id, space.id, text.data());
  }

  /// The values of a dataset, row by row.
  template <class T>
  std::vector<T> read(const std::string& name) const {
    const hdf5_use use;
    const handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, *this);
    const handle space(H5Dget_space(set.id), H5Sclose, *this);
    const auto count = H5Sget_simple_extent_npoints(space.id);
    require(count);
    std::vector<T> values(static_cast<std::size_t>(count));
    if (count > 0)
      require(H5Dread(set.id, hdf5_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
    return values;
  }

  /// Where the values of a dataset lie, which is not empty, in the file.
  struct place {
    std::uint64_t offset;
    std::uint64_t bytes;
  };
  place place_of(const std::string& name) const {
    const hdf5_use use;
    const handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, *this);
    const haddr_t offset = H5Dget_offset(set.id);
    if (offset == HADDR_UNDEF)
      fail("find the values of " + name + " in");
    return {offset, H5Dget_storage_size(set.id)};
  }

  /// To the disk.
  void close() {
    const hdf5_use use;
    const hid_t file = file_;
    file_ = -1;
    require(is_flushed(file) ? H5Fclose(file) : -1);
    const int descriptor = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
    const bool is_there = descriptor >= 0 && ::fsync(descriptor) == 0;
    if (descriptor >= 0)
      ::close(descriptor);
    if (!is_there)
      throw io_error("cannot write " + path_.string() + ": " + std::strerror(errno));
  }

private:
  struct handle {
    handle(hid_t made, herr_t (*with)(hid_t), const hdf5_file& of) : id(made), close(with) {
      of.require(made);
    }
    handle(const handle&) = delete;
    handle& operator=(const handle&) = delete;
    ~handle() { close(id); }
    hid_t id;
    herr_t (*close)(hid_t);
  };
  /// How a dataset lies in the file, which does not say when it was made.
  struct layout : handle {
    explicit layout(const hdf5_file& of) : handle(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, of) {
      of.require(H5Pset_obj_track_times(id, false));
    }
  };

  void create(const std::string& name, hid_t type, std::uint64_t rows, std::uint64_t columns,
              const layout& how) {
    const std::array<hsize_t, 2> extent{rows, columns};
    const handle space(H5Screate_simple(columns == 1 ? 1 : 2, extent.data(), nullptr), H5Sclose, *this);
    create(name, type, space.id, how.id);
  }
  void create(const std::string& name, hid_t type, hid_t space, hid_t how) {
    const handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, *this);
    require(H5Pset_create_intermediate_group(links.id, 1));
    const handle made(H5Dcreate2(file_, name.c_str(), type, space, links.id, how, H5P_DEFAULT), H5Dclose,
                      *this);
  }
  void add_attribute(const std::string& of, const std::string& name, hid_t type, hid_t space,
                     const void* values) {
    const handle made(H5Acreate_by_name(file_, of.c_str(), name.c_str(), type, space, H5P_DEFAULT,
                                        H5P_DEFAULT, H5P_DEFAULT),
                      H5Aclose, *this);
    require(H5Awrite(made.id, type, values));
  }
  /// Throws where there is no room to begin the file: HDF5 2 ends the process then. What else is wrong with
  /// it HDF5 says itself.
  void require_room() const {
    const int descriptor = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor < 0)
      return;
    const std::array<char, 64> zeros{};
    ssize_t wrote = 1;
    for (int bytes = 0; bytes < 4096 && wrote > 0; bytes += static_cast<int>(wrote))
      wrote = ::write(descriptor, zeros.data(), zeros.size());
    const int reason = errno;
    ::close(descriptor);
    if (wrote < 0)
      throw io_error("cannot create " + path_.string() + ": " + std::strerror(reason));
  }

  /// Whether all is in the file. One that is not, on a full disk say, stays open: HDF5 2 ends the process
  /// where it cannot write what is left of a file that it closes.
  static bool is_flushed(hid_t file) { return H5Fflush(file, H5F_SCOPE_LOCAL) >= 0; }

  void require(std::int64_t status) const {
    if (status < 0)
      fail("write");
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw io_error("cannot " + what + " " + path_.string() + ": " + hdf5_failure());
  }

  std::filesystem::path path_;
  hid_t file_ = -1;
};

} // namespace dovetail::io::detail
