/// @file
/// What `improve_pieces.hpp` declares.
#pragma once

#include "dovetail/core/content_key.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/distributed/improve_pieces.hpp"
#include "dovetail/distributed/super_graph.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/parallel/entity_store.hpp"
#include "dovetail/parallel/kept_tasks.hpp"
#include "dovetail/parallel/run_results.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

namespace dovetail {

namespace detail {

/// Improves a piece inside its boundary, and checks that it still fits the skeleton.
inline void improve_inside(mesh_piece& piece, const fine_skeleton& skeleton, std::span<const local_id> listed,
                           const any_improver<3>& improve, const any_sizing& size) {
  const auto table = build_sides(piece.mesh);
  frozen_entities<3> frozen;
  frozen.points = static_cast<local_id>(piece.skeleton_points.size());
  for (const local_id side : find_skeleton_sides<3>(piece, table, skeleton, listed).sides)
    frozen.sides.push_back(table.vertices[side]);
  improve(piece.mesh, frozen, size);
  piece.mesh.tags.clear(); // the piece's material is that of all its elements
  if (const auto faults = io::check_piece<3>(piece, skeleton, listed); !faults.valid())
    throw mesh_error(named_policy("improver", improve.name()) + " left no mesh: " + faults.text());
}

} // namespace detail

DOVETAIL_INLINE quality_statistics quality_of_whole(const distributed_mesh& mesh) {
  quality_statistics whole;
  for (const piece_quality& piece : mesh.quality)
    whole.merge(piece.all, whole.elements);
  return whole;
}

DOVETAIL_INLINE improved_pieces improve_pieces(const distributed_mesh& mesh, const any_improver<3>& improve,
                                               const any_sizing& size, const any_executor& run_tasks,
                                               const improving_options& options) {
  const stopwatch clock;
  if (mesh.mid_nodes)
    throw usage_error("elements of second order are not improved: improve the mesh without middles of edges");
  if (runs_in_threads(run_tasks) && !improve.actual_traits().thread_safe)
    throw usage_error(named_policy("improver", improve.name()) +
                      " must not run in several threads of one process; use worker processes");
  const io::sides_by_subdomain<3> sides(mesh);
  const auto store = store_of(run_tasks, "improved");
  const kept_tasks tasks{run_tasks, *store, options.on_progress};
  const auto keys = std::make_shared<std::vector<content_key>>(mesh.counts.size());
  improved_pieces result{mesh, {}, {}, std::vector<local_id>(mesh.counts.size())};
  std::iota(result.piece_before.begin(), result.piece_before.end(), 0);
  result.mesh.release = {};
  result.mesh.released = {};
  result.mesh.quality.resize(mesh.counts.size());
  result.summary.name = "improvement";
  const auto chosen = [&](std::size_t p) {
    return options.only.empty() ||
           std::binary_search(options.only.begin(), options.only.end(), static_cast<local_id>(p));
  };
  improvement_counts counts;
  std::vector<global_id> sizes;
  for (std::size_t p = 0; p < mesh.counts.size(); ++p) {
    sizes.push_back(mesh.counts[p].elements);
    if (chosen(p)) {
      ++counts.pieces;
      counts.elements += sizes.back();
    }
  }
  tasks.run(
      "improving pieces", sizes,
      [&](std::size_t p) {
        auto piece = io::load_checked(mesh, static_cast<local_id>(p));
        const stopwatch time;
        if (chosen(p))
          detail::improve_inside(piece, mesh.skeleton, sides[static_cast<local_id>(p)], improve, size);
        const double seconds = time.seconds();
        piece_counts of_piece = mesh.counts[p];
        of_piece.elements = static_cast<global_id>(piece.mesh.elements.size());
        of_piece.inner_points =
            static_cast<global_id>(piece.mesh.points.size() - piece.skeleton_points.size());
        key_maker make;
        return std::tuple(seconds, of_piece, piece_quality{measure_quality(piece.mesh)},
                          tasks.keep_by_content(make(static_cast<std::int64_t>(p)), piece));
      },
      [&](std::size_t p, std::tuple<double, piece_counts, piece_quality, kept_value> improved) {
        counts.improver_seconds += std::get<0>(improved);
        result.mesh.counts[p] = std::get<1>(improved);
        result.mesh.quality[p] = std::get<2>(improved);
        (*keys)[p] = store->take(std::move(std::get<3>(improved)));
      });
  tasks.exchange(*keys);
  result.summary.set(counts);
  result.quality = quality_of_whole(result.mesh);
  result.mesh.load = [store, keys](local_id p) {
    return store->value<mesh_piece>(keys->at(static_cast<std::size_t>(p)));
  };
  result.summary.seconds = clock.seconds();
  return result;
}

} // namespace dovetail
