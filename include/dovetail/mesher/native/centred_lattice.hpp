/// @file
/// Points inside of a boundary: a body-centred cubic lattice in the cells of an octree of the sizes.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/core/octree.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/inside_surface.hpp"
#include "dovetail/mesher/boundary_sides.hpp"
#include "dovetail/sizing/checked_size.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace dovetail::detail {

/// Points in the middles and corners of the cells of an octree, cells being as large as makes the mean edge
/// of the lattice's Delaunay tetrahedra (each point has 8 neighbours at sqrt(3)/2 of a cell and 6 at one) the
/// size; those that are inside and away from the boundary.
class centred_lattice {
public:
  centred_lattice(const simplicial_mesh<2>& boundary, const any_sizing& size)
      : boundary_(boundary), size_(size), inside_(one_sided(boundary)), tree_(boxes_of(boundary)) {}

  std::vector<vec3> points() {
    box3 box;
    for (const vec3 p : boundary_.points)
      box.include(p);
    const vec3 extent = box.upper - box.lower;
    const double cell = cell_per_size * checked_size(size_, box.center());
    double width = cell; // doubled until the box fits, so that a uniform size is met exactly
    while (width < std::max({extent.x, extent.y, extent.z}))
      width *= 2;
    const vec3 half = 0.5 * vec3{width, width, width};
    descend_octants({box.center() - half, box.center() + half}, [&](const box3& octant, int depth) {
      if (!octant.overlaps(box))
        return false;
      const double h = checked_size(size_, octant.center());
      if (depth < most_depth && octant.upper.x - octant.lower.x > widest_cell * cell_per_size * h)
        return true;
      try_point(octant.center(), h);
      for (unsigned k = 0; k < 8; ++k)
        corners_.push_back({{(k & 1U) != 0 ? octant.upper.x : octant.lower.x,
                             (k & 2U) != 0 ? octant.upper.y : octant.lower.y,
                             (k & 4U) != 0 ? octant.upper.z : octant.lower.z},
                            h});
      return false;
    });
    add_corners();
    return std::move(points_);
  }

private:
  static constexpr double cell_per_size = 7 / (4 * 0.8660254037844386 + 3);
  static constexpr double widest_cell = 1.4142135623730951; // so that cells are right on average
  static constexpr double clearance = 0.7;                  // from the boundary, over the size
  static constexpr int most_depth = 24;

  struct corner {
    vec3 place;
    double size;
  };

  /// The triangles that have the outside on one side.
  static simplicial_mesh<2> one_sided(const simplicial_mesh<2>& boundary) {
    const boundary_sides sides(span_of(boundary.elements));
    simplicial_mesh<2> result;
    result.points = boundary.points;
    for (const auto& triangle : boundary.elements) {
      const auto& listed = sides.entries()[static_cast<std::size_t>(sides.find(triangle).entry)].listed;
      if (listed[0] == no_id || listed[1] == no_id)
        result.elements.push_back(triangle);
    }
    return result;
  }
  static box_tree boxes_of(const simplicial_mesh<2>& boundary) {
    std::vector<box3> boxes(boundary.elements.size());
    for (std::size_t t = 0; t < boxes.size(); ++t)
      for (const local_id v : boundary.elements[t])
        boxes[t].include(boundary.points[static_cast<std::size_t>(v)]);
    return box_tree(boxes);
  }
  bool is_clear(vec3 p, double distance) const {
    bool clear = true;
    tree_.for_each(
        [&](const box3& box, std::size_t) { return clear && distance_squared(box, p) < distance * distance; },
        [&](local_id t) {
          const auto& v = boundary_.elements[static_cast<std::size_t>(t)];
          const vec3 a = boundary_.points[static_cast<std::size_t>(v[0])],
                     b = boundary_.points[static_cast<std::size_t>(v[1])],
                     c = boundary_.points[static_cast<std::size_t>(v[2])];
          const auto w = nearest_on_triangle(a, b, c, p);
          clear = clear && norm(w[0] * a + w[1] * b + w[2] * c - p) >= distance;
        });
    return clear;
  }
  void try_point(vec3 p, double h) {
    if (is_clear(p, clearance * h) && inside_(p))
      points_.push_back(p);
  }
  /// Corners, each once, with the least of the sizes of its cells.
  void add_corners() {
    sort_all(corners_, [](const corner& a, const corner& b) {
      return std::array{a.place.x, a.place.y, a.place.z, a.size} <
             std::array{b.place.x, b.place.y, b.place.z, b.size};
    });
    for (std::size_t k = 0; k < corners_.size(); ++k)
      if (k == 0 || !(corners_[k].place == corners_[k - 1].place))
        try_point(corners_[k].place, corners_[k].size);
  }

  const simplicial_mesh<2>& boundary_;
  const any_sizing& size_;
  inside_surface inside_;
  box_tree tree_;
  std::vector<corner> corners_;
  std::vector<vec3> points_;
};

} // namespace dovetail::detail
