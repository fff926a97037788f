/// @file
/// The library's own mesh improver.
#pragma once

#include "dovetail/improver/native_parameters.hpp"

namespace dovetail {

namespace improvement {

/// Leaves the mesh as it is. Models `improver<none, D>`.
struct none {
  template <int D>
  report operator()(simplicial_mesh<D>&, const frozen_entities<D>& = {}, const any_sizing& = {}) const {
    report result;
    result.name = "improver";
    return result;
  }
};

} // namespace improvement

using native_improver = improvement::native;
using no_improver = improvement::none;

static_assert(improver<native_improver, 3> && improver<native_improver, 2>);
static_assert(improver<no_improver, 3> && improver<no_improver, 2>);

} // namespace dovetail

#if !defined(DOVETAIL_COMPILED)
#include "dovetail/improver/native.ipp"
#endif
