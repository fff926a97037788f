/// @file
/// What `loehner_improvement.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/experiments/baselines/element_layers.hpp"
#include "dovetail/experiments/baselines/labelled_elements.hpp"
#include "dovetail/experiments/baselines/loehner_improvement.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::baselines {

DOVETAIL_INLINE improved_pieces loehner_improvement::operator()(const distributed_mesh& mesh,
                                                                const any_improver<3>& improve,
                                                                const any_sizing& size,
                                                                const any_executor& run_tasks,
                                                                const improving_options& options) const {
  const stopwatch clock;
  improved_pieces first = improve_pieces(mesh, improve, size, run_tasks, within_stage(options, "first pass"));

  const stopwatch moving;
  const interface_points points(first.mesh);
  const labelled_mesh moved = divide_by_labels(
      first.mesh, first.piece_before,
      [&](const mesh_piece& piece, const side_table<3>&, std::span<const local_id>,
          std::span<const local_id>) {
        auto labels = least_within_layers(piece.mesh, points.least_pieces(piece), layers);
        for (local_id& label : labels)
          label = std::min(label, piece.subdomain);
        return labels;
      },
      run_tasks, within_stage(options, "redistribution"));
  global_id most = 0, all = 0;
  for (const piece_counts& counts : moved.mesh->counts) {
    most = std::max(most, counts.elements);
    all += counts.elements;
  }
  const double largest_over_mean =
      static_cast<double>(most) * static_cast<double>(moved.labels.size()) / static_cast<double>(all);
  first.mesh = {};
  report redistribution{"redistribution", moving.seconds(), {}, {}, {}};
  redistribution.set(moved_counts{moved.moved, moved.labels.size(), largest_over_mean});

  improved_pieces result =
      improve_pieces(*moved.mesh, improve, size, run_tasks, within_stage(options, "second pass"));
  result.summary =
      summary_of_passes(std::move(first.summary), std::move(redistribution), std::move(result.summary));
  result.piece_before = moved.labels;
  result.summary.seconds = clock.seconds();
  return result;
}

} // namespace dovetail::baselines
