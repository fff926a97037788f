#include "failure.hpp"
#include "stop_request.hpp"
#include "supervision.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <functional>
#include <string>

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

ending end_of(const std::function<int()>& command) {
  std::FILE* file = std::tmpfile();
  REQUIRE(file != nullptr);
  std::fflush(stderr);
  const int terminal = ::dup(STDERR_FILENO);
  ::dup2(::fileno(file), STDERR_FILENO);
  const auto start = std::chrono::steady_clock::now();
  const pid_t test = ::getpid();
  ending result{0, 0, 0, {}};
  result.code = run_supervised(command, [&] { ++result.cleaned; });
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

TEST_CASE("a request to stop is passed on, and who does not listen is ended after a second") {
  const ending polite = end_of([] {
    ::kill(::getppid(), SIGTERM);
    while (!stop_was_requested())
      ::usleep(1000);
    return 130;
  });
  CHECK(polite.code == exit_stopped);
  CHECK(polite.cleaned == 0);
  const ending deaf = end_of([] {
    ::kill(::getppid(), SIGINT);
    work(30);
    return 0;
  });
  CHECK(deaf.code == exit_stopped);
  CHECK(deaf.cleaned == 1);
  CHECK(deaf.seconds > 0.9);
  CHECK(deaf.seconds < 10);
  CHECK(deaf.told.starts_with("dovetail: stopped"));
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
