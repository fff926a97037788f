/// @file
/// What `xml_tree.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/xml_tree.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace dovetail {

DOVETAIL_INLINE std::string_view xml_element::attribute(std::string_view key) const {
  for (const auto& [name_of, value] : attributes)
    if (name_of == key)
      return value;
  return {};
}

DOVETAIL_INLINE const xml_element* xml_element::child(std::string_view name_of) const {
  for (const auto& element : children)
    if (element.name == name_of)
      return &element;
  return nullptr;
}

DOVETAIL_INLINE std::string xml_unescaped(std::string_view text) {
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

DOVETAIL_INLINE xml_element xml_parser::parse() {
  skip_prologue();
  if (!at_.rest().starts_with('<'))
    at_.fail("this is not an XML file");
  return element(0);
}

DOVETAIL_INLINE void xml_parser::skip_past(std::string_view end) {
  const auto found = at_.rest().find(end);
  if (found == std::string_view::npos)
    at_.fail("the file ends early: \"" + std::string(end) + "\" is missing");
  at_.skip(found + end.size());
}

DOVETAIL_INLINE bool xml_parser::skip_aside() {
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

DOVETAIL_INLINE void xml_parser::skip_prologue() {
  if (at_.rest().starts_with("\xef\xbb\xbf")) // a byte order mark
    at_.skip(3);
  do
    at_.skip_space();
  while (skip_aside());
}

DOVETAIL_INLINE std::string_view xml_parser::identifier() {
  const auto text = take(std::min(at_.rest().find_first_of(" \t\r\n=/<>\""), at_.left()));
  if (text.empty())
    at_.fail("a name is expected");
  return text;
}

DOVETAIL_INLINE std::pair<std::string_view, std::string_view> xml_parser::attribute() {
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

DOVETAIL_INLINE xml_element xml_parser::element(int depth) {
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

DOVETAIL_INLINE void xml_parser::appended(xml_element& result) {
  const auto end = at_.rest().rfind("</AppendedData");
  if (end == std::string_view::npos)
    at_.fail("the appended data end early");
  result.text = take(end);
  skip_past(">");
}

DOVETAIL_INLINE void xml_parser::content(xml_element& result, int depth) {
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

} // namespace dovetail
