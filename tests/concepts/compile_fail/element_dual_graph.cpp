// near miss 1: elements have no weight
// error 1: g\.weight\(element\)
// near miss 2: a side has any number of elements
// error 2: g\.elements\(side\).*return-type|std::array<int, 2>|std::array<(dovetail::)?local_id, 2>
// near miss 3: it does not say which sides are fixed
// error 3: g\.is_fixed\(side\)
// near miss 4: its sides have no weights
// error 4: g\.side_weight\(side\)
#include "dovetail/simplification/dual_graphs.hpp"

struct my_graph {
  int element_count() const;
  int side_count() const;
#if NEAR_MISS != 1
  double weight(dovetail::local_id element) const;
#endif
#if NEAR_MISS == 2
  std::vector<dovetail::local_id> elements(dovetail::local_id side) const;
#else
  std::array<dovetail::local_id, 2> elements(dovetail::local_id side) const;
#endif
#if NEAR_MISS != 3
  bool is_fixed(dovetail::local_id side) const;
#endif
#if NEAR_MISS != 4
  double side_weight(dovetail::local_id side) const;
#endif
};

template <dovetail::element_dual_graph G>
void use(const G&) {}

void call() {
  use(my_graph{});
}
