/// @file
/// What `by_elements.hpp` declares.
#pragma once

#include "dovetail/core/content_key.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/io/mesh_hash.hpp"
#include "dovetail/meshing/piece_codec.hpp"
#include "dovetail/parallel/entity_store.hpp"
#include "dovetail/partition/connectivity.hpp"
#include "dovetail/partition/refinement.hpp"
#include "dovetail/pipeline/by_elements.hpp"
#include "dovetail/pipeline/kept_tasks.hpp"
#include "dovetail/pipeline/piece_supers.hpp"
#include "dovetail/redistribution/piece_cut.hpp"
#include "dovetail/redistribution/piece_graph.hpp"
#include "dovetail/redistribution/super_graph.hpp"

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
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// Joins what is stray within a component of the graph; a part may have a share of several components.
inline void join_strays_within(const csr_graph& graph, const labelled_components& components,
                               std::vector<local_id>& part) {
  std::map<std::pair<local_id, local_id>, local_id> shares;
  for (std::size_t v = 0; v < part.size(); ++v)
    shares.try_emplace({part[v], components.of_node[v]}, static_cast<local_id>(shares.size()));
  std::vector<local_id> share(part.size()), part_of_share(shares.size());
  for (const auto& [key, number] : shares)
    part_of_share[static_cast<std::size_t>(number)] = key.first;
  for (std::size_t v = 0; v < part.size(); ++v)
    share[v] = shares.at({part[v], components.of_node[v]});
  join_stray_components(graph, share, static_cast<int>(shares.size()));
  for (std::size_t v = 0; v < part.size(); ++v)
    part[v] = part_of_share[static_cast<std::size_t>(share[v])];
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
        store_(std::make_shared<entity_store>(given.store, "redistributed")), tasks_{given.run_tasks, *store_,
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
    cut_pieces();
    gather_pieces();
    summarize();
    summary_.seconds = clock.seconds();
    return {std::move(rank_of_piece_), std::move(summary_), std::move(result_)};
  }

private:
  static std::size_t index(local_id id) { return static_cast<std::size_t>(id); }
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
          const auto [known, supers] =
              simplify_piece<D>(piece, mesh_.skeleton, sides_[id], given_.simplify_by, given_.super_elements);
          io::mesh_hasher hash;
          io::hash_elements_by_place(hash, piece);
          byte_writer reply;
          reply.value(hash);
          encode(reply, known);
          const byte_buffer bytes = supers.encoded();
          key_maker make;
          tasks_.keep(make(std::int64_t{id})(static_cast<std::int64_t>(hash.value()))(bytes).key(), bytes,
                      reply);
          return reply.take();
        },
        [&](std::size_t p, byte_reader& from) {
          hash_.merge(from.value<io::mesh_hasher>());
          pieces[p] = decode_simplified_piece(from);
          keys_[p] = tasks_.take_kept(from);
        });
    tasks_.exchange(keys_);
    joined_ = join_supers<D>(mesh_.skeleton, pieces, given_.seam_weight);
    report done{"simplification", clock.seconds(), {}, {}, {}};
    done.set("super_elements", joined_.graph.node_count());
    summary_.children.push_back(std::move(done));
  }

  /// New pieces are what is connected of a rank within a material, by ranks.
  void partition() {
    const stopwatch clock;
    any_communicator network = given_.run_tasks.network();
    std::vector<local_id> part = given_.partitioner.of_whole(network, joined_.graph, ranks_);
    const byte_buffer known = network.once([&] {
      byte_writer to;
      to.array(connected_parts(joined_.graph, ranks_, std::move(part), given_.imbalance));
      return to.take();
    });
    rank_of_super_ = byte_reader(known).template array<local_id>();
    const auto material_of = [&](std::size_t p) { return mesh_.counts[p].material; };
    const auto for_each_super = [&](const auto& visit) {
      for (std::size_t p = 0; p < old_pieces(); ++p)
        for (local_id s = joined_.first_of_piece[p]; s < joined_.first_of_piece[p + 1]; ++s)
          visit(p, index(s));
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
      if (auto& from = sources_[index(to)]; from.empty() || from.back() != static_cast<local_id>(p))
        from.push_back(static_cast<local_id>(p));
    });
    summary_.children.push_back({"partition", clock.seconds(), {}, {}, {}});
  }

  /// In a task: the new piece of each element of an old one.
  std::vector<local_id> new_piece_of_elements(local_id p, std::vector<local_id> super_of_element) const {
    for (local_id& at : super_of_element)
      at = piece_of_super_[index(joined_.first_of_piece[index(p)] + at)];
    return super_of_element;
  }
  elements_of_supers supers_of(local_id p) const {
    return elements_of_supers::decoded(store_->get(keys_[index(p)]));
  }

  void cut_pieces() {
    const stopwatch clock;
    std::vector<local_id> to_cut; // the others go to one new piece as they are
    std::vector<global_id> sizes;
    std::vector<int> targets(old_pieces(), 0);
    for (const auto& from : sources_)
      for (const local_id p : from)
        ++targets[index(p)];
    for (std::size_t p = 0; p < old_pieces(); ++p)
      if (targets[p] > 1) {
        to_cut.push_back(static_cast<local_id>(p));
        sizes.push_back(mesh_.counts[p].elements);
      }
    std::vector<piece_cut<D>> cuts(old_pieces());
    tasks_.run(
        "cutting pieces", sizes,
        [&](std::size_t k) {
          const local_id p = to_cut[k];
          const auto piece = io::load_checked(mesh_, p);
          elements_of_supers supers = supers_of(p);
          const auto goes_to = new_piece_of_elements(p, std::move(supers.super_of_element));
          const auto table = build_sides(piece.mesh);
          const auto on_skeleton = find_skeleton_sides<D>(piece, table, mesh_.skeleton, sides_[p]);
          byte_writer reply;
          encode(reply, cut_piece<D>(piece, table, on_skeleton, goes_to, supers.refused));
          return reply.take();
        },
        [&](std::size_t k, byte_reader& from) { cuts[index(to_cut[k])] = decode_cut<D>(from); });

    std::vector<std::array<local_id, 2>> beside = joined_.at_side;
    for (auto& pair : beside)
      for (local_id& at : pair)
        at = at == no_id ? no_id : piece_of_super_[index(at)];
    made_ = join_cuts<D>(mesh_.skeleton, beside, joined_.price_of_side, cuts);
    for (auto& cut : cuts)
      own_points_.push_back(std::move(cut.points));
    summary_.set("cut_pieces", static_cast<double>(to_cut.size()));
    summary_.children.push_back({"cuts", clock.seconds(), {}, {}, {}});
  }

  byte_buffer gather(local_id n) const {
    gathered_piece<D> gathered(n, materials_[index(n)]);
    for (const local_id p : sources_[index(n)])
      gathered.add(io::load_checked(mesh_, p), new_piece_of_elements(p, supers_of(p).super_of_element), made_,
                   own_points_[index(p)]);
    byte_writer bytes;
    encode(bytes, gathered.finish(made_.fine));
    return bytes.take();
  }

  void gather_pieces() {
    const stopwatch clock;
    key_maker all;
    all(piece_of_super_);
    for (const content_key key : keys_)
      all(static_cast<std::int64_t>(key.value));
    const content_key from_all = all.key();
    std::vector<global_id> sizes(materials_.size(), 0);
    for (std::size_t s = 0; s < piece_of_super_.size(); ++s)
      sizes[index(piece_of_super_[s])] += static_cast<global_id>(joined_.graph.node_weights[s]);
    auto mesh = std::make_shared<distributed_simplicial_mesh<D>>();
    mesh->counts.resize(materials_.size());
    auto keys = std::make_shared<std::vector<content_key>>(materials_.size());
    io::mesh_hasher after;
    tasks_.run(
        "moving elements", sizes,
        [&](std::size_t n) {
          const content_key key = key_maker(from_all)(static_cast<std::int64_t>(n)).key();
          const auto found = store_->is_shared() ? store_->find(key) : std::nullopt;
          const byte_buffer bytes = found ? *found : gather(static_cast<local_id>(n));
          byte_reader written(bytes);
          const auto piece = decode_piece<D>(written);
          io::mesh_hasher hash;
          io::hash_elements_by_place(hash, piece);
          byte_writer reply;
          reply.value(hash);
          reply.value(piece_counts{
              piece.material, static_cast<global_id>(piece.mesh.points.size() - piece.skeleton_points.size()),
              static_cast<global_id>(piece.mesh.elements.size())});
          tasks_.keep(key, bytes, reply);
          return reply.take();
        },
        [&](std::size_t n, byte_reader& from) {
          after.merge(from.value<io::mesh_hasher>());
          mesh->counts[n] = from.value<piece_counts>();
          (*keys)[n] = tasks_.take_kept(from);
        });
    if (after.value() != hash_.value())
      throw mesh_error("elements were changed or lost on their way to other pieces");
    tasks_.exchange(*keys);
    if (given_.run_tasks.leads() || !store_->is_common())
      for (const content_key key : keys_)
        store_->release(key);
    mesh->skeleton = std::move(made_.fine);
    mesh->load = [store = store_, keys](local_id n) {
      const byte_buffer bytes = store->get(keys->at(static_cast<std::size_t>(n)));
      byte_reader from(bytes);
      return decode_piece<D>(from);
    };
    mesh->material_names = mesh_.material_names;
    mesh->face_names = mesh_.face_names;
    mesh->group_names = mesh_.group_names;
    result_ = std::move(mesh);
    summary_.children.push_back({"migration", clock.seconds(), {}, {}, {}});
  }

  /// Ranks are connected if their super-elements are, in each component of the mesh.
  void summarize() {
    report described = describe_redistribution(piece_graph(*result_), rank_of_piece_, ranks_);
    const labelled_components of_ranks = components_within(joined_.graph, rank_of_super_);
    const labelled_components of_all =
        components_within(joined_.graph, std::vector<local_id>(rank_of_super_.size(), 0));
    std::vector<std::set<std::array<local_id, 2>>> shares(static_cast<std::size_t>(ranks_));
    for (std::size_t s = 0; s < rank_of_super_.size(); ++s)
      shares[index(rank_of_super_[s])].insert({of_all.of_node[s], of_ranks.of_node[s]});
    described.set("disconnected_ranks",
                  static_cast<double>(std::count_if(shares.begin(), shares.end(), [](const auto& of_rank) {
                    return std::adjacent_find(of_rank.begin(), of_rank.end(),
                                              [](const auto& a, const auto& b) { return a[0] == b[0]; }) !=
                           of_rank.end();
                  })));
    const auto is_seam = [](const simplicial_skeleton<D>& skeleton, std::size_t s) {
      return skeleton.side_hosts[s] == no_id && skeleton.subdomains[s][1] != no_id;
    };
    const auto count_seams = [&](const simplicial_skeleton<D>& skeleton) {
      double count = 0;
      for (std::size_t s = 0; s < skeleton.sides.size(); ++s)
        count += is_seam(skeleton, s) ? 1 : 0;
      return count;
    };
    described.set("super_elements", joined_.graph.node_count());
    described.set("seams_before", count_seams(mesh_.skeleton));
    described.set("seams_after", static_cast<double>(made_.seams));
    described.set("interface_sides", count_seams(result_->skeleton));
    described.set("cut_pieces", summary_.get("cut_pieces"));
    described.set("depends_on_ranks", given_.partitioner.depends_on_ranks() ? 1 : 0);
    if (given_.partitioner.depends_on_ranks())
      described.warnings.push_back(named_policy("partitioner", given_.partitioner.name()) +
                                   " gives other parts on another number of ranks: the mesh is the same up "
                                   "to meshing, what each rank of the solver gets is not");
    if constexpr (D == 3)
      measure_angles(described);
    described.children = std::move(summary_.children);
    summary_ = std::move(described);
  }

  void measure_angles(report& to) const requires(D == 3) {
    const auto& fine = result_->skeleton;
    std::vector<triangle_origin> origins;
    for (std::size_t s = 0; s < fine.sides.size(); ++s)
      origins.push_back(fine.side_hosts[s] != no_id || fine.subdomains[s][1] == no_id ? triangle_origin::cad
                        : made_.avoided[s] != 0 ? triangle_origin::refused
                                                : triangle_origin::kept);
    const interface_angles angles = measure_interface_angles(
        {span_of(fine.points), span_of(fine.sides), span_of(fine.subdomains), span_of(origins)},
        given_.interface_angle_deg);
    to.set("min_face_angle_deg", angles.face_angle.angle_deg);
    to.set("min_wedge_deg", angles.min_wedge_deg());
    to.set("small_angles", static_cast<double>(angles.violations.size()));
    to.set("avoidable_angles", static_cast<double>(angles.count(violation_cause::remeshing)));
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
  std::vector<std::vector<local_id>> own_points_; ///< per old piece: of its own, those on the new skeleton
  new_skeleton<D> made_;
  std::shared_ptr<const distributed_simplicial_mesh<D>> result_;
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
