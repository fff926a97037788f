/// @file
/// The memory of a machine's nodes, each with some of the ranks of a run.
#pragma once

#include "dovetail/parallel/execution_trace.hpp"

#include <cstdint>

namespace dovetail::simulation {

/// Bytes that a rank was measured to need, its computing process and its workers together; tetrahedra of
/// `mesher::tetgen`, more than one rank (`benchmarks/run memory`). Without them is what MPI takes.
struct rank_memory {
  double program = 50e6;
  double background_element = 700;
  double skeleton_side = 40;
  double piece_element = 250; ///< of the largest piece, in each worker

  /// Of a node with so many ranks, if each of their workers is at the largest piece.
  double of_node(const mesh_sizes& sizes, std::int64_t ranks, std::int64_t workers_of_each) const {
    const double of_rank =
        program + background_element * sizes.background_elements + skeleton_side * sizes.skeleton_sides;
    const double of_worker = piece_element * sizes.largest_piece;
    return static_cast<double>(ranks) * (of_rank + static_cast<double>(workers_of_each) * of_worker);
  }
};

} // namespace dovetail::simulation
