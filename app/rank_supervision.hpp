/// @file
/// A command on several ranks that mpirun has started.
#pragma once

#include "dovetail/parallel/any_communicator.hpp"

#include <functional>

namespace dovetail::app {

/// Which rank this process is, as mpirun says before MPI is initialised.
struct mpirun_rank {
  int rank = 0;
  int size = 1;
};
mpirun_rank rank_of_mpirun();

/// Runs a command on all ranks, each in a child process that computes, as `run_supervised` does; this process
/// is its relay and speaks MPI. Returns the same exit code on all ranks. Where one fails, or is killed, the
/// others are ended; the error is said once, and `clean_up` is called once, when all processes are gone.
/// Throws `command_line_error` when the program was built without MPI.
int run_on_ranks(const std::function<int(const any_communicator&)>& command,
                 const std::function<bool()>& clean_up);

} // namespace dovetail::app
