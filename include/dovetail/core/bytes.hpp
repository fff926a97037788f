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

using byte_buffer = std::vector<std::byte>; ///< what an encoding is made of

/// Appends trivially copyable values, numbers, texts and arrays to a buffer. Types with structure:
/// `core/encoding.hpp`.
class byte_writer {
public:
  /// One trivially copyable value, as it is in memory.
  template <class T>
    requires std::is_trivially_copyable_v<T>
  void value(const T& item) { append(&item, sizeof(T)); }
  /// A number that is mostly small: seven bits to a byte.
  void count(std::uint64_t number) {
    for (; number >= 128; number >>= 7)
      value(static_cast<std::uint8_t>(number | 128));
    value(static_cast<std::uint8_t>(number));
  }
  /// How many items, then the items.
  template <class T>
    requires std::is_trivially_copyable_v<T>
  void array(const std::vector<T>& items) {
    count(items.size());
    append(items.data(), items.size() * sizeof(T));
  }
  /// How many characters, then the characters.
  void text(const std::string& s);
  /// Makes room for so many bytes, where it is known about how many there will be.
  void reserve(std::size_t bytes) { buffer_.reserve(bytes); }
  byte_buffer take() { return std::move(buffer_); } ///< what has been written; the writer is empty after that

private:
  // Here, since numbers come one by one, and most are of a byte.
  void append(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const std::byte*>(data);
    buffer_.insert(buffer_.end(), bytes, bytes + size);
  }
  byte_buffer buffer_;
};

/// Reads back what `byte_writer` wrote, in the same order; throws `input_error` when the data end early.
class byte_reader {
public:
  explicit byte_reader(const byte_buffer& buffer) : data_(buffer.data()), left_(buffer.size()) {}

  /// A value that `byte_writer::value` wrote.
  template <class T>
    requires std::is_trivially_copyable_v<T> T value() {
      T item;
      read(&item, sizeof(T));
      return item;
    }
  /// A number that `byte_writer::count` wrote.
  std::uint64_t count();
  /// What `byte_writer::array` wrote.
  template <class T>
    requires std::is_trivially_copyable_v<T> std::vector<T> array() {
      std::vector<T> items(count_with_room(sizeof(T)));
      read(items.data(), items.size() * sizeof(T));
      return items;
    }
  /// What `byte_writer::text` wrote.
  std::string text();
  bool at_end() const { return left_ == 0; } ///< whether all has been read

private:
  /// Of items of which so many are left; looked at before memory for them is asked for.
  std::size_t count_with_room(std::size_t size_of_item);
  void read(void* to, std::size_t size) {
    if (size > left_)
      throw_end();
    if (size > 0)
      std::memcpy(to, data_, size);
    data_ += size;
    left_ -= size;
  }
  [[noreturn]] static void throw_end();
  const std::byte* data_;
  std::size_t left_;
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/core/bytes.ipp"
#endif
