/// @file
/// Adapter: the ranks of a network as those of MPI, for libraries that speak MPI themselves.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/partition/distributed_multilevel.hpp"

#include <mpi.h>

#include <string>

namespace dovetail::detail {

/// Throws `usage_error` unless MPI runs, and the ranks of `network` are those of `world`. Collective.
inline void require_ranks_of_mpi(any_communicator& network, MPI_Comm world, const std::string& library) {
  agreed(network, [&] {
    const std::string advice =
        library + " speaks MPI itself, over the ranks of a network that is parallel::mpi; use gathered: ";
    int is_running = 0, has_ended = 0, rank = 0, size = 1;
    MPI_Initialized(&is_running);
    MPI_Finalized(&has_ended);
    if (is_running == 0 || has_ended != 0)
      throw usage_error(advice + "MPI is not initialised in this process");
    MPI_Comm_rank(world, &rank);
    MPI_Comm_size(world, &size);
    if (rank != network.rank() || size != network.size())
      throw usage_error(advice + "rank " + std::to_string(network.rank()) + " of " +
                        std::to_string(network.size()) + " is MPI's rank " + std::to_string(rank) + " of " +
                        std::to_string(size));
  });
}

} // namespace dovetail::detail
