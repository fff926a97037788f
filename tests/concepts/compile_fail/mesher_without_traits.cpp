// error: M::traits.*is invalid|no member named 'traits'
#include "dovetail/mesher/concepts.hpp"

struct my_mesher {
#ifdef CORRECT
  static constexpr dovetail::mesher_traits traits{};
#endif
  dovetail::mesher_result<3> operator()(const dovetail::mesher_input<3>&, const dovetail::any_sizing&) const;
};

template <dovetail::piece_mesher<3> M>
void use(const M&) {}

void call() {
  use(my_mesher{});
}
