/// @file
/// New pieces by labels of elements.
#pragma once

#include "dovetail/core/content_key.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/distributed/element_migration.hpp"
#include "dovetail/distributed/improve_pieces.hpp"
#include "dovetail/distributed/super_graph.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/entity_store.hpp"
#include "dovetail/parallel/kept_tasks.hpp"
#include "dovetail/parallel/run_results.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace dovetail::baselines {

/// A mesh whose pieces are made of what has one label.
struct labelled_mesh {
  std::shared_ptr<distributed_mesh> mesh; ///< the new pieces and what is between them
  std::vector<local_id> labels;           ///< of each piece, growing
  global_id moved = 0;                    ///< elements whose label is not the one of their old piece
};

/// What is counted of elements that were moved between two passes.
struct moved_counts {
  global_id elements = 0;       ///< that were moved
  std::size_t pieces = 0;       ///< afterwards
  double largest_over_mean = 0; ///< of the elements of pieces afterwards

  using fields = field_list<&moved_counts::elements, &moved_counts::pieces, &moved_counts::largest_over_mean>;
};

/// The same progress, but with one name for all that is done from here on, and so have traces.
inline progress within_stage(const progress& given, const char* stage) {
  given(stage, 0, 0);
  progress named = given;
  if (given.update)
    named.update = [stage, update = given.update](std::string_view, std::size_t done, std::size_t total) {
      update(stage, done, total);
    };
  return named;
}
inline improving_options within_stage(const improving_options& options, const char* stage) {
  improving_options named = options;
  named.on_progress = within_stage(options.on_progress, stage);
  return named;
}

/// What is known of a piece whose elements have labels.
struct labelled_piece {
  io::mesh_hasher hash;                         ///< of its elements and points
  std::vector<std::array<global_id, 2>> counts; ///< of each label, growing, and its elements
  std::vector<local_id> at_sides;               ///< labels of the elements at its sides of the skeleton
  kept_value kept;                              ///< the labels of all elements

  using fields = field_list<&labelled_piece::hash, &labelled_piece::counts, &labelled_piece::at_sides,
                            &labelled_piece::kept>;
};

/// Gives each element a label, in a task per piece, and puts those of one label together. `label(piece,
/// table, listed, at_sides)` labels the elements of a piece, whose own label is `own[piece]`; the table is
/// that of its sides, and `at_sides` are its elements at the `listed` sides of the skeleton. Elements of one
/// label are of one material. Errors are those of `migrate_elements`.
template <class Label>
labelled_mesh divide_by_labels(const distributed_mesh& mesh, const std::vector<local_id>& own,
                               const Label& label, const any_executor& run_tasks,
                               const improving_options& options) {
  const io::sides_by_subdomain<3> sides(mesh);
  const auto store = store_of(run_tasks, "labelled");
  const kept_tasks tasks{run_tasks, *store, options.on_progress};
  std::vector<content_key> keys(mesh.counts.size());
  std::map<local_id, std::map<local_id, global_id>> elements_of; // of a label, by old piece
  std::vector<std::array<local_id, 2>> label_at_side(mesh.skeleton.sides.size(), {no_id, no_id});
  element_moves moves;
  for (const piece_counts& counts : mesh.counts)
    moves.sizes.push_back(counts.elements);
  labelled_mesh result;
  tasks.run(
      "layers at interfaces", moves.sizes,
      [&](std::size_t p) {
        const auto id = static_cast<local_id>(p);
        const auto piece = io::load_checked(mesh, id);
        const auto table = build_sides(piece.mesh);
        const auto at_sides = find_skeleton_sides<3>(piece, table, mesh.skeleton, sides[id]).elements;
        const std::vector<local_id> labels = label(piece, table, sides[id], span_of(at_sides));
        std::map<local_id, global_id> count;
        for (const local_id l : labels)
          ++count[l];
        std::vector<std::array<global_id, 2>> counts;
        for (const auto& [l, elements] : count)
          counts.push_back({l, elements});
        std::vector<local_id> labels_at_sides;
        for (const local_id e : at_sides)
          labels_at_sides.push_back(labels[e]);
        io::mesh_hasher hash;
        io::hash_elements_by_place(hash, piece);
        key_maker make;
        make(std::int64_t{id})(static_cast<std::int64_t>(hash.value()));
        return labelled_piece{hash, std::move(counts), std::move(labels_at_sides),
                              tasks.keep_by_content(make, labels)};
      },
      [&](std::size_t p, labelled_piece labelled) {
        moves.hash.merge(labelled.hash);
        for (const auto& [l, count] : labelled.counts) {
          elements_of[static_cast<local_id>(l)][static_cast<local_id>(p)] = count;
          result.moved += l == own[p] ? 0 : count;
        }
        const auto listed = sides[static_cast<local_id>(p)];
        for (std::size_t i = 0; i < listed.size(); ++i) {
          const auto s = static_cast<std::size_t>(listed[i]);
          const bool behind = is_behind(mesh.skeleton, listed, i, static_cast<local_id>(p));
          label_at_side[s][behind ? 0 : 1] = labelled.at_sides[i];
        }
        keys[p] = store->take(std::move(labelled.kept));
      });
  tasks.exchange(keys);
  moves.sizes.clear();
  for (const auto& [l, from] : elements_of) {
    result.labels.push_back(l);
    moves.materials.push_back(mesh.counts[from.begin()->first].material);
    moves.sources.emplace_back();
    moves.sizes.push_back(0);
    for (const auto& [p, count] : from) {
      moves.sources.back().push_back(p);
      moves.sizes.back() += count;
    }
  }
  const auto numbered = [&](std::vector<local_id> labels) {
    for (local_id& l : labels)
      l = static_cast<local_id>(std::lower_bound(result.labels.begin(), result.labels.end(), l) -
                                result.labels.begin());
    return labels;
  };
  for (auto& pair : label_at_side)
    moves.beside.push_back({numbered({pair[0]})[0], pair[1] == no_id ? no_id : numbered({pair[1]})[0]});
  moves.penalty_of_side.assign(mesh.skeleton.sides.size(), 1);
  moves.of_piece = [&](local_id p) -> moves_of_piece {
    return {numbered(store->value<std::vector<local_id>>(keys[p]))};
  };
  key_maker all;
  for (const content_key key : keys)
    all(static_cast<std::int64_t>(key.value));
  moves.key = all.key();
  result.mesh = migrate_elements<3>(mesh, sides, moves, store, tasks).mesh;
  if (leads(run_tasks) || !store->is_common())
    for (const content_key key : keys)
      store->release(key);
  return result;
}

/// The summaries of two passes and of what was done between them as one.
inline report summary_of_passes(report first, report between, report second) {
  report both;
  both.name = first.name;
  for (const report* pass : {&first, &second})
    for (const auto& [counter, value] : pass->counters)
      both.add(counter, value);
  auto counts = both.as<improvement_counts>();
  counts.pieces = first.as<improvement_counts>().pieces;
  both.set(counts);
  first.name = "first pass";
  second.name = "second pass";
  both.children = {std::move(first), std::move(between), std::move(second)};
  return both;
}

} // namespace dovetail::baselines
