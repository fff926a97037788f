/// @file
/// JSON documents as text, whatever bytes are in them.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace dovetail::app {

/// On one line, or indented by so many spaces. Names of files and CAD entities may be any bytes: what is not
/// UTF-8 is replaced by the sign for that, since no JSON can hold it. `ascii`: other signs are escaped.
template <class Json>
std::string text_of_json(const Json& document, int indentation = -1, bool ascii = false) {
  return document.dump(indentation, ' ', ascii, Json::error_handler_t::replace);
}

inline bool is_utf8(const std::string& text) {
  try {
    static_cast<void>(nlohmann::json(text).dump());
    return true;
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
}

/// The bytes of a text that is none in JSON, as two hexadecimal digits each.
inline std::string digits_of_bytes(const std::string& bytes) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (const char byte : bytes) {
    const auto value = static_cast<unsigned char>(byte);
    text += {digits[value >> 4U], digits[value & 15U]};
  }
  return text;
}
/// Throws `std::logic_error` where there are no such digits.
inline std::string bytes_of_digits(const std::string& digits) {
  std::string bytes;
  for (std::size_t k = 0; k < digits.size(); k += 2)
    bytes += static_cast<char>(std::stoi(digits.substr(k, 2), nullptr, 16));
  return bytes;
}

} // namespace dovetail::app
