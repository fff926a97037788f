// error: i\(mesh, frozen, h\).*invalid
#include "dovetail/improver/concepts.hpp"

struct my_improver {
#ifdef CORRECT
  dovetail::report operator()(dovetail::simplicial_mesh<3>&, const dovetail::frozen_entities<3>&,
                              const dovetail::any_sizing&) const;
#else
  dovetail::report operator()(dovetail::simplicial_mesh<3>&, const dovetail::frozen_entities<3>&,
                              const dovetail::any_sizing&);
#endif
};

template <dovetail::improver<3> I>
void use(const I&) {}

void call() {
  use(my_improver{});
}
