/// @file
/// What `by_elements.hpp` declares.
#pragma once

#include "dovetail/core/content_key.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/distributed/by_elements.hpp"
#include "dovetail/distributed/element_migration.hpp"
#include "dovetail/distributed/piece_graph.hpp"
#include "dovetail/distributed/piece_supers.hpp"
#include "dovetail/distributed/super_graph.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/parallel/entity_store.hpp"
#include "dovetail/parallel/kept_tasks.hpp"
#include "dovetail/parallel/run_results.hpp"
#include "dovetail/partition/connectivity.hpp"
#include "dovetail/partition/refinement.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// What is counted of elements that changed their ranks, beside `redistribution_counts`.
struct migration_counts {
  local_id super_elements = 0;
  std::size_t seams_before = 0;    ///< sides between pieces, inside solids
  std::size_t seams_after = 0;     ///< of these, those that still are
  std::size_t interface_sides = 0; ///< sides between pieces now
  std::size_t cut_pieces = 0;      ///< whose elements went to several ranks
  bool depends_on_ranks = false;   ///< another number of ranks gives other parts

  using fields = field_list<&migration_counts::super_elements, &migration_counts::seams_before,
                            &migration_counts::seams_after, &migration_counts::interface_sides,
                            &migration_counts::cut_pieces, &migration_counts::depends_on_ranks>;
};

/// The angles of the new interfaces.
struct seam_angle_counts {
  double min_face_angle_deg = 0;
  double min_dihedral_deg = 0;
  std::size_t small_angles = 0;
  std::size_t avoidable_angles = 0;

  using fields = field_list<&seam_angle_counts::min_face_angle_deg, &seam_angle_counts::min_dihedral_deg,
                            &seam_angle_counts::small_angles, &seam_angle_counts::avoidable_angles>;
};

/// Joins what is stray within a component of the graph; a part may have a share of several components.
inline void join_strays_within(const csr_graph& graph, const labelled_components& components,
                               std::vector<local_id>& part) {
  std::map<std::pair<local_id, local_id>, local_id> shares;
  for (std::size_t v = 0; v < part.size(); ++v)
    shares.try_emplace({part[v], components.of_node[v]}, static_cast<local_id>(shares.size()));
  std::vector<local_id> share(part.size()), part_of_share(shares.size());
  for (const auto& [key, number] : shares)
    part_of_share[number] = key.first;
  for (std::size_t v = 0; v < part.size(); ++v)
    share[v] = shares.at({part[v], components.of_node[v]});
  join_stray_components(graph, share, static_cast<int>(shares.size()));
  for (std::size_t v = 0; v < part.size(); ++v)
    part[v] = part_of_share[share[v]];
}

/// Makes parts connected where the graph is, as even as wanted where that can be.
inline std::vector<local_id> connected_parts(const csr_graph& graph, int parts, std::vector<local_id> part,
                                             double imbalance) {
  const labelled_components components =
      components_within(graph, std::vector<local_id>(graph.node_weights.size(), 0));
  for (int round = 0;; ++round) {
    join_strays_within(graph, components, part);
    if (round == 10 || imbalance_of(graph, part, parts) <= imbalance)
      return part;
    partition_refiner(graph, part, equal_limits(graph, parts, imbalance)).refine(1);
  }
}

/// One run of `redistribution_by::elements`.
template <int D>
class element_redistribution {
public:
  element_redistribution(const distributed_simplicial_mesh<D>& mesh, int ranks,
                         const redistribution_by::elements& given)
      : mesh_(mesh), ranks_(ranks), given_(given), sides_(mesh),
        store_(store_of(given.run_tasks, "redistributed")), tasks_{given.run_tasks, *store_,
                                                                   given.on_progress} {
    if (ranks < 1 || mesh.counts.empty())
      throw partition_error("cannot give elements to " + std::to_string(ranks) +
                            " ranks; ask for one at least");
    if (given.super_elements < 1 || !(given.seam_weight > 0) || !(given.imbalance >= 1))
      throw usage_error("redistribution_by::elements: super_elements and imbalance must be 1 at least, and "
                        "seam_weight positive");
    if (mesh.mid_nodes)
      throw usage_error(
          "elements of second order do not migrate: redistribute the mesh without middles of edges");
  }

  redistribution<D> run() {
    const stopwatch clock;
    simplify_pieces();
    partition();
    migrate();
    summarize();
    summary_.seconds = clock.seconds();
    return {std::move(rank_of_piece_), std::move(summary_), migrated_.mesh};
  }

private:
  std::size_t old_pieces() const { return mesh_.counts.size(); }

