#include "relay_loop.hpp"

#include "stop_request.hpp"

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/parallel/communicator.hpp"

#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include <sys/socket.h>
#include <unistd.h>

namespace dovetail::app {
namespace {

/// That of a rank which the others send nothing but perhaps a farewell, and which looks when they are told
/// that it goes no further.
class observed_network {
public:
  explicit observed_network(std::function<void()> on_abandon, std::string farewell = {})
      : on_abandon_(std::move(on_abandon)), farewell_(std::move(farewell)) {}

  int rank() const { return 0; }
  int size() const { return 2; }
  void send(int, std::int32_t, const byte_buffer&) {}
  std::optional<rank_message> receive() {
    if (!farewell_.empty())
      throw communication_error(farewell_);
    return std::nullopt;
  }
  void wait(std::chrono::milliseconds) {}
  int descriptor() const { return -1; }
  bool shares_process() const { return false; }
  void abandon(const std::string&) { on_abandon_(); }

private:
  std::function<void()> on_abandon_;
  std::string farewell_;
};

bool is_there(pid_t process) {
  return ::kill(process, 0) == 0;
}

/// A rank whose process runs a command.
class tried_rank {
public:
  explicit tried_rank(const std::function<int()>& command) {
    REQUIRE(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends_.data()) == 0);
    computing_.emplace();
    if (!computing_->supervises())
      ::_exit(command());
  }
  tried_rank(const tried_rank&) = delete;
  tried_rank& operator=(const tried_rank&) = delete;
  ~tried_rank() {
    for (const int end : ends_)
      ::close(end);
  }

  pid_t computing() const { return computing_->child(); }
  rank_end end_on(observed_network network) {
    return relay_loop(*computing_, network, ends_[0],
                      {.all_live = [] { return true; },
                       .said = [] { return "said"; },
                       .serve = [](const auto& pass_messages) { pass_messages(); }})
        .run();
  }
  rank_end end_of_stopped(const std::function<void()>& on_abandon) {
    ::kill(::getpid(), SIGTERM); // comes when the relay looks for it
    return end_on(observed_network(on_abandon));
  }

private:
  std::array<int, 2> ends_{};
  std::optional<supervisor> computing_;
};

int never_end() {
  for (;;)
    ::pause();
}

void await_request() {
  while (!stop_was_requested())
    ::usleep(1000);
}

TEST_CASE("who is asked to stop tells the others before it has ended, and is not told as ended by them") {
  int told = 0;
  bool was_there = false;
  tried_rank deaf(never_end);
  const rank_end end = deaf.end_of_stopped([&] {
    ++told;
    was_there = is_there(deaf.computing());
  });
  CHECK(told == 1);
  CHECK(was_there);
  CHECK(end.code == exit_stopped);
  CHECK(end.by_itself);
  CHECK_FALSE(end.was_told);
  CHECK(end.cause == stopped_line(false));
}

TEST_CASE("a rank that was at its end when it was asked to stop is stopped too, since others were not") {
  tried_rank done([] {
    await_request();
    return 0;
  });
  const rank_end end = done.end_of_stopped([] {});
  CHECK(end.code == exit_stopped);
  CHECK(end.by_itself);
  CHECK(end.cause == stopped_line(false));
}

TEST_CASE("a request to stop that came to another rank is passed on, and not what else becomes of that") {
  tried_rank stopped([] {
    await_request();
    return static_cast<int>(exit_stopped);
  });
  const rank_end by_request = stopped.end_on(observed_network([] {}, "rank 1: " + stopped_line(false)));
  CHECK(by_request.code == exit_stopped);
  CHECK(by_request.by_itself);
  CHECK(by_request.cause == "said");
  tried_rank ended([] {
    await_request();
    return static_cast<int>(exit_stopped);
  });
  const rank_end by_failure = ended.end_on(observed_network([] {}, "rank 1: out of memory"));
  CHECK_FALSE(by_failure.by_itself);
  CHECK(by_failure.was_told);
  CHECK(by_failure.cause == "");
}

} // namespace
} // namespace dovetail::app
