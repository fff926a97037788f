/// @file
/// What `input_file.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/input_file.hpp"
#include "dovetail/core/linkage.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

namespace dovetail {

DOVETAIL_INLINE std::string read_file(const std::filesystem::path& path, std::uintmax_t most) {
  std::error_code failure;
  if (!std::filesystem::exists(path, failure))
    throw input_error(path.string() + ": there is no such file");
  if (!std::filesystem::is_regular_file(path, failure))
    throw input_error(path.string() + ": this is not a file");
  const auto size = std::min(std::filesystem::file_size(path, failure), most);
  std::ifstream stream(path, std::ios::binary);
  if (failure || !stream)
    throw input_error(path.string() + ": the file cannot be read; check its permissions");
  if (size == 0)
    throw input_error(path.string() + ": the file is empty");
  std::string content(static_cast<std::size_t>(size), '\0');
  stream.read(content.data(), static_cast<std::streamsize>(size));
  if (stream.gcount() != static_cast<std::streamsize>(size))
    throw input_error(path.string() + ": the file cannot be read to its end");
  return content;
}

DOVETAIL_INLINE void file_cursor::skip_space() {
  while (at_ < content_.size() && is_space(content_[at_]))
    ++at_;
}

DOVETAIL_INLINE std::string_view file_cursor::word() {
  skip_space();
  const auto first = at_;
  while (at_ < content_.size() && !is_space(content_[at_]))
    ++at_;
  return content_.substr(first, at_ - first);
}

DOVETAIL_INLINE std::string_view file_cursor::line() {
  const auto end = std::min(content_.find('\n', at_), content_.size());
  auto text = content_.substr(at_, end - at_);
  at_ = std::min(end + 1, content_.size());
  if (text.ends_with('\r'))
    text.remove_suffix(1);
  return text;
}

DOVETAIL_INLINE std::size_t file_cursor::plausible(std::uint64_t count, std::size_t bytes_each) const {
  if (count > left() / std::max<std::size_t>(bytes_each, 1))
    fail("the file ends early: " + std::to_string(count) + " entries are announced");
  return static_cast<std::size_t>(count);
}

DOVETAIL_INLINE void file_cursor::fail(const std::string& what) const {
  const auto passed = content_.substr(0, at_);
  const bool binary = passed.find('\0') != std::string_view::npos;
  const auto place = binary ? "byte " + std::to_string(at_)
                            : "line " + std::to_string(1 + std::count(passed.begin(), passed.end(), '\n'));
  throw input_error(name_ + ": " + place + ": " + what);
}

} // namespace dovetail
