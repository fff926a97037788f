/// @file
/// Moves one free vertex so that the worst element around it gets better.
#pragma once

#include "dovetail/improver/apex_search.hpp"
#include "dovetail/improver/size_band.hpp"

namespace dovetail::improvement {

template <shape_measure Measure>
class vertex_smoothing {
public:
  /// Moves `v` when that raises the worst value of its star by more than rounding could feign and keeps the
  /// edges in the band. O(star).
  bool improve(tet_complex& mesh, local_id v, const apex_search_limits& limits, const size_band& band) {
    if (!collect_star(mesh, v, star_))
      return false;
    const vec3 old_point = mesh.point(v);
    const float old_worst = worst_value(mesh, star_.view());
    double length = 0;
    for (int i = 0; i < star_.size; ++i)
      length = std::max(length, norm_squared(mesh.point(other_vertex(mesh, star_[i], v)) - old_point));
    batch_.start(old_point, std::sqrt(length));
    for (const local_id e : star_) {
      const auto& local = numbering::sides<3>[static_cast<std::size_t>(mesh.corner_of(e, v))];
      // (v, s0, s1, s2) is positive: the normal of a side points away from the vertex opposite it.
      batch_.add(mesh.point(mesh.vertex(e, local[0])), mesh.point(mesh.vertex(e, local[1])),
                 mesh.point(mesh.vertex(e, local[2])));
    }
    batch_.finish();
    triple<float> p{0, 0, 0};
    if (!(search_.climb(batch_, p, limits) > old_worst + 1e-4F))
      return false;
    const vec3 place = batch_.to_global(p);
    return keeps_lengths(mesh, v, place, band) && move(mesh, v, place, old_point, old_worst);
  }

private:
  static local_id other_vertex(const tet_complex& mesh, local_id e, local_id v) {
    return mesh.vertex(e, 0) == v ? mesh.vertex(e, 1) : mesh.vertex(e, 0);
  }

  bool keeps_lengths(const tet_complex& mesh, local_id v, vec3 place, const size_band& band) const {
    edge_lengths before, after;
    for (const local_id e : star_)
      for (const local_id other : mesh.vertices(e))
        if (other != v) {
          before.add(mesh.point(v), mesh.point(other));
          after.add(place, mesh.point(other));
        }
    return band.admits(mesh, before, after, mesh.vertices(star_[0]), place);
  }

  /// Verifies the new position in double precision and keeps it only if it is better.
  bool move(tet_complex& mesh, local_id v, vec3 to, vec3 from, float old_worst) {
    mesh.set_point(v, to);
    for (int i = 0; i < star_.size; ++i) {
      const auto& n = mesh.vertices(star_[i]);
      new_values_[i] = static_cast<float>(
          measure_of<Measure>(mesh.point(n[0]), mesh.point(n[1]), mesh.point(n[2]), mesh.point(n[3])));
      if (!(new_values_[i] > old_worst) ||
          ((new_values_[i] > 0 || !mesh.is_tangled()) &&
           !(orient3d(mesh.point(n[0]), mesh.point(n[1]), mesh.point(n[2]), mesh.point(n[3])) > 0))) {
        mesh.set_point(v, from);
        return false;
      }
    }
    mesh.start_change();
    for (int i = 0; i < star_.size; ++i) {
      mesh.set_value(star_[i], new_values_[i]);
      for (const local_id other : mesh.vertices(star_[i]))
        mesh.touch(other);
    }
    return true;
  }

  bounded_list<local_id, max_star> star_;
  bounded_list<float, max_star> new_values_;
  star_batch<Measure> batch_;
  apex_search<Measure> search_;
};

} // namespace dovetail::improvement
