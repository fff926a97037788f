#include "dovetail/distributed/made_aside.hpp"

#include <doctest/doctest.h>

#include <csignal>
#include <cstdlib>
#include <future>
#include <stdexcept>
#include <string>
#include <thread>
#include <unistd.h>
#include <utility>

using namespace dovetail;

TEST_CASE("a value is made by a child from the memory at its start") {
  int number = 6;
  made_aside<std::pair<int, pid_t>> made([&] { return std::pair(7 * number, ::getpid()); });
  number = 0;
  const auto found = made.wait();
  REQUIRE(found);
  CHECK(found->first == 42);
  CHECK(found->second != ::getpid());
}

TEST_CASE("large values pass") {
  made_aside<std::string> made([] { return std::string(3000000, 'x'); });
  CHECK(made.wait() == std::string(3000000, 'x'));
}

TEST_CASE("work that throws, crashes or exits makes nothing") {
  made_aside<int> thrown([]() -> int { throw std::runtime_error("no"); });
  made_aside<int> crashed([]() -> int { std::abort(); });
  made_aside<int> left([]() -> int { ::_exit(0); });
  CHECK(!thrown.wait());
  CHECK(!crashed.wait());
  CHECK(!left.wait());
}

TEST_CASE("a child that is not asked is ended") {
  pid_t child = 0;
  {
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    const made_aside<int> endless([&]() -> int {
      const pid_t self = ::getpid();
      if (::write(ends[1], &self, sizeof(self)) != sizeof(self))
        return 1;
      for (;;)
        ::pause();
    });
    REQUIRE(::read(ends[0], &child, sizeof(child)) == sizeof(child));
    CHECK(::kill(child, 0) == 0);
    ::close(ends[0]);
    ::close(ends[1]);
  }
  CHECK(::kill(child, 0) != 0);
}

TEST_CASE("in a process with other threads the work is done when it is asked for") {
  std::promise<void> asked;
  std::thread other([&] { asked.get_future().wait(); });
  made_aside<pid_t> made([] { return ::getpid(); });
  CHECK(made.wait() == ::getpid());
  asked.set_value();
  other.join();
}
