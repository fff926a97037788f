/// @file
/// For tests of readers: is a mesh the one that was written, and what is said of a file with one thing
/// changed?
#pragma once

#include "files/scratch_folder.hpp"
#include "support/refusal.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail::testing {

/// The elements by the places of their corners, whatever the numbers of these, with what they turn and their
/// tags.
template <std::size_t N>
auto by_places(const std::vector<vec3>& points, const std::vector<std::array<local_id, N>>& simplices,
               const std::vector<local_id>& tags) {
  using place = std::tuple<double, double, double>;
  std::vector<std::tuple<std::array<place, N>, bool, local_id>> all;
  for (std::size_t e = 0; e < simplices.size(); ++e) {
    std::array<place, N> corners;
    for (std::size_t k = 0; k < N; ++k) {
      const vec3 p = points[simplices[e][k]];
      corners[k] = {p.x, p.y, p.z};
    }
    bool odd = false;
    for (std::size_t a = 0; a < N; ++a)
      for (std::size_t b = a + 1; b < N; ++b)
        odd = odd != (corners[b] < corners[a]);
    std::sort(corners.begin(), corners.end());
    all.emplace_back(corners, odd, tags[e]);
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// The lines of a text file, to be changed.
struct text_lines {
  explicit text_lines(std::filesystem::path path) : path_(std::move(path)) {
    std::istringstream stream(file_content(path_));
    for (std::string line; std::getline(stream, line);)
      lines.push_back(line);
  }
  /// The first line from `from` on that begins so.
  std::size_t find(const std::string& begin, std::size_t from = 0) const {
    while (from < lines.size() && !lines[from].starts_with(begin))
      ++from;
    REQUIRE_MESSAGE(from < lines.size(), "no line begins with " << begin);
    return from;
  }
  void write() const {
    std::string text;
    for (const std::string& line : lines)
      text += line + "\n";
    write_content(path_, text);
  }

  std::vector<std::string> lines;

private:
  std::filesystem::path path_;
};

/// Expects an `input_error` with `expected` in it while a file is changed.
template <class Read>
void expect_refusal(const std::filesystem::path& file, const std::string& expected,
                    const std::function<void(text_lines&)>& change, const Read& read) {
  CAPTURE(expected);
  const std::string before = file_content(file);
  text_lines changed(file);
  change(changed);
  changed.write();
  REQUIRE(file_content(file) != before);
  const std::string said = refusal_of<input_error>(read);
  CHECK_MESSAGE(said.find(expected) != std::string::npos, said);
  CHECK_MESSAGE(said.find(file.parent_path().parent_path().parent_path().parent_path().string()) == 0, said);
  write_content(file, before);
}

/// Expects that a file is refused wherever it ends.
template <class Read>
void expect_refusal_when_cut(const std::filesystem::path& file, std::size_t cuts, const Read& read) {
  const std::string before = file_content(file);
  for (std::size_t cut = 0; cut < cuts; ++cut) {
    CAPTURE(cut);
    write_content(file, before.substr(0, before.size() * cut / cuts));
    CHECK_THROWS_AS(read(), input_error);
  }
  write_content(file, before.substr(0, before.size() - 2));
  CHECK_THROWS_AS(read(), input_error);
  write_content(file, before);
}

/// Changes one byte after the other, each time another one: the file is read or refused, whatever it says.
template <class Read>
void expect_reading_or_refusal(const std::filesystem::path& file, int changes, const Read& read) {
  const std::string before = file_content(file);
  std::size_t at = 0;
  for (int k = 0; k < changes; ++k) {
    at = (at + 7919 + before.size() / 3) % before.size();
    std::string changed = before;
    changed[at] = "0123456789(){}- \n;x\xff"[k % 20];
    write_content(file, changed);
    CAPTURE(at);
    try {
      read();
    } catch (const input_error&) {
    } catch (const std::exception& problem) {
      FAIL_CHECK(problem.what());
    }
  }
  write_content(file, before);
}

} // namespace dovetail::testing
