#include "failure.hpp"
#include "stop_request.hpp"
#include "supervision.hpp"

#include "dovetail/distributed/stack_overflow.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>

#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

namespace dovetail::app {
namespace {

/// What became of a command under supervision.
struct ending {
  int code;
  int cleaned;
  double seconds;
  std::string told; ///< on the error stream
};

ending end_of(
    const std::function<int()>& command, const std::function<bool()>& clean_up = [] { return false; },
    const std::function<std::string(bool)>& stopped = stopped_line) {
  std::FILE* file = std::tmpfile();
  REQUIRE(file != nullptr);
  std::fflush(stderr);
  const int terminal = ::dup(STDERR_FILENO);
  ::dup2(::fileno(file), STDERR_FILENO);
  const auto start = std::chrono::steady_clock::now();
  const pid_t test = ::getpid();
  ending result{0, 0, 0, {}};
  result.code = run_supervised(
      command,
      [&] {
        ++result.cleaned;
        return clean_up();
      },
      stopped);
  if (::getpid() != test) // the child, whose command has returned
    ::_exit(result.code);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ::dup2(terminal, STDERR_FILENO);
  ::close(terminal);
  std::rewind(file);
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file))
    result.told += static_cast<char>(c);
  std::fclose(file);
  return result;
}

void work(double seconds) {
  const auto start = std::chrono::steady_clock::now();
  while (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < seconds) {
  }
}

int crash(int signal) {
  std::signal(signal, SIG_DFL); // it is the test's no more
  std::raise(signal);
  return 0;
}

TEST_CASE("a command's code is returned, and nothing is cleaned up") {
  const ending end = end_of([] { return 7; });
  CHECK(end.code == 7);
  CHECK(end.cleaned == 0);
  CHECK(end.told == "");
}

TEST_CASE("a crash is one line, of the step that is known to be risky or of any") {
  const ending plain = end_of([] { return crash(SIGSEGV); });
  CHECK(plain.code == exit_failure);
  CHECK(plain.cleaned == 1);
  CHECK(plain.told.starts_with("dovetail: ended by signal 11"));
  const ending known = end_of([] {
    const risky_step step("reading", "export it again", 60);
    return crash(SIGABRT);
  });
  CHECK(known.told == "dovetail: reading crashed; export it again\n");
  const ending past = end_of([] {
    { const risky_step step("reading", "export it again", 60); }
    return crash(SIGABRT);
  });
  CHECK(past.told.starts_with("dovetail: ended by signal 6"));
  const ending killed = end_of([] {
    const risky_step step("reading", "export it again", 60);
    return crash(SIGKILL);
  });
  CHECK(killed.told == "dovetail: reading was killed, perhaps for want of memory\n");
}

/// What several processes count together.
class shared_count {
public:
  shared_count()
      : number_(static_cast<std::atomic<int>*>(::mmap(
            nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))) {}
  shared_count(const shared_count&) = delete;
  shared_count& operator=(const shared_count&) = delete;
  ~shared_count() { ::munmap(number_, sizeof *number_); }
  int next() { return ++*number_; }
  int value() const { return *number_; }

private:
  std::atomic<int>* number_;
};

TEST_CASE("a command that is killed while it has a spare process goes on in that, once") {
  shared_count tries;
  const ending once = end_of([&] {
    const spare_process spare;
    return tries.next() == 1 ? crash(SIGKILL) : 7;
  });
  CHECK(once.code == 7);
  CHECK(once.cleaned == 0);
  CHECK(once.told == "");
  CHECK(tries.value() == 2);
  const ending twice = end_of([&] {
    const spare_process spare;
    const risky_step step("reading", "export it again", 60);
    tries.next();
    return crash(SIGKILL);
  });
  CHECK(twice.code == exit_failure);
  CHECK(twice.cleaned == 1);
  CHECK(twice.told == "dovetail: reading was killed, perhaps for want of memory\n");
  CHECK(tries.value() == 4);
}

TEST_CASE("a spare process does not go on where its command ends otherwise, or has passed that place") {
  shared_count tries;
  const ending crashed = end_of([&] {
    const spare_process spare;
    tries.next();
    return crash(SIGSEGV);
  });
  CHECK(crashed.code == exit_failure);
  const ending stopped = end_of([&] {
    const spare_process spare;
    tries.next();
    ::kill(::getppid(), SIGTERM);
    work(30);
    return 0;
  });
  CHECK(stopped.code == exit_stopped);
  const ending past = end_of([&] {
    { const spare_process spare; }
    tries.next();
    return crash(SIGKILL);
  });
  CHECK(past.code == exit_failure);
  CHECK(tries.value() == 3);
}

/// Until the stack is used up.
int descend(int depth) {
  volatile char frame[4096];
  frame[0] = static_cast<char>(depth);
  return depth < 0 ? 0 : descend(depth + 1) + frame[0];
}

int use_up_stack() {
  std::signal(SIGSEGV, SIG_DFL); // it is the test's no more
  detail::on_stack_overflow(detail::action_on_overflow());
  const rlimit little{1 << 20, RLIM_INFINITY};
  ::setrlimit(RLIMIT_STACK, &little);
  detail::watch_stack_of_thread();
  return descend(0);
}

