/// @file
/// STL, text and binary.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/models/discrete/soup.hpp"
#include "dovetail/models/discrete/text_scanner.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace dovetail::discrete {

inline constexpr std::size_t stl_header_size = 84; ///< 80 bytes of text, the 32-bit number of facets
inline constexpr std::size_t stl_facet_size = 50;  ///< normal and corners as 12 floats, 2 bytes unused

/// How many triangles the header of a binary STL file announces.
inline std::size_t binary_stl_facets(std::string_view data) {
  static_assert(std::endian::native == std::endian::little, "STL and this reader are little-endian");
  std::uint32_t count = 0;
  std::memcpy(&count, data.data() + 80, 4);
  return count;
}

/// Whether a word is a keyword, in small letters or in capitals.
/// \param word any letters
/// \param keyword in small letters
inline bool is_stl_word(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                    [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

/// Whether a file begins as text does, behind blanks.
inline bool begins_with_solid(std::string_view data) {
  const std::string_view keyword = "solid";
  const std::size_t first = data.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && is_stl_word(data.substr(first, keyword.size()), keyword);
}

/// Many binary files begin with "solid" too: a size that fits the number of facets exactly tells them apart.
inline bool is_binary_stl(std::string_view data) {
  if (data.size() < stl_header_size)
    return false;
  if (data.size() == stl_header_size + stl_facet_size * binary_stl_facets(data))
    return true;
  const std::string_view head = data.substr(0, 512);
  return !begins_with_solid(data) || head.find('\0') != std::string_view::npos;
}

/// The triangles of a binary STL file. Throws `input_error` when it is shorter than announced.
inline triangle_soup parse_binary_stl(std::string_view data, const std::string& file) {
  const std::size_t count = binary_stl_facets(data);
  const std::size_t available = (data.size() - stl_header_size) / stl_facet_size;
  if (count > available)
    throw input_error(file + ": the STL file is truncated or foreign: it announces " + std::to_string(count) +
                      " triangles and has room for " + std::to_string(available) + "; export it again");
  triangle_soup soup;
  soup.points.reserve(3 * count);
  for (std::size_t f = 0; f < count; ++f) {
    std::array<float, 12> numbers;
    std::memcpy(numbers.data(), data.data() + stl_header_size + f * stl_facet_size, sizeof numbers);
    const auto first = static_cast<local_id>(soup.points.size());
    for (std::size_t k = 3; k < 12; k += 3) {
      const vec3 p{numbers[k], numbers[k + 1], numbers[k + 2]};
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw input_error(file + ": triangle " + std::to_string(f) +
                          " has a coordinate that is not finite; export it again");
      soup.points.push_back(p);
    }
    soup.triangles.push_back({first, first + 1, first + 2});
    soup.groups.push_back(no_id);
  }
  return soup;
}

/// Several solids in one text file become groups by their names.
inline triangle_soup parse_text_stl(std::string_view data, const std::string& file) {
  triangle_soup soup;
  text_scanner in(data, file);
  group_numbering group_of(soup);
  local_id group = no_id;
  bool open = false;
  int corners = 0;
  while (in.next_line()) {
    const std::string_view key = in.word();
    if (is_stl_word(key, "solid")) {
      group = group_of(in.rest());
      open = true;
    } else if (!open) {
      in.fail("this is not an STL file: \"solid\" is expected first");
    } else if (is_stl_word(key, "facet")) {
      corners = 0;
    } else if (is_stl_word(key, "vertex")) {
      soup.points.push_back(in.point());
      ++corners;
    } else if (is_stl_word(key, "endfacet")) {
      if (corners != 3)
        in.fail("the facet has " + std::to_string(corners) + " vertices instead of 3");
      const auto end = static_cast<local_id>(soup.points.size());
      soup.triangles.push_back({end - 3, end - 2, end - 1});
      soup.groups.push_back(group);
      corners = 0;
    } else if (is_stl_word(key, "endsolid")) {
      open = false;
    } else if (!is_stl_word(key, "outer") && !is_stl_word(key, "endloop")) {
      in.fail("unknown word \"" + std::string(key.substr(0, 40)) + "\" in an STL file");
    }
  }
  if (open || corners != 0)
    in.fail("the STL file is truncated: \"endsolid\" is missing; export it again");
  return soup;
}

/// The triangles of an STL file of either kind. Throws `input_error` naming the file.
inline triangle_soup parse_stl(std::string_view data, const std::string& file) {
  return is_binary_stl(data) ? parse_binary_stl(data, file) : parse_text_stl(data, file);
}

} // namespace dovetail::discrete
