/// @file
/// What the pipeline asks of meshers of pieces and of whole domains, and what goes in and out.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/remesh/surface_region.hpp"
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
  simplicial_mesh<D - 1> boundary; ///< points and oriented sides
  local_id material = 0;           ///< of the elements to be made
};

/// In D = 2 the boundary are the edges of the lines, each passed with the piece on its left. An edge inside
/// the piece, on a CAD curve or an inner line, is listed in both directions.
template <>
struct mesher_input<2> {
  simplicial_mesh<1> boundary;
  local_id material = 0;
  std::vector<surface_region> regions = {}; ///< what the piece consists of
};

/// What a mesher has made of a piece.
template <int D>
struct mesher_result {
  simplicial_mesh<D> mesh; ///< the input's points first, unchanged; then the new ones
  report summary;          ///< what it counted
};

template <>
struct mesher_result<2> {
  simplicial_mesh<2> mesh; ///< as above; tags are faces
  report summary;
  std::vector<std::array<vec2, 3>> corner_uv = {}; ///< per triangle: parameters on its face; may be empty
};

/// What a mesher counts of its result.
struct mesher_counts {
  std::size_t elements = 0;                      ///< that were made
  std::size_t points = 0;                        ///< those of the boundary too
  std::optional<std::int64_t> sizing_calls = {}; ///< how often the field was asked, where it is known

  using fields = field_list<&mesher_counts::elements, &mesher_counts::points, &mesher_counts::sizing_calls>;
};

/// The role `piece_mesher<M, D>`: fill the inside of a closed boundary with elements.
///
/// Valid expressions for `const M& m`, `const mesher_input<D>& in`, `const any_sizing& h`:
///
/// - `m(in, h)`: mesher_result<D>
/// - `M::traits`: mesher_traits, constexpr static
///
/// It may also be a `calibrated_mesher`, a `piece_sizing_mesher`, and one that `has_fallbacks` or
/// `has_background_form`.
///
/// Semantics: all elements are positively oriented and fill the inside of the oriented shells (outer shells
/// and voids). The mean edge length on a uniform field equals the size within 5 % (netgen: 12 %). The traits
/// are true. A mesher is a local (not collective) operation.
///
/// Complexity: about linear in the number of elements made.
///
/// Failure: throws `mesher_error`; with `traits.may_crash` it may also end the process, so run it in a
/// worker.
///
/// Models: those of `boundary_keeping_mesher`; cgal_mesh_3, which keeps no boundary, for whole domains.
template <class M, int D>
concept piece_mesher = std::copy_constructible<M> &&
    requires(const M& m, const mesher_input<D>& in, const any_sizing& h) {
  { m(in, h) } -> std::same_as<mesher_result<D>>;
  { M::traits } -> std::convertible_to<mesher_traits>;
};

/// The role `boundary_keeping_mesher<M, D>`: a mesher for subdomains, which keeps the boundary it is given.
///
/// Valid expressions: those of `piece_mesher<M, D>`; `M::traits.keeps_boundary` is true in a constant
/// expression.
///
/// Semantics: every boundary side of `in` is a side of exactly one element of the result (two for a side
/// listed in both directions); points [0, in.boundary.points.size()) of the result are the input's, bit for
/// bit; elements fill the inside. In D = 2 points lie on the surface of the region's CAD face or plane, and
/// elements are oriented along the face.
///
/// Complexity: about linear in the number of elements made.
///
/// Failure: as `piece_mesher`.
///
/// Models: native_surface, cgal_surface, gmsh_surface for D = 2; native, tetgen, gmsh_hxt, gmsh_delaunay,
/// netgen for D = 3.
template <class M, int D>
concept boundary_keeping_mesher = piece_mesher<M, D> && M::traits.keeps_boundary;

/// The role `line_keeping_mesher`: a mesher of whole domains that follows given lines, for
/// `make_background_by`.
///
/// Valid expressions for `const M& m`, `std::vector<std::vector<vec3>> lines`: those of `piece_mesher<M, 3>`,
/// and
///
/// - `m.with_lines(lines)`: M, the same mesher told the lines
///
/// Semantics: `lines` are chains of points on the boundary that will be given; those that meet do so in their
/// ends. The result of `m.with_lines(lines)(in, h)` has its own boundary triangles, near the given ones; a
/// chain of their edges runs along each line.
///
/// Complexity: `with_lines` is linear in the points.
///
/// Failure: as `piece_mesher`.
///
/// Models: cgal_mesh_3. A mesher that keeps its whole boundary can be made one by a `with_lines` that returns
/// a copy.
template <class M>
concept line_keeping_mesher = piece_mesher<M, 3> &&
    requires(const M& m, std::vector<std::vector<vec3>> lines) {
  { m.with_lines(lines) } -> std::same_as<M>;
};

} // namespace dovetail
