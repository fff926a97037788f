/// @file
/// Decodes the data arrays of VTK's XML files: text, base64 and raw, inline and appended, plain and, with
/// somebody's help, compressed by zlib, either byte order.
#pragma once

#include "dovetail/core/input_file.hpp"
#include "dovetail/core/xml_tree.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
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
  std::vector<std::uint8_t> take(std::uint64_t count) {
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
  std::uint8_t next_decoded() {
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
inline vtk_encoding read_vtk_encoding(const xml_element& root, vtk_expander expand) {
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
    const auto compressed = source.take(compressed_sizes[static_cast<std::size_t>(b)]);
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

/// The bytes of a binary array, which its header counts; compressed ones may be `most`.
inline std::vector<std::uint8_t> array_bytes(const xml_element& array, const vtk_encoding& encoding,
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
