/// @file
/// What ran when, and where: the record of a run, for pictures and for the simulation of larger machines.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace dovetail {

/// A task that gave a result. Times are seconds since its batch began.
struct task_span {
  std::size_t task = 0;         ///< its number in the batch
  int worker = 0;               ///< of the batch, by when they began
  double begin = 0;             ///< when it began
  double seconds = 0;           ///< how long it took
  std::size_t result_bytes = 0; ///< how large its result was

  friend bool operator==(const task_span&, const task_span&) = default;
};

/// The tasks that were given to an executor at once. Times are seconds since the trace began.
struct batch_span {
  std::string stage;                 ///< what progress called it
  double begin = 0;                  ///< when it began
  double end = 0;                    ///< when its last task ended
  std::vector<task_span> tasks = {}; ///< by number
  std::size_t failed = 0;            ///< tasks without result, of which no times are known
  bool once = false;                 ///< not given away: the process that leads works, and tells the others

  friend bool operator==(const batch_span&, const batch_span&) = default;
};

/// What progress calls a stage, from one name to the next.
struct stage_span {
  std::string stage; ///< what progress called it
  double begin = 0;  ///< when it began
  double end = 0;    ///< when the next one began

  friend bool operator==(const stage_span&, const stage_span&) = default;
};

/// What the memory of a rank goes with.
struct mesh_sizes {
  double background_elements = 0; ///< of the whole background mesh
  double skeleton_sides = 0;      ///< of the whole skeleton
  double largest_piece = 0;       ///< its elements; 0 where none of these are known

  bool are_known() const { return largest_piece > 0; } ///< whether there are any
  friend bool operator==(const mesh_sizes&, const mesh_sizes&) = default;
};

/// As `parallel::traced` makes it, in the order in which things began.
struct execution_trace {
  int workers = 1;                      ///< how many ran tasks
  double elements = 0;                  ///< of the mesh that was made, when known
  mesh_sizes sizes = {};                ///< of the mesh that was made
  double seconds = 0;                   ///< of the whole run
  std::vector<stage_span> stages = {};  ///< in the order they began
  std::vector<batch_span> batches = {}; ///< in the order they were given
  std::string subject = {};             ///< what was meshed; empty where it is not known

  friend bool operator==(const execution_trace&, const execution_trace&) = default;
};

/// Seconds between the first and the last moment of a stretch of the trace that no batch fills: what all
/// ranks do alike. `begin` and `end` are seconds since the trace began.
inline double seconds_alike(const execution_trace& trace, double begin, double end) {
  double alone = end - begin;
  for (const batch_span& batch : trace.batches)
    alone -= std::max(0.0, std::min(end, batch.end) - std::max(begin, batch.begin));
  return std::max(0.0, alone);
}

} // namespace dovetail
