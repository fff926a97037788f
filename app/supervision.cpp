#include "supervision.hpp"

#include "failure.hpp"
#include "stop_request.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
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
};
shared_lines* lines = nullptr;

sigset_t set_of(const std::vector<int>& signals) {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : signals)
    sigaddset(&set, signal);
  return set;
}

/// Waits until the child has ended by itself or was ended, and returns its status.
class watch {
public:
  /// The signals are those watched, which are blocked.
  watch(pid_t child, const sigset_t& signals) : child_(child), signals_(signals) {}

  int until_end() {
    for (int status = 0;;) {
      const timespec tenth{0, 100'000'000};
      const int signal = sigtimedwait(&signals_, nullptr, &tenth);
      const pid_t found = ::waitpid(child_, &status, WNOHANG);
      if (found == child_)
        return status;
      if (found < 0 && errno == ECHILD) // somebody else has waited for it: how it ended nobody knows
        return W_EXITCODE(exit_failure, 0);
      if (signal > 0 && signal != SIGCHLD)
        request();
      if (requested_ && clock::now() - since_ > patience)
        end();
    }
  }
  bool ended() const { return ended_; }

private:
  void request() {
    if (requested_ && clock::now() - since_ > one_request)
      end();
    if (requested_)
      return;
    requested_ = true;
    since_ = clock::now();
    ::kill(child_, SIGTERM);
  }
  void end() {
    ended_ = true;
    ::kill(child_, SIGKILL);
  }

  pid_t child_;
  sigset_t signals_;
  bool requested_ = false;
  bool ended_ = false;
  clock::time_point since_{};
};

std::string line_of(int signal) {
  if (lines != nullptr && lines->crashed[0] != 0)
    return (signal == SIGXCPU ? lines->endless : signal == SIGKILL ? lines->killed : lines->crashed).data();
  return "ended by signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")" +
         (signal == SIGKILL ? ", perhaps for want of memory" : "");
}

void copy(const std::string& text, std::array<char, 2048>& to) {
  std::snprintf(to.data(), to.size(), "%s", text.c_str());
}

/// Whatever goes wrong in it, the supervisor still says how the command ended.
bool cleaned_up(const std::function<bool()>& clean_up) noexcept {
  try {
    return clean_up();
  } catch (...) {
    return false;
  }
}

} // namespace

int run_supervised(const std::function<int()>& command, const std::function<bool()>& clean_up) {
  void* const memory =
      ::mmap(nullptr, sizeof(shared_lines), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  lines = memory == MAP_FAILED ? nullptr : static_cast<shared_lines*>(memory);
  ::prctl(PR_SET_CHILD_SUBREAPER, 1); // the workers of a child that is gone can be waited for
  std::signal(SIGCHLD, SIG_DFL);      // who started us may ignore it, and then nothing is left to wait for
  auto watched_signals = stop_signals();
  watched_signals.push_back(SIGCHLD);
  const sigset_t signals = set_of(watched_signals);
  sigset_t before;
  sigprocmask(SIG_BLOCK, &signals, &before);
  std::fflush(nullptr);
  const pid_t supervisor = ::getpid();
  const pid_t child = ::fork();
  if (child <= 0) { // or there can be no other process: without supervision then
    if (child == 0)
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (child == 0 && ::getppid() != supervisor)
      ::_exit(exit_failure);
    if (child < 0)
      lines = nullptr; // nobody would read them
    catch_stop_signals();
    sigprocmask(SIG_SETMASK, &before, nullptr);
    return command();
  }
  watch watched(child, signals);
  const int status = watched.until_end();
  int code = WEXITSTATUS(status);
  const bool was_killed = !WIFEXITED(status);
  if (was_killed || code == exit_stopped) { // its workers die with it, also in the middle of a file
    while (::waitpid(-1, nullptr, 0) > 0 || errno == EINTR) {
    }
    const bool can_go_on = cleaned_up(clean_up);
    if (was_killed) {
      complain(watched.ended() ? stopped_line(can_go_on) : line_of(WTERMSIG(status)));
      code = watched.ended() ? exit_stopped : exit_failure;
    }
  }
  sigprocmask(SIG_SETMASK, &before, nullptr);
  return code;
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
