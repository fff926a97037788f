#ifdef DOVETAIL_DRIVER_WITH_CGAL

#include "background_cgal.hpp"

#include "dovetail/mesher/cgal_mesh_3.hpp"

namespace dovetail::app {

any_background_mesher cgal_background_mesher() {
  return {"cgal", mesher::cgal_mesh_3{}};
}

} // namespace dovetail::app

#endif
