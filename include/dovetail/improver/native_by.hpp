/// @file
/// The native improver with other operations than its own.
#pragma once

#include "dovetail/improver/native_parameters.hpp"
#include "dovetail/improver/operations.hpp"
#include "dovetail/improver/tetrahedra/tet_improver.hpp"
#include "dovetail/improver/triangles/triangle_improver.hpp"

namespace dovetail::improvement {

/// `Operations` names a list for each dimension and, for tetrahedra, each measure of shape, as
/// `native_operations` does. To add one to those for tetrahedra:
///
///     struct mine : native_operations {
///       template <shape_measure Measure>
///       using on_tetrahedra =
///           typename native_operations::on_tetrahedra<Measure>::template with<my_operation<Measure>>;
///     };
///     improvement::native_by<mine>{improvement::native::fine()}(mesh);
///
/// Models `improver<native_by<Operations>, D>` for D = 2 and 3.
template <class Operations>
struct native_by {
  static_assert(
      requires { typename Operations::template on_tetrahedra<minimum_dihedral>; },
      "native_by takes lists of operations (improver/operations.hpp)");

  static constexpr improver_traits traits = native::traits;
  native parameters = {}; ///< what it goes by

  report operator()(simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen = {},
                    const any_sizing& size = {}) const {
    switch (parameters.objective) {
    case objective::radius_ratio:
      return improve_tetrahedra<Operations, radius_ratio>(parameters, mesh, frozen, size);
    case objective::mean_ratio:
      return improve_tetrahedra<Operations, mean_ratio>(parameters, mesh, frozen, size);
    case objective::minimum_dihedral:
      break;
    }
    return improve_tetrahedra<Operations, minimum_dihedral>(parameters, mesh, frozen, size);
  }
  report operator()(simplicial_mesh<2>& mesh, const frozen_entities<2>& frozen = {},
                    const any_sizing& size = {}, const surface_host& host = {}) const {
    return improve_surface<Operations>(parameters, mesh, frozen, size, host);
  }
};

} // namespace dovetail::improvement

#include "dovetail/improver/native.hpp" // its native.ipp needs what is above
