/// @file
/// A mesher around another one.
#pragma once

#include "dovetail/core/wrapped_policy.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/mesher/fallbacks.hpp"
#include "dovetail/mesher/preferences.hpp"

#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// Whether a mesher that may hold another tells if that has a form for the background.
template <class Mesher>
inline constexpr bool knows_its_form = requires(const Mesher& mesher) {
  mesher.has_form_for_background();
};

/// What a mesher says of the number of its elements, in the form in which it says it.
template <class Self, class Mesher>
struct wrapped_calibration {};
template <class Self, calibrated_mesher Mesher>
struct wrapped_calibration<Self, Mesher> {
  static constexpr double elements_per_inverse_cubed_size = Mesher::elements_per_inverse_cubed_size;
};
template <class Self, class Mesher>
  requires requires(const Mesher& m) {
    m.elements_per_inverse_cubed_size();
  }
struct wrapped_calibration<Self, Mesher> {
  double elements_per_inverse_cubed_size() const {
    return static_cast<const Self&>(*this).wrapped.elements_per_inverse_cubed_size();
  }
};

} // namespace detail

namespace mesher {

/// Base of a mesher that changes what another one is given or gives: it has the traits, the preferences, the
/// fallbacks and the background form of `Mesher`, each of the latter wrapped as well.
///
///     struct counted : mesher::wraps<counted, mesher::native> {
///       std::atomic<int>* calls = nullptr;
///       mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const {
///         ++*calls;
///         return wrapped(input, size);
///       }
///     };
///
/// Whoever makes more or fewer elements than `Mesher` has an `elements_per_inverse_cubed_size` of its own.
template <class Self, class Mesher>
struct wraps : wrapped_policy<Self, Mesher>, detail::wrapped_calibration<Self, Mesher> {
  static_assert(piece_mesher<Mesher, 2> || piece_mesher<Mesher, 3>,
                "mesher::wraps holds a piece_mesher (mesher/concepts.hpp)");
  using wrapped_policy<Self, Mesher>::wrapped_policy;
  using wrapped_policy<Self, Mesher>::wrapped;

  /// Those of the wrapped mesher.
  static constexpr mesher_traits traits = Mesher::traits;

  /// Those of a wrapped mesher that holds another one.
  mesher_traits actual_traits() const requires detail::has_actual_traits<Mesher> {
    return wrapped.actual_traits();
  }
  /// Of the pieces that the wrapped mesher does best with.
  double elements_per_subdomain() const requires piece_sizing_mesher<Mesher> {
    return wrapped.elements_per_subdomain();
  }
  /// Whether the wrapped mesher, which holds another one, has one.
  bool has_form_for_background() const requires detail::knows_its_form<Mesher> {
    return wrapped.has_form_for_background();
  }
  /// The form of the wrapped mesher, wrapped.
  Self for_background() const requires has_background_form<Mesher> {
    return this->around(wrapped.for_background());
  }
  /// The fallbacks of the wrapped mesher, each wrapped.
  std::vector<Self> fallbacks() const requires has_fallbacks<Mesher> {
    std::vector<Self> each;
    for (Mesher& next : wrapped.fallbacks())
      each.push_back(this->around(std::move(next)));
    return each;
  }
  /// The wrapped mesher told the lines, wrapped.
  Self with_lines(std::vector<std::vector<vec3>> lines) const requires line_keeping_mesher<Mesher> {
    return this->around(wrapped.with_lines(std::move(lines)));
  }
  /// What the wrapped mesher makes.
  template <int D>
    requires(piece_mesher<Mesher, D>)
  mesher_result<D>
  operator()(const mesher_input<D>& input, const any_sizing& size) const { return wrapped(input, size); }
};

} // namespace mesher
} // namespace dovetail
