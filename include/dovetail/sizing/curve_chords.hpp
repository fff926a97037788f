/// @file
/// The curves of a model as straight pieces, and the faces beside them.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/sizing/checked_size.hpp"
#include "dovetail/sizing/erased.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail::sizing {

/// A part of a curve as a straight line.
struct curve_chord {
  std::array<vec3, 2> ends; ///< in the curve's direction
  double middle = 0;        ///< parameter of the curve

  double length() const { return distance(ends[0], ends[1]); } ///< in the model's unit
};

/// A chord as a face passes it.
struct passed_chord {
  const curve_chord* line; ///< the chord
  local_id curve;          ///< that it is of
  int coedge;              ///< of the face
};

/// The chords that a face passes, which can be searched.
struct face_chords {
  std::vector<passed_chord> passed; ///< coedge by coedge
  box_tree tree;                    ///< of their boxes

  explicit face_chords(std::vector<passed_chord> chords) : passed(std::move(chords)), tree(boxes()) {}

private:
  std::vector<box3> boxes() const {
    std::vector<box3> boxes(passed.size());
    for (std::size_t k = 0; k < passed.size(); ++k)
      for (const vec3 end : passed[k].line->ends)
        boxes[k].include(end);
    return boxes;
  }
};

/// The chords of all curves of a model: half as long as the size in the middle of the curve, but for a least
/// and a largest number of them.
template <geometry_model G>
class curve_chords {
public:
  /// Both must outlive the object. Linear in the chords. Throws `sizing_error` for sizes that are none.
  curve_chords(const G& model, const any_sizing& size)
      : model_(model), chords_(model.topology().curves.size()) {
    for (std::size_t c = 0; c < chords_.size(); ++c)
      if (!model.topology().curves[c].degenerate)
        chords_[c] = chords_of(static_cast<local_id>(c), size);
  }

  const std::vector<curve_chord>& of(local_id curve) const { return chords_[curve]; } ///< of degenerate: none

  /// Those that a face passes.
  face_chords passed_by(local_id face) const {
    std::vector<passed_chord> passed;
    const auto& coedges = model_.topology().faces[face].coedges;
    for (std::size_t k = 0; k < coedges.size(); ++k)
      for (const curve_chord& one : chords_[coedges[k].curve])
        passed.push_back({&one, coedges[k].curve, static_cast<int>(k)});
    return face_chords(std::move(passed));
  }

  /// From a passage of a face, square to it into the face; of unit length.
  vec3 into_face(local_id face, const passed_chord& along) const {
    const vec2 uv = model_.curve_uv(face, along.coedge, along.line->middle);
    const surface_frame frame = model_.face_frame(face, uv);
    const vec3 run = along.line->ends[1] - along.line->ends[0];
    const vec3 inward = normalized(cross(cross(frame.du, frame.dv), run));
    return model_.topology().faces[face].coedges[along.coedge].reversed ? -inward : inward;
  }

  /// The parameter of the nearest place to `p` of the curve that a chord is of, near that chord.
  double foot_parameter(const passed_chord& near, vec3 p) const {
    const auto& range = model_.topology().curves[near.curve].t;
    return std::clamp(model_.project_to_curve(near.curve, p, near.line->middle), range[0], range[1]);
  }
  /// That place.
  vec3 foot_on(const passed_chord& near, vec3 p) const {
    return model_.curve_point(near.curve, foot_parameter(near, p));
  }

private:
  std::vector<curve_chord> chords_of(local_id c, const any_sizing& size) const {
    constexpr int fewest = 8, most = 1024;
    const auto& range = model_.topology().curves[c].t;
    const auto parameter = [&](double share) { return range[0] + share * (range[1] - range[0]); };
    const auto point = [&](double share) { return model_.curve_point(c, parameter(share)); };
    double rough = 0;
    for (int k = 0; k < fewest; ++k)
      rough += distance(point(1.0 * k / fewest), point((k + 1.0) / fewest));
    const double wanted = std::ceil(2 * rough / checked_size(size, point(0.5)));
    const int count = wanted < most ? std::max(fewest, static_cast<int>(wanted)) : most;
    std::vector<curve_chord> chords;
    vec3 from = point(0);
    for (int k = 1; k <= count; ++k) {
      const vec3 to = point(1.0 * k / count);
      chords.push_back({{from, to}, parameter((k - 0.5) / count)});
      from = to;
    }
    return chords;
  }

  const G& model_;
  std::vector<std::vector<curve_chord>> chords_; ///< by curve
};

/// The nearest place of a chord to a point.
inline vec3 foot_on(const curve_chord& line, vec3 p) {
  const auto [a, b] = nearest_on_segment(line.ends[0], line.ends[1], p);
  return a * line.ends[0] + b * line.ends[1];
}

} // namespace dovetail::sizing
