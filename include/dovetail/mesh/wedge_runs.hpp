/// @file
/// The side-dual graph under node deletion: runs of wedges between consecutive remaining sides of a ridge.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/quality.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace dovetail {

/// Around each ridge the remaining sides cut the elements into runs of wedges; a run's angle is the sum of
/// its wedge angles. At first every wedge is a run of its own; removing a side joins the runs beside it.
///
/// A wedge is numbered element x wedges per element + local ridge. Only the two end wedges of a run are
/// addressed (they may be the same one): each knows the other end and the run's angle, so a removal takes
/// constant time and no ridge table is needed. A run around a whole ridge without any side is gone.
template <int D>
class wedge_runs {
public:
  static constexpr std::size_t per_element = numbering::ridges<D>.size();
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  wedge_runs(const simplicial_mesh<D>& mesh, const side_table<D>& sides)
      : mesh_(&mesh), sides_(&sides), other_end_(mesh.elements.size() * per_element),
        angle_(other_end_.size()), removed_(sides.size(), 0) {
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      const auto angles = wedge_angles(corners(span_of(mesh.points), mesh.elements[e]));
      for (std::size_t r = 0; r < per_element; ++r) {
        const std::size_t w = e * per_element + r;
        other_end_[w] = static_cast<std::uint32_t>(w);
        angle_[w] = angles[r];
      }
    }
  }

  std::size_t wedge_count() const { return angle_.size(); }
  /// Is the wedge at an end of a run?
  bool is_end(std::uint32_t wedge) const { return other_end_[wedge] != none; }
  /// The wedge that stands for its run: the end with the smaller number.
  bool is_name(std::uint32_t wedge) const { return is_end(wedge) && wedge <= other_end_[wedge]; }
  /// Angle in degrees of the run with an end at `wedge`.
  double angle(std::uint32_t wedge) const { return angle_[wedge]; }
  bool is_removed(local_id side) const { return removed_[static_cast<std::size_t>(side)] != 0; }

  /// The two remaining sides that bound the run with an end at `wedge`; the same one twice when it is the
  /// last of its ridge.
  std::array<local_id, 2> bounding_sides(std::uint32_t wedge) const {
    const std::uint32_t other = other_end_[wedge];
    const auto [a, b] = sides_of(wedge);
    if (other == wedge)
      return {a, b};
    const auto [c, d] = sides_of(other);
    return {is_removed(a) ? b : a, is_removed(c) ? d : c};
  }

  /// Removes an interior side from all its ridges and calls `on_run(name)` for every run that grew.
  template <class OnRun>
  void remove(local_id side, const OnRun& on_run) {
    const auto [e0, e1] = sides_->elements[static_cast<std::size_t>(side)];
    removed_[static_cast<std::size_t>(side)] = 1;
    const auto local = local_side(e0, side);
    for (std::size_t r = 0; r < per_element; ++r) {
      const auto& ends = numbering::sides_of_ridge<D>[r];
      if (ends[0] == local || ends[1] == local)
        join(wedge_number(e0, r), wedge_number(e1, same_ridge(e0, r, e1)), on_run);
    }
  }

private:
  static std::uint32_t wedge_number(local_id element, std::size_t ridge) {
    return static_cast<std::uint32_t>(static_cast<std::size_t>(element) * per_element + ridge);
  }
  std::array<local_id, 2> sides_of(std::uint32_t wedge) const {
    const auto& of_element = sides_->of_element[wedge / per_element];
    const auto& local = numbering::sides_of_ridge<D>[wedge % per_element];
    return {of_element[static_cast<std::size_t>(local[0])], of_element[static_cast<std::size_t>(local[1])]};
  }
  int local_side(local_id element, local_id side) const {
    const auto& of_element = sides_->of_element[static_cast<std::size_t>(element)];
    return static_cast<int>(std::find(of_element.begin(), of_element.end(), side) - of_element.begin());
  }
  /// The local ridge of element `to` with the vertices of local ridge r of element `from`.
  std::size_t same_ridge(local_id from, std::size_t r, local_id to) const {
    const auto& here = mesh_->elements[static_cast<std::size_t>(from)];
    const auto& there = mesh_->elements[static_cast<std::size_t>(to)];
    const auto key = sorted_vertices(detail::pick(here, numbering::ridges<D>[r]));
    std::size_t match = 0;
    while (sorted_vertices(detail::pick(there, numbering::ridges<D>[match])) != key)
      ++match;
    return match;
  }

  template <class OnRun>
  void join(std::uint32_t a, std::uint32_t b, const OnRun& on_run) {
    const std::uint32_t far_a = other_end_[a];
    const std::uint32_t far_b = other_end_[b];
    other_end_[a] = none;
    other_end_[b] = none;
    if (far_a == b) // the last side of the ridge went
      return;
    const double total = angle_[a] + angle_[b];
    other_end_[far_a] = far_b;
    other_end_[far_b] = far_a;
    angle_[far_a] = total;
    angle_[far_b] = total;
    on_run(std::min(far_a, far_b));
  }

  const simplicial_mesh<D>* mesh_;
  const side_table<D>* sides_;
  std::vector<std::uint32_t> other_end_; ///< per wedge: the other end of its run; `none` inside a run
  std::vector<double> angle_;            ///< per wedge at an end: the angle of its run
  std::vector<std::uint8_t> removed_;    ///< per side
};

} // namespace dovetail
