/// @file
/// What `cgal_mesh_3.hpp` declares.
#pragma once

#include "dovetail/adapters/call_budget.hpp"
#include "dovetail/adapters/cgal_mesh_3.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/mesher/checks.hpp"
#include "dovetail/sizing/checked_size.hpp"

#pragma push_macro("Handle") // Open CASCADE defines it
#undef Handle
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mesh_3.h>
#pragma pop_macro("Handle")

#include <array>
#include <cstddef>
#include <exception>
#include <map>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// CGAL's types for one use of Mesh_3.
struct mesh_3_types {
  using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using surface = CGAL::Surface_mesh<kernel::Point_3>;
  using domain = CGAL::Polyhedral_mesh_domain_with_features_3<kernel, surface>;
  using triangulation = CGAL::Mesh_triangulation_3<domain>::type;
  using complex =
      CGAL::Mesh_complex_3_in_triangulation_3<triangulation, domain::Corner_index, domain::Curve_index>;
  using criteria = CGAL::Mesh_criteria_3<triangulation>;
};

/// The boundary as CGAL's half-edge structure; throws `mesher_error` when it is not the boundary of a body.
inline mesh_3_types::surface mesh_3_surface(const simplicial_mesh<2>& boundary) {
  namespace processing = CGAL::Polygon_mesh_processing;
  std::vector<mesh_3_types::kernel::Point_3> points;
  for (const vec3 p : boundary.points)
    points.emplace_back(p.x, p.y, p.z);
  std::vector<std::array<std::size_t, 3>> triangles;
  for (const auto& [a, b, c] : boundary.elements)
    triangles.push_back(
        {static_cast<std::size_t>(a), static_cast<std::size_t>(b), static_cast<std::size_t>(c)});
  if (!processing::is_polygon_soup_a_polygon_mesh(triangles))
    throw mesher_error("CGAL Mesh_3 takes manifold shells only; use TetGen");
  mesh_3_types::surface surface;
  processing::polygon_soup_to_polygon_mesh(points, triangles, surface);
  if (!CGAL::is_closed(surface))
    throw mesher_error("the boundary is open: it encloses nothing; close its gaps");
  if (!(enclosed_volume(boundary.points, boundary.elements) > 0))
    throw mesher_error("the boundary's triangles point inwards; turn them round");
  if (processing::does_self_intersect(surface))
    throw mesher_error("the boundary crosses itself; make it finer where it does");
  return surface;
}

inline std::vector<std::vector<mesh_3_types::kernel::Point_3>>
mesh_3_lines(const std::vector<std::vector<vec3>>& given) {
  std::vector<std::vector<mesh_3_types::kernel::Point_3>> lines;
  for (const auto& line : given)
    for (auto& points = lines.emplace_back(); const vec3 p : line)
      points.emplace_back(p.x, p.y, p.z);
  return lines;
}

/// A sizing field as CGAL asks for it, in multiples of the size. Copies share one count of calls.
class mesh_3_sizing {
public:
  using FT = mesh_3_types::kernel::FT; // NOLINT(readability-identifier-naming): CGAL asks for it

  mesh_3_sizing(const any_sizing& size, double factor, std::size_t& calls, std::size_t budget)
      : size_(&size), factor_(factor), calls_(&calls), budget_(budget) {}

  template <class Point, class Index>
  FT operator()(const Point& p, int, const Index&) const {
    if (++*calls_ > budget_)
      throw mesher_error("CGAL Mesh_3 refines without end: more than " + std::to_string(budget_) +
                         " size evaluations; make the field smoother or the ridges' angles larger");
    return factor_ * checked_size(*size_, {p.x(), p.y(), p.z()});
  }

private:
  const any_sizing* size_;
  double factor_;
  std::size_t* calls_;
  std::size_t budget_;
};

