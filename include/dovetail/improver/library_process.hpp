/// @file
/// Runs a library that has global state, or may crash, in a child process with fresh memory.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/parallel/fresh_memory.hpp"
#include "dovetail/parallel/processes.hpp"

#include <string>
#include <utility>

namespace dovetail::improvement::detail {

/// The mesh that `work()` returns in a child. Throws `mesher_error` when the child fails or crashes,
/// `time_limit_error` when it takes longer than the limit; `usage_error` when this process has other threads.
template <class Work>
simplicial_mesh<3> run_in_child(double limit_seconds, const Work& work) {
  run_options alone;
  alone.limit_seconds = limit_seconds;
  auto outcomes = parallel::processes{1}.run(
      1,
      [&](std::size_t) {
        return dovetail::detail::on_fresh_memory([&] {
          const simplicial_mesh<3> made = work();
          byte_writer bytes;
          bytes.array(made.points);
          bytes.array(made.elements);
          return bytes.take();
        });
      },
      alone);
  dovetail::detail::require_done(outcomes.front(), "its process");
  byte_reader reader(outcomes.front().result);
  simplicial_mesh<3> made;
  made.points = reader.array<vec3>();
  made.elements = reader.array<simplex<3>>();
  return made;
}

} // namespace dovetail::improvement::detail
