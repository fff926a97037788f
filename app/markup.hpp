/// @file
/// HTML and SVG as text, which is well-formed as XML too.
#pragma once

#include "fixed.hpp"
#include "json_text.hpp"

#include "dovetail/files/vtk_xml_output.hpp"

#include <nlohmann/json.hpp>

#include <initializer_list>
#include <string>
#include <string_view>

namespace dovetail::app {

/// Any bytes as content or an attribute's value: what is no text is replaced by the sign for that.
inline std::string escaped(const std::string& text) {
  std::string shown;
  for (const char c : nlohmann::json::parse(text_of_json(nlohmann::json(text))).get<std::string>()) {
    if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t')
      shown += "\xef\xbf\xbd";
    else
      shown += c;
  }
  return io::xml_escaped(shown);
}

/// Of an element; numbers are those of pixels, to a tenth.
struct markup_attribute {
  std::string_view name;
  std::string value; ///< as it is between the quotes

  markup_attribute(std::string_view named, const std::string& text) : name(named), value(escaped(text)) {}
  markup_attribute(std::string_view named, const char* text) : name(named), value(escaped(text)) {}
  markup_attribute(std::string_view named, double number) : name(named), value(fixed(number)) {
    if (value.ends_with(".0"))
      value.resize(value.size() - 2);
    if (value == "-0")
      value = "0";
  }
};

/// An element with content that is markup itself. Without any it has an end nevertheless, where it is one
/// that may have content: HTML has no other.
inline std::string element(const std::string& name, std::initializer_list<markup_attribute> attributes,
                           const std::string& content = {}) {
  std::string text = "<" + name;
  for (const auto& [key, value] : attributes)
    text.append(" ").append(key).append("=\"").append(value).append("\"");
  for (const std::string_view alone : {"img", "line", "rect", "circle", "polyline"})
    if (content.empty() && name == alone)
      return text + "/>\n";
  return text + ">" + content + "</" + name + ">\n";
}

inline std::string paragraph(const std::string& text) {
  return element("p", {}, escaped(text));
}

/// Puts a text in the place of the first such mark.
inline void put_in(std::string& page, const std::string& mark, const std::string& text) {
  page.replace(page.find(mark), mark.size(), text);
}

} // namespace dovetail::app
