/// @file
/// The mesher of the background mesh: the form that a mesher has for that, and what is tried after it.
#pragma once

#include "dovetail/core/policy.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/mesher/fallbacks.hpp"
#include "dovetail/mesher/preferences.hpp"

#include <concepts>
#include <string>
#include <vector>

namespace dovetail {

/// A mesher with the others of its type that are tried after it, in place of its own fallbacks.
template <class Mesher>
struct mesher_in_turn {
  static constexpr mesher_traits traits = Mesher::traits; ///< those of the mesher

  Mesher first;                    ///< the mesher itself
  std::vector<Mesher> others = {}; ///< what is tried after it, in their order

  std::string name() const { return policy_name(first); }              ///< that of the first
  mesher_traits actual_traits() const { return policy_traits(first); } ///< those of the first
  /// The others, in their order.
  std::vector<mesher_in_turn> fallbacks() const {
    std::vector<mesher_in_turn> each;
    for (const Mesher& other : others)
      each.push_back({other});
    return each;
  }
  /// Calls the first.
  template <int D>
  mesher_result<D> operator()(const mesher_input<D>& input, const any_sizing& size) const {
    return first(input, size);
  }
};

/// Whether a mesher has a form for the mesh that is decomposed.
template <class Mesher>
bool has_form_for_background(const Mesher& mesher) {
  if constexpr (requires {
                  { mesher.has_form_for_background() } -> std::same_as<bool>;
                })
    return mesher.has_form_for_background();
  else
    return has_background_form<Mesher>;
}

/// The form of a mesher for the mesh that is decomposed, with the mesher and its fallbacks after it; the
/// mesher itself when it has none.
template <class Mesher>
auto form_for_background(const Mesher& mesher) {
  if constexpr (requires { mesher.has_form_for_background(); }) // it holds them all itself
    return mesher.for_background();
  else if constexpr (has_background_form<Mesher>)
    return mesher_in_turn<Mesher>{mesher.for_background(), with_fallbacks(mesher)};
  else
    return mesher;
}

} // namespace dovetail
