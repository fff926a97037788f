// near miss 1: it cannot be told the lines
// error 1: m\.with_lines\(lines\).*invalid|no member named 'with_lines'
// near miss 2: telling it the lines changes it, instead of giving another one
// error 2: m\.with_lines\(lines\).*(invalid|return-type)|not marked const
// near miss 3: it takes the lines as one list of points
// error 3: m\.with_lines\(lines\).*invalid|no viable conversion
// near miss 4: it makes no elements by itself
// error 4: m\(in, h\).*invalid|no matching function for call to object of type 'const my_mesher
#include "dovetail/mesher/concepts.hpp"

struct my_mesher {
  static constexpr dovetail::mesher_traits traits{};
#if NEAR_MISS == 2
  void with_lines(std::vector<std::vector<dovetail::vec3>> lines);
#elif NEAR_MISS == 3
  my_mesher with_lines(std::vector<dovetail::vec3> lines) const;
#elif NEAR_MISS != 1
  my_mesher with_lines(std::vector<std::vector<dovetail::vec3>> lines) const;
#endif
#if NEAR_MISS != 4
  dovetail::mesher_result<3> operator()(const dovetail::mesher_input<3>&, const dovetail::any_sizing&) const;
#endif
};

template <dovetail::line_keeping_mesher M>
void use(const M&) {}

void call() {
  use(my_mesher{});
}
