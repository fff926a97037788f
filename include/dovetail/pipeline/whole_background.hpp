/// @file
/// The background mesh by a mesher that keeps no boundary, for `generate_from_background`.
#pragma once

#include "dovetail/mesher/any_line_keeping_mesher.hpp"
#include "dovetail/pipeline/background.hpp"

namespace dovetail {

/// `make_background<3>` with a mesher of whole domains; subdomains are meshed by another one:
///
///     auto background = make_background_by(mesher::cgal_mesh_3{}, model, size, given);
///     auto mesh = generate_from_background<3>(model, std::move(background), given);
///
/// The mesher's triangles become the coarse surface. Throws `geometry_error` for models of several solids,
/// whose common faces it would not keep, and what its steps throw.
/// Complexity: that of the mesher, and about linear in the elements of the background mesh.
/// \param mesh_whole meshes a domain along the given lines
/// \param model one solid
/// \param size the final edge lengths, in the units of the model
/// \param given policies and options
template <bound_parameters<3> Parameters>
background_result<3> make_background_by(const any_line_keeping_mesher& mesh_whole, const any_geometry& model,
                                        const erased_sizing& size, const Parameters& given);
template <class Parameters>
background_result<3> make_background_by(const any_line_keeping_mesher& mesh_whole, const any_geometry& model,
                                        const erased_sizing& size, const Parameters& given) {
  return make_background_by(mesh_whole, model, size, bind_parameters<3>(given));
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/pipeline/whole_background.ipp"
#endif
