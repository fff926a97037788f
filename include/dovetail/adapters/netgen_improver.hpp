/// @file
/// Netgen's optimisation of volume meshes as an improver.
#pragma once

#include "dovetail/adapters/library_pieces.hpp"
#include "dovetail/distributed/run_in_child.hpp"

namespace nglib {
#include <nglib.h>
}

#include <string>

namespace dovetail {

namespace improvement {

/// Netgen's optimiser: flips, splits, combinations and smoothing, by its own badness of shape and size.
/// Models `improver<netgen, 3>`. nglib has no call for it: asked to mesh a domain that is full of elements
/// already, Netgen goes on to optimise them. It is slow, and worth it on small meshes only. Inner frozen
/// sides are not known to it: a result that lost one is not used (see `improve_by_library`). Each call forks
/// a child, as Netgen prints and has global state: the calling process must have one thread only
/// (`usage_error`).
struct netgen {
  static constexpr improver_traits traits{.thread_safe = false};

  int steps = 3;               ///< rounds of optimisation
  double limit_seconds = 3600; ///< the child's wall clock; the last resort

  report operator()(simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen = {},
                    const any_sizing& size = {}) const;
};

namespace detail {

/// One use of Netgen, in a process that ends right after it.
inline simplicial_mesh<3> optimise_with_netgen(const netgen& parameters, const library_piece& piece) {
  using namespace nglib;
  Ng_Init();
  Ng_Mesh* loaded = Ng_NewMesh();
  for (vec3 p : piece.mesh.points)
    Ng_AddPoint(loaded, &p.x);
  for (const auto& [a, b, c] : piece.boundary) {
    std::array<int, 3> corners{a + 1, b + 1, c + 1};
    Ng_AddSurfaceElement(loaded, NG_TRIG, corners.data());
  }
  for (const auto& [a, b, c, d] : piece.mesh.elements) {
    std::array<int, 4> corners{a + 1, b + 1, d + 1, c + 1}; // Netgen's tetrahedra are oriented the other way
    Ng_AddVolumeElement(loaded, NG_TET, corners.data());
  }
  Ng_Meshing_Parameters wanted;
  wanted.maxh = mean_edge_length(piece.mesh);
  wanted.optsteps_3d = parameters.steps;
  wanted.check_overlap = wanted.check_overlapping_boundary = 0;
  if (const Ng_Result outcome = Ng_GenerateVolumeMesh(loaded, &wanted); outcome != NG_OK)
    throw mesher_error("Netgen gave error " + std::to_string(outcome));

  simplicial_mesh<3> made;
  const int points = Ng_GetNP(loaded), elements = Ng_GetNE(loaded);
  for (int v = 1; v <= points; ++v) {
    vec3 p;
    Ng_GetPoint(loaded, v, &p.x);
    made.points.push_back(p);
  }
  for (int e = 1; e <= elements; ++e) {
    std::array<int, 10> corners{};
    if (Ng_GetVolumeElement(loaded, e, corners.data()) != NG_TET)
      throw mesher_error("Netgen made an element that is no tetrahedron");
    made.elements.push_back({corners[0] - 1, corners[1] - 1, corners[3] - 1, corners[2] - 1});
  }
  return made;
}

} // namespace detail

inline report netgen::operator()(simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen,
                                 const any_sizing&) const {
  return improve_by_library("Netgen", mesh, frozen, [this](const library_piece& piece) {
    return run_in_child("its process", limit_seconds,
                        [&] { return detail::optimise_with_netgen(*this, piece); });
  });
}

} // namespace improvement

static_assert(improver<improvement::netgen, 3>);

} // namespace dovetail
