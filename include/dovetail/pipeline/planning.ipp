/// @file
/// What `planning.hpp` declares.
#pragma once

#include "dovetail/background/coarse_surface.hpp"
#include "dovetail/background/tubes.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/mesher/background_form.hpp"
#include "dovetail/mesher/preferences.hpp"
#include "dovetail/pipeline/bound_parameters.hpp"
#include "dovetail/pipeline/planning.hpp"
#include "dovetail/pipeline/surface_without_crossings.hpp"
#include "dovetail/sizing/checked_size.hpp"
#include "dovetail/sizing/coarse.hpp"
#include "dovetail/sizing/prediction.hpp"
#include "dovetail/sizing/thin_walls.hpp"
#include "dovetail/sizing/volume_prediction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

namespace dovetail {

DOVETAIL_INLINE simplicial_mesh<2> outer_surface(const surface_mesh& surface,
                                                 const geometry_topology& topology) {
  simplicial_mesh<2> outer;
  outer.points = surface.mesh.points;
  for (std::size_t t = 0; t < surface.mesh.elements.size(); ++t) {
    const auto& [behind, in_front] = topology.faces[surface.mesh.tags[t]].solids;
    if ((behind == no_id) == (in_front == no_id))
      continue;
    simplex<2> triangle = surface.mesh.elements[t];
    if (behind == no_id)
      std::swap(triangle[1], triangle[2]);
    outer.elements.push_back(triangle);
  }
  return outer;
}

namespace detail {

/// A size is refused where it makes no sense: larger than the model, or so small that coordinates have too
/// few digits.
inline void require_usable_size(const any_geometry& model, const erased_sizing& size) {
  const box3 box = model.bounds();
  const double h = size(box.center());
  if (h > box.diagonal())
    throw sizing_error("the size " + number_text(h) + " is larger than the model, whose diagonal is " +
                       number_text(box.diagonal()) + "; give a smaller size");
  if (const double least = size.smallest_size_in(box); least > 0 && least < 1e-9 * box.diagonal())
    throw sizing_error("there are sizes down to " + number_text(least) +
                       ", less than a billionth of the model's diagonal, " + number_text(box.diagonal()) +
                       "; give larger ones");
}

inline void require_room(const mesh_plan& plan, const generate_options& options) {
  if (options.largest_prediction > 0 && plan.predicted_elements > options.largest_prediction)
    throw too_many_elements(plan.predicted_elements, options.largest_prediction);
}

inline int default_subdomains(double elements, double per_subdomain, const generate_options& options) {
  const double least =
      std::clamp(static_cast<double>(options.least_subdomains), 1.0, std::max(1.0, elements));
  if (elements < options.undivided_elements)
    return static_cast<int>(least);
  const double plain = elements / per_subdomain;
  const double excess = std::max(1.0, elements / options.many_elements);
  constexpr double most = std::numeric_limits<int>::max();
  return static_cast<int>(std::clamp(std::round(plain / std::sqrt(excess)), least, most));
}

} // namespace detail

template <int D>
mesh_plan plan_mesh(const element_prediction& predicted, double per_subdomain,
                    const generate_options& options) {
  const auto of_dimension = [](double elements) {
    return D == 3 ? elements : std::pow(elements, static_cast<double>(D) / 3);
  };
  if (!(predicted.elements <= most_elements))
    throw sizing_error("the sizes predict about " + number_text(predicted.elements, 3) +
                       " elements, more than any machine can hold; give larger sizes");
  if (options.subdomains < 0)
    throw usage_error("generate_options::subdomains is " + std::to_string(options.subdomains) +
                      "; give a number of subdomains, or 0 for as many as suit the mesh");
  if (options.subdomains > std::max(1.0, predicted.elements))
    throw sizing_error(std::to_string(options.subdomains) + " subdomains are more than the about " +
                       std::to_string(std::llround(predicted.elements)) +
                       " elements that the sizes predict; give fewer, or smaller sizes");
  mesh_plan plan;
  plan.predicted_elements = predicted.elements;
  plan.relative_error = predicted.relative_error;
  plan.subdomains = options.subdomains > 0
                        ? options.subdomains
                        : detail::default_subdomains(predicted.elements, per_subdomain, options);
  const double coarse_elements =
      std::max(plan.subdomains * of_dimension(options.background_elements_per_subdomain),
               std::min(of_dimension(options.background_elements), predicted.elements / 10));
  plan.coarse_scale = options.coarse_scale > 0
                          ? options.coarse_scale
                          : std::max(1.5, D == 3 ? std::cbrt(predicted.elements / coarse_elements)
                                                 : std::pow(predicted.elements / coarse_elements, 1.0 / D));
  return plan;
}

template <int D>
element_prediction predict_mesh(const surface_mesh& surface, const geometry_topology& topology,
                                const any_sizing& size, double elements_per_unit_size) {
  if constexpr (D == 3) {
    // Thin walls would want millions, and be predicted no better by them.
    constexpr std::size_t cells = 400'000;
    return predict_volume_elements(outer_surface(surface, topology), size,
                                   {.density = elements_per_unit_size, .largest_cells = cells});
  } else {
    return predict_elements<2>(surface.mesh, size);
  }
}

template <int D>
any_sizing allowed_size(const erased_sizing& size, const std::vector<size_ball>& bounds) {
  if constexpr (D == 3)
    return keep_bounds(size);
  else
    return within_bounds(keep_bounds(size), bounds, background::coarse_surface_parameters{}.growth);
}

namespace detail {

/// Sizes that can be meshed.
struct usable_sizes {
  erased_sizing size;
  bool finer_at_tubes = false; ///< than the sizes given: they are no multiple of those of another factor
};

/// The field with every value looked at, small enough for tubes; throws what is known to be wrong before
/// anything is made.
template <int D, bound_parameters<D> Parameters>
usable_sizes usable_size(const any_geometry& model, const erased_sizing& size, const Parameters& given) {
  require_policies(given.mesh_it, given.improve_it, given.run_tasks);
  erased_sizing checked(checked_sizing{size});
  require_usable_size(model, checked);
  auto at_tubes = background::sizes_at_tubes(model, keep_bounds(checked));
  if (at_tubes.empty())
    return {checked};
  return {background::finer_at_tubes(keep_bounds(checked), std::move(at_tubes)), true};
}

/// Elements beside surfaces that turn so much within one size, or are so thin, that their triangles have to
/// be smaller than it: those of a layer in which the size grows from the triangles' to the one wanted, less
/// those that the integral has there. `surface` is as coarse as the model allows.
inline double elements_beside_fine_surface(const simplicial_mesh<2>& surface, const any_sizing& size,
                                           double elements_per_unit_size) {
  constexpr double growth = 1; // of the size per length, as meshers do it by themselves
  double elements = 0;
  for (const auto& triangle : surface.elements) {
    std::array<vec3, 3> p{};
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = surface.points[triangle[k]];
    const double area = 0.5 * norm(cross(p[1] - p[0], p[2] - p[0]));
    const double edge = std::sqrt(4 / std::sqrt(3.0) * area); // of a regular one
    const double wanted = size((p[0] + p[1] + p[2]) / 3);
    if (edge > 0 && edge < wanted)
      elements += area * ((1 / (edge * edge) - 1 / (wanted * wanted)) / (2 * growth) -
                          (wanted - edge) / growth / (wanted * wanted * wanted));
  }
  return elements_per_unit_size * elements;
}

/// The triangles around each solid, oriented outwards: those between two solids come twice.
inline simplicial_mesh<2> sides_of_solids(const surface_mesh& surface, const geometry_topology& topology) {
  simplicial_mesh<2> sides;
  sides.points = surface.mesh.points;
  for (std::size_t t = 0; t < surface.mesh.elements.size(); ++t) {
    const auto& [behind, in_front] = topology.faces[surface.mesh.tags[t]].solids;
    const simplex<2>& triangle = surface.mesh.elements[t];
    if (behind != no_id)
      sides.elements.push_back(triangle);
    if (in_front != no_id)
      sides.elements.push_back({triangle[0], triangle[2], triangle[1]});
  }
  return sides;
}

/// Those that the integral over the volume does not have.
inline double elements_beside_surface(const background::coarse_surface_result& made,
                                      const geometry_topology& topology, const erased_sizing& size,
                                      double elements_per_unit_size) {
  const any_sizing allowed = allowed_size<3>(size, made.bounds);
  return elements_beside_fine_surface(outer_surface(made.surface, topology), allowed,
                                      elements_per_unit_size) +
         sizing::elements_in_thin_walls(sides_of_solids(made.surface, topology), allowed,
                                        elements_per_unit_size);
}

/// Of the elements that a mesher makes in the whole domain, the share that is left in a mesh of pieces that
/// are improved: edge removal takes some, and beside interfaces, whose points are given, a mesher makes
/// fewer, in proportion to their area. Measured on solids and built-in models of 0.1 to 6 million elements
/// (docs/sizing.md, "Prediction").
inline double share_of_elements(const mesh_plan& plan, bool improved) {
  constexpr double left_by_improver = 0.955;
  constexpr double lost_beside_interfaces = 0.7; // times the pieces' area over their volume, in elements
  const double of_piece = std::max(1.0, plan.predicted_elements / plan.subdomains);
  const double beside = plan.subdomains > 1 ? lost_beside_interfaces / std::cbrt(of_piece) : 0.0;
  return (improved ? left_by_improver : 1.0) * (1 - std::min(beside, 0.1));
}

/// The elements by the integral of the sizes alone, on a first surface.
template <int D, bound_parameters<D> Parameters>
element_prediction predict_on_surface(const any_geometry& model, const erased_sizing& size,
                                      const background::coarse_surface_result& first,
                                      const Parameters& given) {
  return predict_mesh<D>(first.surface, model.topology(), allowed_size<D>(size, first.bounds),
                         elements_per_inverse_cubed_size(given.mesh_it));
}

template <int D, bound_parameters<D> Parameters>
mesh_plan plan_of_prediction(const any_geometry& model, const erased_sizing& size,
                             const background::coarse_surface_result& first, element_prediction predicted,
                             const Parameters& given) {
  const generate_options& options = given.options;
  if constexpr (D == 3)
    predicted.elements += elements_beside_surface(first, model.topology(), size,
                                                  elements_per_inverse_cubed_size(given.mesh_it));
  double size_scale = 1;
  if (options.enlarged_above > 0 && predicted.elements > options.enlarged_above) {
    size_scale = std::pow(predicted.elements / options.enlarged_above, 1.0 / D);
    predicted.elements = options.enlarged_above;
  }
  mesh_plan plan = plan_mesh<D>(predicted,
                                options.elements_per_subdomain > 0 ? options.elements_per_subdomain
                                                                   : elements_per_subdomain(given.mesh_it),
                                options);
  plan.size_scale = size_scale;
  if constexpr (D == 3)
    plan.predicted_elements *= share_of_elements(plan, is_given(given.improve_it));
  constexpr double of_calibration = 0.1; // of 18 predictions none was farther off
  plan.relative_error += of_calibration;
  require_room(plan, options);
  return plan;
}

/// A surface as coarse as sources and curvature allow.
template <int D, bound_parameters<D> Parameters>
background::coarse_surface_result first_surface(const any_geometry& model, const erased_sizing& size,
                                                const Parameters& given) {
  const generate_options& options = given.options;
  constexpr double as_coarse_as_possible = 1e12; // times any size that is not refused
  options.on_progress("planning", 0, 0);
  return surface_without_crossings(model, coarse_size(size, as_coarse_as_possible, model.bounds()),
                                   given.run_tasks, given.mesh_surface, options.refinement_rounds,
                                   options.on_progress);
}

/// What is in a plan of a background.
enum class planned { numbers, walls_too };

template <int D, bound_parameters<D> Parameters>
mesh_plan plan_of_usable(const any_geometry& model, const erased_sizing& size, const Parameters& given,
                         planned what) {
  const auto first = first_surface<D>(model, size, given);
  return once(given.run_tasks, [&] {
    mesh_plan plan =
        plan_of_prediction<D>(model, size, first, predict_on_surface<D>(model, size, first, given), given);
    if constexpr (D == 3)
      if (what == planned::walls_too && given.options.coarse_scale == 0 && plan.subdomains > 1) {
        const double largest = has_form_for_background(given.mesh_it)
                                   ? 2 * plan.coarse_scale
                                   : plan.coarse_scale; // it may be doubled
        plan.walls =
            sizing::coarse_sizes_in_walls(sides_of_solids(first.surface, model.topology()),
                                          allowed_size<3>(enlarged(size, plan), first.bounds), largest);
      }
    return plan;
  });
}

} // namespace detail

template <int D, bound_parameters<D> Parameters>
mesh_plan plan_background(const any_geometry& model, const erased_sizing& size, const Parameters& given) {
  return detail::plan_of_usable<D>(model, detail::usable_size<D>(model, size, given).size, given,
                                   detail::planned::numbers);
}

template <int D, bound_parameters<D> Parameters>
std::function<mesh_plan(double factor)> plan_multiples(const any_geometry& model, const erased_sizing& size,
                                                       const Parameters& given) {
  const auto usable = detail::usable_size<D>(model, size, given);
  const auto surface_once = detail::first_surface<D>(model, usable.size, given);
  element_prediction predicted_once;
  std::tie(predicted_once.elements, predicted_once.relative_error) = once(given.run_tasks, [&] {
    const auto predicted = detail::predict_on_surface<D>(model, usable.size, surface_once, given);
    return std::pair(predicted.elements, predicted.relative_error);
  });
  return [=](double factor) {
    const bool is_once = factor == 1;
    const auto multiple = is_once ? usable : detail::usable_size<D>(model, scaled(size, factor), given);
    const auto surface = is_once ? surface_once : detail::first_surface<D>(model, multiple.size, given);
    return once(given.run_tasks, [&] {
      element_prediction predicted = predicted_once;
      if (D == 3 && !usable.finer_at_tubes && !multiple.finer_at_tubes)
        predicted.elements /= factor * factor * factor; // the cells of the integral are those of any multiple
      else if (!is_once)
        predicted = detail::predict_on_surface<D>(model, multiple.size, surface, given);
      return detail::plan_of_prediction<D>(model, multiple.size, surface, predicted, given);
    });
  };
}

#ifdef DOVETAIL_COMPILED
template mesh_plan plan_mesh<2>(const element_prediction& predicted, double per_subdomain,
                                const generate_options& options);
template mesh_plan plan_mesh<3>(const element_prediction& predicted, double per_subdomain,
                                const generate_options& options);
template element_prediction predict_mesh<2>(const surface_mesh& surface, const geometry_topology& topology,
                                            const any_sizing& size, double elements_per_unit_size);
template element_prediction predict_mesh<3>(const surface_mesh& surface, const geometry_topology& topology,
                                            const any_sizing& size, double elements_per_unit_size);
template any_sizing allowed_size<2>(const erased_sizing& size, const std::vector<size_ball>& bounds);
template any_sizing allowed_size<3>(const erased_sizing& size, const std::vector<size_ball>& bounds);
template mesh_plan plan_background<2>(const any_geometry& model, const erased_sizing& size,
                                      const any_parameters<2>& given);
template mesh_plan plan_background<3>(const any_geometry& model, const erased_sizing& size,
                                      const any_parameters<3>& given);
template std::function<mesh_plan(double)>
plan_multiples<2>(const any_geometry& model, const erased_sizing& size, const any_parameters<2>& given);
template std::function<mesh_plan(double)>
plan_multiples<3>(const any_geometry& model, const erased_sizing& size, const any_parameters<3>& given);
#endif

} // namespace dovetail
