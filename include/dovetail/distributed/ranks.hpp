/// @file
/// The executor of a run whose ranks share the tasks.
#pragma once

#include "dovetail/distributed/rank_places.hpp"
#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/parallel/concepts.hpp"

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace dovetail::parallel {

/// A model of `executor`. All ranks go through the same program and call `run` with the same tasks; each task
/// is run on one of them, by request, and its outcome is known on all, so that they go on alike. What a task
/// keeps on a disk that all ranks see is not sent. Of a machine with fewer processors than
/// workers only so many ranks take tasks in one run, others in the next.
///
/// With `worker_count` above 0 a rank runs its tasks in so many forked processes, as `processes` does, and
/// may have no other threads: then the network is `relayed`, not `mpi`. With 0 it runs them itself, one at a
/// time; rank 0 then answers the others between two of its own.
class ranks {
public:
  /// Collective. `worker_count` may differ from rank to rank.
  explicit ranks(any_communicator network, int worker_count = 0);

  /// Of all ranks.
  int workers() const { return workers_; }
  bool shares_process() const { return network_.shares_process(); }
  any_communicator network() const { return network_; }

  std::vector<task_outcome> run(std::size_t count, const task_function& task,
                                const run_options& options = {}) const;

private:
  any_communicator network_;
  int worker_count_;
  int workers_ = 0;
  std::vector<detail::rank_place> places_;
  std::shared_ptr<std::size_t> runs_ = std::make_shared<std::size_t>(0); ///< so far, of all copies
};

} // namespace dovetail::parallel

namespace dovetail::parallel {

static_assert(executor<ranks>);

} // namespace dovetail::parallel

#ifndef DOVETAIL_COMPILED
#include "dovetail/distributed/ranks.ipp"
#endif
