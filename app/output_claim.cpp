#include "output_claim.hpp"

#include "file_place.hpp"

#include "dovetail/core/error.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

namespace dovetail::app {
namespace {

/// Who holds the lock of an open file or folder, as the system lists it; 0 where it does not say. Some file
/// systems call their device there by another number.
pid_t holder_of(int descriptor) {
  struct stat found {};
  if (::fstat(descriptor, &found) != 0)
    return 0;
  pid_t likely = 0;
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    char kind[16]{};
    int holder = 0;
    unsigned device_major = 0, device_minor = 0;
    unsigned long number = 0;
    if (std::sscanf(line.c_str(), "%*d: %15s %*s %*s %d %x:%x:%lu", kind, &holder, &device_major,
                    &device_minor, &number) == 5 &&
        std::strcmp(kind, "FLOCK") == 0 && number == found.st_ino) {
      likely = holder;
      if (device_major == ::major(found.st_dev) && device_minor == ::minor(found.st_dev))
        return holder;
    }
  }
  return likely;
}

/// One that has ended stays until its parent asks how, and still has no lock of its own.
bool is_alive(pid_t process) {
  if (::kill(process, 0) != 0 && errno != EPERM)
    return false;
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(file, text);
  const std::size_t name_end = text.rfind(") ");
  return name_end == std::string::npos || name_end + 2 >= text.size() || text[name_end + 2] != 'Z';
}

/// Where the file system knows no locks it is as if nobody else were there.
bool is_held_by_another(int descriptor) {
  int result = 0;
  do
    result = ::flock(descriptor, LOCK_EX | LOCK_NB);
  while (result != 0 && errno == EINTR);
  return result != 0 && errno == EWOULDBLOCK;
}

/// Takes the lock. A process that was killed may have left some that are about to end: these are waited for.
void lock(int descriptor, const std::string& what, const std::string& remedy) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (is_held_by_another(descriptor)) {
    const pid_t holder = holder_of(descriptor);
    const bool ends = holder > 0 && !is_alive(holder) && std::chrono::steady_clock::now() < until;
    if (!ends)
      throw io_error(what + ": another process" +
                     (holder > 0 ? " (" + std::to_string(holder) + ")" : std::string()) +
                     " is writing there; wait until it has ended, or give another " + remedy);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

/// Whether a name still leads to what was opened by it.
bool leads_to(const std::filesystem::path& name, int descriptor) {
  struct stat named {
  }, opened{};
  return ::stat(name.c_str(), &named) == 0 && ::fstat(descriptor, &opened) == 0 &&
         named.st_dev == opened.st_dev && named.st_ino == opened.st_ino;
}

} // namespace

output_claim::output_claim(const command_outputs& outputs, bool leads) {
  try {
    if (leads && !outputs.folder.empty())
      take_folder("--out", outputs.folder);
    if (outputs.has_own_spool)
      take_folder("--spool", outputs.spool);
    if (leads)
      for (const named_file& each : outputs.files)
        if (!each.file.empty())
          take_file(each);
  } catch (...) {
    release();
    throw;
  }
}

output_claim::~output_claim() {
  release();
}

void output_claim::release() {
  for (const held_file& each : files_)
    if (leads_to(each.part, each.lock.get()))
      ::unlink(each.part.c_str());
  folders_.clear();
  files_.clear();
  locks_.clear();
}

/// Another process may remove the folder, which is empty at its end, while this one opens it.
void output_claim::take_folder(const char* option, const std::filesystem::path& folder) {
  for (;;) {
    folders_.emplace_back(folder);
    detail::owned_descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (opened.get() < 0)
      return; // it can be written to, as was just tried
    try {
      lock(opened.get(), std::string(option) + " " + folder.string(), "folder");
    } catch (const io_error&) {
      folders_.back().keep();
      throw;
    }
    if (leads_to(folder, opened.get())) {
      locks_.push_back(std::move(opened));
      return;
    }
    folders_.pop_back();
  }
}

void output_claim::take_file(const named_file& output) {
  const auto& file = output.file;
  const std::string what = output.option + " " + file.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw io_error(what + ": cannot write the file, there is a folder of this name");
  if (const auto folder = file.parent_path(); !folder.empty() && !std::filesystem::exists(folder, ignored))
    folders_.emplace_back(folder); // which goes again if nothing is written
  const auto part = temporary_name(file);
  if (!part) {
    if (::access(file.c_str(), W_OK) != 0)
      throw io_error(what + ": cannot write to it: " + std::strerror(errno));
    return;
  }
  for (;;) {
    detail::owned_descriptor opened(::open(part->c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666));
    if (opened.get() < 0)
      throw io_error(what + ": cannot create the file: " + std::strerror(errno));
    lock(opened.get(), what, "name");
    if (leads_to(*part, opened.get())) {
      files_.push_back({*part, std::move(opened)});
      return;
    }
  }
}

} // namespace dovetail::app
