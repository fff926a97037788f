#include "named_policies.hpp"
#include "policies.hpp"

#include "dovetail/mesher/by_regions.hpp"
#ifdef DOVETAIL_DRIVER_WITH_CGAL
#include "dovetail/adapters/cgal_surface.hpp"
#endif
#ifdef DOVETAIL_DRIVER_WITH_GMSH
#include "dovetail/adapters/gmsh_surface.hpp"
#endif

namespace dovetail::app {
namespace {

std::vector<any_surface_mesher> surface_meshers() {
  std::vector<any_surface_mesher> known{any_surface_mesher()};
#ifdef DOVETAIL_DRIVER_WITH_CGAL
  known.emplace_back(mesher::cgal_delaunay{}, "cgal");
#endif
#ifdef DOVETAIL_DRIVER_WITH_GMSH
  known.emplace_back(mesher::gmsh_frontal{}, "gmsh");
#endif
  return known;
}

} // namespace

std::vector<std::string> surface_mesher_names() {
  return names_of(surface_meshers());
}

any_surface_mesher make_surface_mesher(const std::string& name) {
  return chosen(surface_meshers(), name, "--surface-mesher");
}

template <>
std::vector<std::string> mesher_names<2>() {
  return surface_mesher_names();
}

template <>
any_mesher<2> make_mesher<2>(const std::string& name) {
  const auto mesher = chosen(surface_meshers(), name, "--mesher with --dimension 2");
  return {mesher::by_regions<any_surface_mesher>{mesher}, mesher.name()};
}

} // namespace dovetail::app
