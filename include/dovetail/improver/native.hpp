/// @file
/// The library's own mesh improver.
#pragma once

#include "dovetail/improver/native_parameters.hpp"

namespace dovetail {

namespace improvement {

/// Leaves the mesh as it is. Models `improver<none, D>`.
struct none {
  static constexpr improver_traits traits{.thread_safe = true}; ///< it may run in several threads
  /// Changes nothing; the report is empty.
  template <int D>
  report operator()(simplicial_mesh<D>&, const frozen_entities<D>& = {}, const any_sizing& = {}) const {
    report result;
    result.name = "improver";
    return result;
  }
};

} // namespace improvement

using native_improver = improvement::native; ///< what the library improves meshes with by default
using no_improver = improvement::none;       ///< leaves meshes as they are

static_assert(improver<native_improver, 3> && surface_improver<native_improver>);
static_assert(improver<no_improver, 3> && improver<no_improver, 2>);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/improver/native.ipp"
#endif
