/// @file
/// Ranks that are threads of this process: everything distributed can be tried, and tested, without MPI.
#pragma once

#include "dovetail/parallel/communicator.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace dovetail::parallel {

/// A model of `communicator`: one rank of those that `run_ranks` has started.
class in_process {
public:
  int rank() const { return rank_; }
  int size() const;

  void send(int to, std::int32_t tag, byte_buffer bytes);
  std::optional<rank_message> receive();
  void wait(std::chrono::milliseconds at_most);
  int descriptor() const { return -1; }
  bool shares_process() const { return true; }
  void abandon(const std::string& reason);

private:
  friend void run_ranks(int ranks, const std::function<void(in_process&)>& work);

  struct shared;
  in_process(std::shared_ptr<shared> all, int rank);

  std::shared_ptr<shared> all_;
  int rank_;
};
static_assert(communicator<in_process>);

/// Runs `work(communicator)` on so many ranks, each in a thread of its own, and returns when all have ended.
/// What a rank throws ends the others' waiting; of several errors that of the lowest rank is thrown here,
/// those that only tell of another rank's last.
/// Complexity: a thread per rank. Throws `usage_error` for less than one rank, else what a rank throws.
/// \param ranks how many, at least 1
/// \param work is called once per rank, in its thread
void run_ranks(int ranks, const std::function<void(in_process&)>& work);

} // namespace dovetail::parallel

#ifndef DOVETAIL_COMPILED
#include "dovetail/parallel/in_process.ipp"
#endif
