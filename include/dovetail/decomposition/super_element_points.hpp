/// @file
/// Super-elements at the points of their mesh.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/boundary_defects.hpp"
#include "dovetail/mesh/adjacency.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace dovetail {

/// What super-elements have at the points of their mesh, whatever parts they are in. Mesh, sides and
/// `super_of_element` must outlive it.
template <int D>
class super_element_points {
public:
  super_element_points(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                       std::span<const local_id> super_of_element, std::size_t supers)
      : mesh_(mesh), sides_(sides), super_(super_of_element),
        stars_(std::make_shared<const point_stars<D>>(mesh, sides)), points_(points_of_supers(supers)) {}

  const simplicial_mesh<D>& mesh() const { return mesh_; } ///< the mesh that the elements are of
  const side_table<D>& sides() const { return sides_; }    ///< of that mesh
  const std::shared_ptr<const point_stars<D>>& stars() const { return stars_; } ///< of the mesh's points
  /// The super-element that an element is in.
  local_id super_of(local_id element) const { return super_[element]; }
  /// The super-elements at a point, growing.
  std::vector<local_id> supers_at(local_id point) const {
    std::vector<local_id> supers;
    for (const local_id e : stars_->elements[point])
      supers.push_back(super_[e]);
    sort_unique(supers);
    return supers;
  }
  /// The points of a super-element, growing, where others meet it or the mesh ends: at all others no
  /// partition has a defect.
  std::span<const local_id> points_of(local_id super) const { return points_[super]; }

private:
  compressed_rows<local_id> points_of_supers(std::size_t supers) const {
    const auto is_inside = [&](local_id point) {
      const auto around = stars_->elements[point];
      return stars_->on_boundary[point] == 0 && std::all_of(around.begin(), around.end(), [&](local_id e) {
               return super_of(e) == super_of(around.front());
             });
    };
    return sorted_into_rows<local_id>(supers, [&](const auto& put_into) {
      for (std::size_t v = 0; v < mesh_.points.size(); ++v)
        if (const auto point = static_cast<local_id>(v); !is_inside(point))
          for (const local_id s : supers_at(point))
            put_into(s, point);
    });
  }

  const simplicial_mesh<D>& mesh_;
  const side_table<D>& sides_;
  std::span<const local_id> super_;
  std::shared_ptr<const point_stars<D>> stars_;
  compressed_rows<local_id> points_; ///< per super-element
};

} // namespace dovetail
