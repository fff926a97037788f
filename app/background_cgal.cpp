#ifdef DOVETAIL_DRIVER_WITH_CGAL

#include "background_cgal.hpp"

#include "dovetail/adapters/cgal_mesh_3.hpp"

namespace dovetail::app {

any_line_keeping_mesher cgal_background_mesher() {
  return {mesher::cgal_mesh_3{}, "cgal"};
}

} // namespace dovetail::app

#endif
