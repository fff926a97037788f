// near miss 1: it names the side that goes by its number where it should answer for the first
// error 1: r\.prefer_removal\(a, b\).*return-type|(constraint|because) 'std::same_as<(int|dovetail::local_id), (bool|_Bool)>
// near miss 2: a refused side has no penalty
// error 2: r\.penalty\(d\)
// near miss 3: its choice changes it
// error 3: r\.prefer_removal\(a, b\)
#include "dovetail/simplification/concepts.hpp"

using dovetail::dihedral_side;

struct my_rule {
#if NEAR_MISS == 1
  dovetail::local_id prefer_removal(const dihedral_side& a, const dihedral_side& b) const;
#elif NEAR_MISS == 3
  bool prefer_removal(const dihedral_side& a, const dihedral_side& b);
#else
  bool prefer_removal(const dihedral_side& a, const dihedral_side& b) const;
#endif
#if NEAR_MISS != 2
  double penalty(const dovetail::deficit& missed) const;
#endif
};

template <dovetail::contraction_rule R>
void use(const R&) {}

void call() {
  use(my_rule{});
}
