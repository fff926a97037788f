// near miss 1: it returns triangles without a report
// error 1: m\(s, b, h\).*return-type|(constraint|because) 'std::same_as<std::vector<(std::array<int, 3>|dovetail::simplex<2>)
// near miss 2: it takes no sizing field
// error 2: m\(s, b, h\).*invalid|no matching function for call to object of type 'const my_mesher
// near miss 3: its call changes it
// error 3: m\(s, b, h\).*(invalid|discards)|no matching function for call to object of type 'const my_mesher
// near miss 4: it changes the boundary it is given
// error 4: m\(s, b, h\).*(invalid|discards)|no matching function for call to object of type 'const my_mesher
#include "dovetail/remesh/concepts.hpp"

#include <vector>

struct my_mesher {
  using surface = dovetail::any_surface;
  using boundary = dovetail::patch_boundary;
#if NEAR_MISS == 1
  std::vector<dovetail::simplex<2>> operator()(const surface&, const boundary&,
                                               const dovetail::any_sizing&) const;
#elif NEAR_MISS == 2
  dovetail::patch_mesh operator()(const surface&, const boundary&) const;
#elif NEAR_MISS == 3
  dovetail::patch_mesh operator()(const surface&, const boundary&, const dovetail::any_sizing&);
#elif NEAR_MISS == 4
  dovetail::patch_mesh operator()(const surface&, boundary&, const dovetail::any_sizing&) const;
#else
  dovetail::patch_mesh operator()(const surface&, const boundary&, const dovetail::any_sizing&) const;
#endif
};

template <dovetail::surface_mesher M>
void use(const M&) {}

void call() {
  use(my_mesher{});
}
