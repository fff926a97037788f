/// @file
/// A surface mesher around another one.
#pragma once

#include "dovetail/core/wrapped_policy.hpp"
#include "dovetail/remesh/concepts.hpp"

namespace dovetail::remesh {

/// Base of a surface mesher that changes what another one is given or gives: it may run in threads where
/// `Mesher` may.
template <class Self, class Mesher>
struct wraps : wrapped_policy<Self, Mesher> {
  static_assert(surface_mesher<Mesher>, "remesh::wraps holds a surface_mesher (remesh/concepts.hpp)");
  using wrapped_policy<Self, Mesher>::wrapped_policy;
  using wrapped_policy<Self, Mesher>::wrapped;

  /// Whether the wrapped mesher says nothing against it.
  static constexpr bool thread_safe = is_thread_safe<Mesher>();

  /// The same of a wrapped mesher that may hold another one.
  bool may_run_in_threads() const { return dovetail::may_run_in_threads(wrapped); }
  /// What the wrapped mesher makes.
  patch_mesh operator()(const any_surface& surface, const patch_boundary& boundary,
                        const any_sizing& size) const {
    return wrapped(surface, boundary, size);
  }
};

} // namespace dovetail::remesh
