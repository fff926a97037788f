/// @file
/// What `surface_sizes.hpp` declares.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/sizing/checked_size.hpp"
#include "dovetail/sizing/point_sizes.hpp"
#include "dovetail/sizing/size_balls.hpp"
#include "dovetail/sizing/surface_sizes.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// The mean length of the edges at each point of triangles that has some.
inline std::vector<sized_point> mean_edges_at_points(const simplicial_mesh<2>& surface) {
  const auto at = [&](local_id v) { return surface.points[v]; };
  std::vector<double> sum(surface.points.size(), 0), count(surface.points.size(), 0);
  for (const simplex<2>& triangle : surface.elements)
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = distance(at(triangle[k]), at(triangle[(k + 1) % 3]));
      for (const local_id v : {triangle[k], triangle[(k + 1) % 3]}) {
        sum[v] += length;
        ++count[v];
      }
    }
  std::vector<sized_point> sizes;
  for (std::size_t v = 0; v < sum.size(); ++v)
    if (count[v] > 0)
      sizes.push_back({surface.points[v], sum[v] / count[v]});
  return sizes;
}

} // namespace dovetail::detail

namespace dovetail {

DOVETAIL_INLINE point_sizes surface_sizes(const simplicial_mesh<2>& surface, double growth) {
  box3 box;
  std::vector<sized_point> sizes = detail::mean_edges_at_points(surface);
  for (const sized_point& p : sizes)
    box.include(p.point);
  if (box.empty() || !(box.diagonal() > 0))
    throw sizing_error("a surface without extent has no sizes of its own; give a size or a field of sizes");
  return {std::move(sizes), growth, box.diagonal()};
}

DOVETAIL_INLINE any_sizing within_surface_sizes(any_sizing size, const simplicial_mesh<2>& surface,
                                                double growth) {
  constexpr double much_larger = 1.6; // than the mean edge; a surface made in these sizes has no such points
  std::vector<size_ball> smaller;
  for (const sized_point& p : detail::mean_edges_at_points(surface))
    if (checked_size(size, p.point) > much_larger * p.size)
      smaller.push_back({p.point, 0, p.size});
  return within_bounds(std::move(size), std::move(smaller), growth);
}

} // namespace dovetail
