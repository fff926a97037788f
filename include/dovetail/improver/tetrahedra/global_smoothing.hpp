/// @file
/// A cheap move of every free vertex, whether its elements are poor or not.
///
/// A vertex goes to where an optimal Delaunay triangulation would have it: the average of the circumcentres
/// of its elements, weighted by their volumes and a density, size^-5, so that it is not drawn into the larger
/// elements of a graded mesh. L. Chen, "Mesh smoothing schemes based on optimal Delaunay triangulations"
/// (2004); P. Alliez, D. Cohen-Steiner, M. Yvinec, M. Desbrun, "Variational tetrahedral meshing", doi
/// 10.1145/1073204.1073238.
#pragma once

#include "dovetail/improver/tetrahedra/star_move.hpp"

#include <cstddef>

namespace dovetail::improvement {

/// How vertices may move.
struct global_smoothing_limits {
  int passes = 1;              ///< sweeps over all free vertices
  bool must_raise_mean = true; ///< the mean value around a vertex must get better, not only the worst one
  float target = -2;           ///< no element under this may get worse, and none may fall under it
  size_band band = {};         ///< edges stay within it
};

/// How many moves there were.
struct global_smoothing_counts {
  std::size_t tried = 0, accepted = 0; ///< moves that were tried, and those of them that were kept
};

/// Moves free vertices to where an optimal Delaunay triangulation would have them.
template <shape_measure Measure>
class global_smoothing {
public:
  /// Sweeps over the free vertices by number (take_mesh puts them along the curve). O(elements) each.
  global_smoothing_counts run(tet_complex& mesh, const global_smoothing_limits& limits) {
    global_smoothing_counts counts;
    for (int pass = 0; pass < limits.passes; ++pass)
      for (local_id v = 0; v < mesh.vertex_slots(); ++v)
        if (mesh.is_free(v)) {
          ++counts.tried;
          counts.accepted += improve(mesh, v, limits);
        }
    return counts;
  }

  /// Moves `v` all the way or half of it, when that raises the worst value of its star and meets the limits.
  /// Stars with inverted elements are left alone. O(star).
  bool improve(tet_complex& mesh, local_id v, const global_smoothing_limits& limits) {
    if (!star_.start(mesh, v))
      return false;
    move_conditions wanted{.worst = star_.worst(mesh), .target = limits.target};
    if (!(wanted.worst > 0))
      return false;
    if (limits.must_raise_mean) {
      wanted.sum = 0;
      for (const local_id e : star_.elements())
        wanted.sum += static_cast<double>(mesh.value(e));
    }
    const vec3 from = mesh.point(v), way = way_to_optimum(mesh, v);
    return star_.move(mesh, from + way, wanted, limits.band) ||
           star_.move(mesh, from + 0.5 * way, wanted, limits.band);
  }

private:
  vec3 way_to_optimum(const tet_complex& mesh, local_id v) const {
    const vec3 origin = mesh.point(v);
    // Relative to the first size, so that the fifth power neither overflows nor underflows.
    const double unit = size_of(mesh, star_.elements()[0]);
    vec3 sum{};
    double weight = 0;
    for (const local_id e : star_.elements()) {
      const auto [p, q, r] = star_.opposite_side(mesh, e);
      const vec3 a = p - origin, b = q - origin, c = r - origin, bc = cross(b, c);
      const double size = size_of(mesh, e) / unit, density = 1 / (size * size * size * size * size);
      // Twelve times the volume times the circumcentre, seen from the vertex.
      sum += density * (norm_squared(a) * bc + norm_squared(b) * cross(c, a) + norm_squared(c) * cross(a, b));
      weight += density * dot(a, bc);
    }
    return sum / (2 * weight);
  }
  /// The mean of the sizes at its vertices; the same for all elements when there are none.
  static double size_of(const tet_complex& mesh, local_id e) {
    double sum = 0;
    for (const local_id v : mesh.vertices(e))
      sum += static_cast<double>(mesh.size_at(v));
    return sum > 0 ? sum : 1;
  }

  star_move<Measure> star_;
};

} // namespace dovetail::improvement
