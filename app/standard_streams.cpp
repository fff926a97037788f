#include "standard_streams.hpp"

#include <cerrno>
#include <csignal>
#include <initializer_list>

#include <fcntl.h>
#include <unistd.h>

namespace dovetail::app {

void open_closed_streams() {
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(standard, F_GETFD) < 0 && errno == EBADF)
      ::open("/dev/null", O_RDWR); // which takes the lowest number that is free: this one
}

void outlive_readers() {
  std::signal(SIGPIPE, SIG_IGN);
}

} // namespace dovetail::app
