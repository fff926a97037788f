/// @file
/// What Open MPI leaves in memory when a run is killed.
#pragma once

#include <filesystem>

namespace dovetail::app {

/// Removes the shared memory of ranks (`vader_segment.*` or `sm_segment.*`, of this user) that no process of
/// this machine has open or mapped, as after `kill -9` of mpirun. Nothing that goes wrong is an error.
void remove_dead_mpi_segments(const std::filesystem::path& folder = "/dev/shm");

} // namespace dovetail::app
