/// @file
/// Local repartition where remeshing makes an angle of an interface small.
#pragma once

#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/decomposition/local_repartition.hpp"
#include "dovetail/pipeline/divide.hpp"
#include "dovetail/pipeline/realize.hpp"

#include <algorithm>
#include <cstddef>
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
      : repartition_(mesh.elements(), divided.sides, divided.pieces),
        are_wanted_(are_wanted && divided.angles.count(violation_cause::remeshing) == 0) {}

  /// Changes `subdomain_of_element`, of which `made` is realized, round by round; the best is taken, and
  /// what is realized of it returned. Where something crosses then, a round is taken back. Where the coarse
  /// interfaces have such angles already, the rule does not care for them, and nothing is done.
  ///
  /// `realize()` realizes `subdomain_of_element` as it is then, `crosses(made)` says whether something
  /// crosses in that, and `small_angles(made)` gives the places of small angles in it, each as
  /// its coarse sides.
  template <class Realize, class Crosses, class SmallAngles>
  realized<D> avoid_small_angles(realized<D> made, std::vector<local_id>& subdomain_of_element,
                                 local_id subdomains, const Realize& realize, const Crosses& crosses,
                                 const SmallAngles& small_angles, double& seconds) {
    const auto realize_again = [&] {
      made = {}; // before the next one, which is as large
      made = realize();
    };
    auto places = small_angles(made);
    const stopwatch cost;
    auto best = std::pair(places.size(), subdomain_of_element);
    while (are_wanted_ && !places.empty() && places.size() <= most_places(made.counts) &&
           rounds_ < most_rounds) {
      const auto before = subdomain_of_element;
      const stopwatch clock;
      const std::size_t moved = repartition_.avoid(places, subdomain_of_element, subdomains);
      seconds += clock.seconds();
      if (moved == 0)
        break;
      ++rounds_;
      realize_again();
      if (crosses(made)) { // the same places would only ask for the same moves again
        subdomain_of_element = before;
        realize_again();
        break;
      }
      moved_ += moved;
      places = small_angles(made);
      if (places.size() < best.first)
        best = {places.size(), subdomain_of_element};
    }
    if (places.size() > best.first) {
      subdomain_of_element = std::move(best.second);
      realize_again();
      small_angles(made);
    }
    seconds_ += rounds_ > 0 ? cost.seconds() : 0;
    made.counts.repartition_rounds = rounds_;
    made.counts.repartitioned = moved_;
    made.counts.repartition_seconds = seconds_;
    made.summary.set(made.counts);
    return made;
  }

private:
  /// Each takes the time of what it changes, and mostly two are enough.
  static constexpr int most_rounds = 8;
  /// With more places of small angles per interface face the decomposition is poor as a whole: this would
  /// take longer than all the rest.
  static constexpr double most_places_per_face = 0.01;
  static constexpr std::size_t always_tried = 32; ///< places, however few the faces are

  static std::size_t most_places(const skeleton_counts& counts) {
    return std::max(always_tried, static_cast<std::size_t>(most_places_per_face *
                                                           static_cast<double>(counts.interface_faces)));
  }

  local_repartition<D> repartition_;
  bool are_wanted_;
  int rounds_ = 0;
  double seconds_ = 0;
  std::size_t moved_ = 0; ///< super-elements that changed their subdomain
};

} // namespace dovetail
