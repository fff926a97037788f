/// @file
/// What a failed piece is tried by: the same mesher with other parameters, in a fixed order.
#pragma once

#include <concepts>
#include <vector>

namespace dovetail {

/// A mesher, or another policy, that knows what to try next.
///
/// Valid expression for `const M& m`: `m.fallbacks()` -> std::vector<M>.
///
/// Semantics: what to try, in this order, on a piece on which `m` failed; fallbacks of fallbacks are not
/// asked for.
///
/// Complexity: constant.
///
/// Failure: none; when all have failed the piece is merged with a neighbour.
///
/// Models: mesher::tetgen.
template <class M>
concept has_fallbacks = requires(const M& m) {
  { m.fallbacks() } -> std::same_as<std::vector<M>>;
};

/// The mesher itself and then its fallbacks; never empty.
template <class M>
std::vector<M> with_fallbacks(const M& mesher) {
  std::vector<M> meshers{mesher};
  if constexpr (has_fallbacks<M>)
    for (const M& next : mesher.fallbacks())
      meshers.push_back(next);
  return meshers;
}

} // namespace dovetail
