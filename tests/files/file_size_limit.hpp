/// @file
/// Files that cannot be written to their end.
#pragma once

#include <csignal>
#include <sys/resource.h>

namespace dovetail::testing {

/// While it lives, no file may grow beyond a number of bytes: the nearest thing to a full disk.
class file_size_limit {
public:
  explicit file_size_limit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit lowered{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &lowered);
  }
  ~file_size_limit() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }

  file_size_limit(const file_size_limit&) = delete;
  file_size_limit& operator=(const file_size_limit&) = delete;

private:
  void (*old_handler_)(int);
  rlimit old_{};
};

} // namespace dovetail::testing
