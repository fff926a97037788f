// near miss 1: its dihedrals have no angles
// error 1: g\.angles\(\)
// near miss 2: it does not say which sides bound a dihedral
// error 2: g\.sides\(dihedral\)
// near miss 3: it visits the dihedrals at a side one by one, so nothing says which join
// error 3: g\.for_each_joint\(side, visit\)
#include "dovetail/simplification/dual_graphs.hpp"

struct my_graph {
  int side_count() const;
#if NEAR_MISS != 1
  std::vector<double> angles() const;
#endif
#if NEAR_MISS != 2
  std::array<dovetail::local_id, 2> sides(dovetail::dihedral_id dihedral) const;
#endif
#if NEAR_MISS == 3
  void for_each_joint(dovetail::local_id side, void (&visit)(dovetail::dihedral_id)) const;
#else
  void for_each_joint(dovetail::local_id side,
                      void (&visit)(dovetail::dihedral_id, dovetail::dihedral_id)) const;
#endif
};

template <dovetail::side_dual_graph G>
void use(const G&) {}

void call() {
  use(my_graph{});
}
