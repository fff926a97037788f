/// @file
/// Ranks that are threads of this process: everything distributed can be tried, and tested, without MPI.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/parallel/communicator.hpp"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace dovetail::parallel {

/// A model of `communicator`: one rank of those that `run_ranks` has started.
class in_process {
public:
  int rank() const { return rank_; }
  int size() const { return static_cast<int>(all_->inboxes.size()); }

  void send(int to, std::int32_t tag, byte_buffer bytes) {
    const std::lock_guard lock(all_->guard);
    all_->require_all();
    all_->inboxes.at(static_cast<std::size_t>(to)).push_back({rank_, tag, std::move(bytes)});
    all_->news.notify_all();
  }
  std::optional<rank_message> receive() {
    const std::lock_guard lock(all_->guard);
    all_->require_all();
    auto& inbox = all_->inboxes[static_cast<std::size_t>(rank_)];
    if (inbox.empty())
      return std::nullopt;
    rank_message next = std::move(inbox.front());
    inbox.pop_front();
    return next;
  }
  void wait(std::chrono::milliseconds at_most) {
    std::unique_lock lock(all_->guard);
    all_->news.wait_for(lock, at_most, [&] {
      return !all_->abandoned.empty() || !all_->inboxes[static_cast<std::size_t>(rank_)].empty();
    });
    all_->require_all();
  }
  int descriptor() const { return -1; }
  bool shares_process() const { return true; }
  void abandon(const std::string& reason) {
    const std::lock_guard lock(all_->guard);
    if (all_->abandoned.empty())
      all_->abandoned = "rank " + std::to_string(rank_) + ": " + reason;
    all_->news.notify_all();
  }

private:
  friend void run_ranks(int ranks, const std::function<void(in_process&)>& work);

  struct shared {
    std::mutex guard;
    std::condition_variable news;
    std::vector<std::deque<rank_message>> inboxes; ///< per rank
    std::string abandoned;                         ///< by whom, and why; empty while all go on

    void require_all() const {
      if (!abandoned.empty())
        throw communication_error(abandoned);
    }
  };
  in_process(std::shared_ptr<shared> all, int rank) : all_(std::move(all)), rank_(rank) {}

  std::shared_ptr<shared> all_;
  int rank_;
};
static_assert(communicator<in_process>);

/// Runs `work(communicator)` on so many ranks, each in a thread of its own, and returns when all have ended.
/// What a rank throws ends the others' waiting; of several errors that of the lowest rank is thrown here,
/// those that only tell of another rank's last.
inline void run_ranks(int ranks, const std::function<void(in_process&)>& work) {
  if (ranks < 1)
    throw usage_error("a run has at least one rank, not " + std::to_string(ranks));
  const auto all = std::make_shared<in_process::shared>();
  all->inboxes.resize(static_cast<std::size_t>(ranks));
  std::vector<std::exception_ptr> causes(all->inboxes.size());
  std::vector<std::exception_ptr> consequences(all->inboxes.size());
  std::vector<std::thread> threads;
  for (int r = 0; r < ranks; ++r)
    threads.emplace_back([&, r] {
      in_process mine(all, r); // which the work may move into an `any_communicator`
      const auto abandon = [&](const std::string& reason) { in_process(all, r).abandon(reason); };
      const auto at = static_cast<std::size_t>(r);
      try {
        work(mine);
      } catch (const communication_error& problem) {
        consequences[at] = std::current_exception();
        abandon(problem.what());
      } catch (const std::exception& problem) {
        causes[at] = std::current_exception();
        abandon(problem.what());
      } catch (...) {
        causes[at] = std::current_exception();
        abandon("an exception that is not a std::exception");
      }
    });
  for (std::thread& thread : threads)
    thread.join();
  for (const auto* errors : {&causes, &consequences})
    for (const std::exception_ptr& error : *errors)
      if (error)
        std::rethrow_exception(error);
}

} // namespace dovetail::parallel
