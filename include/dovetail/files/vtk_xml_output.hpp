/// @file
/// The parts of VTK's XML formats that all our writers share: data arrays whose values follow the XML as raw
/// appended data, and string arrays in the field data.
#pragma once

#include "dovetail/core/output_file.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dovetail::io {

/// VTK's name of a number type.
template <class T>
constexpr const char* vtk_type = nullptr;
template <>
inline constexpr const char* vtk_type<double> = "Float64"; ///< what VTK's XML calls the type
template <>
inline constexpr const char* vtk_type<std::int32_t> = "Int32"; ///< what VTK's XML calls the type
template <>
inline constexpr const char* vtk_type<std::int64_t> = "Int64"; ///< what VTK's XML calls the type
template <>
inline constexpr const char* vtk_type<std::uint8_t> = "UInt8"; ///< what VTK's XML calls the type

/// Writes the XML elements of arrays whose values follow in the appended section, and hands out their places
/// there. The values must then be written in the same order.
class appended_layout {
public:
  explicit appended_layout(output_file& file) : file_(file) {}

  /// The XML element of the next array, of `tuples` times `components` values of type T. Returns where its
  /// first value is, from the beginning of the appended section.
  template <class T>
  std::uint64_t array(std::string_view name, std::uint64_t tuples, int components = 1) {
    file_.text("<DataArray type=\"");
    file_.text(vtk_type<T>);
    file_.text("\" Name=\"");
    file_.text(name);
    file_.text("\" NumberOfComponents=\"");
    file_.number(components);
    file_.text("\" format=\"appended\" offset=\"");
    file_.number(next_);
    file_.text("\"/>\n");
    const std::uint64_t values = next_ + sizeof(std::uint64_t);
    next_ = values + tuples * static_cast<std::uint64_t>(components) * sizeof(T);
    return values;
  }

private:
  output_file& file_;
  std::uint64_t next_ = 0;
};

/// Writes the values of an array as the appended section wants them: byte count, then bytes.
template <class T>
void append_values(output_file& file, std::span<const T> values) {
  file.value<std::uint64_t>(values.size_bytes());
  file.array(values);
}

/// The same for `count` values computed one by one, value i being `at(i)`.
template <class T, class Function>
void append_computed(output_file& file, std::uint64_t count, Function at) {
  file.value<std::uint64_t>(count * sizeof(T));
  for (std::uint64_t i = 0; i < count; ++i)
    file.value<T>(at(i));
}

/// VTK's number of a type of elements.
inline std::uint8_t vtk_cell_type(int dimension, bool second_order) {
  if (dimension == 1)
    return 3;
  if (second_order)
    return dimension == 3 ? 24 : 22;
  return dimension == 3 ? 10 : 5;
}

/// The text between the opening of a VTK XML file and its data.
inline std::string vtk_xml_opening(const std::string& kind) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + kind +
         "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n";
}

/// Text as the value of an XML attribute.
inline std::string xml_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped += c;
  }
  return escaped;
}

/// A string array of the field data. VTK stores it as the codes of its characters, each string ending in 0.
inline std::string vtk_string_array(const std::string& name, const std::vector<std::string>& strings) {
  std::string xml = "<Array type=\"String\" Name=\"" + name + "\" NumberOfTuples=\"" +
                    std::to_string(strings.size()) + "\" format=\"ascii\">\n";
  for (const auto& s : strings) {
    for (const char c : s)
      xml += std::to_string(static_cast<unsigned char>(c)) + ' ';
    xml += "0\n";
  }
  return xml + "</Array>\n";
}

/// A `<FieldData>` element of string arrays; empty ones are left out.
inline std::string
vtk_field_data(const std::vector<std::pair<std::string, std::vector<std::string>>>& arrays) {
  std::string xml = "<FieldData>\n";
  for (const auto& [name, strings] : arrays)
    if (!strings.empty())
      xml += vtk_string_array(name, strings);
  return xml + "</FieldData>\n";
}

} // namespace dovetail::io
