#ifdef DOVETAIL_DRIVER_WITH_CGAL

#include "improver_cgal.hpp"

#include "dovetail/improver/cgal.hpp"

namespace dovetail::app {

any_improver cgal_improver() {
  return {"cgal", improvement::cgal{}};
}

} // namespace dovetail::app

#endif
