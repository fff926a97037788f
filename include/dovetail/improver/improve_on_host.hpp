/// @file
/// The call of any improver of triangles on a surface, whether it knows of surfaces or not.
#pragma once

#include "dovetail/improver/concepts.hpp"
#include "dovetail/improver/surface_host.hpp"

namespace dovetail {

/// Improves triangles that lie on `host`. An improver that is no surface improver may move vertices only
/// where all faces are planes: frozen, flips alone keep them on the surface.
/// Throws what the improver throws. Complexity: that of the improver.
/// \param improve an improver of triangles
/// \param mesh triangles, which change
/// \param frozen points and sides that stay
/// \param size edge lengths wanted, in the units of the model
/// \param host the surface that the triangles lie on
template <improver<2> I>
report improve_on_host(const I& improve, simplicial_mesh<2>& mesh, const frozen_entities<2>& frozen,
                       const any_sizing& size, const surface_host& host) {
  if constexpr (surface_improver<I>) {
    return improve(mesh, frozen, size, host);
  } else {
    frozen_entities<2> kept = frozen;
    if (!is_plane_throughout(host, mesh.tags))
      kept.points = static_cast<local_id>(mesh.points.size());
    return improve(mesh, kept, size);
  }
}

} // namespace dovetail
