#include "dovetail/core/failure_reasons.hpp"
#include "dovetail/distributed/fresh_memory.hpp"
#include "dovetail/distributed/process_pool.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/distributed/task_board.hpp"
#include "dovetail/parallel/serial.hpp"
#include "parallel/executor_contract.hpp"

#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <future>
#include <new>
#include <thread>
#include <utility>

#include <poll.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace dovetail;
using parallel::processes;

namespace {

[[noreturn]] void hang() {
  for (;;)
    std::this_thread::sleep_for(std::chrono::seconds(1));
}

/// Numbers that workers and their parent share.
class shared_numbers {
public:
  shared_numbers()
      : first_(static_cast<std::atomic<int>*>(
            ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))) {}
  ~shared_numbers() { ::munmap(first_, bytes); }
  shared_numbers(const shared_numbers&) = delete;
  shared_numbers& operator=(const shared_numbers&) = delete;
  std::atomic<int>& operator[](std::size_t i) const { return first_[i]; }

private:
  static constexpr std::size_t bytes = 4096;
  std::atomic<int>* first_;
};

/// Whether that many are reached within ten seconds.
bool reaches(const std::atomic<int>& number, int wanted) {
  for (int waited = 0; number < wanted && waited < 10000; ++waited)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return number >= wanted;
}

bool has_children() {
  return ::waitpid(-1, nullptr, WNOHANG) >= 0 || errno != ECHILD;
}

/// Waits until the other end of a pipe is closed by everyone who held it; false when that takes too long.
bool closes_within(int descriptor, int milliseconds) {
  for (;;) {
    pollfd watched{descriptor, POLLIN, 0};
    if (::poll(&watched, 1, milliseconds) <= 0)
      return false;
    char byte = 0;
    if (::read(descriptor, &byte, 1) == 0)
      return true;
  }
}

} // namespace

TEST_CASE("processes is an executor, whatever the number of workers") {
  for (const int workers : {0, 1, 2, 4}) {
    CAPTURE(workers);
    contract::check_executor(processes{workers});
    CHECK_FALSE(has_children());
  }
}

TEST_CASE("A crash costs one task") {
  for (const int workers : {1, 3}) {
    const auto outcomes = processes{workers}.run(8, [](std::size_t i) {
      if (i == 1)
        ::raise(SIGKILL);
      if (i == 2)
        std::abort();
      if (i == 4)
        std::exit(3);
      if (i == 5)
        ::_exit(0);
      return contract::encoded(i);
    });
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      CAPTURE(i);
      const bool dies = i == 1 || i == 2 || i == 4 || i == 5;
      CHECK(outcomes[i].ok == !dies);
      CHECK(outcomes[i].crashed == dies);
      if (!dies)
        CHECK(contract::decoded(outcomes[i].result) == i);
    }
    CHECK(outcomes[1].failure.find("signal 9") != std::string::npos);
    CHECK(outcomes[2].failure.find("signal 6") != std::string::npos);
    CHECK(outcomes[4].failure == "the worker exited with code 3");
    CHECK(outcomes[5].failure == "the worker exited with code 0");
    CHECK_FALSE(has_children());
  }
}

/// Until the stack is used up.
int descend(int depth) {
  volatile char frame[4096];
  frame[0] = static_cast<char>(depth);
  return depth < 0 ? 0 : descend(depth + 1) + frame[0];
}

TEST_CASE("Of a worker without memory or stack it is said") {
  const auto outcomes = processes{2}.run(5, [](std::size_t i) -> byte_buffer {
    if (i == 1)
      throw std::bad_alloc();
    if (i == 2)
      return contract::encoded(static_cast<std::size_t>(descend(0)));
    if (i == 3) {
      byte_buffer made;
      detail::on_fresh_memory([&] { return descend(0); });
      return made;
    }
    if (i == 4)
      std::raise(SIGSEGV);
    return contract::encoded(i);
  });
  CHECK(outcomes[0].ok);
  CHECK(outcomes[1].failure == "out of memory");
  CHECK_FALSE(outcomes[1].crashed);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  for (const std::size_t i : {2, 3}) {
    CHECK(outcomes[i].failure == "out of stack: allow more of it (ulimit -s)");
    CHECK(outcomes[i].crashed);
  }
#endif
  CHECK(outcomes[4].failure.find("signal 11") != std::string::npos);
  for (const std::size_t i : {1, 2, 3})
    CHECK(detail::is_for_want_of_room(outcomes[i].failure));
  CHECK_FALSE(detail::is_for_want_of_room(outcomes[4].failure));
}

