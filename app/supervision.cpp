#include "supervision.hpp"

#include "failure.hpp"
#include "stop_request.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace dovetail::app {
namespace {

using clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds patience{1000};   ///< from the request to stop to the end
constexpr std::chrono::milliseconds one_request{200}; ///< a signal comes twice, to a process and to its group

/// What both processes see: the lines for the step that the child is in.
struct shared_lines {
  std::array<char, 2048> crashed;
  std::array<char, 2048> endless;
};
shared_lines* lines = nullptr;

sigset_t watched_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM, SIGCHLD})
    sigaddset(&set, signal);
  return set;
}

/// Waits until the child has ended by itself or was ended, and returns its status.
class watch {
public:
  explicit watch(pid_t child) : child_(child) {}

  int until_end() {
    const sigset_t signals = watched_signals();
    for (int status = 0;;) {
      const timespec tenth{0, 100'000'000};
      const int signal = sigtimedwait(&signals, nullptr, &tenth);
      if (::waitpid(child_, &status, WNOHANG) == child_)
        return status;
      if (signal == SIGINT || signal == SIGTERM)
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
  bool requested_ = false;
  bool ended_ = false;
  clock::time_point since_{};
};

std::string line_of(int signal) {
  if (lines != nullptr && lines->crashed[0] != 0)
    return signal == SIGXCPU ? lines->endless.data() : lines->crashed.data();
  return "ended by signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")" +
         (signal == SIGKILL ? ", perhaps for want of memory" : "");
}

void copy(const std::string& text, std::array<char, 2048>& to) {
  std::snprintf(to.data(), to.size(), "%s", text.c_str());
}

} // namespace

int run_supervised(const std::function<int()>& command, const std::function<void()>& clean_up) {
  void* const memory =
      ::mmap(nullptr, sizeof(shared_lines), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  lines = memory == MAP_FAILED ? nullptr : static_cast<shared_lines*>(memory);
  ::prctl(PR_SET_CHILD_SUBREAPER, 1); // the workers of a child that is gone can be waited for
  const sigset_t signals = watched_signals();
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
    catch_stop_signals();
    sigprocmask(SIG_SETMASK, &before, nullptr);
    return command();
  }
  watch watched(child);
  const int status = watched.until_end();
  int code = WEXITSTATUS(status);
  if (!WIFEXITED(status)) {
    while (::waitpid(-1, nullptr, 0) > 0 || errno == EINTR) { // its workers die with it
    }
    clean_up();
    complain(watched.ended() ? stopped_line : line_of(WTERMSIG(status)));
    code = watched.ended() ? exit_stopped : exit_failure;
  }
  sigprocmask(SIG_SETMASK, &before, nullptr);
  return code;
}

risky_step::risky_step(const std::string& what, const std::string& advice, double seconds) {
  if (lines == nullptr)
    return;
  std::array<char, 32> limit{};
  std::snprintf(limit.data(), limit.size(), "%.0f s", seconds);
  copy(what + " is not done after " + limit.data() + " of processor time; " + advice, lines->endless);
  copy(what + " crashed; " + advice, lines->crashed);
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  rlimit processor{};
  ::getrlimit(RLIMIT_CPU, &processor);
  processor.rlim_cur = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                       static_cast<rlim_t>(std::ceil(seconds)) + 1;
  ::setrlimit(RLIMIT_CPU, &processor);
}

risky_step::~risky_step() {
  if (lines == nullptr)
    return;
  rlimit processor{};
  ::getrlimit(RLIMIT_CPU, &processor);
  processor.rlim_cur = processor.rlim_max;
  ::setrlimit(RLIMIT_CPU, &processor);
  lines->crashed[0] = 0;
}

} // namespace dovetail::app