  void simplify_pieces() {
    const stopwatch clock;
    std::vector<global_id> sizes;
    for (const piece_counts& counts : mesh_.counts)
      sizes.push_back(counts.elements);
    std::vector<simplified_piece> pieces(old_pieces());
    keys_.resize(old_pieces());
    tasks_.run(
        "simplifying pieces", sizes,
        [&](std::size_t p) {
          const auto id = static_cast<local_id>(p);
          const auto piece = io::load_checked(mesh_, id);
          auto [known, supers] =
              simplify_piece<D>(piece, mesh_.skeleton, sides_[id], given_.simplify_by, given_.super_elements);
          io::mesh_hasher hash;
          io::hash_elements_by_place(hash, piece);
          key_maker make;
          make(std::int64_t{id})(static_cast<std::int64_t>(hash.value()));
          return std::tuple(hash, std::move(known), tasks_.keep_by_content(make, supers));
        },
        [&](std::size_t p, std::tuple<io::mesh_hasher, simplified_piece, kept_value> made) {
          hash_.merge(std::get<0>(made));
          pieces[p] = std::move(std::get<1>(made));
          keys_[p] = store_->take(std::move(std::get<2>(made)));
        });
    tasks_.exchange(keys_);
    joined_ = join_supers<D>(mesh_.skeleton, pieces, given_.seam_weight);
    report done{"simplification", clock.seconds(), {}, {}, {}};
    done.set(simplification_counts{.super_elements = joined_.graph.node_count()});
    summary_.children.push_back(std::move(done));
  }

  /// New pieces are what is connected of a rank within a material, by ranks.
  void partition() {
    const stopwatch clock;
    any_communicator network = given_.run_tasks.network();
    std::vector<local_id> part = given_.partitioner.of_whole(network, joined_.graph, ranks_);
    rank_of_super_ = once(given_.run_tasks, [&] {
      return connected_parts(joined_.graph, ranks_, std::move(part), given_.imbalance);
    });
    const auto material_of = [&](std::size_t p) { return mesh_.counts[p].material; };
    const auto for_each_super = [&](const auto& visit) {
      for (std::size_t p = 0; p < old_pieces(); ++p)
        for (local_id s = joined_.first_of_piece[p]; s < joined_.first_of_piece[p + 1]; ++s)
          visit(p, static_cast<std::size_t>(s));
    };
    std::map<std::pair<local_id, local_id>, local_id> labels; // of rank and material
    std::vector<local_id> label(rank_of_super_.size());
    for_each_super([&](std::size_t p, std::size_t s) {
      label[s] = labels.try_emplace({rank_of_super_[s], material_of(p)}, static_cast<local_id>(labels.size()))
                     .first->second;
    });
    const labelled_components parts = components_within(joined_.graph, label);
    std::map<std::array<local_id, 3>, local_id> numbers; // of rank, material and component
    for_each_super([&](std::size_t p, std::size_t s) {
      numbers[{rank_of_super_[s], material_of(p), parts.of_node[s]}] = 0;
    });
    for (auto& [key, number] : numbers) {
      number = static_cast<local_id>(rank_of_piece_.size());
      rank_of_piece_.push_back(key[0]);
      materials_.push_back(key[1]);
    }
    piece_of_super_.resize(rank_of_super_.size());
    sources_.resize(materials_.size());
    for_each_super([&](std::size_t p, std::size_t s) {
      const local_id to = piece_of_super_[s] = numbers[{rank_of_super_[s], material_of(p), parts.of_node[s]}];
      if (auto& from = sources_[to]; from.empty() || from.back() != static_cast<local_id>(p))
        from.push_back(static_cast<local_id>(p));
    });
    summary_.children.push_back({"partition", clock.seconds(), {}, {}, {}});
  }

  /// In a task: where the elements of an old piece go.
  moves_of_piece moves_of(local_id p) const {
    auto supers = store_->template value<elements_of_supers>(keys_[p]);
    for (local_id& at : supers.super_of_element)
      at = piece_of_super_[joined_.first_of_piece[p] + at];
    return {std::move(supers.super_of_element), std::move(supers.refused)};
  }

  void migrate() {
    element_moves moves;
    moves.materials = materials_;
    moves.sources = sources_;
    moves.sizes.assign(materials_.size(), 0);
    for (std::size_t s = 0; s < piece_of_super_.size(); ++s)
      moves.sizes[piece_of_super_[s]] += static_cast<global_id>(joined_.graph.node_weights[s]);
    moves.beside = joined_.at_side;
    for (auto& pair : moves.beside)
      for (local_id& at : pair)
        at = at == no_id ? no_id : piece_of_super_[at];
    moves.penalty_of_side = joined_.penalty_of_side;
    moves.of_piece = [this](local_id p) { return moves_of(p); };
    key_maker all;
    all(piece_of_super_);
    for (const content_key key : keys_)
      all(static_cast<std::int64_t>(key.value));
    moves.key = all.key();
    moves.hash = hash_;
    migrated_ = migrate_elements<D>(mesh_, sides_, moves, store_, tasks_);
    if (leads(given_.run_tasks) || !store_->is_common())
      for (const content_key key : keys_)
        store_->release(key);
    append(summary_.children, migrated_.parts);
  }

