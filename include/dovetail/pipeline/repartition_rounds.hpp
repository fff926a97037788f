/// @file
/// Local repartition where remeshing makes an angle of an interface small.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/decomposition/local_repartition.hpp"
#include "dovetail/decomposition/skeleton_part.hpp"
#include "dovetail/pipeline/divide.hpp"
#include "dovetail/pipeline/realize.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace dovetail {

/// A local search for the decomposition with small angles in the fewest places. Mesh and division must
/// outlive it.
template <int D>
class repartition_rounds {
public:
  /// `are_wanted`: false does nothing but measure.
  repartition_rounds(const simplicial_background<D>& mesh, const divided_background<D>& divided,
                     bool are_wanted)
      : mesh_(mesh), sides_(divided.sides), repartition_(mesh.elements(), divided.sides, divided.pieces),
        are_wanted_(are_wanted && divided.angles.count(violation_cause::remeshing) == 0) {}

  /// Changes `subdomain_of_element`, of which `made` is realized, and returns what is realized of it then.
  /// Rounds look at what is around their changes alone. One after which something crosses there is taken
  /// back, and the places next to that are given up. The best round is realized as a whole; all are taken
  /// back where that is no better, or something crosses. Where the coarse interfaces have such angles
  /// already, the rule does not care for them, and nothing is done.
  ///
  /// `realize()` realizes `subdomain_of_element` as it is then, `realize_part(subdomain_of_element,
  /// is_wanted)` what has a wanted point; `crossings(made)` says where something crosses in that, nothing
  /// where nothing does, and `small_angles(made)` gives the places of small angles in it.
  template <class Realize, class RealizePart, class Crossings, class SmallAngles>
  realized<D> avoid_small_angles(realized<D> made, std::vector<local_id>& subdomain_of_element,
                                 local_id subdomains, const Realize& realize, const RealizePart& realize_part,
                                 const Crossings& crossings, const SmallAngles& small_angles,
                                 double& seconds) {
    const auto realize_again = [&] {
      made = {}; // before the next one, which is as large
      made = realize();
    };
    auto places = small_angles(made);
    const stopwatch cost;
    while (are_wanted_ && !places.empty() && places.size() <= most_places(made.counts)) {
      candidate best{places, subdomain_of_element};
      const auto looks_at = [&](const std::vector<local_id>& subdomain, const std::vector<bool>& is_wanted) {
        auto part = realize_part(subdomain, is_wanted);
        if (auto crossed = crossings(part))
          return sight{{}, std::move(crossed)};
        return sight{small_angles(part), {}};
      };
      if (!find_better(best, subdomains, looks_at, seconds))
        break;
      const auto before = std::exchange(subdomain_of_element, std::move(best.subdomain_of_element));
      realize_again();
      auto left = crossings(made) ? places : small_angles(made); // no better where something crosses
      if (left.size() >= places.size()) {
        subdomain_of_element = before;
        realize_again();
        small_angles(made);
        break;
      }
      moved_ += best.moved;
      places = std::move(left);
      if (best.is_last)
        break;
    }
    seconds_ += rounds_ > 0 ? cost.seconds() : 0;
    made.counts.repartition_rounds = rounds_;
    made.counts.repartitioned = moved_;
    made.counts.repartition_seconds = seconds_;
    made.summary.set(made.counts);
    return made;
  }

private:
  /// Mostly two are enough.
  static constexpr int most_rounds = 8;
  /// With more places of small angles per interface face the decomposition is poor as a whole: this would
  /// take longer than all the rest.
  static constexpr double most_places_per_face = 0.01;
  static constexpr std::size_t always_tried = 32; ///< places, however few the faces are

  static std::size_t most_places(const skeleton_counts& counts) {
    return std::max(always_tried, static_cast<std::size_t>(most_places_per_face *
                                                           static_cast<double>(counts.interface_faces)));
  }

  /// A decomposition, and where it has small angles.
  struct candidate {
    places_of_angles places;
    std::vector<local_id> subdomain_of_element;
    std::size_t moved = 0; ///< super-elements, since the decomposition that was realized as a whole
    bool is_last = false;  ///< the search went on from it to where something crosses
  };

