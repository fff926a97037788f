/// @file
/// A JSON document that remembers its lines. An adapter: with json.hpp the only file that includes
/// nlohmann-json.
#pragma once

#include "dovetail/core/error.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dovetail::sizing {

/// A JSON value with the line it stands on (the line of its key, for a member of an object).
struct json_value {
  /// What kind of value it is: `null`, `boolean`, `number`, `text`, `array` or `object`.
  enum class kind { null, boolean, number, text, array, object };

  kind type = kind::null;             ///< which kind it is
  std::size_t line = 0;               ///< of the file, from 1
  bool boolean = false;               ///< of a `kind::boolean`
  double number = 0;                  ///< of a `kind::number`
  std::string text = {};              ///< of a `kind::text`
  std::vector<json_value> items = {}; ///< of an array, or an object's in the file's order
  /// Of an object's items. Pairs of key and item would be one member, which clang 22 with the library of g++
  /// 16 does not take: pairs ask whether this type can be made before it is known how.
  std::vector<std::string> keys = {};

  /// The member of that name, or null.
  const json_value* find(std::string_view key) const {
    const auto found = std::find(keys.begin(), keys.end(), key);
    return found == keys.end() ? nullptr : &items[static_cast<std::size_t>(found - keys.begin())];
  }
};

namespace detail {

/// Walks characters and counts the lines passed; copies share the count.
class line_counting_iterator {
public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  line_counting_iterator(const char* at, std::size_t* line) : at_(at), line_(line) {}

  reference operator*() const { return *at_; }
  line_counting_iterator& operator++() {
    if (*at_ == '\n')
      ++*line_;
    ++at_;
    return *this;
  }
  line_counting_iterator operator++(int) {
    auto old = *this;
    ++*this;
    return old;
  }
  friend bool operator==(const line_counting_iterator& a, const line_counting_iterator& b) {
    return a.at_ == b.at_;
  }

private:
  const char* at_;
  std::size_t* line_;
};

/// Builds the tree from the parser's events.
class json_tree_builder {
public:
  json_tree_builder(const std::string& file, const std::size_t* line) : file_(file), line_(line) {}

  json_value take() { return std::move(root_); }

  bool null() { return add({.type = json_value::kind::null}); }
  bool boolean(bool value) { return add({.type = json_value::kind::boolean, .boolean = value}); }
  bool number_integer(nlohmann::json::number_integer_t value) { return number(static_cast<double>(value)); }
  bool number_unsigned(nlohmann::json::number_unsigned_t value) { return number(static_cast<double>(value)); }
  bool number_float(double value, const std::string&) { return number(value); }
  bool string(std::string& value) { return add({.type = json_value::kind::text, .text = value}); }
  bool binary(nlohmann::json::binary_t&) { return false; }
  bool start_object(std::size_t) { return open(json_value::kind::object); }
  bool start_array(std::size_t) { return open(json_value::kind::array); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  bool key(std::string& name) {
    if (const json_value* other = open_.back()->find(name))
      throw sizing_error(file_ + ":" + std::to_string(*line_) + ": key \"" + name +
                         "\" is given twice, first on line " + std::to_string(other->line) + "; keep one");
    key_ = name;
    key_line_ = *line_;
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& e) {
    throw input_error(file_ + ":" + std::to_string(*line_) + ": not valid JSON: " + e.what());
  }

private:
  static constexpr std::size_t deepest = 64; ///< whoever walks through the tree does it by recursion

  bool number(double value) { return add({.type = json_value::kind::number, .number = value}); }

  json_value* place(json_value value) {
    if (open_.empty()) {
      value.line = *line_;
      root_ = std::move(value);
      return &root_;
    }
    json_value& parent = *open_.back();
    const bool has_key = parent.type == json_value::kind::object;
    value.line = has_key ? key_line_ : *line_;
    if (has_key)
      parent.keys.push_back(key_);
    parent.items.push_back(std::move(value));
    return &parent.items.back();
  }
  bool add(json_value value) {
    place(std::move(value));
    return true;
  }
  bool open(json_value::kind type) {
    if (open_.size() == deepest)
      throw input_error(file_ + ":" + std::to_string(*line_) + ": values are nested more than " +
                        std::to_string(deepest) + " deep; this is no sizing file");
    open_.push_back(
        place({.type = type})); // its parent does not grow before it is closed: the pointer stays valid
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  const std::string& file_;
  const std::size_t* line_;
  json_value root_;
  std::vector<json_value*> open_;
  std::string key_;
  std::size_t key_line_ = 0;
};

} // namespace detail

/// Parses JSON text; `file` names it in messages. Throws `input_error` when it is not JSON or nested too
/// deep, `sizing_error` when an object has a key twice; both name the line.
inline json_value parse_json(const std::string& text, const std::string& file) {
  std::size_t line = 1;
  const char* begin = text.data();
  detail::json_tree_builder builder(file, &line);
  nlohmann::json::sax_parse(detail::line_counting_iterator(begin, &line),
                            detail::line_counting_iterator(begin + text.size(), &line), &builder);
  return builder.take();
}

} // namespace dovetail::sizing
