// Two functions, of which the second has its definition in another file of the package.
#include "dovetail/core/predicates.hpp"
#include "dovetail/core/version.hpp"

#include <cstdio>

int main() {
  const double volume = dovetail::orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  std::printf("dovetail %s\n", dovetail::version);
  return volume != 0 ? 0 : 1;
}
