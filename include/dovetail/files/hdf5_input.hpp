/// @file
/// Adapter: an HDF5 file that is read, whose arrays may not be what they should be.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/input_file.hpp"
#include "dovetail/files/hdf5_file.hpp"

#include <hdf5.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <system_error>
#include <vector>

namespace dovetail::io::detail {

/// What no reader of HDF5 takes.
inline constexpr const char* names_in_hdf5 = "the names of materials and faces";

/// Datasets of numbers, of one or two dimensions. Throws `input_error` naming the file and the dataset.
class hdf5_input {
public:
  /// How much a dataset has.
  struct extent {
    std::uint64_t rows = 0;
    std::uint64_t columns = 1;

    bool operator==(const extent&) const = default;
  };

  explicit hdf5_input(const std::filesystem::path& path) : path_(path) {
    if (!read_file(path, 8).starts_with("\x89HDF"))
      throw input_error(path.string() + ": this is no HDF5 file");
    const hdf5_use use;
    file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file_ < 0)
      throw input_error(path.string() + ": HDF5 cannot read the file (" + hdf5_failure() +
                        "); write it anew");
    std::error_code failure;
    bytes_ = std::filesystem::file_size(path, failure);
  }
  hdf5_input(const hdf5_input&) = delete;
  hdf5_input& operator=(const hdf5_input&) = delete;
  ~hdf5_input() {
    const hdf5_use use;
    H5Fclose(file_);
  }

  const std::filesystem::path& path() const { return path_; }

  bool has(const std::string& name) const {
    const hdf5_use use;
    const hid_t set = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    if (set >= 0)
      H5Dclose(set);
    return set >= 0;
  }
  extent extent_of(const std::string& name) const {
    const hdf5_use use;
    const dataset set(*this, name);
    return set.size;
  }
  /// Refuses a dataset of another extent.
  void require(const std::string& name, extent wanted) const {
    const extent found = extent_of(name);
    if (found != wanted)
      fail(name, "it is " + text_of(found) + ", not " + text_of(wanted));
  }
  /// Its extent. Refuses one that has more values, of so many bytes, than there can be in the file: by
  /// others, which are packed or a constant, nothing may be allocated.
  extent require_stored(const std::string& name, std::uint64_t columns, std::uint64_t bytes_each) const {
    const extent found = extent_of(name);
    if (found.columns != columns)
      fail(name, "it has " + std::to_string(found.columns) + " columns, not " + std::to_string(columns));
    if (found.rows > bytes_ / (columns * bytes_each))
      fail(name, "it announces " + std::to_string(found.rows) + " rows, for which the file is too small");
    return found;
  }
  /// Rows from `first` on, of which the caller knows that they are there.
  template <class T>
  std::vector<T> read(const std::string& name, std::uint64_t first, std::uint64_t rows) const {
    const hdf5_use use;
    const dataset set(*this, name);
    if (rows > set.size.rows || first > set.size.rows - rows)
      fail(name, "it ends before row " + std::to_string(first + rows));
    if (set.kind != (std::same_as<T, double> ? H5T_FLOAT : H5T_INTEGER))
      fail(name, std::string("its values are no ") + (std::same_as<T, double> ? "reals" : "whole numbers"));
    std::vector<T> values(static_cast<std::size_t>(rows * set.size.columns));
    if (values.empty())
      return values;
    const std::array<hsize_t, 2> start{first, 0}, count{rows, set.size.columns};
    const hid_t here = H5Screate_simple(set.dimensions, count.data(), nullptr);
    const bool done =
        here >= 0 &&
        H5Sselect_hyperslab(set.space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) >= 0 &&
        H5Dread(set.id, hdf5_type<T>(), here, set.space, H5P_DEFAULT, values.data()) >= 0;
    const std::string failure = done ? std::string() : hdf5_failure();
    if (here >= 0)
      H5Sclose(here);
    if (!done)
      fail(name, "it cannot be read: " + failure);
    return values;
  }
  /// All rows of a dataset of one column, which is small: no larger than the file is.
  template <class T>
  std::vector<T> read_list(const std::string& name) const {
    return read<T>(name, 0, require_stored(name, 1, sizeof(T)).rows);
  }
  [[noreturn]] void fail(const std::string& name, const std::string& what) const {
    throw input_error(path_.string() + ": dataset " + name + ": " + what + "; write the file anew");
  }

private:
  static std::string text_of(extent of) {
    return std::to_string(of.rows) + (of.columns == 1 ? "" : " x " + std::to_string(of.columns));
  }

  struct dataset {
    dataset(const hdf5_input& of, const std::string& name)
        : id(H5Dopen2(of.file_, name.c_str(), H5P_DEFAULT)), space(id < 0 ? -1 : H5Dget_space(id)) {
      std::array<hsize_t, 2> sizes{0, 1};
      dimensions = space < 0 ? -1 : H5Sget_simple_extent_ndims(space);
      const bool known = (dimensions == 1 || dimensions == 2) &&
                         H5Sget_simple_extent_dims(space, sizes.data(), nullptr) == dimensions;
      const hid_t type = known ? H5Dget_type(id) : -1;
      if (type >= 0) {
        kind = H5Tget_class(type);
        H5Tclose(type);
      }
      size = {sizes[0], sizes[1]};
      if (!known) {
        close();
        of.fail(name, "it is missing, or not of one or two dimensions");
      }
      if (size.columns == 0 || size.rows > std::numeric_limits<std::int64_t>::max() / size.columns) {
        close();
        of.fail(name, "its dimensions are out of range");
      }
    }
    dataset(const dataset&) = delete;
    dataset& operator=(const dataset&) = delete;
    ~dataset() { close(); }
    void close() {
      if (space >= 0)
        H5Sclose(space);
      if (id >= 0)
        H5Dclose(id);
      space = id = -1;
    }

    hid_t id;
    hid_t space;
    int dimensions = 0;
    extent size;
    H5T_class_t kind = H5T_NO_CLASS;
  };

  std::filesystem::path path_;
  std::uint64_t bytes_ = 0; ///< of the file
  hid_t file_ = -1;
};

} // namespace dovetail::io::detail
