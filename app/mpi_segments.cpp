#include "mpi_segments.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

namespace dovetail::app {
namespace {

namespace fs = std::filesystem;

struct segment {
  fs::path file;
  ino_t number;
};
using segments = std::vector<segment>;

/// Returns whether all were seen.
template <class F>
bool for_each_in(const fs::path& folder, const F& f) {
  std::error_code problem;
  for (fs::directory_iterator at(folder, problem); !problem && at != fs::directory_iterator();
       at.increment(problem))
    f(at->path());
  return !problem;
}

/// As Open MPI calls them up to version 4, and from 5 on.
bool is_segment(const std::string& name) {
  return name.starts_with("vader_segment.") || name.starts_with("sm_segment.");
}

segments segments_in(const fs::path& folder) {
  segments found;
  for_each_in(folder, [&](const fs::path& entry) {
    struct stat file {};
    if (is_segment(entry.filename().string()) && ::lstat(entry.c_str(), &file) == 0 &&
        S_ISREG(file.st_mode) && file.st_uid == ::geteuid())
      found.push_back({entry, file.st_ino});
  });
  return found;
}

void drop(segments& from, ino_t number) {
  std::erase_if(from, [&](const segment& one) { return one.number == number; });
}

/// By their numbers alone: some file systems call their device in /proc by another one than elsewhere.
void drop_open(segments& from, const fs::path& process) {
  for_each_in(process / "fd", [&](const fs::path& descriptor) {
    struct stat file {};
    if (::stat(descriptor.c_str(), &file) == 0)
      drop(from, file.st_ino);
  });
}

void drop_mapped(segments& from, const fs::path& process) {
  std::ifstream maps(process / "maps");
  for (std::string line; std::getline(maps, line);) {
    unsigned long number = 0;
    if (std::sscanf(line.c_str(), "%*x-%*x %*s %*x %*x:%*x %lu", &number) == 1)
      drop(from, static_cast<ino_t>(number));
  }
}

bool is_process(const fs::path& entry) {
  const std::string name = entry.filename().string();
  return std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// A process opens a segment, maps it, and closes it then: who looks in this order sees one of the two. What
/// another process of the same user may not see has more rights than ranks have.
void drop_living(segments& from) {
  const bool all_seen = for_each_in("/proc", [&](const fs::path& entry) {
    struct stat process {};
    if (!is_process(entry) || ::stat(entry.c_str(), &process) != 0 || process.st_uid != ::geteuid())
      return;
    drop_open(from, entry);
    drop_mapped(from, entry);
  });
  if (!all_seen)
    from.clear();
}

} // namespace

void remove_dead_mpi_segments(const fs::path& folder) {
  segments found = segments_in(folder);
  if (!found.empty())
    drop_living(found);
  for (const segment& dead : found)
    ::unlink(dead.file.c_str());
}

} // namespace dovetail::app
