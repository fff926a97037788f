/// @file
/// The inside of a given triangulation, with every triangle of it kept.
#pragma once

#include "dovetail/core/progress.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/improver/concepts.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/mesher/native.hpp"
#include "dovetail/mesher/preferences.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/remembering.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/sizing/concepts.hpp"
#include "dovetail/sizing/erased.hpp"
#include "dovetail/sizing/refined_sizing.hpp"
#include "dovetail/sizing/surface_sizes.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <functional>
#include <vector>

namespace dovetail {

/// What is said of the region that a point is in.
struct region_mark {
  vec3 place;                ///< a point of the region
  local_id material = no_id; ///< `no_id`: it is left empty
};

/// What `fill` goes by beside the sizes.
struct fill_options {
  double growth = 0.25;                ///< of the sizes that the surface has of itself, per length
  std::vector<region_mark> marks = {}; ///< what is said of regions, each by a point in it
  /// More predicted elements are refused before anything is meshed; the indices of a mesh in memory end soon
  /// after.
  double largest_prediction = 2e8;
  any_executor run_regions = parallel::serial{}; ///< what the regions are meshed by
  progress on_progress = {};                     ///< told how the regions come along
};

/// A region that was filled.
struct filled_region {
  local_id material = 0;    ///< its number, that of its elements' tags
  std::size_t elements = 0; ///< how many it has
  double volume = 0;        ///< of its elements together
};

/// What is counted of a filled surface.
struct fill_counts {
  std::size_t triangles = 0; ///< of the surface
  std::size_t regions = 0;   ///< that were filled
  std::size_t voids = 0;     ///< that were not
  std::size_t elements = 0;  ///< in the regions
  std::size_t points = 0;    ///< those of the surface too

  using fields = field_list<&fill_counts::triangles, &fill_counts::regions, &fill_counts::voids,
                            &fill_counts::elements, &fill_counts::points>;
};

/// A filled surface.
struct filled_surface {
  simplicial_mesh<3> mesh; ///< the surface's points first, then those inside; tags: materials
  /// Per triangle of the surface: the materials behind it and before it, where its normal points to; `no_id`
  /// where it is empty.
  std::vector<std::array<local_id, 2>> materials_beside;
  std::vector<filled_region> regions; ///< those that were filled
  quality_statistics quality;         ///< of all elements
  report summary;                     ///< `fill_counts`; children "checks", "regions", "sizes", "meshing"
};

namespace detail {

/// What the policies do for `fill`, which is compiled once without them.
struct enclosed_region_mesher {
  double elements_per_inverse_cubed_size = 0;
  std::function<meshed_pieces<3>(std::size_t count, const piece_source<3>& source, const refined_sizing& size,
                                 const meshing_options& how)>
      mesh = {};
};

/// `fill` by these; without a size in those of the surface.
filled_surface fill_by(const enclosed_region_mesher& mesh_regions, const simplicial_mesh<2>& surface,
                       const any_sizing& size, const fill_options& options);

template <class M, class I>
filled_surface fill_by(const M& mesh_it, const I& improve, const simplicial_mesh<2>& surface,
                       const any_sizing& size, const fill_options& options) {
  const auto mesh = [&](std::size_t count, const piece_source<3>& source, const refined_sizing& sizes,
                        const meshing_options& how) {
    // Pieces of other sizes are not to be taken for these.
    return mesh_subdomains<3>(count, source, mesh_it, improve, sizes,
                              parallel::forgetting(options.run_regions), how);
  };
  return fill_by({dovetail::elements_per_inverse_cubed_size(mesh_it), mesh}, surface, size, options);
}

/// Whether `fill` can call these; where not, the compiler's first error says what it needs.
template <class M, class I>
consteval bool can_fill() {
  constexpr bool meshes = boundary_keeping_mesher<M, 3>;
  constexpr bool improves = improver<I, 3>;
  static_assert(meshes, "fill needs a mesher of tetrahedra that keeps its boundary (mesher/concepts.hpp)");
  static_assert(improves, "fill needs an improver of tetrahedra (improver/concepts.hpp)");
  return meshes && improves;
}

} // namespace detail

/// Meshes what closed triangles enclose, in edges of the given sizes as far as these triangles allow. Every
/// triangle becomes a side of the result and every point keeps its index, both bit for bit.
///
/// `surface`: any number of shells beside, around and inside each other, which may have edges and corners in
/// common; edges of more than two triangles, as where inner walls divide a body, are as good as others. Each
/// triangle once, and none crosses another (`require_fillable`). Each region that triangles enclose becomes a
/// material, numbered from 0 in the order of their first triangles, or of a number that is asked for by
/// `marks`.
///
/// Regions that all triangles around them show the side that their normals point to are voids and stay empty.
/// That is only so where all outer triangles are oriented outwards: else orientations mean nothing, all
/// regions are filled, and a warning says so. Marks decide in any case.
///
/// About linear in the elements. The result does not depend on the executor, nor on which way inner walls are
/// oriented. Throws `geometry_error` for a surface that cannot be filled, and for a mark that is outside of
/// it or has a negative material, naming places; `mesher_error` for a region that no attempt could mesh;
/// `sizing_error` also where far too many elements are predicted; `cancelled`.
/// \param surface the triangles; indices of points from 0
/// \param size edge lengths wanted, in the units of the points
/// \param options growth of sizes, marks of regions, executor, largest prediction
/// \param mesh_it keeps the boundary it is given
/// \param improve improves a piece inside its boundary
template <class H, class M = mesher::native, class I = native_improver>
  requires(!std::convertible_to<const H&, fill_options>)
filled_surface fill(const simplicial_mesh<2>& surface, const H& size, const fill_options& options = {},
                    const M& mesh_it = {}, const I& improve = {}) {
  constexpr bool is_field = sizing_field<H>;
  static_assert(is_field, "fill(surface, size) takes a sizing_field (sizing/concepts.hpp)");
  if constexpr (is_field && detail::can_fill<M, I>())
    return detail::fill_by(mesh_it, improve, surface, erased_sizing(size), options);
}

/// The same in sizes of the surface: the mean edge at each of its points, growing inwards.
template <class M = mesher::native, class I = native_improver>
filled_surface fill(const simplicial_mesh<2>& surface, const fill_options& options = {},
                    const M& mesh_it = {}, const I& improve = {}) {
  if constexpr (detail::can_fill<M, I>())
    return detail::fill_by(mesh_it, improve, surface, {}, options);
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/pipeline/fill.ipp"
#endif
