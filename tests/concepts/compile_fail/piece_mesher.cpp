// near miss 1: it declares no traits
// error 1: M::traits.*invalid|no member named 'traits'
// near miss 2: it returns a bare mesh without a report
// error 2: m\(in, h\).*return-type|(constraint|because) 'std::same_as<dovetail::simplicial_mesh<3>
// near miss 3: it takes no sizing field
// error 3: m\(in, h\).*invalid|no matching function for call to object of type 'const my_mesher
// near miss 4: it makes triangles where tetrahedra are asked for
// error 4: m\(in, h\).*invalid|no matching function for call to object of type 'const my_mesher
#include "dovetail/mesher/concepts.hpp"

#if NEAR_MISS == 4
constexpr int dimension = 2;
#else
constexpr int dimension = 3;
#endif
using input = dovetail::mesher_input<dimension>;

struct my_mesher {
#if NEAR_MISS != 1
  static constexpr dovetail::mesher_traits traits{};
#endif
#if NEAR_MISS == 2
  dovetail::simplicial_mesh<3> operator()(const input&, const dovetail::any_sizing&) const;
#elif NEAR_MISS == 3
  dovetail::mesher_result<3> operator()(const input&) const;
#else
  dovetail::mesher_result<dimension> operator()(const input&, const dovetail::any_sizing&) const;
#endif
};

template <dovetail::piece_mesher<3> M>
void use(const M&) {}

void call() {
  use(my_mesher{});
}
