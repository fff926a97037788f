#include "dovetail/core/predicates.hpp"

int count_parts() {
  return 2;
}
