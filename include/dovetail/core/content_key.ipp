/// @file
/// What `content_key.hpp` declares.
#pragma once

#include "dovetail/core/content_key.hpp"
#include "dovetail/core/linkage.hpp"

#include <cstddef>
#include <string>

namespace dovetail {

DOVETAIL_INLINE std::string to_string(content_key key) {
  constexpr const char* digits = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t k = text.size(); k-- > 0; key.value >>= 4)
    text[k] = digits[key.value & 15];
  return text;
}

} // namespace dovetail
