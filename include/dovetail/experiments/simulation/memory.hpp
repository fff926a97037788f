/// @file
/// The memory of a machine's nodes, each with some of the ranks of a run.
#pragma once

#include "dovetail/parallel/execution_trace.hpp"

#include <cstdint>

namespace dovetail::simulation {

/// Bytes that a rank was measured to need, its computing process and its workers together; tetrahedra of
/// `mesher::native` (`benchmarks/run memory`). The ranks of a node have the skeleton together. What MPI takes
/// is not in it.
struct rank_memory {
  double program = 23e6;           ///< of the program itself
  double background_element = 539; ///< for each element of the background mesh
  double piece_element = 146;      ///< of the largest piece, in each worker
  double skeleton_side = 71;       ///< once on a node

  /// Of a node with so many ranks, if each of their workers is at the largest piece.
  double of_node(const mesh_sizes& sizes, std::int64_t ranks, std::int64_t workers_of_each) const {
    const double of_rank = program + background_element * sizes.background_elements;
    const double of_worker = piece_element * sizes.largest_piece;
    return skeleton_side * sizes.skeleton_sides +
           static_cast<double>(ranks) * (of_rank + static_cast<double>(workers_of_each) * of_worker);
  }
};

} // namespace dovetail::simulation
