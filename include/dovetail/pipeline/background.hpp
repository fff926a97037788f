/// @file
/// The first step of the pipeline: the coarse surface mesh, and volume mesh in D = 3, that is decomposed
/// (paper, section 3.2), as the plan of the mesh has it.
#pragma once

#include "dovetail/core/fields.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/mesh/background_mesh.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/pipeline/bound_parameters.hpp"
#include "dovetail/pipeline/planning.hpp"
#include "dovetail/sizing/size_balls.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace dovetail {

/// What is counted of a background mesh.
struct background_counts {
  double predicted_elements = 0; ///< of the mesh that is wanted
  double coarse_scale = 0;       ///< factor between coarse and final size
  double size_scale = 0;         ///< by which the sizes were enlarged
  std::size_t elements = 0;      ///< of the background mesh
  int stops_by_clock = 0;        ///< stops by a time limit
  std::optional<int> kept = {};  ///< 1: an earlier run has kept it

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

/// Makes a planned background mesh at the size `coarse`, its bounds, and the children of its summary, by this
/// executor.
template <int D>
using background_maker =
    std::function<void(background_result<D>&, const any_sizing& coarse, const any_executor& run_tasks)>;

/// Plans the mesh and makes its background mesh, or finds what an earlier run has kept: in the first form by
/// the library's own steps, which make no volume for one subdomain, as nothing is decomposed then. Throws
/// what its steps throw, all naming the CAD entity concerned.
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
