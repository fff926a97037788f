/// @file
/// What a mesher may say about itself beyond its traits, and what holds for one that does not.
#pragma once

#include <concepts>
#include <type_traits>

namespace dovetail {

/// The role `calibrated_mesher`: a mesher that says how many elements it makes, for predictions.
///
/// Valid expressions: those of `piece_mesher<M, 3>` and
///
/// - `M::elements_per_inverse_cubed_size`: a positive number, constexpr static
///
/// Semantics: the elements made per integral of h^-3, with default parameters. Other meshers are taken to
/// make regular elements.
///
/// Complexity: constant.
///
/// Failure: none.
///
/// Models: native, tetgen, gmsh_hxt, gmsh_delaunay, netgen.
template <class M>
concept calibrated_mesher = requires {
  typename std::bool_constant<(M::elements_per_inverse_cubed_size > 0)>;
};

/// The role `piece_sizing_mesher`: a mesher that does best with pieces of a certain size.
///
/// Valid expressions: those of `piece_mesher<M, D>` and, for `const M& m`,
///
/// - `m.elements_per_subdomain()`: a number
///
/// Semantics: the elements that a subdomain should have when the caller does not say; of other meshers
/// `default_elements_per_subdomain`.
///
/// Complexity: constant.
///
/// Failure: none.
///
/// Models: gmsh_hxt, any_mesher.
template <class M>
concept piece_sizing_mesher = requires(const M& m) {
  { m.elements_per_subdomain() } -> std::convertible_to<double>;
};

/// The role `has_background_form`: a mesher that makes the mesh that is decomposed with other parameters.
///
/// Valid expressions: those of `piece_mesher<M, 3>` and, for `const M& m`,
///
/// - `m.for_background()`: M
///
/// Semantics: a mesher of the same role with more elements and no small angles. Where it fails, `m` and its
/// fallbacks are tried.
///
/// Complexity: constant.
///
/// Failure: none.
///
/// Models: tetgen, any_mesher.
template <class M>
concept has_background_form = requires(const M& m) {
  { m.for_background() } -> std::same_as<M>;
};

/// Predicted elements of a subdomain where the mesher does not name another number.
inline constexpr double default_elements_per_subdomain = 31250;

/// 0, for regular elements, when the mesher does not say.
template <class Mesher>
constexpr double elements_per_inverse_cubed_size() {
  if constexpr (calibrated_mesher<Mesher>)
    return Mesher::elements_per_inverse_cubed_size;
  else
    return 0;
}

/// The same of one that may hold another behind one type.
template <class Mesher>
double elements_per_inverse_cubed_size(const Mesher& mesher) {
  if constexpr (requires {
                  { mesher.elements_per_inverse_cubed_size() } -> std::convertible_to<double>;
                })
    return mesher.elements_per_inverse_cubed_size();
  else
    return elements_per_inverse_cubed_size<Mesher>();
}

/// The elements of the pieces that a mesher does best with.
template <class Mesher>
double elements_per_subdomain(const Mesher& mesher) {
  if constexpr (piece_sizing_mesher<Mesher>)
    return mesher.elements_per_subdomain();
  else
    return default_elements_per_subdomain;
}

} // namespace dovetail
