/// @file
/// What most rules have in common: the answers of the paper's rule, for others to pass on.
#pragma once

#include "dovetail/simplification/concepts.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace dovetail::simplifier {

/// The penalty of a refused side: 1 + base for one that is as good as wanted, growing linearly to 1 + base +
/// growth for one that has nothing of what is wanted.
struct refusal_penalty {
  double base = 10;    ///< of a side that is as good as wanted, beyond 1
  double growth = 200; ///< more for a side that has nothing of what is wanted

  /// The penalty for what a side falls short of.
  double operator()(const deficit& missed) const {
    return 1 + base + growth * std::max(0.0, 1 - missed.fraction());
  }
};

/// The side of lower quality goes; ties by number.
inline bool is_worse(const dihedral_side& a, const dihedral_side& b) {
  return std::pair(a.quality, a.side) < std::pair(b.quality, b.side);
}

/// The decision of the surface goes for the volume too: sides at a removed edge are removed, those at the
/// worst edge (against `wanted`) first; those at a refused edge are penalised by what the edge missed.
inline ridge_decision as_below(const side_below& below, double wanted) {
  if (below.state == side_state::refused)
    return {below.missed, true};
  return {{below.quality, wanted}};
}

} // namespace dovetail::simplifier
