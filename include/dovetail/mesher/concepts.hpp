/// @file
/// The role `piece_mesher<M, D>`: fill a bounded piece with elements without touching its boundary.
///
/// Valid expressions for `const M& m`, `const mesher_input<D>& in`, `const any_sizing& h`:
///
/// - `m(in, h)`: mesher_result<D>
/// - `M::traits`: mesher_traits, constexpr static
///
/// Semantics: every boundary side of `in` is a side of exactly one element of the result (two for a side
/// listed in both directions); points [0, in.boundary.points.size()) of the result are the input's, bit for
/// bit; all elements are positively oriented and fill exactly the inside of the oriented shells (outer
/// shells and voids). The mean edge length on a uniform field equals the size within 5 %.
/// Complexity: about linear in the number of elements made.
/// Failure: throws `mesher_error`; with `traits.may_crash` it may also end the process, so run it in a
/// worker.
///
/// In D = 2 a piece consists of regions on CAD faces or planes: points lie exactly on the region's surface,
/// and elements are oriented along the oriented face. Models for D = 2: native_surface, cgal_surface,
/// gmsh_surface. Models for D = 3: tetgen, gmsh_hxt, gmsh_delaunay, netgen (mean edge within 12 %);
/// cgal_mesh_3, which keeps no boundary, is a `piece_mesher` only. A mesher is a local (not collective)
/// operation.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/mesher/surface_region.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <array>
#include <concepts>
#include <vector>

namespace dovetail {

/// What a mesher promises; declared by each model and tested by the shared contract test.
struct mesher_traits {
  bool keeps_boundary = false;       ///< every given side is in the result
  bool thread_safe = false;          ///< may run in several threads of one process
  bool accepts_non_manifold = false; ///< accepts boundaries where more than two sides meet at a ridge
  bool repeats_in_process = false;   ///< a second call on the same input gives the same mesh
  bool may_crash = false;            ///< can end the process on bad input
};

/// The closed, oriented boundary of one piece: sides with outward orientation; voids are inner shells.
template <int D>
struct mesher_input {
  simplicial_mesh<D - 1> boundary;
  local_id material = 0;
};

/// In D = 2 the boundary are the edges of the lines, each passed with the piece on its left. An edge inside
/// the piece, on a CAD curve or an inner line, is listed in both directions.
template <>
struct mesher_input<2> {
  simplicial_mesh<1> boundary;
  local_id material = 0;
  std::vector<surface_region> regions = {};
};

template <int D>
struct mesher_result {
  simplicial_mesh<D> mesh; ///< the input's points first, unchanged; then the new ones
  report summary;
};

template <>
struct mesher_result<2> {
  simplicial_mesh<2> mesh; ///< as above; tags are faces
  report summary;
  std::vector<std::array<vec2, 3>> corner_uv = {}; ///< per triangle: parameters on its face; may be empty
};

template <class M, int D>
concept piece_mesher = std::copy_constructible<M> &&
    requires(const M& m, const mesher_input<D>& in, const any_sizing& h) {
  { m(in, h) } -> std::same_as<mesher_result<D>>;
  { M::traits } -> std::convertible_to<mesher_traits>;
};

/// A mesher that may be used on subdomains: it keeps the boundary it is given.
template <class M, int D>
concept boundary_keeping_mesher = piece_mesher<M, D> && M::traits.keeps_boundary;

} // namespace dovetail
