/// @file
/// What a mesher may say about itself beyond its traits: optional members, and what holds without them.
#pragma once

namespace dovetail {

/// The elements a mesher makes per integral of h^-3; 0, for regular elements, when it does not say.
template <class Mesher>
constexpr double elements_per_inverse_cubed_size() {
  if constexpr (requires { Mesher::elements_per_inverse_cubed_size; })
    return Mesher::elements_per_inverse_cubed_size;
  else
    return 0;
}

inline constexpr double default_elements_per_subdomain = 31250;

/// The elements of the pieces that a mesher does best with.
template <class Mesher>
double elements_per_subdomain(const Mesher& mesher) {
  if constexpr (requires { mesher.elements_per_subdomain(); })
    return mesher.elements_per_subdomain();
  else
    return default_elements_per_subdomain;
}

} // namespace dovetail
