/// @file
/// Reading files: the content at once, and a cursor that can say where it is when something is wrong.
#pragma once

#include "dovetail/core/error.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace dovetail {

/// The bytes of a file, or its first `most`. Throws `input_error` naming it when it is missing, no file,
/// unreadable or empty.
std::string read_file(const std::filesystem::path& path,
                      std::uintmax_t most = std::numeric_limits<std::uintmax_t>::max());

/// The value with its bytes in reverse order.
template <class T>
T byte_swapped(T value) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  std::reverse(bytes.begin(), bytes.end());
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

/// A place in a text or binary file that moves on as things are read. Every failure throws `input_error`
/// naming file and place.
class file_cursor {
public:
  file_cursor(std::string_view content, std::string name) : content_(content), name_(std::move(name)) {}

  bool at_end() const { return at_ == content_.size(); }         ///< whether nothing is left to read
  std::size_t left() const { return content_.size() - at_; }     ///< how many bytes are left
  std::size_t position() const { return at_; }                   ///< how many bytes have been passed
  std::string_view rest() const { return content_.substr(at_); } ///< what is left, a view into the content
  const std::string& name() const { return name_; }              ///< the file's name, for messages
  /// Passes so many bytes, or all that are left.
  void skip(std::size_t bytes) { at_ += std::min(bytes, left()); }

  /// Passes spaces, tabs and line ends.
  void skip_space();
  /// The next run of characters that are not space; empty at the end.
  std::string_view word();
  /// The rest of the line, without its end, which is passed.
  std::string_view line();
  /// The next number in decimal notation.
  template <class Number>
  Number number() {
    skip_space();
    const char* first = content_.data() + at_;
    const char* last = content_.data() + content_.size();
    if (first != last && *first == '+')
      ++first;
    Number value{};
    const auto [end, problem] = std::from_chars(first, last, value);
    if (problem == std::errc::result_out_of_range)
      fail("a number is out of range");
    if (problem != std::errc() || (end != last && !is_space(*end)))
      fail(at_end() ? "the file ends where a number is expected" : "a number is expected");
    at_ = static_cast<std::size_t>(end - content_.data());
    return value;
  }
  /// The next value as raw bytes.
  template <class T>
    requires std::is_trivially_copyable_v<T> T raw(bool swapped = false) {
      if (left() < sizeof(T))
        fail("the file ends early");
      T value;
      std::memcpy(&value, content_.data() + at_, sizeof(T));
      at_ += sizeof(T);
      return swapped ? byte_swapped(value) : value;
    }
  /// Refuses a count of things of at least so many bytes each that cannot be in what is left of the file.
  std::size_t plausible(std::uint64_t count, std::size_t bytes_each) const;
  /// Throws `input_error` with the file's name, the line (in binary files the byte) and `what`.
  [[noreturn]] void fail(const std::string& what) const;

private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  std::string_view content_;
  std::string name_;
  std::size_t at_ = 0;
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/core/input_file.ipp"
#endif
