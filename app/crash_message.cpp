#include "crash_message.hpp"

#include "failure.hpp"

#include <array>
#include <csignal>
#include <cstddef>
#include <unistd.h>

namespace dovetail::app {
namespace {

constexpr std::array crash_signals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

// A signal handler reaches nothing but what is at a fixed place, and allocates nothing.
std::string line_to_write;
std::array<struct sigaction, crash_signals.size()> actions_before;
std::array<char, std::size_t{64} << 10> stack_of_handler; // the other one may have overflowed
stack_t stack_before;

void write_line_and_end(int) {
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line_to_write.data(), line_to_write.size());
  _exit(exit_failure);
}

} // namespace

crash_message::crash_message(const std::string& text) {
  line_to_write = "dovetail: " + text + "\n";
  stack_t stack{};
  stack.ss_sp = stack_of_handler.data();
  stack.ss_size = stack_of_handler.size();
  sigaltstack(&stack, &stack_before);
  struct sigaction action {};
  action.sa_handler = write_line_and_end;
  action.sa_flags = SA_ONSTACK;
  for (std::size_t k = 0; k < crash_signals.size(); ++k)
    sigaction(crash_signals[k], &action, &actions_before[k]);
}

crash_message::~crash_message() {
  for (std::size_t k = 0; k < crash_signals.size(); ++k)
    sigaction(crash_signals[k], &actions_before[k], nullptr);
  sigaltstack(&stack_before, nullptr);
}

} // namespace dovetail::app
