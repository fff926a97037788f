#include "supervision.hpp"

#include "failure.hpp"
#include "stop_request.hpp"

#include "dovetail/core/failure_reasons.hpp"
#include "dovetail/distributed/stack_overflow.hpp"
#include "dovetail/parallel/run_task.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <new>
#include <thread>
#include <vector>

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
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
  std::atomic<pid_t> spare; ///< 0: none
};
shared_lines* lines_of_child = nullptr;

/// In a child: where its spare process is called from; -1: there can be none.
int spare_calls = -1;

sigset_t set_of(const std::vector<int>& signals) {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : signals)
    sigaddset(&set, signal);
  return set;
}

/// Whether there is a limit to memory: a library may crash where it gets no more.
bool memory_is_limited() {
  rlimit allowed{};
  return ::getrlimit(RLIMIT_AS, &allowed) == 0 && allowed.rlim_cur != RLIM_INFINITY;
}

std::string line_of(int signal) {
  if (lines_of_child != nullptr && lines_of_child->stack_is_used_up)
    return lines_of_child->crashed[0] != 0 ? lines_of_child->out_of_stack.data()
                                           : std::string("ended: ") + detail::out_of_stack;
  if (lines_of_child != nullptr && lines_of_child->crashed[0] != 0)
    return (signal == SIGXCPU   ? lines_of_child->endless
            : signal == SIGKILL ? lines_of_child->killed
                                : lines_of_child->crashed)
        .data();
  return "ended by signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")" +
         (signal == SIGKILL ? ", perhaps for want of memory" : "");
}

void copy(const std::string& text, std::array<char, 2048>& to) {
  std::snprintf(to.data(), to.size(), "%s", text.c_str());
}

/// What a spare process does before it goes on.
void await_call(pid_t supervisor) {
  char call = 0;
  ssize_t got = 0;
  do
    got = ::read(spare_calls, &call, 1);
  while (got < 0 && errno == EINTR);
  if (got != 1)
    ::_exit(exit_failure);
  spare_calls = -1;
  end_with_parent(supervisor);
}

} // namespace

void end_with_parent(pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent)
    ::_exit(exit_failure);
}

void end_without_parent() {
  ::prctl(PR_SET_PDEATHSIG, 0);
}

supervisor::supervisor() {
  void* const memory =
      ::mmap(nullptr, sizeof(shared_lines), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  lines_of_child = memory == MAP_FAILED ? nullptr : new (memory) shared_lines{};
  std::array<int, 2> calls{-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, calls.data()) == 0)
    call_ = detail::owned_descriptor(calls[1]);
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
  if (child_ > 0) {
    ::close(calls[0]);
    return;
  }
  if (child_ == 0)
    end_with_parent(self);
  if (child_ < 0)
    lines_of_child = nullptr; // nobody would read them
  call_.close();
  spare_calls = calls[0];
  catch_stop_signals();
  if (child_ == 0 && lines_of_child != nullptr)
    detail::on_stack_overflow([] { lines_of_child->stack_is_used_up = true; });
  sigprocmask(SIG_SETMASK, &before_, nullptr);
}

supervisor::~supervisor() {
  if (supervises())
    sigprocmask(SIG_SETMASK, &before_, nullptr);
}

bool supervisor::has_ended(std::chrono::microseconds at_most, const std::function<bool()>& passes_on) {
  if (over_)
    return true;
  const timespec time{0, static_cast<long>(at_most.count()) * 1'000};
  const int signal = sigtimedwait(&signals_, nullptr, &time);
  const pid_t found = ::waitpid(child_, &status_, WNOHANG);
  if (found < 0 && errno == ECHILD) // somebody else has waited for it: how it ended nobody knows
    status_ = W_EXITCODE(exit_failure, 0);
  over_ = (found == child_ && !goes_on_in_spare()) || (found < 0 && errno == ECHILD);
  if (over_) {
    call_.close();
    return true;
  }
  if (signal > 0 && signal != SIGCHLD && passes_on())
    request();
  if (requested_ && clock::now() - since_ > patience)
    end();
  return false;
}

bool supervisor::goes_on_in_spare() {
  const bool was_killed_by_others =
      WIFSIGNALED(status_) && WTERMSIG(status_) == SIGKILL && !requested_ && !ended_;
  const pid_t spare = lines_of_child != nullptr ? lines_of_child->spare.exchange(0) : 0;
  if (spare == 0 || !was_killed_by_others)
    return false;
  const bool heard = ::send(call_.get(), "", 1, MSG_NOSIGNAL) == 1;
  if (heard)
    child_ = spare;
  return heard;
}

void supervisor::request() {
  if (requested_ && clock::now() - since_ > one_request)
    end();
  ask_to_stop();
}

void supervisor::ask_to_stop() {
  if (requested_)
    return;
  end_soon();
  asked_to_stop_ = true;
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
  call_.close();
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

int run_supervised(const std::function<int()>& command, const std::function<bool()>& clean_up,
                   const std::function<std::string(bool)>& stopped) {
  supervisor watched;
  if (!watched.supervises()) // or there can be no other process: without supervision then
    return command();
  while (!watched.has_ended(std::chrono::milliseconds(100))) {
  }
  if (watched.was_killed() || watched.code() == exit_stopped) { // its workers die with it, also in a file
    watched.await_workers();
    const bool can_go_on = cleaned_up(clean_up);
    if (watched.was_killed() && !has_complained())
      complain(watched.ended() ? stopped(can_go_on) : watched.killed_line());
  }
  return watched.code();
}

spare_process::spare_process() {
  if (lines_of_child == nullptr || spare_calls < 0)
    return;
  std::fflush(nullptr);
  const pid_t supervisor = ::getppid();
  process_ = ::fork();
  if (process_ > 0)
    lines_of_child->spare = process_;
  if (process_ == 0)
    await_call(supervisor);
}

spare_process::~spare_process() {
  if (process_ <= 0)
    return;
  lines_of_child->spare = 0;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

risky_step::risky_step(const std::string& what, const std::string& advice, double seconds) {
  if (lines_of_child == nullptr)
    return;
  limited_ = limit(seconds);
  std::array<char, 32> budget{};
  std::snprintf(budget.data(), budget.size(), "%.0f s", seconds);
  copy(limited_ ? what + " is not done after " + budget.data() + " of processor time; " + advice
                : what + " is not done within the limit to processor time; allow more (ulimit -t)",
       lines_of_child->endless);
  copy(what + " was killed, perhaps for want of memory", lines_of_child->killed);
  copy(what + ": " + detail::out_of_stack, lines_of_child->out_of_stack);
  copy(what +
           (memory_is_limited() ? " crashed, perhaps for want of memory, to which there is a limit: allow "
                                  "more (ulimit -v); or "
                                : " crashed; ") +
           advice,
       lines_of_child->crashed);
}

risky_step::~risky_step() {
  if (limited_)
    ::setrlimit(RLIMIT_CPU, &before_);
  if (lines_of_child != nullptr)
    lines_of_child->crashed[0] = 0;
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
