/// @file
/// What `in_process.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/parallel/communicator.hpp"
#include "dovetail/parallel/in_process.hpp"

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

struct in_process::shared {
  std::mutex guard;
  std::condition_variable news;
  std::vector<std::deque<rank_message>> inboxes; ///< per rank
  std::string abandoned;                         ///< by whom, and why; empty while all go on

  void require_all() const {
    if (!abandoned.empty())
      throw communication_error(abandoned);
  }
};

DOVETAIL_INLINE int in_process::size() const {
  return static_cast<int>(all_->inboxes.size());
}

DOVETAIL_INLINE void in_process::send(int to, std::int32_t tag, byte_buffer bytes) {
  const std::lock_guard lock(all_->guard);
  all_->require_all();
  all_->inboxes.at(to).push_back({rank_, tag, std::move(bytes)});
  all_->news.notify_all();
}

DOVETAIL_INLINE std::optional<rank_message> in_process::receive() {
  const std::lock_guard lock(all_->guard);
  all_->require_all();
  auto& inbox = all_->inboxes[rank_];
  if (inbox.empty())
    return std::nullopt;
  rank_message next = std::move(inbox.front());
  inbox.pop_front();
  return next;
}

DOVETAIL_INLINE void in_process::wait(std::chrono::milliseconds at_most) {
  std::unique_lock lock(all_->guard);
  all_->news.wait_for(lock, at_most,
                      [&] { return !all_->abandoned.empty() || !all_->inboxes[rank_].empty(); });
  all_->require_all();
}

DOVETAIL_INLINE void in_process::abandon(const std::string& reason) {
  const std::lock_guard lock(all_->guard);
  if (all_->abandoned.empty())
    all_->abandoned = "rank " + std::to_string(rank_) + ": " + reason;
  all_->news.notify_all();
}

DOVETAIL_INLINE in_process::in_process(std::shared_ptr<shared> all, int rank)
    : all_(std::move(all)), rank_(rank) {}

DOVETAIL_INLINE void run_ranks(int ranks, const std::function<void(in_process&)>& work) {
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
