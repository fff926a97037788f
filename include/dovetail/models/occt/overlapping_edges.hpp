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
#include <cmath>
#include <cstddef>
#include <vector>

namespace dovetail::occt {

/// Searches the faces of a model for edges that lie on each other within a length.
class overlap_search {
public:
  overlap_search(const brep& data, double within)
      : data_(data), within_(within), boxes_(data.curves.size()), parts_(data.curves.size()) {
    for (std::size_t c = 0; c < boxes_.size(); ++c)
      if (!data.topology.curves[c].degenerate)
        boxes_[c] = box_of(c, data.topology.curves[c].t);
  }

  /// The faces with such edges.
  std::vector<local_id> faces() {
    std::vector<local_id> found;
    for (std::size_t f = 0; f < data_.faces.size(); ++f)
      if (has_overlapping_edges(f))
        found.push_back(static_cast<local_id>(f));
    return found;
  }

private:
  /// What of one edge lies on another one.
  struct touches {
    std::vector<vec3> points; ///< ends, and places between them
    bool at_end = false;      ///< an end does that is none of the other's
    bool all_along = true;    ///< the places between its ends do
  };
  /// A part of a curve.
  struct part {
    std::array<double, 2> t;
    box3 box;
  };

  box3 box_of(std::size_t c, const std::array<double, 2>& t) const {
    Bnd_Box box;
    BndLib_Add3dCurve::Add(data_.curves[c], t[0], t[1], within_, box);
    return {to_vec3(box.CornerMin().XYZ()), to_vec3(box.CornerMax().XYZ())};
  }

  bool has_overlapping_edges(std::size_t f) {
    const std::vector<local_id> curves = edges_of_face(data_, f);
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

  /// Whether they do so over more than a point. Two ends that they share are no such thing, nor is a place
  /// beside one where they are tangent.
  bool lie_on_each_other(local_id a, local_id b) {
    if (distance(boxes_[a], boxes_[b]) > 0)
      return false;
    const touches of_a = touches_of(a, b), of_b = touches_of(b, a);
    if (of_a.all_along || of_b.all_along)
      return true;
    std::vector<vec3> points = of_a.points;
    append(points, of_b.points);
    constexpr double apart = 100; // tolerances: else it is one point
    return (of_a.at_end || of_b.at_end) && std::any_of(points.begin(), points.end(), [&](vec3 p) {
             return distance(points.front(), p) > apart * within_;
           });
  }

  touches touches_of(local_id c, local_id other) {
    constexpr int parts = 4;
    const auto& curve = data_.topology.curves[c];
    const auto& ends = data_.topology.curves[other].vertices;
    touches found;
    for (int i = 0; i <= parts; ++i) {
      const vec3 p = point(c, curve.t[0] + (curve.t[1] - curve.t[0]) * i / parts);
      const bool is_end = i % parts == 0;
      const bool is_shared = is_end && std::count(ends.begin(), ends.end(), curve.vertices[i / parts]) > 0;
      const bool is_touch = is_shared || lies_on(other, p);
      if (is_touch)
        found.points.push_back(p);
      found.at_end = found.at_end || (is_end && is_touch && !is_shared);
      found.all_along = found.all_along && (is_end || is_touch);
    }
    return found;
  }

  vec3 point(local_id c, double t) const { return to_vec3(data_.curves[c].Value(t)); }

  bool lies_on(local_id c, vec3 p) {
    if (!contains(boxes_[c], p))
      return false;
    const auto& parts = parts_of(c);
    return std::any_of(parts.begin(), parts.end(), [&](const part& one) {
      return contains(one.box, p) && distance_to(c, one.t, p) <= within_;
    });
  }

  /// Made when they are asked for: most curves are near no others but at their ends.
  const std::vector<part>& parts_of(local_id c) {
    constexpr int count = 32;
    std::vector<part>& parts = parts_[c];
    const auto& t = data_.topology.curves[c].t;
    if (parts.empty() && data_.curves[c].GetType() == GeomAbs_Line)
      parts.push_back({t, boxes_[c]});
    for (int i = 0; parts.size() < count && data_.curves[c].GetType() != GeomAbs_Line; ++i) {
      const std::array range{t[0] + (t[1] - t[0]) * i / count, t[0] + (t[1] - t[0]) * (i + 1) / count};
      parts.push_back({range, box_of(c, range)});
    }
    return parts;
  }

  double distance_to(local_id c, const std::array<double, 2>& t, vec3 p) const {
    double least = std::min(distance(point(c, t[0]), p), distance(point(c, t[1]), p));
    const Extrema_ExtPC extrema(gp_Pnt(p.x, p.y, p.z), data_.curves[c], t[0], t[1]);
    for (int i = 1; extrema.IsDone() && i <= extrema.NbExt(); ++i)
      least = std::min(least, std::sqrt(extrema.SquareDistance(i)));
    return least;
  }

  const brep& data_;
  double within_;
  std::vector<box3> boxes_;              ///< by curve
  std::vector<std::vector<part>> parts_; ///< by curve
};

/// The faces that have two edges which lie on each other, without being one, over more than a point. About
/// n log n in the edges of each face, as long as their boxes do not overlap.
/// \param data a model without faults
/// \param within a length: up to which edges lie on each other
inline std::vector<local_id> faces_with_overlapping_edges(const brep& data, double within) {
  return overlap_search(data, within).faces();
}

} // namespace dovetail::occt
