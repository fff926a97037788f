/// @file
/// The first step of the pipeline: how large the mesh will be, and the coarse surface mesh, and volume mesh
/// in D = 3, that is decomposed (paper, section 3.2).
#pragma once

#include "dovetail/background/coarse_surface.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/mesh/background_mesh.hpp"
#include "dovetail/pipeline/bound_parameters.hpp"
#include "dovetail/sizing/coarse.hpp"
#include "dovetail/sizing/compose.hpp"
#include "dovetail/sizing/prediction.hpp"

#include <cmath>
#include <functional>
#include <string>
#include <type_traits>

namespace dovetail {

/// More elements than this no machine holds: each takes some hundred bytes.
inline constexpr double most_elements = 1e12;

/// The sizes ask for more elements than `generate_options::largest_prediction` allows.
class too_many_elements : public sizing_error {
public:
  too_many_elements(double predicted_elements, double limit)
      : sizing_error("the sizes predict about " + number_text(predicted_elements, 3) +
                     " elements, more than the limit of " + number_text(limit, 3) +
                     "; give larger sizes or raise the limit"),
        predicted(predicted_elements) {}
  double predicted; ///< elements that the sizes ask for
};

/// What is known before the background mesh: sizes of the mesh and of its decomposition.
struct mesh_plan {
  double predicted_elements = 0; ///< elements of the mesh at the given sizes, enlarged ones if they are
  double relative_error = 0;     ///< estimated: of the integral of sizes, and of what meshers make of it
  int subdomains = 1;            ///< how many parts the background mesh is to be cut into
  double coarse_scale = 1;       ///< factor between coarse and final size
  double size_scale = 1; ///< factor between final size and that given (`generate_options::enlarged_above`)

  using fields = field_list<&mesh_plan::predicted_elements, &mesh_plan::relative_error, ///< what is stored
                            &mesh_plan::subdomains, &mesh_plan::coarse_scale, &mesh_plan::size_scale>;
};

/// The field given as the plan has it.
inline erased_sizing enlarged(const erased_sizing& size, const mesh_plan& plan) {
  return plan.size_scale == 1 ? size : erased_sizing(scaled(size, plan.size_scale));
}

/// The triangles with a solid on one side only, oriented outwards: they enclose all solids together.
simplicial_mesh<2> outer_surface(const surface_mesh& surface, const geometry_topology& topology);

namespace detail {

/// `surface_without_crossings` by a function that makes the surface mesh.
background::coarse_surface_result surface_without_crossings_by(
    const any_geometry& model,
    const std::function<background::coarse_surface_result(const background::coarse_surface_parameters&)>&
        make,
    const any_executor& run, int refinement_rounds, const progress& on_progress);

} // namespace detail

/// The surface mesh at a size, refined locally until no two of its triangles cross. Throws
/// `intersection_error` naming the two CAD faces when that does not help.
/// \param refinement_rounds how often sizes may be refined at crossings
template <surface_mesher Mesher>
background::coarse_surface_result
surface_without_crossings(const any_geometry& model, const any_sizing& size, const any_executor& run,
                          const Mesher& mesher, int refinement_rounds, const progress& on_progress = {}) {
  const auto make = [&](const background::coarse_surface_parameters& parameters) {
    return background::coarse_surface(model, size, parameters, run, mesher);
  };
  return detail::surface_without_crossings_by(model, make, run, refinement_rounds, on_progress);
}

/// Chooses the decomposition from the predicted size of a mesh, in subdomains of `per_subdomain` elements.
/// The numbers of background elements in the options are those of D = 3; a surface has as many per length.
template <int D>
mesh_plan plan_mesh(const element_prediction& predicted, double per_subdomain,
                    const generate_options& options);

/// The elements that a mesh of a model will have: tetrahedra inside a surface, or triangles on it. `surface`
/// may be as coarse as the sizing field's features allow. `elements_per_unit_size` are the tetrahedra a
/// mesher makes per integral of h^-3.
template <int D>
element_prediction predict_mesh(const surface_mesh& surface, const geometry_topology& topology,
                                const any_sizing& size, double elements_per_unit_size);

/// The size of a mesh that its coarse surface, with its `bounds`, allows. In D = 3 that is the one given:
/// where interfaces and surfaces cross, `realize` mends it. In D = 2 an edge turns with the surface by no
/// more than an edge of the background mesh: beyond that, triangles of sheets that are near to each other
/// would cross.
template <int D>
any_sizing allowed_size(const erased_sizing& size, const std::vector<size_ball>& bounds);

/// What is counted of a background mesh.
struct background_counts {
  double predicted_elements = 0; ///< of the mesh that is wanted
  double coarse_scale = 0;       ///< factor between coarse and final size
  double size_scale = 0;         ///< by which the sizes were enlarged
  std::size_t elements = 0;      ///< of the background mesh
  int stops_by_clock = 0;        ///< stops by a time limit
  std::optional<int> kept = {};  ///< 1: it was found in the spool

