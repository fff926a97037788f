/// @file
/// The whole pipeline, for D = 2 and D = 3: from a CAD model and a sizing field to a distributed mesh (paper,
/// figures 3 and 8). What the dimensions do not share are overloads beside this file.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/mesh/background_mesh.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/parallel/executor_services.hpp"
#include "dovetail/pipeline/background.hpp"
#include "dovetail/pipeline/bound_parameters.hpp"
#include "dovetail/pipeline/intersection_counts.hpp"
#include "dovetail/pipeline/model_measure.hpp"
#include "dovetail/pipeline/only.hpp"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// Whether there are a model and sizes; where not, the compiler's first error says what was expected.
template <class G, class H>
consteval bool checked_input() {
  constexpr bool is_model = geometry_model<G>;
  constexpr bool is_field = sizing_field<H>;
  static_assert(is_model,
                "generate<D>(model, size, parameters) takes a geometry_model (geometry/concepts.hpp)");
  static_assert(geometry_model<G>);
  static_assert(is_field, "generate<D>(model, size, parameters) takes a sizing_field (sizing/concepts.hpp)");
  static_assert(sizing_field<H>);
  return is_model && is_field;
}

} // namespace detail

/// A generated mesh and all that is known about it. Subdomains that could not be meshed are in `failures`;
/// `mesh` is whole only when there are none, and `generate_options::only` is empty.
template <int D>
struct generated {
  distributed_simplicial_mesh<D> mesh;
  simplicial_background<D> background;        ///< without a volume where there is one subdomain
  std::vector<local_id> subdomain_of_element; ///< of the background mesh
  std::size_t subdomains = 0;                 ///< of the decomposition; pieces may be asked for of some only
  std::vector<local_id> only;                 ///< those that were, as numbered after merges; empty: all
  mesh_plan plan;                             ///< what was known before anything was meshed
  interface_angles coarse_angles;             ///< of the coarse skeleton, before merges
  interface_angles fine_angles;               ///< of the interfaces of the mesh; or around `alone`
  quality_statistics quality;                 ///< of all elements
  std::vector<piece_failure> failures;
  report summary; ///< children: background, simplification, partition, skeleton, intersection, meshing
};

using generate_result = generated<3>; ///< a mesh of tetrahedra

/// What `generate` does once the background mesh is there: `background` must be what `make_background` makes
/// for the same model, field, mesher and options. For runs that differ in the simplification, the partitioner
/// or the improver alone.
/// Throws what the stages throw. Complexity: as `generate`, without the background mesh.
/// \param model the model that the background is of
/// \param background the coarse mesh with its plan
/// \param given policies and options
template <int D, bound_parameters<D> Parameters>
generated<D> generate_from_background(const any_geometry& model, background_result<D> background,
                                      const Parameters& given);
template <int D, class Parameters>
generated<D> generate_from_background(const any_geometry& model, background_result<D> background,
                                      const Parameters& given) {
  return generate_from_background<D>(model, std::move(background), bind_parameters<D>(given));
}

/// Generates a mesh sized by `size`: for D = 3 tetrahedra of all solids of `model`, for D = 2 triangles of
/// all its faces.
///
///     auto solid = generate<3>(model, uniform_size(2.0));
///     auto shell = generate<2>(model, uniform_size(2.0), parameters<>{}.with_executor(parallel::threads{}));
///
/// The mesh depends on the model, the field and the parameters, not on the executor or its workers. Throws
/// what the stages throw: typed errors that name the CAD entity concerned. A subdomain that no attempt could
/// mesh is data. The report warns of faces that are further from the mesh than the sizes explain, of a volume
/// that differs from the model's `volume()`, if it knows that, by more than the gap between their surfaces or
/// by a fifth, and of 50 % more elements than were predicted. Where too many subdomains would have to be
/// merged, half as many are made, which a warning tells.
/// Complexity: that of the mesher and the improver over all pieces; the decomposition costs about n log n in
/// the elements of the background mesh.
/// \param given_model a model of `geometry_model`; for D = 2 also a `plane_domain`
/// \param given_size a sizing field: edge lengths wanted, in the units of the model
/// \param policies policies and options
template <int D, class G, class H, class Parameters = parameters<>>
  requires(D == 2 || D == 3)
generated<D> generate(const G& given_model, const H& given_size, const Parameters& policies = {}) {
  if constexpr (detail::checked_input<G, H>() && detail::checked_parameters<D, Parameters>()) {
    const any_geometry model(given_model);
    const erased_sizing size(given_size);
    const auto& given = bind_parameters<D>(policies);
    detail::require_growing_only(given.options);
    detail::require_separable<D>(given.options);
    auto result = generate_from_background<D>(model, make_background<D>(model, size, given), given);
    if constexpr (D == 3 && requires { given_model.volume(); })
      if (given.options.only.empty()) {
        const auto of_model = [&] { return std::optional<double>(given_model.volume()); };
        compare_volume(result.mesh.skeleton, once(given.run_tasks, of_model), result.summary);
      }
    return result;
  }
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/pipeline/generate.ipp"
#endif