  /// What is seen of a decomposition around its changes.
  struct sight {
    places_of_angles places;                    ///< of small angles
    std::optional<std::vector<vec3>> crossings; ///< where something crosses, if something does
  };

  /// Goes on from the best one round by round; whether there is a better one.
  template <class Look>
  bool find_better(candidate& best, local_id subdomains, const Look& looks_at, double& seconds) {
    const std::size_t places_before = best.places.size();
    candidate here = best;
    while (!here.places.empty() && rounds_ < most_rounds) {
      const auto before = here.subdomain_of_element;
      const stopwatch clock;
      const std::size_t moved = repartition_.avoid(here.places, here.subdomain_of_element, subdomains);
      const auto changed = points_of_changed(before, here.subdomain_of_element);
      seconds += clock.seconds();
      if (moved == 0)
        break;
      ++rounds_;
      here.moved += moved;
      const sight there =
          looks_at(here.subdomain_of_element, points_around<D>(mesh_.elements().elements, changed));
      if (there.crossings) {
        here.subdomain_of_element = before;
        here.moved -= moved;
        if (repartition_.give_up(places_next_to(*there.crossings, here.places)))
          continue;
        best.is_last = true; // the same places would only ask for the same moves again
        break;
      }
      std::erase_if(here.places, [&](const auto& place) { return is_at(place, changed); });
      std::copy_if(there.places.begin(), there.places.end(), std::back_inserter(here.places),
                   [&](const auto& place) { return is_at(place, changed); });
      sort_unique(here.places);
      if (here.places.size() < best.places.size())
        best = here;
    }
    return best.places.size() < places_before;
  }

  /// Of these places the one nearest to each point, and all that are hardly farther: by the length of its
  /// sides.
  places_of_angles places_next_to(const std::vector<vec3>& points, const places_of_angles& places) const {
    places_of_angles next;
    for (const vec3 point : points) {
      const auto nearest = std::min_element(places.begin(), places.end(), [&](const auto& a, const auto& b) {
        return distance_to(a, point) < distance_to(b, point);
      });
      if (nearest == places.end())
        continue;
      const double reach = distance_to(*nearest, point) + length_of(*nearest);
      std::copy_if(places.begin(), places.end(), std::back_inserter(next),
                   [&](const auto& place) { return distance_to(place, point) <= reach; });
    }
    return next;
  }
  double distance_to(const std::vector<local_id>& place, vec3 point) const {
    double least = std::numeric_limits<double>::infinity();
    for (const local_id side : place)
      for (const local_id v : sides_.vertices[side])
        least = std::min(least, distance(mesh_.points()[v], point));
    return least;
  }
  /// The longest edge at the first point of one of its sides.
  double length_of(const std::vector<local_id>& place) const {
    double longest = 0;
    for (const local_id side : place)
      for (const local_id v : sides_.vertices[side])
        longest = std::max(longest, distance(mesh_.points()[v], mesh_.points()[sides_.vertices[side][0]]));
    return longest;
  }

  std::vector<bool> points_of_changed(const std::vector<local_id>& before,
                                      const std::vector<local_id>& after) const {
    std::vector<bool> changed(mesh_.points().size(), false);
    for (std::size_t e = 0; e < before.size(); ++e)
      if (before[e] != after[e])
        for (const local_id v : mesh_.elements().elements[e])
          changed[v] = true;
    return changed;
  }
  bool is_at(const std::vector<local_id>& place, const std::vector<bool>& points) const {
    return std::any_of(place.begin(), place.end(), [&](local_id side) {
      const auto& vertices = sides_.vertices[side];
      return std::any_of(vertices.begin(), vertices.end(), [&](local_id v) { return points[v]; });
    });
  }

  const simplicial_background<D>& mesh_;
  const side_table<D>& sides_;
  local_repartition<D> repartition_;
  bool are_wanted_;
  int rounds_ = 0;
  double seconds_ = 0;
  std::size_t moved_ = 0; ///< super-elements that changed their subdomain
};

} // namespace dovetail
