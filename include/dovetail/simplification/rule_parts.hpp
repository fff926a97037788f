/// @file
/// What most rules have in common: the answers of the paper's rule, for others to pass on.
#pragma once

#include "dovetail/simplification/concepts.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace dovetail::simplifier {

/// Weight of a refused side: 1 + base at what was wanted, growing linearly with what is missing of it by up
/// to `penalty`.
struct refusal_price {
  double base = 10;
  double penalty = 200;

  double operator()(const shortfall& missed) const {
    return 1 + base + penalty * std::max(0.0, 1 - missed.fraction());
  }
};

/// The side of lower quality goes; ties by number.
inline bool is_worse(const wedge_side& a, const wedge_side& b) {
  return std::pair(a.quality, a.side) < std::pair(b.quality, b.side);
}

/// As below, so here: sides at a removed edge are removed, the worse the edge against `wanted` the sooner;
/// those at a refused one are penalised by what it missed.
inline ridge_decision as_below(const side_below& below, double wanted) {
  if (below.state == side_state::refused)
    return {below.missed, true};
  return {{below.quality, wanted}};
}

} // namespace dovetail::simplifier
