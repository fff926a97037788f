/// @file
/// What `vtk_arrays.hpp` declares.
#pragma once

#include "dovetail/core/input_file.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/xml_tree.hpp"
#include "dovetail/files/vtk_arrays.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dovetail::io {

DOVETAIL_INLINE std::vector<std::uint8_t> vtk_byte_source::take(std::uint64_t count) {
  if (count > left())
    throw input_error("the data end early");
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(count));
  if (base64_) {
    for (auto& byte : bytes)
      byte = next_decoded();
  } else {
    std::copy_n(data_.begin(), bytes.size(), bytes.begin());
    data_.remove_prefix(bytes.size());
  }
  return bytes;
}

DOVETAIL_INLINE std::uint8_t vtk_byte_source::next_decoded() {
  while (decoded_ == used_) {
    std::array<int, 4> digits{};
    int padding = 0;
    for (auto& digit : digits) {
      while (!data_.empty() && (data_[0] == ' ' || (data_[0] >= '\t' && data_[0] <= '\r')))
        data_.remove_prefix(1);
      if (data_.empty())
        throw input_error("the base64 data end early");
      const auto c = static_cast<unsigned char>(data_[0]);
      data_.remove_prefix(1);
      padding += c == '=' ? 1 : 0;
      digit = c == '=' ? 0 : values[c];
      if (digit < 0)
        throw input_error("a character that is not base64");
    }
    if (padding > 2)
      throw input_error("too much padding in base64 data");
    group_ = {static_cast<std::uint8_t>(digits[0] << 2 | digits[1] >> 4),
              static_cast<std::uint8_t>((digits[1] & 15) << 4 | digits[2] >> 2),
              static_cast<std::uint8_t>((digits[2] & 3) << 6 | digits[3])};
    used_ = 0;
    decoded_ = static_cast<std::size_t>(3 - padding);
  }
  return group_[used_++];
}

DOVETAIL_INLINE vtk_encoding read_vtk_encoding(const xml_element& root, vtk_expander expand) {
  vtk_encoding encoding;
  encoding.expand = expand;
  const bool big = root.attribute("byte_order") == "BigEndian";
  encoding.swapped = big != (std::endian::native == std::endian::big);
  encoding.wide_header = root.attribute("header_type") == "UInt64";
  if (const auto compressor = root.attribute("compressor"); !compressor.empty()) {
    if (compressor != "vtkZLibDataCompressor")
      throw input_error("the data are compressed by " + std::string(compressor) +
                        ", which is not supported; write them without compression or with zlib");
    encoding.compressed = true;
  }
  if (const auto* section = root.child("AppendedData")) {
    const auto start = section->text.find('_');
    if (start == std::string_view::npos)
      throw input_error("the appended data do not start with an underscore");
    encoding.appended = section->text.substr(start + 1);
    encoding.appended_left = 2 * encoding.appended.size();
    encoding.appended_base64 = section->attribute("encoding") == "base64";
  }
  return encoding;
}

namespace detail {

inline std::uint64_t header_number(vtk_byte_source& source, const vtk_encoding& encoding) {
  const auto bytes = source.take(encoding.wide_header ? 8 : 4);
  if (encoding.wide_header) {
    std::uint64_t value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return encoding.swapped ? byte_swapped(value) : value;
  }
  std::uint32_t value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return encoding.swapped ? byte_swapped(value) : value;
}

/// The bytes of an array that is stored in blocks, each of which is a zlib stream. Nothing is allocated for
/// sizes that the data cannot have: more than `most` bytes in all, or than a stream can expand to.
inline std::vector<std::uint8_t> take_compressed(vtk_byte_source& source, const vtk_encoding& encoding,
                                                 std::uint64_t most) {
  constexpr std::uint64_t largest_expansion = 1032;
  if (encoding.expand == nullptr)
    throw input_error(
        "it is compressed; give the reader the function io::zlib_expand of the component zlib, or "
        "write the file without compression");
  const auto blocks = header_number(source, encoding);
  const auto block_size = header_number(source, encoding);
  const auto last_size = header_number(source, encoding);
  std::vector<std::uint64_t> compressed_sizes;
  for (std::uint64_t b = 0; b < blocks; ++b)
    compressed_sizes.push_back(header_number(source, encoding));
  std::vector<std::uint8_t> all;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const auto compressed = source.take(compressed_sizes[b]);
    const bool partial = b + 1 == blocks && last_size != 0;
    const auto size = partial ? last_size : block_size;
    if (size > most - all.size())
      throw input_error("its compressed data announce more than its values");
    if (size / largest_expansion > compressed.size())
      throw input_error("its compressed data end early");
    const auto begin = all.size();
    all.resize(begin + static_cast<std::size_t>(size));
    encoding.expand(compressed, std::span(all).subspan(begin));
  }
  return all;
}

DOVETAIL_INLINE std::vector<std::uint8_t> array_bytes(const xml_element& array, const vtk_encoding& encoding,
                                                      std::uint64_t most) {
  std::string_view data = array.text;
  bool base64 = true;
  const bool appended = array.attribute("format") == "appended";
  if (appended) {
    const auto offset = file_cursor(array.attribute("offset"), "offset").number<std::uint64_t>();
    if (offset > encoding.appended.size())
      throw input_error("its offset is behind the end of the appended data");
    data = encoding.appended.substr(static_cast<std::size_t>(offset));
    base64 = encoding.appended_base64;
  }
  vtk_byte_source source(data, base64);
  auto bytes = encoding.compressed ? take_compressed(source, encoding, most)
                                   : source.take(header_number(source, encoding));
  const std::uint64_t taken = appended ? data.size() - source.rest().size() : 0;
  if (taken > encoding.appended_left)
    throw input_error("its data are those of other arrays too");
  encoding.appended_left -= taken;
  return bytes;
}

} // namespace detail

} // namespace dovetail::io