TEST_CASE("A process without standard streams has workers that answer") {
  const pid_t child = ::fork();
  if (child == 0) {
    for (const int standard : {0, 1, 2})
      ::close(standard);
    const auto outcomes = processes{2}.run(20, [](std::size_t i) { return contract::encoded(i); });
    bool all = true;
    for (std::size_t i = 0; i < 20; ++i)
      all = all && outcomes[i].ok && contract::decoded(outcomes[i].result) == i;
    ::_exit(all ? 0 : 1);
  }
  int status = 0;
  CHECK(::waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("Every task can crash") {
  const auto outcomes = processes{2}.run(20, [](std::size_t) -> byte_buffer { std::abort(); });
  CHECK(std::all_of(outcomes.begin(), outcomes.end(), [](const task_outcome& o) { return o.crashed; }));
  CHECK_FALSE(has_children());
}

TEST_CASE("A hang is ended at the time limit") {
  run_options options;
  options.limit_seconds = 0.3;
  const auto outcomes = processes{2}.run(
      4,
      [](std::size_t i) {
        if (i == 1)
          hang();
        return contract::encoded(i);
      },
      options);
  CHECK(outcomes[1].timed_out);
  CHECK_FALSE(outcomes[1].ok);
  CHECK(outcomes[1].seconds >= 0.3);
  CHECK(outcomes[1].failure.find("time limit") != std::string::npos);
  CHECK((outcomes[0].ok && outcomes[2].ok && outcomes[3].ok));
  CHECK_FALSE(has_children());
}

TEST_CASE("A stop leaves no children, even when tasks hang") {
  run_options options;
  int asked = 0;
  options.on_progress.stop_requested = [&] { return ++asked > 3; };
  CHECK_THROWS_AS(processes{2}.run(
                      2, [](std::size_t) -> byte_buffer { hang(); }, options),
                  cancelled);
  CHECK_FALSE(has_children());
}

TEST_CASE("Ctrl-C reaches the parent alone") {
  run_options options;
  static volatile std::sig_atomic_t interrupted = 0;
  interrupted = 0;
  const auto previous = std::signal(SIGINT, [](int) { interrupted = 1; });
  options.on_progress.stop_requested = [] { return interrupted != 0; };
  const auto parent = ::getpid();
  CHECK_THROWS_AS(processes{2}.run(
                      2,
                      [parent](std::size_t i) -> byte_buffer {
                        if (i == 0) {
                          ::raise(SIGINT); // survived here
                          ::kill(parent, SIGINT);
                        }
                        hang();
                      },
                      options),
                  cancelled);
  std::signal(SIGINT, previous);
  CHECK_FALSE(has_children());
}

TEST_CASE("Workers die with their parent") {
  std::array<int, 2> alive{};   // held open by the workers
  std::array<int, 2> started{}; // a byte from each worker
  REQUIRE(::pipe(alive.data()) == 0);
  REQUIRE(::pipe(started.data()) == 0);
  std::fflush(nullptr);
  const pid_t parent = ::fork();
  REQUIRE(parent >= 0);
  if (parent == 0) {
    ::close(alive[0]);
    processes{3}.run(3, [&](std::size_t) -> byte_buffer {
      if (::write(started[1], "x", 1) == 1)
        hang();
      std::abort();
    });
    ::_exit(0);
  }
  ::close(alive[1]);
  for (int worker = 0; worker < 3; ++worker) {
    char byte = 0;
    REQUIRE(::read(started[0], &byte, 1) == 1);
  }
  CHECK_FALSE(closes_within(alive[0], 50));
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  CHECK(closes_within(alive[0], 5000));
  for (const int descriptor : {alive[0], started[0], started[1]})
    ::close(descriptor);
}

TEST_CASE("A process with threads is refused") {
  std::atomic<bool> stop = false;
  std::thread other([&] {
    while (!stop)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
  CHECK_THROWS_AS(processes{2}.run(1, [](std::size_t i) { return contract::encoded(i); }), usage_error);
  stop = true;
  other.join();
  CHECK_NOTHROW(processes{2}.run(1, [](std::size_t i) { return contract::encoded(i); }));
}

TEST_CASE("A worker prints nothing and does not touch the parent's data") {
  std::array<int, 2> ends{};
  REQUIRE(::pipe(ends.data()) == 0);
  std::fflush(nullptr);
  const int saved = ::dup(STDOUT_FILENO);
  ::dup2(ends[1], STDOUT_FILENO);
  std::printf("buffered by the parent\n"); // must come out once
  int counter = 0;
  processes{2}.run(4, [&](std::size_t i) {
    std::puts("noise");
    std::fflush(stdout);
    ++counter;
    if (i == 3)
      std::exit(0);
    return byte_buffer{};
  });
  std::fflush(stdout);
  ::dup2(saved, STDOUT_FILENO);
  ::close(saved);
  ::close(ends[1]);
  std::string text(1000, '\0');
  const ssize_t size = ::read(ends[0], text.data(), text.size());
  ::close(ends[0]);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  CHECK(text == "buffered by the parent\n");
  CHECK(counter == 0);
}

TEST_CASE("Peak memory of the worker is reported") {
  const auto outcomes = processes{1}.run(1, [](std::size_t) {
    const byte_buffer large(std::size_t{200} << 20, std::byte{1});
    const volatile std::size_t any_place = 12345; // else clang 22 makes no buffer
    return byte_buffer{large[any_place]};
  });
  CHECK(outcomes[0].peak_rss_bytes > std::size_t{200} << 20);
}

TEST_CASE("Outcomes equal those of serial, failures included") {
  const task_function task = [](std::size_t i) -> byte_buffer {
    if (i % 7 == 3)
      throw mesher_error("piece " + std::to_string(i));
    return contract::encoded(i * 31 % 17);
  };
  const auto expected = parallel::serial{}.run(50, task);
  for (const int workers : {1, 2, 4}) {
    const auto outcomes = processes{workers}.run(50, task);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      CHECK(outcomes[i].ok == expected[i].ok);
      CHECK(outcomes[i].result == expected[i].result);
      CHECK(outcomes[i].failure == expected[i].failure);
    }
  }
}

TEST_CASE("Workers go on while their parent is busy") {
  const shared_numbers begun;
  run_options options;
  bool went_on = true;
  options.on_progress.update = [&](std::string_view, std::size_t done, std::size_t) {
    if (done > 0)
      went_on = went_on && reaches(begun[0], 20);
  };
  const task_function task = [&](std::size_t i) {
    ++begun[0];
    return contract::encoded(i);
  };
  processes{2}.run(20, task, options);
  CHECK(went_on);
}

TEST_CASE("No task waits behind a long one while another worker has nothing to do") {
  const shared_numbers ended;
  const auto outcomes = processes{2}.run(20, [&](std::size_t i) {
    if (i == 3 && !reaches(ended[0], 19))
      throw mesher_error("some task waits for this one");
    ++ended[0];
    return contract::encoded(i);
  });
  CHECK(outcomes[3].ok);
}

TEST_CASE("A task whose worker is killed is run once more, and no other one twice") {
  for (const int workers : {1, 2, 4}) {
    CAPTURE(workers);
    const shared_numbers runs; // per task; then the process that another one may kill, and such kills
    constexpr std::size_t tasks = 200;
    runs[tasks] = runs[tasks + 1] = 0;
    const auto outcomes = processes{workers}.run(tasks, [&](std::size_t i) {
      ++runs[i];
      int self = static_cast<int>(::getpid());
      if (i % 20 == 7 && (i < 100 || runs[i] == 1)) {
        runs[tasks].compare_exchange_strong(self, 0);
        ::raise(SIGKILL);
      }
      const int victim = runs[tasks].exchange(i % 20 == 13 ? 0 : self);
      if (i % 20 == 13 && victim != 0 && victim != self) {
        ++runs[tasks + 1];
        ::kill(victim, SIGKILL); // wherever that one is
      }
      return contract::encoded(i);
    });
    int again = 0, lost = 0;
    for (std::size_t i = 0; i < tasks; ++i) {
      CAPTURE(i);
      CHECK(runs[i] <= 2);
      CHECK(outcomes[i].ok != outcomes[i].crashed);
      if (i % 20 == 7)
        CHECK(runs[i] >= (workers == 1 ? 2 : 1)); // one that is killed by another one may not have begun
      else if (runs[i] == 2)
        ++again;
      if (outcomes[i].ok) {
        CHECK(contract::decoded(outcomes[i].result) == i);
      } else {
        CHECK(outcomes[i].failure.find("signal 9") != std::string::npos);
        ++lost;
      }
    }
    CHECK(lost >= 5);
    CHECK(again + lost - 5 <= runs[tasks + 1]);
    CHECK_FALSE(has_children());
  }
}

TEST_CASE("A worker whose task failed takes no other one") {
  const shared_numbers failed; // whether a process has seen a failure is in its own memory
  static bool this_one_failed = false;
  const auto outcomes = processes{2}.run(40, [&](std::size_t i) {
    failed[0] += this_one_failed ? 1 : 0;
    this_one_failed = i % 3 == 0;
    if (this_one_failed)
      throw mesher_error("on purpose");
    return contract::encoded(i);
  });
  CHECK(failed[0] == 0);
  CHECK_FALSE(this_one_failed);
}

TEST_CASE("A task is taken once, and again when it is given back") {
  detail::task_board board(3);
  CHECK(board.take(1, 0) == 0);
  CHECK(board.take(2, 0) == 1);
  CHECK(board.is_taken_by(2, 1));
  CHECK_FALSE(board.is_taken_by(1, 1));
  CHECK(board.has_free());
  CHECK(board.take(1, 1) == 2);
  CHECK_FALSE(board.has_free());
  CHECK_FALSE(board.take(1, 0).has_value());
  board.give_back(1);
  CHECK(board.has_free());
  CHECK(board.take(3, 0) == 1);
  CHECK_FALSE(board.has_free());
  CHECK_FALSE(board.take(1, 0).has_value());
}

namespace {

std::promise<void>* stand_by = nullptr; // of a thread that ends before this process forks
std::thread* standing_by = nullptr;

} // namespace

TEST_CASE("A library's thread that ends before a fork keeps nobody from forking") {
  std::promise<void> ended;
  std::thread thread([&] { ended.get_future().wait(); });
  stand_by = &ended;
  standing_by = &thread;
  const auto end_thread = [] {
    if (stand_by == nullptr)
      return;
    std::exchange(stand_by, nullptr)->set_value();
    standing_by->join();
  };
  REQUIRE(::pthread_atfork(end_thread, nullptr, nullptr) == 0);
  CHECK(detail::is_only_thread());
  CHECK_FALSE(thread.joinable());
  end_thread();
}

TEST_CASE("A thread that was joined keeps nobody from forking, though the system may list it still") {
  int kept = 0;
  for (int i = 0; i < 2000; ++i) {
    std::thread([] {}).join();
    kept += detail::is_only_thread() ? 0 : 1;
  }
  CHECK(kept == 0);
  std::promise<void> done;
  std::thread other([&] { done.get_future().wait(); });
  CHECK_FALSE(detail::is_only_thread());
  CHECK_THROWS_AS(detail::require_single_thread(), usage_error);
  done.set_value();
  other.join();
}
