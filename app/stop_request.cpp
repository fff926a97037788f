#include "stop_request.hpp"

#include <csignal>

namespace dovetail::app {
namespace {

volatile std::sig_atomic_t stop_flag = 0; // a signal handler can reach nothing else

void note_request(int) {
  stop_flag = 1;
}

} // namespace

std::vector<int> stop_signals() {
  std::vector<int> signals{SIGINT, SIGTERM};
  for (const int signal : {SIGHUP, SIGQUIT}) {
    struct sigaction present {};
    if (::sigaction(signal, nullptr, &present) == 0 && present.sa_handler != SIG_IGN)
      signals.push_back(signal);
  }
  return signals;
}

void catch_stop_signals() {
  for (const int signal : stop_signals())
    std::signal(signal, note_request);
  std::signal(SIGXFSZ, SIG_IGN); // a limit to the size of files is then an error like a full disk
}

bool stop_was_requested() {
  return stop_flag != 0;
}

} // namespace dovetail::app
