/// @file
/// The plan of a mesh: how large it will be, and into how many subdomains it is to be cut.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/pipeline/bound_parameters.hpp"
#include "dovetail/sizing/compose.hpp"
#include "dovetail/sizing/point_sizes.hpp"
#include "dovetail/sizing/prediction.hpp"
#include "dovetail/sizing/size_balls.hpp"

#include <functional>
#include <vector>

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
  double predicted_elements = 0;  ///< elements of the mesh at the given sizes, enlarged ones if they are
  double relative_error = 0;      ///< estimated: of the integral of sizes, and of what meshers make of it
  int subdomains = 1;             ///< how many parts the background mesh is to be cut into
  double coarse_scale = 1;        ///< factor between coarse and final size
  std::vector<sized_point> walls; ///< coarse sizes in walls, while a background of D = 3 is made
  double size_scale = 1; ///< factor between final size and that given (`generate_options::enlarged_above`)

  using fields =
      field_list<&mesh_plan::predicted_elements, &mesh_plan::relative_error, &mesh_plan::subdomains,
                 &mesh_plan::coarse_scale, &mesh_plan::walls, &mesh_plan::size_scale>;
};

/// The field given as the plan has it.
inline erased_sizing enlarged(const erased_sizing& size, const mesh_plan& plan) {
  return plan.size_scale == 1 ? size : erased_sizing(scaled(size, plan.size_scale));
}

/// The triangles with a solid on one side only, oriented outwards: they enclose all solids together.
simplicial_mesh<2> outer_surface(const surface_mesh& surface, const geometry_topology& topology);

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

/// A function that gives the plan for a field times a factor, as `plan_background` does, but in D = 3 from
/// one integral of sizes, which takes longer than all the rest. Both throw what `plan_background` throws.
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

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/pipeline/planning.ipp"
#endif
