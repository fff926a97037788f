#include "file_place.hpp"

#include <cctype>
#include <system_error>

#include <sys/stat.h>

namespace dovetail::app {
namespace {

/// Without links, as far as it exists.
std::filesystem::path resolved(const std::filesystem::path& name) {
  std::error_code failure;
  const auto whole = std::filesystem::absolute(name, failure);
  const auto found = std::filesystem::weakly_canonical(failure ? name : whole, failure);
  auto path = (failure ? whole : found).lexically_normal();
  return path.has_filename() ? path : path.parent_path(); // "folder/" is "folder"
}

std::optional<file_place> place_of_resolved(const std::filesystem::path& path) {
  std::filesystem::path rest;
  for (auto at = path; !at.empty(); at = at.parent_path()) {
    struct stat found {};
    if (::stat(at.c_str(), &found) == 0) {
      if (S_ISCHR(found.st_mode) || S_ISSOCK(found.st_mode))
        return std::nullopt;
      return file_place{found.st_dev, found.st_ino, rest};
    }
    rest = rest.empty() ? at.filename() : at.filename() / rest;
    if (at == at.root_path())
      break;
  }
  return std::nullopt;
}

} // namespace

std::optional<file_place> place_of(const std::filesystem::path& name) {
  return place_of_resolved(resolved(name));
}

std::optional<std::string> name_below(const std::filesystem::path& file,
                                      const std::filesystem::path& folder) {
  const auto around = place_of(folder);
  const auto whole = resolved(file);
  for (auto at = whole; around && !at.empty(); at = at.parent_path()) {
    if (place_of_resolved(at) == around)
      return whole.lexically_relative(at).generic_string();
    if (at == at.root_path())
      break;
  }
  return std::nullopt;
}

std::optional<std::filesystem::path> temporary_name(const std::filesystem::path& file) {
  std::error_code failure;
  const auto found = std::filesystem::status(file, failure);
  if (std::filesystem::exists(found) && !std::filesystem::is_regular_file(found) &&
      !std::filesystem::is_directory(found))
    return std::nullopt;
  const auto target = std::filesystem::is_symlink(std::filesystem::symlink_status(file, failure))
                          ? std::filesystem::canonical(file, failure)
                          : file;
  return (failure || target.empty() ? file : target).string() + ".part";
}

bool matches(const char* pattern, const char* name) {
  const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  switch (*pattern) {
  case 0:
    return *name == 0;
  case '*':
    return matches(pattern + 1, name) || (*name != 0 && matches(pattern, name + 1));
  case '#':
    return is_digit(*name) && (matches(pattern + 1, name + 1) || matches(pattern, name + 1));
  default:
    return *pattern == *name && matches(pattern + 1, name + 1);
  }
}

} // namespace dovetail::app
