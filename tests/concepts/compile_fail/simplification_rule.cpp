// near miss 1: it judges meshes of triangles only
// error 1: r\(mesh, sides\).*invalid|no matching function for call to object of type 'const my_rule
// near miss 2: it returns the sides' qualities without what is wanted
// error 2: r\(mesh, sides\).*return-type|(constraint|because) 'std::same_as<std::vector<double>
// near miss 3: it does not say what is coupled from the surface
// error 3: r\.propagate\(below\)
// near miss 4: it has no penalty of a refused side
// error 4: r\.penalty\(d\)
#include "dovetail/simplification/concepts.hpp"

struct my_rule {
#if NEAR_MISS == 1
  dovetail::side_judgement operator()(const dovetail::simplicial_mesh<2>&,
                                      const dovetail::side_table<2>&) const;
#elif NEAR_MISS == 2
  std::vector<double> operator()(const dovetail::simplicial_mesh<3>&, const dovetail::side_table<3>&) const;
#else
  dovetail::side_judgement operator()(const dovetail::simplicial_mesh<3>&,
                                      const dovetail::side_table<3>&) const;
#endif
#if NEAR_MISS != 3
  std::optional<dovetail::ridge_decision> propagate(const dovetail::side_below& below) const;
#endif
  bool prefer_removal(const dovetail::dihedral_side& a, const dovetail::dihedral_side& b) const;
#if NEAR_MISS != 4
  double penalty(const dovetail::deficit& missed) const;
#endif
};

template <dovetail::simplification_rule<3> R>
void use(const R&) {}

void call() {
  use(my_rule{});
}
