/// @file
/// Flat binary encoding of plain data, used to carry results between worker processes and spool files.
#pragma once

#include "dovetail/core/error.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace dovetail {

using byte_buffer = std::vector<std::byte>;

/// Appends trivially copyable values, strings and vectors of them to a buffer.
class byte_writer {
public:
  template <class T>
    requires std::is_trivially_copyable_v<T>
  void value(const T& item) { append(&item, sizeof(T)); }
  template <class T>
    requires std::is_trivially_copyable_v<T>
  void array(const std::vector<T>& items) {
    value<std::uint64_t>(items.size());
    append(items.data(), items.size() * sizeof(T));
  }
  void text(const std::string& s) {
    value<std::uint64_t>(s.size());
    append(s.data(), s.size());
  }
  byte_buffer take() { return std::move(buffer_); }

private:
  void append(const void* data, std::size_t size) {
    if (size == 0)
      return;
    const std::size_t at = buffer_.size();
    buffer_.resize(at + size);
    std::memcpy(buffer_.data() + at, data, size);
  }
  byte_buffer buffer_;
};

/// Reads back what `byte_writer` wrote, in the same order; throws `input_error` when the data end early.
class byte_reader {
public:
  explicit byte_reader(const byte_buffer& buffer) : data_(buffer.data()), left_(buffer.size()) {}

  template <class T>
    requires std::is_trivially_copyable_v<T> T value() {
      T item;
      read(&item, sizeof(T));
      return item;
    }
  template <class T>
    requires std::is_trivially_copyable_v<T> std::vector<T> array() {
      const auto count = value<std::uint64_t>();
      if (count > left_ / sizeof(T))
        throw input_error("binary data end early");
      std::vector<T> items(static_cast<std::size_t>(count));
      read(items.data(), items.size() * sizeof(T));
      return items;
    }
  std::string text() {
    const auto count = value<std::uint64_t>();
    if (count > left_)
      throw input_error("binary data end early");
    std::string s(static_cast<std::size_t>(count), '\0');
    read(s.data(), s.size());
    return s;
  }
  bool at_end() const { return left_ == 0; }

private:
  void read(void* to, std::size_t size) {
    if (size > left_)
      throw input_error("binary data end early");
    if (size > 0)
      std::memcpy(to, data_, size);
    data_ += size;
    left_ -= size;
  }
  const std::byte* data_;
  std::size_t left_;
};

} // namespace dovetail