TEST_CASE("a stack that is used up is not told as a crash of the step") {
  const ending plain = end_of(use_up_stack);
  CHECK(plain.code == exit_failure);
  CHECK(plain.told == "dovetail: ended: out of stack: allow more of it (ulimit -s)\n");
  const ending known = end_of([] {
    const risky_step step("reading", "export it again", 60);
    return use_up_stack();
  });
  CHECK(known.told == "dovetail: reading: out of stack: allow more of it (ulimit -s)\n");
}

TEST_CASE("what goes wrong while cleaning up hides nothing") {
  const ending end = end_of([] { return crash(SIGSEGV); }, []() -> bool { throw std::runtime_error("no"); });
  CHECK(end.code == exit_failure);
  CHECK(end.told.starts_with("dovetail: ended by signal 11"));
}

TEST_CASE("a command ends also where its parent does not want to hear of the end of children") {
  std::signal(SIGCHLD, SIG_IGN);
  CHECK(end_of([] { return 7; }).code == 7);
  std::signal(SIGCHLD, SIG_DFL);
}

TEST_CASE("a step that does not end is ended by its processor time, which others do not have to mind") {
  const ending endless = end_of([] {
    const risky_step step("reading", "export it again", 1);
    work(30);
    return 0;
  });
  CHECK(endless.code == exit_failure);
  CHECK(endless.told == "dovetail: reading is not done after 1 s of processor time; export it again\n");
  const ending after = end_of([] {
    { const risky_step step("reading", "export it again", 0); }
    work(2.5);
    return 3;
  });
  CHECK(after.code == 3);
}

rlim_t soft_limit() {
  rlimit processor{};
  ::getrlimit(RLIMIT_CPU, &processor);
  return processor.rlim_cur;
}

void set_soft_limit(rlim_t seconds) {
  rlimit processor{};
  ::getrlimit(RLIMIT_CPU, &processor);
  processor.rlim_cur = seconds;
  ::setrlimit(RLIMIT_CPU, &processor);
}

TEST_CASE("a limit to processor time that was there is found again, and is not raised") {
  const ending restored = end_of([] {
    set_soft_limit(1000);
    { const risky_step step("reading", "export it again", 60); }
    return soft_limit() == 1000 ? 4 : 5;
  });
  CHECK(restored.code == 4);
  const ending lower = end_of([] {
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    set_soft_limit(static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1);
    const risky_step step("reading", "export it again", 60);
    work(30);
    return 0;
  });
  CHECK(lower.told ==
        "dovetail: reading is not done within the limit to processor time; allow more (ulimit -t)\n");
}

TEST_CASE("a request to stop is passed on, and who does not listen is ended after a second") {
  const ending polite = end_of([] {
    ::kill(::getppid(), SIGTERM);
    while (!stop_was_requested())
      ::usleep(1000);
    return 130;
  });
  CHECK(polite.code == exit_stopped);
  CHECK(polite.cleaned == 1); // its workers may leave parts of files
  const ending deaf = end_of([] {
    ::kill(::getppid(), SIGINT);
    work(30);
    return 0;
  });
  CHECK(deaf.code == exit_stopped);
  CHECK(deaf.cleaned == 1);
  CHECK(deaf.seconds > 0.7);
  CHECK(deaf.seconds < 10);
  CHECK(deaf.told.starts_with("dovetail: stopped"));
}

TEST_CASE("a terminal that is closed is a request to stop, unless that was to be ignored") {
  const auto hang_up = [] {
    ::kill(::getppid(), SIGHUP);
    work(0.5);
    return stop_was_requested() ? 5 : 6;
  };
  std::signal(SIGHUP, SIG_IGN);
  CHECK(end_of(hang_up).code == 6);
  std::signal(SIGHUP, SIG_DFL);
  CHECK(end_of(hang_up).code == 5);
}

TEST_CASE("only where something is left it is said that another run can go on from it") {
  const auto deaf = [] {
    ::kill(::getppid(), SIGTERM);
    work(30);
    return 0;
  };
  CHECK(end_of(deaf, [] { return true; }).told.find("--resume") != std::string::npos);
  CHECK(end_of(deaf, [] { return false; }).told == "dovetail: stopped\n");
  // An experiment says it in words of its own.
  CHECK(end_of(
            deaf, [] { return false; }, stopped_experiment_line)
            .told == "dovetail: " + stopped_experiment_line(false) + "\n");
}

TEST_CASE("who has said how it ends, and is ended on its way out, has said enough") {
  const ending stopped = end_of([] {
    complain(stopped_line(true));
    ::kill(::getppid(), SIGTERM);
    work(30);
    return 0;
  });
  CHECK(stopped.code == exit_stopped);
  CHECK(stopped.told == "dovetail: " + stopped_line(true) + "\n");
  const ending failed = end_of([] {
    complain("a.step: cannot be read");
    return crash(SIGSEGV);
  });
  CHECK(failed.code == exit_failure);
  CHECK(failed.told == "dovetail: a.step: cannot be read\n");
}

TEST_CASE("a second request ends at once, a signal that comes twice does not") {
  const ending twice = end_of([] {
    ::kill(::getppid(), SIGTERM);
    ::kill(::getppid(), SIGINT);
    work(0.5);
    return stop_was_requested() ? 5 : 6;
  });
  CHECK(twice.code == 5);
  const ending again = end_of([] {
    ::kill(::getppid(), SIGTERM);
    work(0.4);
    ::kill(::getppid(), SIGTERM);
    work(0.4);
    return 0;
  });
  CHECK(again.code == exit_stopped);
}

} // namespace
} // namespace dovetail::app
