#ifdef DOVETAIL_DRIVER_WITH_CGAL

#include "improver_cgal.hpp"

#include "dovetail/adapters/cgal_improver.hpp"

namespace dovetail::app {

named_improver cgal_improver() {
  // CGAL 5.5 flips some pieces without end; others take seconds. A piece beyond the limit stays as it was.
  return {improvement::cgal{.limit_seconds = 30}, "cgal"};
}

} // namespace dovetail::app

#endif
