#include "surface_policies.hpp"

#include "failure.hpp"
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
  std::vector<std::string> names;
  for (const auto& policy : surface_meshers())
    names.push_back(policy.name());
  return names;
}

any_surface_mesher make_surface_mesher(const std::string& name) {
  std::string known;
  for (const auto& policy : surface_meshers()) {
    if (name.empty() || policy.name() == name)
      return policy;
    known += (known.empty() ? "" : ", ") + policy.name();
  }
  throw command_line_error("--mesher: there is no '" + name + "' for triangles; there are: " + known);
}

} // namespace dovetail::app
