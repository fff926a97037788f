/// @file
/// The star of one free vertex, and the move of that vertex when its elements allow it.
#pragma once

#include "dovetail/core/predicates.hpp"
#include "dovetail/improver/shape_measure.hpp"
#include "dovetail/improver/tetrahedra/local_change.hpp"
#include "dovetail/improver/tetrahedra/size_band.hpp"

namespace dovetail::improvement {

/// What the elements around a vertex must be like after its move.
struct move_conditions {
  float worst;       ///< every value is above this
  float target = -2; ///< and no value that is under this is lower than it was
  double sum = -1e9; ///< and the sum of the values is above this
};

/// The star of a vertex, and its move.
template <shape_measure Measure>
class star_move {
public:
  using star = bounded_list<local_id, max_star>; ///< the elements at the vertex

  /// Takes the star of the free vertex `v`; false when it is too large. O(star).
  bool start(tet_complex& mesh, local_id v) {
    vertex_ = v;
    return collect_star(mesh, v, elements_);
  }
  const star& elements() const { return elements_; } ///< the elements at the vertex
  /// The least value of the elements.
  float worst(const tet_complex& mesh) const { return worst_value(mesh, elements_.view()); }
  /// The points of the side opposite the vertex in `e`: (vertex, a, b, c) is positive.
  std::array<vec3, 3> opposite_side(const tet_complex& mesh, local_id e) const {
    const auto& local = numbering::sides<3>[mesh.corner_of(e, vertex_)];
    return {mesh.point(mesh.vertex(e, local[0])), mesh.point(mesh.vertex(e, local[1])),
            mesh.point(mesh.vertex(e, local[2]))};
  }

  /// Moves the vertex when its elements then meet the conditions and its edges are in the band; verified in
  /// double precision, positive orientation exactly. O(star), less when an early element refuses.
  bool move(tet_complex& mesh, vec3 place, const move_conditions& wanted, const size_band& band) {
    const vec3 from = mesh.point(vertex_);
    mesh.set_point(vertex_, place);
    if (!is_better(mesh, wanted) || !keeps_lengths(mesh, from, band)) {
      mesh.set_point(vertex_, from);
      return false;
    }
    mesh.start_change();
    for (int i = 0; i < elements_.size; ++i) {
      mesh.set_value(elements_[i], new_values_[i]);
      for (const local_id other : mesh.vertices(elements_[i]))
        mesh.touch(other);
    }
    return true;
  }

private:
  bool keeps_lengths(const tet_complex& mesh, vec3 from, const size_band& band) const {
    const vec3 place = mesh.point(vertex_);
    edge_lengths before, after;
    for (const local_id e : elements_)
      for (const local_id other : mesh.vertices(e))
        if (other != vertex_) {
          before.add(from, mesh.point(other));
          after.add(place, mesh.point(other));
        }
    return band.admits(mesh, before, after, mesh.vertices(elements_[0]), place);
  }
  bool is_better(const tet_complex& mesh, const move_conditions& wanted) {
    double sum = 0;
    for (int i = 0; i < elements_.size; ++i) {
      const auto& n = mesh.vertices(elements_[i]);
      new_values_[i] = static_cast<float>(
          measure_of<Measure>(mesh.point(n[0]), mesh.point(n[1]), mesh.point(n[2]), mesh.point(n[3])));
      const float value = new_values_[i];
      if (!(value > wanted.worst) || (value < wanted.target && value < mesh.value(elements_[i])) ||
          ((value > 0 || !mesh.is_tangled()) &&
           !(orient3d(mesh.point(n[0]), mesh.point(n[1]), mesh.point(n[2]), mesh.point(n[3])) > 0)))
        return false;
      sum += static_cast<double>(value);
    }
    return sum > wanted.sum;
  }

  local_id vertex_ = no_id;
  star elements_;
  bounded_list<float, max_star> new_values_;
};

} // namespace dovetail::improvement
