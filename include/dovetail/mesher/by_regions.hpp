/// @file
/// From a surface mesher, which fills one region of one surface, to a mesher of pieces of D = 2.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/remesh/mesh_regions.hpp"
#include "dovetail/remesh/surface_deviation.hpp"

#include <array>
#include <string>

namespace dovetail::mesher {

/// Fills every region of a piece by M and joins them along their lines.
template <surface_mesher M>
struct by_regions {
  /// It keeps the boundary, and is as safe in threads as M.
  static constexpr mesher_traits traits{.keeps_boundary = true,
                                        .thread_safe = is_thread_safe<M>(),
                                        .accepts_non_manifold = true,
                                        .repeats_in_process = true,
                                        .may_crash = false};

  M remesher = {}; ///< meshes each region

  /// As above, and what a mesher behind one type says of the one that it holds.
  mesher_traits actual_traits() const {
    mesher_traits actual = traits;
    actual.thread_safe = may_run_in_threads(remesher);
    return actual;
  }
  /// Costs what M does. Throws `mesher_error` naming the face when the lines of a region cross in its
  /// parameter plane, its boundary is not kept or its triangles cannot be kept from folding over, and what M
  /// throws.
  mesher_result<2> operator()(const mesher_input<2>& input, const any_sizing& size) const {
    const stopwatch clock;
    mesher_result<2> result;
    simplicial_mesh<2>& mesh = result.mesh;
    mesh.points = input.boundary.points;
    report deviation;
    for (const surface_region& region : input.regions) {
      const patch_mesh made = mesh_whole(region, size);
      note_deviation(deviation, "face " + std::to_string(region.face),
                     measure_deviation(region.surface, region.boundary, made, size));
      append_region(region, made, mesh.points,
                    [&](const simplex<2>& triangle, const std::array<vec2, 3>& uv) {
                      mesh.elements.push_back(triangle);
                      mesh.tags.push_back(region.face);
                      result.corner_uv.push_back(uv);
                    });
    }
    result.summary.set(mesher_counts{mesh.elements.size(), mesh.points.size()});
    result.summary.children.push_back(std::move(deviation));
    result.summary.seconds = clock.seconds();
    return result;
  }

private:
  patch_mesh mesh_whole(const surface_region& region, const any_sizing& size) const try {
    patch_mesh made = mesh_region(remesher, region.surface, region, size, {});
    if (!made.crossings.empty() || !made.misplaced.empty())
      throw mesher_error("its boundary lines cross in the parameter plane");
    if (!made.folded.empty())
      throw mesher_error(folds_of(made));
    return made;
  } catch (const time_limit_error&) {
    throw;
  } catch (const mesher_error& problem) {
    throw mesher_error("a region of face " + std::to_string(region.face) + ": " + problem.what());
  }
};

} // namespace dovetail::mesher
