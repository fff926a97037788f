/// @file
/// As much XML as VTK's and SVG's files use: elements, attributes, text. Views into the file's content;
/// nothing is copied.
#pragma once

#include "dovetail/core/input_file.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dovetail {

/// An element, with views into the file's content.
struct xml_element {
  std::string_view name;                                                 ///< of the tag
  std::vector<std::pair<std::string_view, std::string_view>> attributes; ///< names and values, in their order
  std::vector<xml_element> children;                                     ///< elements inside, in their order
  std::string_view text; ///< what stands before the first child, or all of it without children

  /// The value of an attribute as it stands in the file; empty when there is none.
  std::string_view attribute(std::string_view key) const;
  /// The first child of that name, or null.
  const xml_element* child(std::string_view name_of) const;
};

/// Text with the five entities of XML resolved.
std::string xml_unescaped(std::string_view text);

/// Parses a file into its root element. The text of an element called `AppendedData` may be any bytes; it
/// ends at the last closing tag of that name. Throws `input_error` naming file and line.
class xml_parser {
public:
  xml_parser(std::string_view content, const std::string& name) : at_(content, name) {}

  /// The root element, with all that is in it.
  xml_element parse();

private:
  static constexpr int deepest = 64;

  void skip_past(std::string_view end);
  /// Passes a comment, an instruction or the like, if one stands here.
  bool skip_aside();
  /// A document type, which may have declarations of its own between brackets.
  void skip_declaration() {
    if (const auto found = at_.rest().find_first_of("[>"); found < at_.left() && at_.rest()[found] == '[')
      skip_past("]");
    skip_past(">");
  }
  void skip_prologue();
  std::string_view take(std::size_t length) {
    const auto text = at_.rest().substr(0, length);
    at_.skip(length);
    return text;
  }
  std::string_view identifier();
  std::pair<std::string_view, std::string_view> attribute();

  xml_element element(int depth);
  void appended(xml_element& result);
  void content(xml_element& result, int depth);

  file_cursor at_;
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/core/xml_tree.ipp"
#endif
