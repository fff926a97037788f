/// @file
/// What other numbers of segments would make of an interface face and the faces beside it: meshes of them, as
/// few as the angles at the corners allow.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/coarse_skeleton.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/remesh/concepts.hpp"
#include "dovetail/remesh/triangle_surface.hpp"
#include "dovetail/skeleton/line_segments.hpp"
#include "dovetail/skeleton/matched_skeleton.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// Trials during which the lines stay as they are.
template <geometry_model Geometry, surface_mesher Mesher>
class segment_trials {
public:
  segment_trials(const Geometry& model, const matched_skeleton& skeleton, const Mesher& mesher)
      : model_(model), skeleton_(skeleton), mesher_(mesher) {}

  /// What becomes of the lines of a face: the change that lifts its angle the most, less what the faces
  /// beside it lose; the cheapest of several. Nothing when no change gains.
  face_segments mend(local_id f) {
    const double before = deficit(f, {});
    face_segments best{};
    double most = least_gain;
    if (before <= most)
      return best;
    int left = most_trials;
    for (const auto& [penalty, other] : changes_of(f, before)) {
      if (before - least_deficit(f, other) <= most)
        continue;
      if (left-- == 0)
        break;
      const double gain = before - deficit(f, other);
      if (gain <= most)
        continue;
      const double loss = loss_beside(f, other, gain - most);
      if (gain - loss <= most)
        continue;
      most = gain - loss;
      best = other;
      if (most >= before) // the face is mended, and no other one spoilt
        break;
    }
    return best;
  }

private:
  static constexpr double least_gain = 1e-9;
  /// Meshes of a face; each has some more of the faces beside it where it gains.
  static constexpr int most_trials = 96;
  /// Bounds of the length of a segment beside the sizes.
  static constexpr double shortest = 0.45, longest = 1.8;

  struct change {
    double penalty = 0; ///< how far lengths come away from the sizes; more for lines on the surface
    face_segments lines{};
  };
  /// What one line may become.
  struct choice {
    double penalty = 0;
    line_segments segments{};
  };

