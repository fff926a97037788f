/// @file
/// A command on several ranks that mpirun has started.
#pragma once

#include "dovetail/parallel/any_communicator.hpp"

#include <functional>
#include <string>
#include <vector>

namespace dovetail::app {

/// What a process that computes has of its relay.
struct relayed_rank {
  any_communicator network; ///< of the processes that compute
  int partition_desk;       ///< a socket to its `partition_desk`
  std::vector<int> group;   ///< the ranks for which it computes, itself too
};

/// How ranks are started.
struct ranks_to_run {
  std::string command_line;     ///< the same for all
  int group;                    ///< so many ranks of a machine compute as one at most; 0: all of them
  std::function<int()> stopped; ///< says that the command was stopped, and returns its exit code
};

/// What is done where a command did not come to its end.
struct clean_up_on_ranks {
  std::function<void()> of_rank; ///< on each, when its processes are gone
  std::function<bool()> of_all;  ///< on one, when all are; whether another run can go on from what is left
};

/// Runs a command on all ranks, those of a group in one child process that computes, as `run_supervised`
/// does; the children of the others wait for it. This process is its child's relay and speaks MPI. Returns
/// the same exit code on all ranks. Where one fails, or is killed, the others are ended, and the error is
/// said once. Throws `command_line_error` when the program was built without MPI.
int run_on_ranks(const ranks_to_run& ranks, const std::function<int(const relayed_rank&)>& command,
                 const clean_up_on_ranks& clean_up);

} // namespace dovetail::app
