#include "stop_request.hpp"

#include <csignal>

namespace dovetail::app {
namespace {

volatile std::sig_atomic_t stop_flag = 0; // a signal handler can reach nothing else

void note_request(int) {
  stop_flag = 1;
}

} // namespace

void catch_stop_signals() {
  std::signal(SIGINT, note_request);
  std::signal(SIGTERM, note_request);
  std::signal(SIGXFSZ, SIG_IGN); // a limit to the size of files is then an error like a full disk
}

bool stop_was_requested() {
  return stop_flag != 0;
}

} // namespace dovetail::app