  /// Ranks are connected if their super-elements are, in each component of the mesh.
  void summarize() {
    report described = describe_redistribution(piece_graph(*migrated_.mesh), rank_of_piece_, ranks_);
    const labelled_components of_ranks = components_within(joined_.graph, rank_of_super_);
    const labelled_components of_all =
        components_within(joined_.graph, std::vector<local_id>(rank_of_super_.size(), 0));
    std::vector<std::set<std::array<local_id, 2>>> shares(static_cast<std::size_t>(ranks_));
    for (std::size_t s = 0; s < rank_of_super_.size(); ++s)
      shares[rank_of_super_[s]].insert({of_all.of_node[s], of_ranks.of_node[s]});
    auto counts = described.template as<redistribution_counts>();
    counts.disconnected_ranks = std::count_if(shares.begin(), shares.end(), [](const auto& of_rank) {
      return std::adjacent_find(of_rank.begin(), of_rank.end(),
                                [](const auto& a, const auto& b) { return a[0] == b[0]; }) != of_rank.end();
    });
    described.set(counts);
    const auto is_seam = [](const simplicial_skeleton<D>& skeleton, std::size_t s) {
      return skeleton.side_hosts[s] == no_id && skeleton.subdomains[s][1] != no_id;
    };
    const auto count_seams = [&](const simplicial_skeleton<D>& skeleton) {
      std::size_t count = 0;
      for (std::size_t s = 0; s < skeleton.sides.size(); ++s)
        count += is_seam(skeleton, s) ? 1 : 0;
      return count;
    };
    described.set(migration_counts{.super_elements = joined_.graph.node_count(),
                                   .seams_before = count_seams(mesh_.skeleton),
                                   .seams_after = migrated_.seams,
                                   .interface_sides = count_seams(migrated_.mesh->skeleton),
                                   .cut_pieces = migrated_.cut_pieces,
                                   .depends_on_ranks = given_.partitioner.depends_on_ranks()});
    if (given_.partitioner.depends_on_ranks())
      described.warnings.push_back(named_policy("partitioner", given_.partitioner.name()) +
                                   " gives other parts on another number of ranks: the mesh is the same up "
                                   "to meshing, what each rank of the solver gets is not");
    if (const double imbalance = counts.imbalance; imbalance > given_.imbalance)
      described.warnings.push_back("the largest rank has " + number_text(imbalance, 4) +
                                   " times the average of elements, more than the " +
                                   number_text(given_.imbalance, 4) +
                                   " that were tried for: connected ranks came no nearer");
    if constexpr (D == 3)
      measure_angles(described);
    described.children = std::move(summary_.children);
    summary_ = std::move(described);
  }

  void measure_angles(report& to) const requires(D == 3) {
    const interface_angles angles =
        measure_skeleton_angles(migrated_.mesh->skeleton, wanted_angles_of<3>(given_.simplify_by),
                                migrated_.avoided, {}, mesh_state::valid);
    to.set(seam_angle_counts{.min_face_angle_deg = angles.face_angle.angle_deg,
                             .min_dihedral_deg = angles.min_dihedral_deg(),
                             .small_angles = angles.violations.size(),
                             .avoidable_angles = angles.count(violation_cause::remeshing)});
  }

  const distributed_simplicial_mesh<D>& mesh_;
  const int ranks_;
  const redistribution_by::elements& given_;
  const io::sides_by_subdomain<D> sides_;
  std::shared_ptr<entity_store> store_;
  const kept_tasks tasks_;
  std::vector<content_key> keys_; ///< per old piece: of its `elements_of_supers`
  io::mesh_hasher hash_;          ///< of all elements, by place
  joined_supers joined_;
  std::vector<local_id> rank_of_super_;
  std::vector<local_id> piece_of_super_; ///< the new piece
  std::vector<local_id> rank_of_piece_, materials_;
  std::vector<std::vector<local_id>> sources_; ///< per new piece: the old ones that give it elements, growing
  migrated_elements<D> migrated_;
  report summary_;
};

} // namespace detail

namespace redistribution_by {

template <int D>
redistribution<D> elements::operator()(const distributed_simplicial_mesh<D>& mesh, int ranks) const {
  return detail::element_redistribution<D>(mesh, ranks, *this).run();
}

#ifdef DOVETAIL_COMPILED
template redistribution<2> elements::operator()<2>(const distributed_simplicial_mesh<2>&, int) const;
template redistribution<3> elements::operator()<3>(const distributed_simplicial_mesh<3>&, int) const;
#endif

} // namespace redistribution_by
} // namespace dovetail
