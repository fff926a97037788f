/// @file
/// An improver around another one.
#pragma once

#include "dovetail/core/wrapped_policy.hpp"
#include "dovetail/improver/concepts.hpp"

#include <concepts>
#include <type_traits>
#include <utility>

namespace dovetail::improvement {

/// Base of an improver that does something before or after another one: it has the traits of `Improver` and
/// its call with a surface. A call of one's own hides those of `Improver` for other dimensions, unless
/// `using wraps::operator();` stands beside it.
template <class Self, class Improver>
struct wraps : wrapped_policy<Self, Improver> {
  static_assert(improver<Improver, 2> || improver<Improver, 3>,
                "improvement::wraps holds an improver (improver/concepts.hpp)");
  using wrapped_policy<Self, Improver>::wrapped_policy;
  using wrapped_policy<Self, Improver>::wrapped;

  /// Those of the wrapped improver.
  static constexpr improver_traits traits = Improver::traits;

  /// Those of a wrapped improver that holds another one.
  improver_traits actual_traits() const requires dovetail::detail::has_actual_traits<Improver> {
    return wrapped.actual_traits();
  }
  /// Improves as the wrapped improver does.
  template <int D>
    requires(improver<Improver, D>)
  report operator()(simplicial_mesh<D>& mesh, const frozen_entities<D>& frozen,
                    const any_sizing& size) const {
    return wrapped(mesh, frozen, size);
  }
  /// The same on a surface.
  report operator()(simplicial_mesh<2>& mesh, const frozen_entities<2>& frozen, const any_sizing& size,
                    const surface_host& host) const requires surface_improver<Improver> {
    return wrapped(mesh, frozen, size, host);
  }
};

/// Whether an improver derives from `wraps` of one that improves triangles on a surface, and has a call of
/// its own that hides that one: its triangles would be improved without their surface.
template <class Improver>
constexpr bool hides_surface_call() {
  if constexpr (requires(const Improver& improver) { improver.wrapped; }) {
    using wrapped_improver = std::remove_cvref_t<decltype(std::declval<const Improver&>().wrapped)>;
    if constexpr (std::derived_from<Improver, wraps<Improver, wrapped_improver>>)
      return surface_improver<wrapped_improver> && improver<Improver, 2> && !surface_improver<Improver>;
  }
  return false;
}

} // namespace dovetail::improvement
