/// @file
/// PLY, text and binary of either byte order.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/models/discrete/soup.hpp"
#include "dovetail/models/discrete/text_scanner.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace dovetail::discrete {

/// What the header of a PLY file announces.
struct ply_header {
  /// A value of each item of an element.
  struct property {
    std::string name;       ///< as the file calls it
    std::string type;       ///< as the file calls it
    std::string count_type; ///< of a list; empty for a scalar
  };
  /// A list of items of one kind.
  struct element {
    std::string name;                 ///< as the file calls it
    std::size_t count = 0;            ///< how many items there are
    std::vector<property> properties; ///< in the order they are stored
  };

  bool text = false;             ///< whether values are text
  bool big_endian = false;       ///< of binary values
  std::vector<element> elements; ///< in the order they are stored
  std::size_t size = 0;          ///< bytes up to the data
};

/// Reads the header. Throws `input_error` naming the file when it is damaged.
inline ply_header parse_ply_header(std::string_view data, const std::string& file) {
  ply_header header;
  const std::size_t end = data.find("end_header");
  if (!data.starts_with("ply") || end == std::string_view::npos ||
      data.find('\n', end) == std::string_view::npos)
    throw input_error(file + ": this is not a PLY file, or its header is truncated");
  header.size = data.find('\n', end) + 1;
  text_scanner in(data.substr(0, header.size), file);
  while (in.next_line("comment")) {
    const std::string_view key = in.word();
    if (key == "format") {
      const std::string_view format = in.word();
      header.text = format == "ascii";
      header.big_endian = format == "binary_big_endian";
      if (!header.text && !header.big_endian && format != "binary_little_endian")
        in.fail("unknown PLY format \"" + std::string(format) + "\"");
    } else if (key == "element") {
      const std::string name(in.word());
      const long count = in.integer();
      if (count < 0)
        in.fail("a negative number of elements");
      header.elements.push_back({name, static_cast<std::size_t>(count), {}});
    } else if (key == "property") {
      if (header.elements.empty())
        in.fail("a property before any element");
      std::string type(in.word());
      std::string count_type;
      if (type == "list") {
        count_type = in.word();
        type = in.word();
      }
      header.elements.back().properties.push_back({std::string(in.word()), type, count_type});
    }
  }
  return header;
}

/// The least number of bytes that one of these elements takes in a file: a header may announce anything.
inline std::size_t least_ply_bytes(const ply_header::element& element, bool text) {
  std::size_t bytes = 0;
  for (const auto& property : element.properties) {
    const std::string& type = property.count_type.empty() ? property.type : property.count_type;
    const bool wide = type == "double" || type == "float64";
    const bool narrow = type.ends_with("char") || type.ends_with("int8");
    const bool half = type.ends_with("short") || type.ends_with("int16");
    bytes += text || narrow ? 1 : half ? 2 : wide ? 8 : 4;
  }
  return std::max<std::size_t>(bytes, 1);
}

/// Takes the values of a PLY file one after the other, whatever its format.
class ply_values {
public:
  ply_values(std::string_view data, const ply_header& header, std::string file)
      : data_(data.substr(header.size)), text_(header.text),
        swap_(header.big_endian != (std::endian::native == std::endian::big)), scanner_(data_, file),
        file_(std::move(file)) {}

  /// The next value, which is of that type. Throws `input_error` when the file ends before it.
  double next(const std::string& type) {
    if (text_)
      return next_word();
    if (type == "float" || type == "float32")
      return static_cast<double>(take<float>());
    if (type == "double" || type == "float64")
      return take<double>();
    if (type == "uchar" || type == "uint8")
      return take<std::uint8_t>();
    if (type == "char" || type == "int8")
      return take<std::int8_t>();
    if (type == "ushort" || type == "uint16")
      return take<std::uint16_t>();
    if (type == "short" || type == "int16")
      return take<std::int16_t>();
    if (type == "uint" || type == "uint32")
      return take<std::uint32_t>();
    if (type == "int" || type == "int32")
      return take<std::int32_t>();
    throw input_error(file_ + ": unknown PLY type \"" + type + "\"");
  }

private:
  double next_word() {
    while (scanner_.at_line_end())
      if (!scanner_.next_line())
        truncated();
    return scanner_.number();
  }
  template <class T>
  T take() {
    if (data_.size() < sizeof(T))
      truncated();
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), data_.data(), sizeof(T));
    data_.remove_prefix(sizeof(T));
    if (swap_)
      std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }
  [[noreturn]] void truncated() const {
    throw input_error(file_ + ": the PLY file is truncated; export it again");
  }

  std::string_view data_;
  bool text_;
  bool swap_;
  text_scanner scanner_;
  std::string file_;
};

/// The elements "vertex" (x, y, z) and "face" (vertex_indices or vertex_index); others are skipped.
inline triangle_soup parse_ply(std::string_view data, const std::string& file) {
  const ply_header header = parse_ply_header(data, file);
  ply_values values(data, header, file);
  triangle_soup soup;
  std::vector<local_id> corners;
  for (const auto& element : header.elements) {
    if (element.count > (data.size() - header.size) / least_ply_bytes(element, header.text))
      throw input_error(file + ": the PLY file is truncated or foreign: it announces " +
                        std::to_string(element.count) + " elements \"" + element.name +
                        "\", and has no room for them; export it again");
    for (std::size_t i = 0; i < element.count; ++i) {
      vec3 point;
      corners.clear();
      for (const auto& property : element.properties) {
        const bool list = !property.count_type.empty();
        const double count = list ? values.next(property.count_type) : 1;
        const bool is_corners = list && element.name == "face" &&
                                (property.name == "vertex_indices" || property.name == "vertex_index");
        for (double k = 0; k < count; ++k) {
          const double value = values.next(property.type);
          if (is_corners) {
            if (!(value >= 0) || value >= static_cast<double>(soup.points.size()))
              throw input_error(file + ": face " + std::to_string(i) +
                                " refers to a vertex that does not exist");
            corners.push_back(static_cast<local_id>(value));
          } else if (!list && (property.name == "x" || property.name == "y" || property.name == "z")) {
            point[property.name[0] - 'x'] = value;
          }
        }
      }
      if (element.name == "vertex") {
        if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z))
          throw input_error(file + ": vertex " + std::to_string(i) + " has a coordinate that is not finite");
        soup.points.push_back(point);
      } else if (element.name == "face") {
        append_polygon(soup, corners, no_id);
      }
    }
  }
  return soup;
}

} // namespace dovetail::discrete
