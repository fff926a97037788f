/// @file
/// As much XML as VTK's and SVG's files use: elements, attributes, text. Views into the file's content;
/// nothing is copied.
#pragma once

#include "dovetail/core/input_file.hpp"

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
  std::string_view attribute(std::string_view key) const {
    for (const auto& [name_of, value] : attributes)
      if (name_of == key)
        return value;
    return {};
  }
  /// The first child of that name, or null.
  const xml_element* child(std::string_view name_of) const {
    for (const auto& element : children)
      if (element.name == name_of)
        return &element;
    return nullptr;
  }
};

/// Text with the five entities of XML resolved.
inline std::string xml_unescaped(std::string_view text) {
  constexpr std::pair<std::string_view, char> entities[] = {
      {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
  std::string plain;
  while (!text.empty()) {
    std::size_t length = 1;
    char c = text[0];
    for (const auto& [entity, meaning] : entities)
      if (text.starts_with(entity)) {
        length = entity.size();
        c = meaning;
      }
    plain += c;
    text.remove_prefix(length);
  }
  return plain;
}

/// Parses a file into its root element. The text of an element called `AppendedData` may be any bytes; it
/// ends at the last closing tag of that name. Throws `input_error` naming file and line.
class xml_parser {
public:
  xml_parser(std::string_view content, const std::string& name) : at_(content, name) {}

  /// The root element, with all that is in it.
  xml_element parse() {
    skip_prologue();
    if (!at_.rest().starts_with('<'))
      at_.fail("this is not an XML file");
    return element(0);
  }

private:
  static constexpr int deepest = 64;

  void skip_past(std::string_view end) {
    const auto found = at_.rest().find(end);
    if (found == std::string_view::npos)
      at_.fail("the file ends early: \"" + std::string(end) + "\" is missing");
    at_.skip(found + end.size());
  }
  /// Passes a comment, an instruction or the like, if one stands here.
  bool skip_aside() {
    if (at_.rest().starts_with("<!--"))
      skip_past("-->");
    else if (at_.rest().starts_with("<?"))
      skip_past("?>");
    else if (at_.rest().starts_with("<![CDATA["))
      skip_past("]]>");
    else if (at_.rest().starts_with("<!"))
      skip_declaration();
    else
      return false;
    return true;
  }
  /// A document type, which may have declarations of its own between brackets.
  void skip_declaration() {
    if (const auto found = at_.rest().find_first_of("[>"); found < at_.left() && at_.rest()[found] == '[')
      skip_past("]");
    skip_past(">");
  }
  void skip_prologue() {
    if (at_.rest().starts_with("\xef\xbb\xbf")) // a byte order mark
      at_.skip(3);
    do
      at_.skip_space();
    while (skip_aside());
  }
  std::string_view take(std::size_t length) {
    const auto text = at_.rest().substr(0, length);
    at_.skip(length);
    return text;
  }
  std::string_view identifier() {
    const auto text = take(std::min(at_.rest().find_first_of(" \t\r\n=/<>\""), at_.left()));
    if (text.empty())
      at_.fail("a name is expected");
    return text;
  }
  std::pair<std::string_view, std::string_view> attribute() {
    const auto name = identifier();
    at_.skip_space();
    if (!at_.rest().starts_with('='))
      at_.fail("the attribute \"" + std::string(name) + "\" has no value");
    at_.skip(1);
    at_.skip_space();
    const char quote = at_.at_end() ? ' ' : at_.rest().front();
    if (quote != '"' && quote != '\'')
      at_.fail("the value of \"" + std::string(name) + "\" is not in quotes");
    at_.skip(1);
    const auto end = at_.rest().find(quote);
    if (end == std::string_view::npos)
      at_.fail("the file ends in an attribute");
    const auto value = take(end);
    at_.skip(1);
    return {name, value};
  }

  xml_element element(int depth) {
    if (depth > deepest)
      at_.fail("elements are nested too deep");
    at_.skip(1); // '<'
    xml_element result;
    result.name = identifier();
    for (at_.skip_space(); !at_.rest().starts_with('>') && !at_.rest().starts_with("/>"); at_.skip_space()) {
      if (at_.at_end())
        at_.fail("the file ends in an element");
      result.attributes.push_back(attribute());
    }
    if (at_.rest().starts_with("/>")) {
      at_.skip(2);
      return result;
    }
    at_.skip(1);
    if (result.name == "AppendedData")
      appended(result);
    else
      content(result, depth);
    return result;
  }
  void appended(xml_element& result) {
    const auto end = at_.rest().rfind("</AppendedData");
    if (end == std::string_view::npos)
      at_.fail("the appended data end early");
    result.text = take(end);
    skip_past(">");
  }
  void content(xml_element& result, int depth) {
    for (bool first = true;;) {
      const auto text = take(std::min(at_.rest().find('<'), at_.left()));
      if (std::exchange(first, false))
        result.text = text;
      if (at_.at_end())
        at_.fail("the file ends early: </" + std::string(result.name) + "> is missing");
      if (at_.rest().starts_with("</")) {
        at_.skip(2);
        if (identifier() != result.name)
          at_.fail("</" + std::string(result.name) + "> is expected");
        skip_past(">");
        return;
      }
      if (!skip_aside())
        result.children.push_back(element(depth + 1));
    }
  }

  file_cursor at_;
};

} // namespace dovetail
