#include "surface_policies.hpp"

#include "named_policies.hpp"

#include "dovetail/mesher/native_surface.hpp"
#ifdef DOVETAIL_DRIVER_WITH_CGAL
#include "dovetail/mesher/cgal_surface.hpp"
#endif
#ifdef DOVETAIL_DRIVER_WITH_GMSH
#include "dovetail/mesher/gmsh_surface.hpp"
#endif

namespace dovetail::app {
namespace {

std::vector<any_surface_mesher> surface_meshers() {
  std::vector<any_surface_mesher> known;
  known.emplace_back("native", mesher::native_surface{});
#ifdef DOVETAIL_DRIVER_WITH_CGAL
  known.emplace_back("cgal", mesher::cgal_surface{});
#endif
#ifdef DOVETAIL_DRIVER_WITH_GMSH
  known.emplace_back("gmsh", mesher::gmsh_surface{});
#endif
  return known;
}

} // namespace

std::vector<std::string> surface_mesher_names() {
  return names_of(surface_meshers());
}

any_surface_mesher make_surface_mesher(const std::string& name) {
  return chosen(surface_meshers(), name, "--mesher with --dimension 2");
}

} // namespace dovetail::app
