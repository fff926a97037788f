/// @file
/// What `native.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/improver/native_by.hpp"

namespace dovetail::improvement {

DOVETAIL_INLINE report native::operator()(simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen,
                                          const any_sizing& size) const {
  return native_by<native_operations>{*this}(mesh, frozen, size);
}

DOVETAIL_INLINE report native::operator()(simplicial_mesh<2>& mesh, const frozen_entities<2>& frozen,
                                          const any_sizing& size, const surface_host& host) const {
  return native_by<native_operations>{*this}(mesh, frozen, size, host);
}

} // namespace dovetail::improvement