  using fields = field_list<&background_counts::predicted_elements, &background_counts::coarse_scale,
                            &background_counts::size_scale, &background_counts::elements,
                            &background_counts::stops_by_clock, &background_counts::kept>;
};

/// A background mesh, and what it was made by.
template <int D>
struct background_result {
  simplicial_background<D> mesh; ///< the coarse mesh
  mesh_plan plan;                ///< what was known before it was made
  std::vector<size_ball> bounds; ///< where the surface asks for smaller sizes (D = 2)
  any_sizing size;               ///< the field given, times the plan's factor, within these bounds
  report summary;                ///< what its stages report

  /// All but the field, which is a function.
  using fields = field_list<&background_result::mesh, &background_result::plan, &background_result::bounds,
                            &background_result::summary>;
};

/// Predicts the size of the mesh and chooses its decomposition. Makes a first surface mesh, as coarse as
/// sources and curvature allow: enough to see how much there is to fill. Throws `sizing_error` for sizes that
/// cannot be used, and what the surface mesher throws.
/// About linear in the triangles of that mesh, and the cells of the prediction.
/// \param model the solids (D = 3) or faces (D = 2) to mesh
/// \param size the final edge lengths, in the units of the model
/// \param given policies and options
template <int D = 3, bound_parameters<D> Parameters>
mesh_plan plan_background(const any_geometry& model, const erased_sizing& size, const Parameters& given);
template <int D = 3, class Parameters>
mesh_plan plan_background(const any_geometry& model, const erased_sizing& size, const Parameters& given) {
  return plan_background<D>(model, size, bind_parameters<D>(given));
}

/// A function that gives the plan for a field times a factor, as `plan_background` does, which costs little
/// beyond the first: all are of one first surface mesh, and in D = 3 of one integral of sizes. It throws
/// `sizing_error` where the factor makes sizes that cannot be used, or too many elements. The model must
/// outlive it. Throws what `plan_background` throws.
/// \param model the solids (D = 3) or faces (D = 2) to mesh
/// \param size edge lengths, in the units of the model
/// \param given policies and options
template <int D = 3, bound_parameters<D> Parameters>
std::function<mesh_plan(double factor)> plan_multiples(const any_geometry& model, const erased_sizing& size,
                                                       const Parameters& given);
template <int D = 3, class Parameters>
std::function<mesh_plan(double factor)> plan_multiples(const any_geometry& model, const erased_sizing& size,
                                                       const Parameters& given) {
  return plan_multiples<D>(model, size, bind_parameters<D>(given));
}

/// Makes a planned background mesh at the size `coarse`, its bounds, and the children of its summary, by this
/// executor.
template <int D>
using background_maker =
    std::function<void(background_result<D>&, const any_sizing& coarse, const any_executor& run_tasks)>;

/// Plans the mesh and makes its background mesh, or finds it in the spool of the options. For one subdomain
/// the library's own steps make no volume: nothing is decomposed, and its mesh would serve nothing. Throws
/// what its steps throw, all naming the CAD entity concerned. In the first form by the library's own steps.
/// About linear in the elements of the background mesh, beside its mesher.
/// \param model the solids (D = 3) or faces (D = 2) to mesh
/// \param size the final edge lengths, in the units of the model; coarse ones are derived
/// \param given policies and options
template <int D, bound_parameters<D> Parameters>
background_result<D> make_background(const any_geometry& model, const erased_sizing& size,
                                     const Parameters& given);
/// The same by other steps.
/// \param make makes the mesh in another way
template <int D, bound_parameters<D> Parameters>
background_result<D> make_background(const any_geometry& model, const erased_sizing& size,
                                     const Parameters& given, const background_maker<D>& make);
template <int D, class Parameters>
background_result<D> make_background(const any_geometry& model, const erased_sizing& size,
                                     const Parameters& given) {
  return make_background<D>(model, size, bind_parameters<D>(given));
}
template <int D, class Parameters>
background_result<D> make_background(const any_geometry& model, const erased_sizing& size,
                                     const Parameters& given, const background_maker<D>& make) {
  return make_background<D>(model, size, bind_parameters<D>(given), make);
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/pipeline/background.ipp"
#endif
