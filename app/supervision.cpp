#include "supervision.hpp"

#include "failure.hpp"
#include "stop_request.hpp"

#include "dovetail/distributed/stack_overflow.hpp"
#include "dovetail/parallel/run_task.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <thread>
#include <vector>

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace dovetail::app {
namespace {

using clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds patience{800};    ///< from the request to stop to the end
constexpr std::chrono::milliseconds one_request{200}; ///< a signal comes twice, to a process and to its group

/// What both processes see: the lines for the step that the child is in.
struct shared_lines {
  std::array<char, 2048> crashed;
  std::array<char, 2048> endless;
  std::array<char, 2048> killed;
  std::array<char, 2048> out_of_stack;
  volatile bool stack_is_used_up;
};
shared_lines* lines = nullptr;

sigset_t set_of(const std::vector<int>& signals) {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : signals)
    sigaddset(&set, signal);
  return set;
}

std::string line_of(int signal) {
  if (lines != nullptr && lines->stack_is_used_up)
    return lines->crashed[0] != 0 ? lines->out_of_stack.data()
                                  : std::string("ended: ") + detail::out_of_stack;
  if (lines != nullptr && lines->crashed[0] != 0)
    return (signal == SIGXCPU ? lines->endless : signal == SIGKILL ? lines->killed : lines->crashed).data();
  return "ended by signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")" +
         (signal == SIGKILL ? ", perhaps for want of memory" : "");
}

void copy(const std::string& text, std::array<char, 2048>& to) {
  std::snprintf(to.data(), to.size(), "%s", text.c_str());
}

} // namespace

supervisor::supervisor() {
  void* const memory =
      ::mmap(nullptr, sizeof(shared_lines), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  lines = memory == MAP_FAILED ? nullptr : static_cast<shared_lines*>(memory);
  share_complaints();
  ::prctl(PR_SET_CHILD_SUBREAPER, 1); // the workers of a child that is gone can be waited for
  std::signal(SIGCHLD, SIG_DFL);      // who started us may ignore it, and then nothing is left to wait for
  auto watched_signals = stop_signals();
  watched_signals.push_back(SIGCHLD);
  signals_ = set_of(watched_signals);
  sigprocmask(SIG_BLOCK, &signals_, &before_);
  std::fflush(nullptr);
  const pid_t self = ::getpid();
  child_ = ::fork();
  if (child_ > 0)
    return;
  if (child_ == 0)
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (child_ == 0 && ::getppid() != self)
    ::_exit(exit_failure);
  if (child_ < 0)
    lines = nullptr; // nobody would read them
  catch_stop_signals();
  if (child_ == 0 && lines != nullptr)
    detail::on_stack_overflow([] { lines->stack_is_used_up = true; });
  sigprocmask(SIG_SETMASK, &before_, nullptr);
}

supervisor::~supervisor() {
  if (supervises())
    sigprocmask(SIG_SETMASK, &before_, nullptr);
}

bool supervisor::has_ended(std::chrono::milliseconds at_most, const std::function<bool()>& passes_on) {
  if (over_)
    return true;
  const timespec time{0, static_cast<long>(at_most.count()) * 1'000'000};
  const int signal = sigtimedwait(&signals_, nullptr, &time);
  const pid_t found = ::waitpid(child_, &status_, WNOHANG);
  if (found < 0 && errno == ECHILD) // somebody else has waited for it: how it ended nobody knows
    status_ = W_EXITCODE(exit_failure, 0);
  over_ = found == child_ || (found < 0 && errno == ECHILD);
  if (over_)
    return true;
  if (signal > 0 && signal != SIGCHLD && passes_on())
    request();
  if (requested_ && clock::now() - since_ > patience)
    end();
  return false;
}

void supervisor::request() {
  if (requested_ && clock::now() - since_ > one_request)
    end();
  if (requested_)
    return;
  end_soon();
  ::kill(child_, SIGTERM);
}

void supervisor::end_soon() {
  if (requested_)
    return;
  requested_ = true;
  since_ = clock::now();
}

void supervisor::end() {
  ended_ = true;
  ::kill(child_, SIGKILL);
}

bool supervisor::was_killed() const {
  return !WIFEXITED(status_);
}

int supervisor::code() const {
  return !was_killed() ? WEXITSTATUS(status_) : ended_ ? exit_stopped : exit_failure;
}

std::string supervisor::killed_line() const {
  return line_of(WTERMSIG(status_));
}

void supervisor::await_workers() const {
  const auto until = clock::now() + std::chrono::seconds(5);
  for (;;) {
    const pid_t found = ::waitpid(-1, nullptr, WNOHANG);
    if ((found < 0 && errno != EINTR) || (found == 0 && clock::now() > until))
      return;
    if (found == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

bool cleaned_up(const std::function<bool()>& clean_up) noexcept {
  try {
    return clean_up();
  } catch (...) {
    return false;
  }
}

int run_supervised(const std::function<int()>& command, const std::function<bool()>& clean_up) {
  supervisor watched;
  if (!watched.supervises()) // or there can be no other process: without supervision then
    return command();
  while (!watched.has_ended(std::chrono::milliseconds(100))) {
  }
  if (watched.was_killed() || watched.code() == exit_stopped) { // its workers die with it, also in a file
    watched.await_workers();
    const bool can_go_on = cleaned_up(clean_up);
    if (watched.was_killed() && !has_complained())
      complain(watched.ended() ? stopped_line(can_go_on) : watched.killed_line());
  }
  return watched.code();
}

risky_step::risky_step(const std::string& what, const std::string& advice, double seconds) {
  if (lines == nullptr)
    return;
  limited_ = limit(seconds);
  std::array<char, 32> budget{};
  std::snprintf(budget.data(), budget.size(), "%.0f s", seconds);
  copy(limited_ ? what + " is not done after " + budget.data() + " of processor time; " + advice
                : what + " is not done within the limit to processor time; allow more (ulimit -t)",
       lines->endless);
  copy(what + " was killed, perhaps for want of memory", lines->killed);
  copy(what + ": " + detail::out_of_stack, lines->out_of_stack);
  copy(what + " crashed; " + advice, lines->crashed);
}

risky_step::~risky_step() {
  if (limited_)
    ::setrlimit(RLIMIT_CPU, &before_);
  if (lines != nullptr)
    lines->crashed[0] = 0;
}

/// Never sets a limit that is higher than the one that is there.
bool risky_step::limit(double seconds) {
  rusage used{};
  if (::getrusage(RUSAGE_SELF, &used) != 0 || ::getrlimit(RLIMIT_CPU, &before_) != 0)
    return false;
  rlimit processor = before_;
  processor.rlim_cur = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                       static_cast<rlim_t>(std::ceil(seconds)) + 1;
  return processor.rlim_cur < std::min(before_.rlim_cur, before_.rlim_max) &&
         ::setrlimit(RLIMIT_CPU, &processor) == 0;
}

} // namespace dovetail::app
