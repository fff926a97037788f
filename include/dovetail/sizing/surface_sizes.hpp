/// @file
/// The sizes that a surface of triangles has of itself, growing away from it.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/sizing/checked_size.hpp"
#include "dovetail/sizing/point_sizes.hpp"
#include "dovetail/sizing/size_balls.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// The mean length of the edges at each point of triangles that has some.
inline std::vector<sized_point> mean_edges_at_points(const simplicial_mesh<2>& surface) {
  const auto at = [&](local_id v) { return surface.points[static_cast<std::size_t>(v)]; };
  std::vector<double> sum(surface.points.size(), 0), count(surface.points.size(), 0);
  for (const simplex<2>& triangle : surface.elements)
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = distance(at(triangle[k]), at(triangle[(k + 1) % 3]));
      for (const local_id v : {triangle[k], triangle[(k + 1) % 3]}) {
        sum[static_cast<std::size_t>(v)] += length;
        ++count[static_cast<std::size_t>(v)];
      }
    }
  std::vector<sized_point> sizes;
  for (std::size_t v = 0; v < sum.size(); ++v)
    if (count[v] > 0)
      sizes.push_back({surface.points[v], sum[v] / count[v]});
  return sizes;
}

} // namespace detail

/// h(x) = min over the surface's points p of (mean length of the edges at p) + growth |x - p|: sizes for the
/// inside of a surface that is kept. O(n log n), then about log n steps per evaluation. Throws `sizing_error`
/// for a growth that is not positive and finite, or a surface without extent.
inline point_sizes surface_sizes(const simplicial_mesh<2>& surface, double growth) {
  box3 box;
  std::vector<sized_point> sizes = detail::mean_edges_at_points(surface);
  for (const sized_point& p : sizes)
    box.include(p.point);
  if (box.empty() || !(box.diagonal() > 0))
    throw sizing_error("a surface without extent has no sizes of its own; give a size or a field of sizes");
  return {std::move(sizes), growth, box.diagonal()};
}

/// A field made smaller near those points of a surface whose edges are much shorter than it says, so that it
/// grows from these by no more than `growth` per length: triangles that are kept can be met by no larger
/// elements. The field itself where there are none. Cost and errors as above, and of the field.
inline any_sizing within_surface_sizes(any_sizing size, const simplicial_mesh<2>& surface, double growth) {
  constexpr double much_larger = 1.6; // than the mean edge; a surface made in these sizes has no such points
  std::vector<size_ball> smaller;
  for (const sized_point& p : detail::mean_edges_at_points(surface))
    if (checked_size(size, p.point) > much_larger * p.size)
      smaller.push_back({p.point, 0, p.size});
  return within_bounds(std::move(size), std::move(smaller), growth);
}

} // namespace dovetail
