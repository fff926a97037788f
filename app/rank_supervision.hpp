/// @file
/// A command on several ranks that mpirun has started.
#pragma once

#include "dovetail/parallel/any_communicator.hpp"

#include <functional>

namespace dovetail::app {

/// What a process that computes has of its relay.
struct relayed_rank {
  any_communicator network;
  int partition_desk; ///< a socket to its `partition_desk`
};

/// What is done where a command did not come to its end.
struct clean_up_on_ranks {
  std::function<void()> of_rank; ///< on each, when its processes are gone
  std::function<bool()> of_all;  ///< on one, when all are; whether another run can go on from what is left
};

/// Runs a command on all ranks, each in a child process that computes, as `run_supervised` does; this process
/// is its relay and speaks MPI. Returns the same exit code on all ranks. Where one fails, or is killed, the
/// others are ended, and the error is said once.
/// Throws `command_line_error` when the program was built without MPI.
int run_on_ranks(const std::function<int(const relayed_rank&)>& command, const clean_up_on_ranks& clean_up);

} // namespace dovetail::app