  /// The changes of a face that may gain, the cheapest first.
  std::vector<change> changes_of(local_id f, double before) {
    const std::array<local_id, 3> sides = skeleton_.sides(f);
    const auto is_straight = [&](local_id line) { return skeleton_.line(line).on.dimension == 3; };
    if (std::all_of(sides.begin(), sides.end(), is_straight) && // its corners stay as they are
        before - (skeleton_.threshold() - smallest_corner_angle(skeleton_.corners(f))) <= least_gain)
      return {};
    std::array<std::vector<choice>, 3> choices;
    for (std::size_t i = 0; i < 3; ++i)
      choices[i] = choices_of(sides[i]);
    // Per corner, of the choices of the side behind it and the one before.
    std::array<std::vector<double>, 3> limits;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t i = (corner + 1) % 3, j = (corner + 2) % 3;
      for (const choice& a : choices[i])
        for (const choice& b : choices[j]) {
          face_segments segments{};
          segments[i] = a.segments;
          segments[j] = b.segments;
          limits[corner].push_back(corner_limit(f, segments, corner));
        }
    }
    const auto limit = [&](std::size_t corner, const std::array<std::size_t, 3>& chosen) {
      const std::size_t i = (corner + 1) % 3, j = (corner + 2) % 3;
      return limits[corner][chosen[i] * choices[j].size() + chosen[j]];
    };
    std::vector<change> all;
    std::array<std::size_t, 3> c{};
    for (c[0] = 0; c[0] < choices[0].size(); ++c[0])
      for (c[1] = 0; c[1] < choices[1].size(); ++c[1])
        for (c[2] = 0; c[2] < choices[2].size(); ++c[2])
          if (c[0] + c[1] + c[2] > 0 &&
              before - (skeleton_.threshold() - std::min({limit(0, c), limit(1, c), limit(2, c)})) >
                  least_gain) {
            all.emplace_back();
            for (std::size_t i = 0; i < 3; ++i) {
              all.back().penalty += choices[i][c[i]].penalty;
              all.back().lines[i] = choices[i][c[i]].segments;
            }
          }
    sort_all(all, [](const change& a, const change& b) {
      return std::tie(a.penalty, a.lines) < std::tie(b.penalty, b.lines);
    });
    return all;
  }

  /// The first is to leave it.
  std::vector<choice> choices_of(local_id l) {
    const skeleton_line& line = skeleton_.line(l);
    const double wanted = wanted_segments(l);
    const int now = static_cast<int>(skeleton_.points_of(l).size()) + 1;
    constexpr int most_more_or_fewer = 2;
    constexpr double of_uneven_ones = 0.4; // longer or shorter than others at one end by so much
    constexpr double penalty_of_change = 0.2;
    std::vector<choice> choices{{}};
    for (int n = std::max(1, now - most_more_or_fewer); n <= now + most_more_or_fewer; ++n)
      for (const double bias : {0.0, -of_uneven_ones, of_uneven_ones}) {
        const double length = wanted / n, uneven = std::abs(bias) * (1 - 1.0 / n);
        if ((n == now && bias == line.bias) || (n == 1 && bias != 0) || length * (1 - uneven) < shortest ||
            length * (1 + uneven) > longest)
          continue;
        choices.push_back(
            {penalty_of_change + std::abs(std::log(length)) + std::abs(bias) + (3 - line.on.dimension),
             {n, bias}});
      }
    return choices;
  }

  double wanted_segments(local_id l) const {
    const skeleton_line& line = skeleton_.line(l);
    const any_sizing size = skeleton_.size_near(l);
    vec3 before = skeleton_.point(line.vertices[0]);
    double sum = 0;
    const auto pass = [&](vec3 p) {
      sum += distance(before, p) / size(midpoint(before, p));
      before = p;
    };
    for (const vec3& p : skeleton_.points_of(l))
      pass(p);
    pass(skeleton_.point(line.vertices[1]));
    return sum;
  }

  const std::vector<vec3>& points_of(local_id l, line_segments wanted) {
    if (wanted.count == 0)
      return skeleton_.points_of(l);
    const auto [found, is_new] = tried_.try_emplace({l, wanted});
    if (is_new)
      found->second = skeleton_.with_segments(model_, l, wanted).fine.points;
    return found->second;
  }

  /// By how much the other faces at changed lines come under the threshold, less what they gain; gives up
  /// when that is more than `bound`.
  double loss_beside(local_id f, const face_segments& changed, double bound) {
    const std::array<local_id, 3> sides = skeleton_.sides(f);
    double loss = 0;
    for (std::size_t i = 0; i < 3; ++i)
      if (changed[i].count != 0)
        for (const local_id other : skeleton_.faces_at(sides[i]))
          if (other != f && loss < bound) {
            face_segments beside{};
            const std::array<local_id, 3> its = skeleton_.sides(other);
            for (std::size_t k = 0; k < 3; ++k)
              for (std::size_t j = 0; j < 3; ++j)
                if (its[k] == sides[j])
                  beside[k] = changed[j];
            const double now = deficit(other, {});
            const double least = least_deficit(other, beside);
            loss += (loss + least - now < bound ? deficit(other, beside) : least) - now;
          }
    return loss;
  }

  /// The largest that the smallest angle at a corner can be when some lines are changed: its first segments
  /// and the edge between their ends make a triangle, or something halves it.
  double corner_limit(local_id f, const face_segments& changed, std::size_t corner) {
    const local_id vertex = skeleton_.key(f)[corner];
    const std::array<local_id, 3> sides = skeleton_.sides(f);
    const vec3 p = skeleton_.point(vertex);
    const auto beside = [&](std::size_t i) {
      const auto& ends = skeleton_.line(sides[i]).vertices;
      const std::vector<vec3>& inner = points_of(sides[i], changed[i]);
      const bool forwards = ends[0] == vertex;
      return inner.empty() ? skeleton_.point(ends[forwards ? 1 : 0])
             : forwards    ? inner.front()
                           : inner.back();
    };
    const vec3 a = beside((corner + 1) % 3), b = beside((corner + 2) % 3);
    double halved = 0.5 * angle_between(a - p, b - p);
    constexpr double stands_out_deg = 15; // at most, a triangle of the curved face beside its corners' plane
    if (std::any_of(sides.begin(), sides.end(),
                    [&](local_id line) { return skeleton_.line(line).on.dimension < 3; }))
      halved = std::acos(std::cos(halved) * std::cos(stands_out_deg / degrees_per_radian));
    return std::max(degrees_per_radian * halved, smallest_corner_angle({p, a, b})) + rounding;
  }
  static constexpr double rounding = 1e-9;

  /// What `deficit` is at least, by the corners alone.
  double least_deficit(local_id f, const face_segments& changed) {
    return std::max(0.0, skeleton_.threshold() -
                             std::min({corner_limit(f, changed, 0), corner_limit(f, changed, 1),
                                       corner_limit(f, changed, 2)}));
  }

  /// By how much the smallest angle of a face is under the threshold when some lines are changed.
  double deficit(local_id f, const face_segments& changed) {
    const auto [found, is_new] = deficits_.try_emplace({f, changed});
    if (is_new)
      found->second = skeleton_.threshold() - std::min(skeleton_.threshold(), least_angle(f, changed));
    return found->second;
  }

  double least_angle(local_id f, const face_segments& changed) {
    const simplex<2> key = skeleton_.key(f);
    const std::array<local_id, 3> sides = skeleton_.sides(f);
    std::array<std::vector<vec3>, 3> points;
    std::array<std::vector<local_id>, 3> labels;
    local_id label = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& ends = skeleton_.line(sides[i]).vertices;
      points[i].push_back(skeleton_.point(ends[0]));
      append(points[i], points_of(sides[i], changed[i]));
      points[i].push_back(skeleton_.point(ends[1]));
      if (ends[0] != key[(i + 1) % 3])
        std::reverse(points[i].begin(), points[i].end());
      for (std::size_t j = 0; j < points[i].size(); ++j)
        labels[i].push_back(label++);
    }
    const remesh::triangle_surface surface(skeleton_.corners(f), points);
    const patch_boundary boundary = remesh::triangle_boundary(surface, points, labels);
    const patch_mesh made =
        mesher_(any_surface::holding(surface), boundary, skeleton_.size().near(skeleton_.place(f)));
    if (!made.ok())
      return 0;
    const auto frozen = static_cast<local_id>(boundary.points.size());
    const auto place = [&](local_id v) {
      return v < frozen ? boundary.points[v] : made.inner_points[v - frozen];
    };
    double least = 180;
    for (const simplex<2>& t : made.triangles)
      least = std::min(least, smallest_corner_angle({place(t[0]), place(t[1]), place(t[2])}));
    return least;
  }

  const Geometry& model_;
  const matched_skeleton& skeleton_;
  const Mesher& mesher_;
  std::map<std::pair<local_id, line_segments>, std::vector<vec3>> tried_;
  std::map<std::pair<local_id, face_segments>, double> deficits_;
};

} // namespace dovetail::detail
