/// @file
/// How the tasks of a run come to its ranks: some in the beginning, then one for each that is done.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/distributed/task_feed.hpp"
#include "dovetail/parallel/any_communicator.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// The feed of one rank. Each has two tasks of its own for each worker in the beginning, so that none waits
/// for an answer, dealt in turn without a word; rank 0 grants the others, in the order of the run, one for
/// each request, and each task that is done is one request: so it knows when all is done, and tells those
/// that do not work. A task costs an empty message and one of 8 bytes.
class rank_tasks final : public task_feed {
public:
  /// Collective, with the same arguments on all ranks. `workers`: by rank, 0 for one that takes no tasks.
  rank_tasks(any_communicator network, std::size_t count, const std::vector<std::int32_t>& workers)
      : network_(std::move(network)), requests_(network_.next_tag()), grants_(network_.next_tag()),
        count_(count) {
    deal(workers);
    deal(workers);
    mine_ = granted_.size();
    for (int r = 1; r < network_.size(); ++r)
      if (workers[r] == 0) {
        idle_.push_back(r);
        unanswered_ += r == network_.rank() ? 1 : 0;
      }
  }

  std::vector<std::size_t> granted() override {
    if (network_.leads())
      while (const auto request = network_.receive(requests_))
        network_.send(request->peer, grants_, text_of(grant()));
    else
      while (const auto answer = network_.receive(grants_))
        take(byte_reader(answer->bytes).value<std::int64_t>());
    return std::exchange(granted_, {});
  }
  void finished(std::size_t place) override {
    finished_.push_back(place);
    if (network_.leads()) {
      take(grant());
    } else {
      network_.send(0, requests_, {});
      ++unanswered_;
    }
  }
  bool ended() const override {
    return network_.leads() ? answered_ == count_ : finished_.size() == mine_ && unanswered_ == 0;
  }
  std::size_t done() const override { return network_.leads() ? answered_ : finished_.size(); }
  int descriptor() const override { return network_.descriptor(); }

  /// Those of this rank.
  const std::vector<std::size_t>& finished_places() const { return finished_; }

private:
  static constexpr std::int64_t nothing = -1;

  /// The next tasks, one for each worker: for the first of each rank, then for the second of each, and so on.
  void deal(const std::vector<std::int32_t>& workers) {
    const std::int32_t most = *std::max_element(workers.begin(), workers.end());
    for (std::int32_t w = 0; w < most; ++w)
      for (std::size_t r = 0; r < workers.size(); ++r)
        if (w < workers[r] && next_ < count_) {
          if (static_cast<int>(r) == network_.rank())
            granted_.push_back(next_);
          ++next_;
        }
  }
  static byte_buffer text_of(std::int64_t place) {
    byte_writer to;
    to.value(place);
    return to.take();
  }
  /// On rank 0: the answer to a request.
  std::int64_t grant() {
    if (++answered_ == count_)
      for (const int r : idle_)
        network_.send(r, grants_, text_of(nothing));
    return next_ < count_ ? static_cast<std::int64_t>(next_++) : nothing;
  }
  void take(std::int64_t place) {
    unanswered_ -= network_.leads() ? 0 : 1;
    if (place == nothing)
      return;
    granted_.push_back(static_cast<std::size_t>(place));
    ++mine_;
  }

  any_communicator network_;
  std::int32_t requests_;
  std::int32_t grants_;
  std::size_t count_;
  std::size_t next_ = 0;     ///< on rank 0: the first place that nobody has
  std::size_t answered_ = 0; ///< on rank 0: requests, its own too
  std::vector<int> idle_;    ///< ranks that do not work, without rank 0
  std::vector<std::size_t> granted_;
  std::size_t mine_ = 0;
  std::vector<std::size_t> finished_;
  std::size_t unanswered_ = 0;
};

} // namespace dovetail::detail
