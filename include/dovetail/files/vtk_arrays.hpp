/// @file
/// Decodes the data arrays of VTK's XML files: text, base64 and raw, inline and appended, plain and, with
/// somebody's help, compressed by zlib, either byte order.
#pragma once

#include "dovetail/core/input_file.hpp"
#include "dovetail/core/xml_tree.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dovetail::io {

/// Bytes that are in the file as they are, or as base64.
class vtk_byte_source {
public:
  vtk_byte_source(std::string_view data, bool base64) : data_(data), base64_(base64) {}

  /// The next bytes; throws `input_error` when there are fewer.
  std::vector<std::uint8_t> take(std::uint64_t count);

  /// What has not been taken, as it stands in the file.
  std::string_view rest() const { return data_; }

private:
  /// An upper bound for encoded data.
  std::uint64_t left() const { return base64_ ? data_.size() + 3 : data_.size(); }

  static constexpr std::array<std::int8_t, 256> values = [] {
    std::array<std::int8_t, 256> table{};
    table.fill(-1);
    std::int8_t value = 0;
    for (const char c : std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"))
      table[static_cast<unsigned char>(c)] = value++;
    return table;
  }();

  /// Decodes four characters at a time. Padding may occur in the middle: a header and its data are often
  /// encoded one after the other.
  std::uint8_t next_decoded();

  std::string_view data_;
  bool base64_;
  std::array<std::uint8_t, 3> group_{};
  std::size_t used_ = 0;
  std::size_t decoded_ = 0;
};

/// Expands a zlib stream to exactly as many bytes as there is room for, or throws `input_error`.
/// `zlib_expand` is one, in the adapter `files/zlib.hpp`; null: compressed arrays are refused.
using vtk_expander = void (*)(std::span<const std::uint8_t> data, std::span<std::uint8_t> out);

/// How the arrays of one file are stored.
struct vtk_encoding {
  bool swapped = false;           ///< the byte order is not this machine's
  bool wide_header = false;       ///< block headers are 64-bit numbers, not 32-bit ones
  bool compressed = false;        ///< by zlib
  vtk_expander expand = nullptr;  ///< what expands it
  std::string_view appended = {}; ///< the appended section, from behind its underscore
  bool appended_base64 = false;   ///< whether what is appended is base64 and not raw bytes
  /// Bytes that may still be taken from the appended section, each of them twice, since the tags of cells
  /// serve two purposes: arrays that share theirs would let a small file expand without end.
  mutable std::uint64_t appended_left = 0;
};

/// Reads the encoding from the root element of a file. Throws `input_error` (without a file name) for what is
/// not understood.
vtk_encoding read_vtk_encoding(const xml_element& root, vtk_expander expand);

namespace detail {

/// The bytes of a binary array, which its header counts; compressed ones may be `most`.
std::vector<std::uint8_t> array_bytes(const xml_element& array, const vtk_encoding& encoding,
                                      std::uint64_t most);

/// The value as an Out, or an error when it does not fit.
template <class Out, class In>
Out converted(In value) {
  if constexpr (std::is_integral_v<Out> && std::is_floating_point_v<In>) {
    if (!(value >= static_cast<In>(std::numeric_limits<Out>::min()) &&
          value < static_cast<In>(std::numeric_limits<Out>::max())))
      throw input_error("a value is out of range");
  } else if constexpr (std::is_integral_v<Out>) {
    if (!std::in_range<Out>(value))
      throw input_error("a value is out of range");
  }
  return static_cast<Out>(value);
}

template <class In, class Out>
std::vector<Out> binary_values(const xml_element& array, const vtk_encoding& encoding,
                               std::uint64_t expected) {
  const auto most = std::min(expected, std::numeric_limits<std::uint64_t>::max() / sizeof(In)) * sizeof(In);
  const auto bytes = array_bytes(array, encoding, most);
  if (bytes.size() % sizeof(In) != 0)
    throw input_error("its size is no multiple of the size of its values");
  std::vector<Out> values(bytes.size() / sizeof(In));
  for (std::size_t i = 0; i < values.size(); ++i) {
    In value;
    std::memcpy(&value, bytes.data() + i * sizeof(In), sizeof(In));
    values[i] = converted<Out>(encoding.swapped ? byte_swapped(value) : value);
  }
  return values;
}

template <class Number, class Out>
std::vector<Out> text_values(std::string_view text) {
  file_cursor at(text, "text");
  std::vector<Out> values;
  for (at.skip_space(); !at.at_end(); at.skip_space())
    values.push_back(converted<Out>(at.number<Number>()));
  return values;
}

template <class Out>
std::vector<Out> decode_vtk_array(const xml_element& array, const vtk_encoding& encoding,
                                  std::uint64_t expected) {
  const auto type = array.attribute("type");
  const auto format = array.attribute("format");
  const bool real = type.starts_with("Float");
  if (format == "ascii" || format.empty())
    return real ? text_values<double, Out>(array.text) : text_values<std::int64_t, Out>(array.text);
  if (format != "binary" && format != "appended")
    throw input_error("its format \"" + std::string(format) + "\" is unknown");
  if (type == "Float64")
    return binary_values<double, Out>(array, encoding, expected);
  if (type == "Float32")
    return binary_values<float, Out>(array, encoding, expected);
  if (type == "Int64")
    return binary_values<std::int64_t, Out>(array, encoding, expected);
  if (type == "UInt64")
    return binary_values<std::uint64_t, Out>(array, encoding, expected);
  if (type == "Int32")
    return binary_values<std::int32_t, Out>(array, encoding, expected);
  if (type == "UInt32")
    return binary_values<std::uint32_t, Out>(array, encoding, expected);
  if (type == "Int16")
    return binary_values<std::int16_t, Out>(array, encoding, expected);
  if (type == "UInt16")
    return binary_values<std::uint16_t, Out>(array, encoding, expected);
  if (type == "Int8")
    return binary_values<std::int8_t, Out>(array, encoding, expected);
  if (type == "UInt8")
    return binary_values<std::uint8_t, Out>(array, encoding, expected);
  throw input_error("its type \"" + std::string(type) + "\" is unknown");
}

} // namespace detail

/// The values of an array. Throws `input_error` naming the array (not the file) when they cannot be decoded,
/// do not fit the type Out, or are not `expected` many.
template <class Out>
std::vector<Out> read_vtk_array(const xml_element& array, const vtk_encoding& encoding,
                                std::uint64_t expected) {
  const auto name = "array \"" + xml_unescaped(array.attribute("Name")) + "\": ";
  try {
    auto values = detail::decode_vtk_array<Out>(array, encoding, expected);
    if (values.size() != expected)
      throw input_error(std::to_string(expected) + " values are expected, but there are " +
                        std::to_string(values.size()));
    return values;
  } catch (const input_error& problem) {
    throw input_error(name + problem.what());
  }
}

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/files/vtk_arrays.ipp"
#endif
