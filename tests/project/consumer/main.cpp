// A user's project: nothing but the installed package. Two translation units include the same headers, so
// that a function that is not inline would fail to link.
#include "dovetail/core/predicates.hpp"
#include "dovetail/core/version.hpp"

#include <iostream>

int count_parts();

int main() {
  std::cout << "dovetail " << dovetail::version << '\n';
  return count_parts() == 2 ? 0 : 1;
}
