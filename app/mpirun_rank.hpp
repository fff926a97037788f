/// @file
/// Which rank a process is, as who has started it says, before MPI is initialised.
#pragma once

#include <optional>

#include <sys/types.h>

namespace dovetail::app {

struct mpirun_rank {
  int rank = 0;
  int size = 1;
};

/// Where it says so: which of the ranks of its machine a process is, and how many these are.
struct place_on_machine {
  int rank = 0;
  int size = 0; ///< 0: it does not say so
};

/// Of this process; one of one where no mpirun has started it.
mpirun_rank rank_of_mpirun();

place_on_machine place_of_mpirun();

/// Of another process of the same run; nothing where it is none, or one that has not begun yet.
std::optional<mpirun_rank> rank_of_mpirun(pid_t process);

} // namespace dovetail::app
