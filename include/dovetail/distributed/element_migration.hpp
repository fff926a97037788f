/// @file
/// Moves elements between pieces: the same mesh, cut elsewhere. Who decides where an element goes is another
/// matter.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/content_key.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/distributed/piece_cut.hpp"
#include "dovetail/distributed/super_graph.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/parallel/entity_store.hpp"
#include "dovetail/parallel/kept_tasks.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

/// The new piece of each element of an old one, and the sides of its table that ought to be no interface,
/// growing.
struct moves_of_piece {
  std::vector<local_id> new_piece_of_element; ///< by element
  std::vector<local_id> refused = {};         ///< sides of the piece that ought to be no interface, growing
};

/// What goes where. Elements of one new piece are of one material.
struct element_moves {
  std::vector<local_id> materials;            ///< per new piece
  std::vector<std::vector<local_id>> sources; ///< per new piece: the old ones that give it elements, growing
  std::vector<global_id> sizes;               ///< per new piece: its elements, about
  std::vector<std::array<local_id, 2>>
      beside; ///< per side of the skeleton: the new pieces behind and in front, or no_id
  std::vector<double>
      penalty_of_side; ///< per side of the skeleton: above 1 where it ought to be no interface
  std::function<moves_of_piece(local_id)> of_piece; ///< called in tasks
  content_key key;                                  ///< of all of the above and the mesh
  io::mesh_hasher hash;                             ///< of all elements, by place
};

/// A mesh cut elsewhere.
template <int D>
struct migrated_elements {
  std::shared_ptr<distributed_simplicial_mesh<D>> mesh; ///< in its new pieces
  std::vector<std::uint8_t> avoided; ///< per side of its skeleton: not zero where it ought to be no interface
  std::size_t seams = 0;             ///< sides inside solids that were in the old skeleton and still are
  std::size_t cut_pieces = 0;        ///< whose elements went to several
  std::vector<report> parts;         ///< "cuts", "migration"
};

namespace detail {

template <int D>
std::vector<piece_cut<D>> cut_old_pieces(const distributed_simplicial_mesh<D>& mesh,
                                         const io::sides_by_subdomain<D>& sides, const element_moves& moves,
                                         const std::vector<local_id>& to_cut, const kept_tasks& tasks) {
  std::vector<global_id> sizes;
  for (const local_id p : to_cut)
    sizes.push_back(mesh.counts[p].elements);
  std::vector<piece_cut<D>> cuts(mesh.counts.size());
  tasks.run(
      "cutting pieces", sizes,
      [&](std::size_t k) {
        const local_id p = to_cut[k];
        const auto piece = io::load_checked(mesh, p);
        const moves_of_piece goes_to = moves.of_piece(p);
        const auto table = build_sides(piece.mesh);
        const auto on_skeleton = find_skeleton_sides<D>(piece, table, mesh.skeleton, sides[p]);
        return cut_piece<D>(piece, table, on_skeleton, goes_to.new_piece_of_element, goes_to.refused);
      },
      [&](std::size_t k, piece_cut<D> cut) { cuts[to_cut[k]] = std::move(cut); });
  return cuts;
}

template <int D>
simplicial_piece<D> gather_elements(const distributed_simplicial_mesh<D>& mesh, const element_moves& moves,
                                    const new_skeleton<D>& made,
                                    const std::vector<std::vector<local_id>>& own_points, std::size_t n) {
  gathered_piece<D> gathered(static_cast<local_id>(n), moves.materials[n]);
  for (const local_id p : moves.sources[n])
    gathered.add(io::load_checked(mesh, p), moves.of_piece(p).new_piece_of_element, made, own_points[p]);
  return gathered.finish(made.fine);
}

} // namespace detail

/// Two rounds of tasks: pieces that go to several are cut, then each new one is put together. The result is
/// the same for any executor; its `quality` is measured. Memory: the new skeleton, a list of the points that
/// come onto it, and of each worker a new piece and the largest old one.
///
/// Throws `mesh_error` when pieces and skeleton disagree or an element would be lost, `io_error` of the
/// store, and `cancelled`.
template <int D>
migrated_elements<D> migrate_elements(const distributed_simplicial_mesh<D>& mesh,
                                      const io::sides_by_subdomain<D>& sides, const element_moves& moves,
                                      const std::shared_ptr<entity_store>& store, const kept_tasks& tasks) {
  const stopwatch cutting;
  migrated_elements<D> result;
  std::vector<int> targets(mesh.counts.size(), 0);
  for (const auto& from : moves.sources)
    for (const local_id p : from)
      ++targets[p];
  std::vector<local_id> to_cut; // the others go to one new piece as they are
  for (std::size_t p = 0; p < targets.size(); ++p)
    if (targets[p] > 1)
      to_cut.push_back(static_cast<local_id>(p));
  auto cuts = detail::cut_old_pieces<D>(mesh, sides, moves, to_cut, tasks);
  auto made = join_cuts<D>(mesh.skeleton, moves.beside, moves.penalty_of_side, cuts);
  std::vector<std::vector<local_id>> own_points; // per old piece: of its own, those on the new skeleton
  for (auto& cut : cuts)
    own_points.push_back(std::move(cut.points));
  cuts = {};
  result.cut_pieces = to_cut.size();
  result.parts.push_back({"cuts", cutting.seconds(), {}, {}, {}});

  const stopwatch moving;
  result.mesh = std::make_shared<distributed_simplicial_mesh<D>>();
  auto& to = *result.mesh;
  const std::size_t pieces = moves.materials.size();
  to.counts.resize(pieces);
  to.quality.resize(pieces);
  const auto keys = std::make_shared<std::vector<content_key>>(pieces);
  io::mesh_hasher after;
  tasks.run(
      "moving elements", moves.sizes,
      [&](std::size_t n) {
        const content_key key = key_maker(moves.key)(static_cast<std::int64_t>(n)).key();
        const auto found = store->is_shared() ? store->find_value<simplicial_piece<D>>(key) : std::nullopt;
        const auto piece = found ? *found : detail::gather_elements(mesh, moves, made, own_points, n);
        io::mesh_hasher hash;
        io::hash_elements_by_place(hash, piece);
        const piece_counts counts{
            piece.material, static_cast<global_id>(piece.mesh.points.size() - piece.skeleton_points.size()),
            static_cast<global_id>(piece.mesh.elements.size())};
        return std::tuple(hash, counts, piece_quality{measure_quality(piece.mesh)},
                          found ? kept_value{key, {}} : tasks.keep(key, piece));
      },
      [&](std::size_t n, std::tuple<io::mesh_hasher, piece_counts, piece_quality, kept_value> moved) {
        after.merge(std::get<0>(moved));
        to.counts[n] = std::get<1>(moved);
        to.quality[n] = std::get<2>(moved);
        (*keys)[n] = store->take(std::move(std::get<3>(moved)));
      });
  if (after.value() != moves.hash.value())
    throw mesh_error("elements were changed or lost on their way to other pieces");
  tasks.exchange(*keys);
  result.avoided = std::move(made.avoided);
  result.seams = made.seams;
  to.skeleton = std::move(made.fine);
  to.load = [store, keys](local_id n) {
    return store->value<simplicial_piece<D>>(keys->at(static_cast<std::size_t>(n)));
  };
  to.material_names = mesh.material_names;
  to.face_names = mesh.face_names;
  to.group_names = mesh.group_names;
  result.parts.push_back({"migration", moving.seconds(), {}, {}, {}});
  return result;
}

} // namespace dovetail
