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
  void text(const std::string& s) {
    count(s.size());
    append(s.data(), s.size());
  }
  byte_buffer take() { return std::move(buffer_); } ///< what has been written; the writer is empty after that

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

  /// A value that `byte_writer::value` wrote.
  template <class T>
    requires std::is_trivially_copyable_v<T> T value() {
      T item;
      read(&item, sizeof(T));
      return item;
    }
  /// A number that `byte_writer::count` wrote.
  std::uint64_t count() {
    std::uint64_t number = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const auto next = value<std::uint8_t>();
      number |= static_cast<std::uint64_t>(next & 127) << shift;
      if (next < 128)
        return number;
    }
    throw input_error("binary data have a number of more than 64 bits");
  }
  /// What `byte_writer::array` wrote.
  template <class T>
    requires std::is_trivially_copyable_v<T> std::vector<T> array() {
      std::vector<T> items(count_with_room(sizeof(T)));
      read(items.data(), items.size() * sizeof(T));
      return items;
    }
  /// What `byte_writer::text` wrote.
  std::string text() {
    std::string s(count_with_room(1), '\0');
    read(s.data(), s.size());
    return s;
  }
  bool at_end() const { return left_ == 0; } ///< whether all has been read

private:
  /// Of items of which so many are left; looked at before memory for them is asked for.
  std::size_t count_with_room(std::size_t size_of_item) {
    const std::uint64_t items = count();
    if (items > left_ / size_of_item)
      throw input_error("binary data end early");
    return static_cast<std::size_t>(items);
  }
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
