// near miss 1: it judges meshes of triangles only
// first error 1: with_simplifier takes a simplification_rule
// error 1: r\(mesh, sides\).*invalid|no matching function for call to object of type 'const my_rule
// near miss 2: it does not say which side of a small dihedral goes
// first error 2: with_simplifier takes a simplification_rule
// error 2: r\.prefer_removal\(a, b\)
// near miss 3: its judgement changes it
// first error 3: with_simplifier takes a simplification_rule
// error 3: r\(mesh, sides\).*invalid|no matching function for call to object of type 'const my_rule
#include "dovetail/pipeline/parameters.hpp"

struct my_rule {
#if NEAR_MISS == 1
  dovetail::side_judgement operator()(const dovetail::simplicial_mesh<2>&,
                                      const dovetail::side_table<2>&) const;
#elif NEAR_MISS == 3
  template <int D>
  dovetail::side_judgement operator()(const dovetail::simplicial_mesh<D>&, const dovetail::side_table<D>&);
#else
  template <int D>
  dovetail::side_judgement operator()(const dovetail::simplicial_mesh<D>&,
                                      const dovetail::side_table<D>&) const;
#endif
  std::optional<dovetail::ridge_decision> propagate(const dovetail::side_below& below) const;
#if NEAR_MISS != 2
  bool prefer_removal(const dovetail::dihedral_side& a, const dovetail::dihedral_side& b) const;
#endif
  double penalty(const dovetail::deficit& missed) const;
};

void call() {
  dovetail::parameters<>{}.with_simplifier(my_rule{});
}
