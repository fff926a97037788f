#include "named_policies.hpp"
#include "policies.hpp"

#include "dovetail/mesher/native_surface.hpp"
#ifdef DOVETAIL_DRIVER_WITH_CGAL
#include "dovetail/mesher/cgal_surface.hpp"
#endif
#ifdef DOVETAIL_DRIVER_WITH_GMSH
#include "dovetail/mesher/gmsh_surface.hpp"
#endif

namespace dovetail::app {
namespace {

std::vector<any_mesher<2>> surface_meshers() {
  std::vector<any_mesher<2>> known;
  known.emplace_back(mesher::native_surface{}, "native");
#ifdef DOVETAIL_DRIVER_WITH_CGAL
  known.emplace_back(mesher::cgal_surface{}, "cgal");
#endif
#ifdef DOVETAIL_DRIVER_WITH_GMSH
  known.emplace_back(mesher::gmsh_surface{}, "gmsh");
#endif
  return known;
}

} // namespace

template <>
std::vector<std::string> mesher_names<2>() {
  return names_of(surface_meshers());
}

template <>
any_mesher<2> make_mesher<2>(const std::string& name) {
  return chosen(surface_meshers(), name, "--mesher with --dimension 2");
}

} // namespace dovetail::app
