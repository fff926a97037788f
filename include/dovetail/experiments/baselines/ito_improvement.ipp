/// @file
/// What `ito_improvement.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/experiments/baselines/element_layers.hpp"
#include "dovetail/experiments/baselines/ito_improvement.hpp"
#include "dovetail/experiments/baselines/labelled_elements.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::baselines {

namespace detail {

/// Labels the elements of a collected mesh by the pieces beside it: each gets the label of the nearest
/// element at a side of such a piece, counted over sides. `label_behind[i]` is that of the piece at side i,
/// or `no_piece`; where none is reached the label is `otherwise`. Linear.
inline std::vector<local_id> nearest_labels(const side_table<3>& table, std::span<const local_id> at_sides,
                                            std::span<const local_id> label_behind, local_id otherwise) {
  std::vector<local_id> labels(table.of_element.size(), no_piece), reached;
  for (std::size_t i = 0; i < at_sides.size(); ++i) {
    local_id& label = labels[at_sides[i]];
    if (label_behind[i] != no_piece && label == no_piece)
      reached.push_back(at_sides[i]);
    label = std::min(label, label_behind[i]);
  }
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const local_id e = reached[k];
    for (const local_id side : table.of_element[e]) {
      const local_id next = table.across(side, e);
      if (next == no_id || labels[next] != no_piece)
        continue;
      labels[next] = labels[e];
      reached.push_back(next);
    }
  }
  std::replace(labels.begin(), labels.end(), no_piece, otherwise);
  return labels;
}

} // namespace detail

DOVETAIL_INLINE improved_pieces ito_improvement::operator()(const distributed_mesh& mesh,
                                                            const any_improver<3>& improve,
                                                            const any_sizing& size,
                                                            const any_executor& run_tasks,
                                                            const improving_options& options) const {
  const stopwatch clock;
  improved_pieces first = improve_pieces(mesh, improve, size, run_tasks, within_stage(options, "first pass"));

  // Pieces have their numbers for labels, and the collected mesh of a material one beyond them.
  const stopwatch collecting;
  const auto pieces = static_cast<local_id>(mesh.counts.size());
  const interface_points points(first.mesh);
  labelled_mesh collected = divide_by_labels(
      first.mesh, first.piece_before,
      [&](const mesh_piece& piece, const side_table<3>&, std::span<const local_id>,
          std::span<const local_id>) {
        auto labels = least_within_layers(piece.mesh, points.least_pieces(piece), layers);
        for (local_id& label : labels)
          label = label == no_piece ? piece.subdomain : pieces + piece.material;
        return labels;
      },
      run_tasks, within_stage(options, "collection"));
  report collection{"collection", collecting.seconds(), {}, {}, {}};
  collection.set(moved_counts{.elements = collected.moved, .pieces = collected.labels.size()});

  improving_options of_collected = within_stage(options, "second pass");
  for (std::size_t p = 0; p < collected.labels.size(); ++p)
    if (collected.labels[p] >= pieces)
      of_collected.only.push_back(static_cast<local_id>(p));
  if (of_collected.only.empty())
    return first; // there are no interfaces
  first.mesh = {};
  improved_pieces second = improve_pieces(*collected.mesh, improve, size, run_tasks, of_collected);
  collected.mesh.reset();

  const stopwatch writing;
  const auto label_of = [&](local_id piece) { return piece == no_id ? no_piece : collected.labels[piece]; };
  const labelled_mesh back = divide_by_labels(
      second.mesh, collected.labels,
      [&](const mesh_piece& piece, const side_table<3>& table, std::span<const local_id> listed,
          std::span<const local_id> at_sides) {
        const local_id mine = label_of(piece.subdomain);
        if (mine < pieces)
          return std::vector<local_id>(piece.mesh.elements.size(), mine);
        std::vector<local_id> beside;
        for (const local_id side : listed) {
          const auto s = static_cast<std::size_t>(side);
          const auto [behind, front] = second.mesh.skeleton.subdomains[s];
          const local_id other = label_of(behind == piece.subdomain ? front : behind);
          beside.push_back(is_interface(second.mesh.skeleton, s) && other < pieces ? other : no_piece);
        }
        const auto of_material = [&](const piece_counts& counts) {
          return counts.material == piece.material;
        };
        const auto least = std::find_if(mesh.counts.begin(), mesh.counts.end(), of_material);
        return detail::nearest_labels(table, at_sides, span_of(beside),
                                      static_cast<local_id>(least - mesh.counts.begin()));
      },
      run_tasks, within_stage(options, "writing back"));

  improved_pieces result{*back.mesh, quality_of_whole(*back.mesh), {}, back.labels};
  report written{"writing back", writing.seconds(), {}, {}, {}};
  written.set(moved_counts{.elements = back.moved, .pieces = back.labels.size()});
  result.summary =
      summary_of_passes(std::move(first.summary), std::move(collection), std::move(second.summary));
  result.summary.children.push_back(std::move(written));
  result.summary.seconds = clock.seconds();
  return result;
}

} // namespace dovetail::baselines
