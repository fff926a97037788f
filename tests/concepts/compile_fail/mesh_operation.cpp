// near miss 1: it has no names
// error 1: O::names
// near miss 2: it does not say when it is tried
// error 2: O::when
// near miss 3: mending is const and not told how to record its tries
// error 3: o.mend\(mesh, e, limits, tries\)
// near miss 4: it does not say whether it changed the mesh
// error 4: o.mend\(mesh, e, limits, tries\).*return-type|std::same_as<void, _?[bB]ool>
#include "dovetail/improver/operation.hpp"

#include <array>

using namespace dovetail::improvement;

struct my_operation {
#if NEAR_MISS != 1
  static constexpr std::array names{"my operation"};
#endif
#if NEAR_MISS != 2
  static constexpr turn when = turn::hard;
#endif
#if NEAR_MISS == 3
  bool mend(tet_complex&, dovetail::local_id, const operation_limits<3>&) const;
#elif NEAR_MISS == 4
  void mend(tet_complex&, dovetail::local_id, const operation_limits<3>&, const recorded_tries&);
#else
  bool mend(tet_complex&, dovetail::local_id, const operation_limits<3>&, const recorded_tries&);
#endif
};

template <mesh_operation<3> O>
void use() {}

void call() {
  use<my_operation>();
}
