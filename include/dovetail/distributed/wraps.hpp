/// @file
/// A redistributor around another one.
#pragma once

#include "dovetail/core/wrapped_policy.hpp"
#include "dovetail/distributed/concepts.hpp"

namespace dovetail::redistribution_by {

/// Base of a redistributor that changes what another one is given or gives, or measures it.
template <class Self, class Redistributor>
struct wraps : wrapped_policy<Self, Redistributor> {
  static_assert(redistributor<Redistributor, 2> || redistributor<Redistributor, 3>,
                "redistribution_by::wraps holds a redistributor (distributed/concepts.hpp)");
  using wrapped_policy<Self, Redistributor>::wrapped_policy;
  using wrapped_policy<Self, Redistributor>::wrapped;

  /// Gives ranks their pieces as the wrapped redistributor does.
  template <int D>
    requires(redistributor<Redistributor, D>)
  redistribution<D>
  operator()(const distributed_simplicial_mesh<D>& mesh, int ranks) const { return wrapped(mesh, ranks); }
};

} // namespace dovetail::redistribution_by
