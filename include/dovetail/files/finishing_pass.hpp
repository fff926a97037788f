/// @file
/// The last pass over a mesh: each piece is loaded once, checked against the skeleton, hashed, written, and
/// its storage given up.
#pragma once

#include "dovetail/core/progress.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/files/piecewise_output.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/poor_elements.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/mesh/quality_at_interfaces.hpp"
#include "dovetail/parallel/any_executor.hpp"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace dovetail::io {

/// How the pass is made.
struct finishing_options {
  /// Give up each piece as soon as its files are complete. If the pass does not come to its end, these stay
  /// in the folder "unfinished" for a resumed run.
  bool release = false;
  double limit_seconds = 600; ///< wall clock per piece; the last resort
  progress on_progress = {};  ///< told how the pieces come along
};

/// What is counted of the pass.
struct finishing_counts {
  std::size_t tasks = 0;            ///< files, or pieces without writers
  std::size_t taken_over = 0;       ///< of these, from a run before
  std::uint64_t peak_rss_bytes = 0; ///< of the largest worker

  using fields =
      field_list<&finishing_counts::tasks, &finishing_counts::taken_over, &finishing_counts::peak_rss_bytes>;
};

/// What the pass found.
struct finished_mesh {
  std::uint64_t hash = 0;              ///< as `mesh_hash`
  quality_statistics quality;          ///< `worst_element` is a global number
  quality_at_interfaces at_interfaces; ///< the same elements by their distance from interfaces
  poor_elements poor;                  ///< by their causes
  report summary;                      ///< `finishing_counts`; a child per writer
};

/// One task per file, or per piece without writers: loads its pieces one after the other, checks each as
/// `check_piece` does, measures it unless its quality is known, and hands it to the writers. Files are
/// complete under temporary names before any gets its final one. The result and the files do not depend on
/// the executor.
///
/// A piece that does not fit throws `mesh_error` naming the subdomain and the place; further `io_error`
/// naming the path, `usage_error` when pieces were given up to files that are not among these, and
/// `cancelled`. Memory: the skeleton, one work array of its size, and one piece per worker.
template <int D>
finished_mesh finish_mesh(const distributed_simplicial_mesh<D>& mesh,
                          const std::vector<any_piecewise_writer<D>>& writers,
                          const std::filesystem::path& folder, const any_executor& run_tasks,
                          const finishing_options& options = {});

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/files/finishing_pass.ipp"
#endif
