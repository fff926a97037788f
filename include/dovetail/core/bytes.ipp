/// @file
/// What `bytes.hpp` declares.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace dovetail {

DOVETAIL_INLINE void byte_writer::text(const std::string& s) {
  count(s.size());
  append(s.data(), s.size());
}

DOVETAIL_INLINE std::uint64_t byte_reader::count() {
  std::uint64_t number = 0;
  for (int shift = 0; shift < 64; shift += 7) {
    const auto next = value<std::uint8_t>();
    number |= static_cast<std::uint64_t>(next & 127) << shift;
    if (next < 128)
      return number;
  }
  throw input_error("binary data have a number of more than 64 bits");
}

DOVETAIL_INLINE std::string byte_reader::text() {
  std::string s(count_with_room(1), '\0');
  read(s.data(), s.size());
  return s;
}

DOVETAIL_INLINE std::size_t byte_reader::count_with_room(std::size_t size_of_item) {
  const std::uint64_t items = count();
  if (items > left_ / size_of_item)
    throw_end();
  return static_cast<std::size_t>(items);
}

DOVETAIL_INLINE void byte_reader::throw_end() {
  throw input_error("binary data end early");
}

} // namespace dovetail
