/// @file
/// Edges of a face that lie on each other and are not the same, such as those of a hole that reaches the
/// outer boundary: between them the face has no width.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/models/occt/brep.hpp"

#include <BndLib_Add3dCurve.hxx>
#include <Bnd_Box.hxx>
#include <Extrema_ExtPC.hxx>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace dovetail::occt {

/// Searches the faces of a model for edges that lie on each other within a length.
class overlap_search {
public:
  overlap_search(const brep& data, double within) : data_(data), within_(within), boxes_(data.curves.size()) {
    for (std::size_t c = 0; c < boxes_.size(); ++c)
      if (!data.topology.curves[c].degenerate)
        boxes_[c] = box_of(c);
  }

  /// The first face with such edges.
  std::optional<local_id> first_face() const {
    for (std::size_t f = 0; f < data_.faces.size(); ++f)
      if (has_overlapping_edges(f))
        return static_cast<local_id>(f);
    return std::nullopt;
  }

private:
  /// A point of one edge that lies on another one.
  struct touch {
    vec3 at;
    bool is_shared; ///< it is a vertex of both
  };

  box3 box_of(std::size_t c) const {
    const auto& t = data_.topology.curves[c].t;
    Bnd_Box box;
    BndLib_Add3dCurve::Add(data_.curves[c], t[0], t[1], within_, box);
    return {to_vec3(box.CornerMin().XYZ()), to_vec3(box.CornerMax().XYZ())};
  }

  bool has_overlapping_edges(std::size_t f) const {
    std::vector<local_id> curves;
    for (const auto& coedge : data_.topology.faces[f].coedges)
      if (!data_.topology.curves[coedge.curve].degenerate)
        curves.push_back(coedge.curve);
    sort_unique(curves);
    std::vector<box3> boxes;
    for (const local_id c : curves)
      boxes.push_back(boxes_[c]);
    const box_tree tree(boxes);
    bool found = false;
    for (std::size_t i = 0; i < curves.size() && !found; ++i)
      tree.for_each([&](const box3& box, std::size_t) { return !found && distance(box, boxes[i]) == 0; },
                    [&](local_id k) {
                      if (const auto j = static_cast<std::size_t>(k); i < j && !found)
                        found = lie_on_each_other(curves[i], curves[j]);
                    });
    return found;
  }

  /// Whether they do so over more than a point: two ends that they share are no such thing.
  bool lie_on_each_other(local_id a, local_id b) const {
    if (distance(boxes_[a], boxes_[b]) > 0)
      return false;
    std::vector<touch> touches = touches_of(a, b);
    append(touches, touches_of(b, a));
    constexpr double apart = 100; // tolerances: else it is one point
    return std::any_of(touches.begin(), touches.end(), [&](const touch& one) {
      return !one.is_shared && std::any_of(touches.begin(), touches.end(), [&](const touch& other) {
        return distance(one.at, other.at) > apart * within_;
      });
    });
  }

  /// Of the ends and three points between them.
  std::vector<touch> touches_of(local_id c, local_id other) const {
    constexpr int parts = 4;
    const auto& curve = data_.topology.curves[c];
    const auto& ends = data_.topology.curves[other].vertices;
    std::vector<touch> touches;
    for (int i = 0; i <= parts; ++i) {
      const vec3 p = point(c, curve.t[0] + (curve.t[1] - curve.t[0]) * i / parts);
      const bool is_shared =
          i % parts == 0 && std::count(ends.begin(), ends.end(), curve.vertices[i / parts]);
      if (is_shared || (contains(boxes_[other], p) && distance_to(other, p) <= within_))
        touches.push_back({p, is_shared});
    }
    return touches;
  }

  vec3 point(local_id c, double t) const { return to_vec3(data_.curves[c].Value(t)); }

  double distance_to(local_id c, vec3 p) const {
    const auto& t = data_.topology.curves[c].t;
    double least = std::min(distance(point(c, t[0]), p), distance(point(c, t[1]), p));
    const Extrema_ExtPC extrema(gp_Pnt(p.x, p.y, p.z), data_.curves[c], t[0], t[1]);
    for (int i = 1; extrema.IsDone() && i <= extrema.NbExt(); ++i)
      least = std::min(least, std::sqrt(extrema.SquareDistance(i)));
    return least;
  }

  const brep& data_;
  double within_;
  std::vector<box3> boxes_;
};

/// The first face that has two edges which lie on each other, without being one, over more than a point.
/// About n log n in the edges of each face.
/// \param data a model without faults
/// \param within a length: up to which edges lie on each other
inline std::optional<local_id> face_with_overlapping_edges(const brep& data, double within) {
  return overlap_search(data, within).first_face();
}

} // namespace dovetail::occt
