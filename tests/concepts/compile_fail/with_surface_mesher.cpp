// near miss 1: it is given no sizes
// first error 1: with_surface_mesher takes an? surface_mesher
// near miss 2: it gives no patch
// first error 2: with_surface_mesher takes an? surface_mesher
// near miss 3: the call operator is not const
// first error 3: with_surface_mesher takes an? surface_mesher
#include "dovetail/pipeline/parameters.hpp"

struct my_policy {
#if NEAR_MISS == 1
  dovetail::patch_mesh operator()(const dovetail::any_surface&, const dovetail::patch_boundary&) const;
#elif NEAR_MISS == 2
  void operator()(const dovetail::any_surface&, const dovetail::patch_boundary&,
                  const dovetail::any_sizing&) const;
#elif NEAR_MISS == 3
  dovetail::patch_mesh operator()(const dovetail::any_surface&, const dovetail::patch_boundary&,
                                  const dovetail::any_sizing&);
#else
  dovetail::patch_mesh operator()(const dovetail::any_surface&, const dovetail::patch_boundary&,
                                  const dovetail::any_sizing&) const;
#endif
};

void call() {
  dovetail::parameters<>{}.with_surface_mesher(my_policy{});
}
