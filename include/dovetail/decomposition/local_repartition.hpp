/// @file
/// Local repartition: where remeshing shows that a side is no good one between parts, the super-elements
/// beside it are joined.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/decompose.hpp"
#include "dovetail/decomposition/manifold_repair.hpp"
#include "dovetail/decomposition/reassignment.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// Places of small angles, each as the coarse sides there.
using places_of_angles = std::vector<std::vector<local_id>>;

/// Keeps a list of places that interfaces are to avoid, and gives super-elements there to other parts. Mesh,
/// sides and decomposition must outlive it.
template <int D>
class local_repartition {
public:
  local_repartition(const simplicial_mesh<D>& mesh, const side_table<D>& sides, const decomposition& pieces)
      : mesh_(mesh), sides_(sides), pieces_(pieces) {}

  /// A place is a list of sides, of which one at least should lie inside a part. Adds some to those of
  /// earlier calls and moves interfaces away from them, at the least penalty of what then lies between parts.
  /// Parts stay connected, of one material and as manifold as they are, and gain little weight where others
  /// can. A place where that is not possible stays as it is. `parts` are those of `part_of_element`, which
  /// may have been merged since the decomposition. Returns how many super-elements changed their part. Linear
  /// in the mesh, and quadratic in the places.
  std::size_t avoid(std::span<const std::vector<local_id>> places, std::vector<local_id>& part_of_element,
                    local_id parts) {
    append(places_, places);
    sort_unique(places_);
    std::erase_if(places_, [&](const auto& place) {
      return std::binary_search(given_up_.begin(), given_up_.end(), place);
    });
    std::vector<local_id> part(pieces_.graph.node_weights.size());
    for (std::size_t e = 0; e < part_of_element.size(); ++e)
      part[super_of(e)] = part_of_element[e];
    std::vector<double> limits = part_weights(pieces_.graph, part, parts);
    for (double& limit : limits)
      limit *= growth;
    if (!supers_)
      supers_ = std::make_shared<const super_element_points<D>>(mesh_, sides_, pieces_.super_of_element,
                                                                part.size());
    const std::vector<local_id> before = part;
    reassignable_parts<D> reassignable(supers_, pieces_.graph, part, std::move(limits));
    manifold_repair<D> repair(reassignable);
    for (const auto& place : places_)
      if (!is_avoided(place, reassignable))
        avoid(place, reassignable, repair);
    for (std::size_t e = 0; e < part_of_element.size(); ++e)
      part_of_element[e] = part[super_of(e)];
    return std::transform_reduce(part.begin(), part.end(), before.begin(), std::size_t{0}, std::plus{},
                                 [](local_id now, local_id then) { return std::size_t{now != then}; });
  }

  /// No move is made for these places any more. Returns whether there was one for which some might be.
  bool give_up(std::span<const std::vector<local_id>> places) {
    const std::size_t before = given_up_.size();
    append(given_up_, places);
    sort_unique(given_up_);
    return given_up_.size() > before;
  }

private:
  /// Of the weight of a part, beyond which others are preferred.
  static constexpr double growth = 1.02;
  /// Super-elements that may change their part together where boundaries have to be kept manifold. What
  /// needs more is not local: it mostly fails in the end, and took longer than all the rest of a large
  /// decomposition.
  static constexpr std::size_t most_reassigned = 32;

  /// Super-elements of one part that go to another.
  struct move {
    std::vector<local_id> supers;
    local_id to = no_id;
  };

  template <class Id>
  local_id super_of(Id element) const {
    return pieces_.super_of_element[element];
  }

  bool is_avoided(const std::vector<local_id>& place, const reassignable_parts<D>& parts) const {
    return std::any_of(place.begin(), place.end(), [&](local_id side) {
      const auto& [a, b] = sides_.elements[side];
      return parts.part_of(super_of(a)) == parts.part_of(super_of(b));
    });
  }
  std::size_t avoided(const reassignable_parts<D>& parts) const {
    return static_cast<std::size_t>(std::count_if(
        places_.begin(), places_.end(), [&](const auto& place) { return is_avoided(place, parts); }));
  }

  void avoid(const std::vector<local_id>& place, reassignable_parts<D>& parts, manifold_repair<D>& repair) {
    std::vector<move> single, several;
    for (const local_id side : place) {
      const auto& [a, b] = sides_.elements[side];
      for (const auto& [super, to] : {std::pair(super_of(a), parts.part_of(super_of(b))),
                                      std::pair(super_of(b), parts.part_of(super_of(a)))}) {
        single.push_back({{super}, to});
        const auto& points = sides_.vertices[side];
        for (const local_id& point : points)
          several.push_back({cluster_at({&point, 1}, super, parts), to});
        several.push_back({cluster_at(points, super, parts), to});
      }
    }
    if (!make_best(single, parts, repair))
      make_best(several, parts, repair);
  }

  /// A super-element and what is next to it, and so on, of its part and at any of the points.
  static std::vector<local_id> cluster_at(std::span<const local_id> points, local_id super,
                                          const reassignable_parts<D>& parts) {
    std::vector<local_id> waiting, cluster{super};
    for (const local_id point : points)
      append(waiting, parts.supers_at(point));
    sort_unique(waiting);
    std::erase_if(waiting,
                  [&](local_id s) { return s == super || parts.part_of(s) != parts.part_of(super); });
    for (std::size_t k = 0; k < cluster.size(); ++k) {
      const auto row = parts.graph().row(cluster[k]);
      const auto rest = std::stable_partition(waiting.begin(), waiting.end(), [&](local_id s) {
        return !std::binary_search(row.begin(), row.end(), s);
      });
      cluster.insert(cluster.end(), rest, waiting.end());
      waiting.erase(rest, waiting.end());
    }
    return cluster;
  }

  bool make_best(const std::vector<move>& moves, reassignable_parts<D>& parts, manifold_repair<D>& repair) {
    const auto before = parts.mark();
    const move* best = nullptr;
    std::size_t most = 0;
    partition_standing least;
    for (const move& each : moves)
      if (make(each, parts, repair)) {
        const std::size_t now = avoided(parts);
        if (now > most || (now == most && parts.standing().is_better_than(least))) {
          best = &each;
          most = now;
          least = parts.standing();
        }
        parts.go_back_to(before);
      }
    return best && make(*best, parts, repair);
  }

  /// Whether it can be made and more places are avoided then; it is made, with all that it entails.
  bool make(const move& wanted, reassignable_parts<D>& parts, manifold_repair<D>& repair) const {
    const auto supers = parts.with_cut_off(wanted.supers, wanted.to);
    if (!supers)
      return false;
    const std::size_t avoided_before = avoided(parts);
    const auto before = parts.mark();
    const auto adds_defects = [&] {
      const defect_count added = parts.standing().defects - before.standing.defects;
      return added.edges > 0 || added.points > 0;
    };
    parts.assign(*supers, wanted.to);
    if (adds_defects())
      repair.repair(parts.points_of(*supers), most_reassigned - std::min(most_reassigned, supers->size()));
    if (!adds_defects() && avoided(parts) > avoided_before)
      return true;
    parts.go_back_to(before);
    return false;
  }

  const simplicial_mesh<D>& mesh_;
  const side_table<D>& sides_;
  const decomposition& pieces_;
  std::shared_ptr<const super_element_points<D>> supers_ = {}; ///< from the first call on
  places_of_angles places_;                                    ///< growing
  places_of_angles given_up_ = {};                             ///< growing
};

} // namespace dovetail