/// The elements inside, on the points that they use, both in CGAL's order of creation.
inline simplicial_mesh<3> from_mesh_3(const mesh_3_types::complex& made) {
  simplicial_mesh<3> mesh;
  std::map<mesh_3_types::triangulation::Vertex_handle, local_id> number;
  for (auto cell = made.cells_in_complex_begin(); cell != made.cells_in_complex_end(); ++cell) {
    simplex<3> element{};
    for (int k = 0; k < 4; ++k) {
      const auto vertex = cell->vertex(k);
      const auto [at, is_new] = number.try_emplace(vertex, static_cast<local_id>(mesh.points.size()));
      if (is_new)
        mesh.points.push_back({vertex->point().x(), vertex->point().y(), vertex->point().z()});
      element[k] = at->second;
    }
    mesh.elements.push_back(element);
  }
  return mesh;
}

/// Refines the domain. What is drawn at random starts from the same seed in each call. CGAL's perturber and
/// exuder are left out: their results depend on addresses (two calls in one process gave other meshes).
inline simplicial_mesh<3> run_mesh_3(const mesher::cgal_mesh_3& settings,
                                     const mesh_3_types::surface& surface, const any_sizing& size,
                                     std::size_t& calls, std::size_t budget) {
  namespace parameters = CGAL::parameters;
  // Over the size wanted: of lines the length, of facets and cells the circumradius.
  constexpr double edge_factor = 1.15, facet_factor = 0.67, cell_factor = 0.725;
  const auto field = [&](double factor) {
    return mesh_3_sizing(size, factor * settings.size_scale, calls, budget);
  };
  CGAL::get_default_random() = CGAL::Random(0);
  CGAL::Random random(0);
  mesh_3_types::domain domain(surface, &random);
  constexpr double no_ridges = 180; // the surface is numbered, and that is all
  domain.detect_features(settings.lines.empty() ? settings.feature_angle_deg : no_ridges);
  const auto lines = mesh_3_lines(settings.lines);
  domain.add_features(lines.begin(), lines.end());
  const mesh_3_types::criteria criteria(parameters::edge_size = field(edge_factor),
                                        parameters::facet_angle = settings.facet_angle_deg,
                                        parameters::facet_size = field(facet_factor),
                                        parameters::facet_distance = field(settings.surface_distance),
                                        parameters::cell_radius_edge_ratio = settings.radius_edge_ratio,
                                        parameters::cell_size = field(cell_factor));
  return from_mesh_3(CGAL::make_mesh_3<mesh_3_types::complex>(domain, criteria, parameters::no_perturb(),
                                                              parameters::no_exude()));
}

} // namespace dovetail::detail

namespace dovetail::mesher {

DOVETAIL_INLINE_CGAL mesher_result<3> cgal_mesh_3::operator()(const mesher_input<3>& input,
                                                              const any_sizing& size) const {
  const stopwatch clock;
  require_meshable(input.boundary);
  const auto surface = detail::mesh_3_surface(input.boundary);
  constexpr double elements_per_inverse_cubed_size = 12;
  const double elements = elements_per_inverse_cubed_size / (size_scale * size_scale * size_scale);
  const std::size_t budget = sizing_call_budget(input.boundary, size, elements, call_budget_factor);
  std::size_t calls = 0;
  mesher_result<3> result;
  try {
    result.mesh = detail::run_mesh_3(*this, surface, size, calls, budget);
  } catch (const error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    throw mesher_error("CGAL Mesh_3 failed: " + std::string(e.what()));
  }
  if (result.mesh.elements.empty())
    throw mesher_error("CGAL Mesh_3 made no elements: the size is too large for the body");
  result.mesh.tags.assign(result.mesh.elements.size(), input.material);
  check_elements_positive(result.mesh);
  result.summary.name = "cgal_mesh_3";
  result.summary.seconds = clock.seconds();
  result.summary.set(mesher_counts{result.mesh.elements.size(), result.mesh.points.size(), calls});
  return result;
}

} // namespace dovetail::mesher
