/// @file
/// What `segment_matching.hpp` declares.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/remesh/patch_remesher.hpp"
#include "dovetail/skeleton/patches.hpp"
#include "dovetail/skeleton/segment_matching.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace dovetail {

namespace detail {

class segment_matcher {
public:
  segment_matcher(const any_geometry& model, std::span<const vec3> coarse_points, coarse_skeleton& skeleton,
                  std::vector<fine_line> lines, const refined_sizing& size, double threshold_deg)
      : model_(model), coarse_points_(coarse_points), skeleton_(skeleton), lines_(std::move(lines)),
        size_(size), everywhere_(size.everywhere()), threshold_(threshold_deg),
        deficits_(skeleton.faces.size(), unknown),
        faces_of_line_(sorted_into_rows<local_id>(skeleton.lines.size(), [&](const auto& put) {
          for (std::size_t f = 0; f < skeleton.faces.size(); ++f)
            for (const local_id line : lines_of(skeleton.faces[f], skeleton.lines))
              put(line, static_cast<local_id>(f));
        })) {}

  /// Faces around what changed are tried in the next sweep, as they may be worse or easier to mend now.
  void run(std::vector<local_id> wanted) {
    for (int sweep = 0; sweep < sweeps && !wanted.empty(); ++sweep) {
      touched_.clear();
      for (const local_id f : wanted)
        if (deficit_of(f) > 0)
          mend(f);
      wanted.swap(touched_);
      sort_unique(wanted);
    }
  }

private:
  static constexpr double unknown = -1;
  static constexpr int sweeps = 3;
  /// Bounds of the length of a segment beside the sizes.
  static constexpr double shortest = 0.45, longest = 1.8;

  /// Other segments for a line; none leave it as it is.
  struct spacing {
    int segments = 0;
    double bias = 0;

    friend auto operator<=>(const spacing&, const spacing&) = default;
  };
  /// Other segments for the lines of a face.
  struct change {
    double price = 0; ///< how far lengths come away from the sizes; more for lines on the surface
    std::array<spacing, 3> lines{};
  };
  using changed_lines = std::array<const fine_line*, 3>;

  static std::size_t at(local_id i) { return static_cast<std::size_t>(i); }
  vec3 point(local_id v) const { return coarse_points_[at(v)]; }

  void mend(local_id f) {
    const std::array<local_id, 3> sides = lines_of(skeleton_.faces[at(f)], skeleton_.lines);
    const double before = deficit_of(f);
    change best;
    double most = 1e-9;
    for (const change& other : changes_of(sides)) {
      const changed_lines changed = lines_with(sides, other);
      const double gain = before - deficit(f, sides, changed);
      if (gain <= most)
        continue;
      const double loss = loss_beside(f, sides, changed, gain - most);
      if (gain - loss <= most)
        continue;
      most = gain - loss;
      best = other;
      if (most >= before) // the face is mended, and no other one spoilt
        break;
    }
    if (best.price > 0)
      accept(sides, best);
  }

  /// All changes of a face, the cheapest first.
  std::vector<change> changes_of(const std::array<local_id, 3>& sides) const {
    std::vector<change> all{{}};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t so_far = all.size();
      const double wanted = wanted_segments(sides[i]);
      const skeleton_line& line = skeleton_.lines[at(sides[i])];
      const int now = segments_of(lines_[at(sides[i])]);
      for (int n = std::max(1, now - 2); n <= now + 2; ++n)
        for (const double bias : {0.0, -0.4, 0.4}) {
          const double length = wanted / n, uneven = std::abs(bias) * (1 - 1.0 / n);
          if ((n == now && bias == line.bias) || (n == 1 && bias != 0) || length * (1 - uneven) < shortest ||
              length * (1 + uneven) > longest)
            continue;
          for (std::size_t k = 0; k < so_far; ++k) {
            all.push_back(all[k]);
            all.back().price += 0.2 + std::abs(std::log(length)) + std::abs(bias) + (3 - line.on.dimension);
            all.back().lines[i] = {n, bias};
          }
        }
    }
    all.erase(all.begin());
    sort_all(all, [](const change& a, const change& b) {
      return std::tie(a.price, a.lines) < std::tie(b.price, b.lines);
    });
    return all;
  }

  static int segments_of(const fine_line& line) { return static_cast<int>(line.points.size()) + 1; }

  any_sizing size_of(const skeleton_line& line) const { return size_.near(place_of(line, coarse_points_)); }

  double wanted_segments(local_id line) const {
    const skeleton_line& key = skeleton_.lines[at(line)];
    const any_sizing size = size_of(key);
    vec3 before = point(key.vertices[0]);
    double sum = 0;
    const auto pass = [&](vec3 p) {
      sum += distance(before, p) / size(midpoint(before, p));
      before = p;
    };
    for (const vec3& p : lines_[at(line)].points)
      pass(p);
    pass(point(key.vertices[1]));
    return sum;
  }

  changed_lines lines_with(const std::array<local_id, 3>& sides, const change& wanted) {
    changed_lines changed{};
    for (std::size_t i = 0; i < 3; ++i)
      if (wanted.lines[i].segments != 0)
        changed[i] = &line_with(sides[i], wanted.lines[i]);
    return changed;
  }

  const fine_line& line_with(local_id line, spacing wanted) {
    const auto [found, is_new] = tried_.try_emplace({line, wanted});
    if (is_new) {
      skeleton_line key = skeleton_.lines[at(line)];
      key.segments = wanted.segments;
      key.bias = wanted.bias;
      found->second = remesh_line(model_, key, coarse_points_, size_of(key));
    }
    return found->second;
  }

  /// By how much the other faces at changed lines come under the threshold, less what they gain; gives up
  /// when that is more than `bound`.
  double loss_beside(local_id f, const std::array<local_id, 3>& sides, const changed_lines& changed,
                     double bound) {
    double loss = 0;
    for (std::size_t i = 0; i < 3; ++i)
      if (changed[i] != nullptr)
        for (const local_id other : faces_of_line_[at(sides[i])])
          if (other != f && loss < bound)
            loss += deficit(other, sides, changed) - deficit_of(other);
    return loss;
  }

  void accept(const std::array<local_id, 3>& sides, const change& chosen) {
    for (std::size_t i = 0; i < 3; ++i)
      if (const spacing& wanted = chosen.lines[i]; wanted.segments != 0) {
        skeleton_.lines[at(sides[i])].segments = wanted.segments;
        skeleton_.lines[at(sides[i])].bias = wanted.bias;
        lines_[at(sides[i])] = line_with(sides[i], wanted);
        for (const local_id f : faces_of_line_[at(sides[i])])
          deficits_[at(f)] = unknown;
        append(touched_, faces_of_line_[at(sides[i])]);
      }
  }

  double deficit_of(local_id f) {
    double& known = deficits_[at(f)];
    if (known == unknown)
      known = deficit(f, {no_id, no_id, no_id}, {});
    return known;
  }

  /// By how much the smallest angle of a face is under the threshold when some lines are changed.
  double deficit(local_id f, const std::array<local_id, 3>& sides, const changed_lines& changed) const {
    const skeleton_face& face = skeleton_.faces[at(f)];
    const simplex<2> key = key_order(face);
    const std::array<local_id, 3> lines = lines_of(face, skeleton_.lines);
    std::array<vec3, 3> corners;
    std::array<std::vector<vec3>, 3> points;
    std::array<std::vector<local_id>, 3> labels;
    local_id label = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = point(key[i]);
      const fine_line* line = &lines_[at(lines[i])];
      for (std::size_t j = 0; j < 3; ++j)
        if (sides[j] == lines[i] && changed[j] != nullptr)
          line = changed[j];
      const skeleton_line& ends = skeleton_.lines[at(lines[i])];
      points[i].push_back(point(ends.vertices[0]));
      append(points[i], line->points);
      points[i].push_back(point(ends.vertices[1]));
      if (ends.vertices[0] != key[(i + 1) % 3])
        std::reverse(points[i].begin(), points[i].end());
      for (std::size_t j = 0; j < points[i].size(); ++j)
        labels[i].push_back(label++);
    }
    const remesh::triangle_surface surface(corners, points);
    const patch_boundary boundary = remesh::triangle_boundary(surface, points, labels);
    const patch_mesh made = remesh::patch_remesher{}(surface, boundary, everywhere_);
    if (!made.ok())
      return threshold_;
    const auto frozen = static_cast<local_id>(boundary.points.size());
    const auto place = [&](local_id v) {
      return v < frozen ? boundary.points[at(v)] : made.inner_points[at(v - frozen)];
    };
    double least = threshold_;
    for (const simplex<2>& t : made.triangles)
      least = std::min(least, smallest_corner_angle({place(t[0]), place(t[1]), place(t[2])}));
    return threshold_ - least;
  }

  const any_geometry& model_;
  std::span<const vec3> coarse_points_;
  coarse_skeleton& skeleton_;
  std::vector<fine_line> lines_;
  const refined_sizing& size_;
  any_sizing everywhere_; ///< for trials
  double threshold_;
  std::vector<double> deficits_; ///< per face, as its lines are
  compressed_rows<local_id> faces_of_line_;
  std::map<std::pair<local_id, spacing>, fine_line> tried_;
  std::vector<local_id> touched_; ///< faces at lines that a sweep changed
};

inline std::vector<local_id> faces_with_small_angles(const coarse_skeleton& skeleton,
                                                     const remeshed_skeleton& made, double threshold_deg) {
  std::vector<local_id> faces;
  for (std::size_t f = 0; f < skeleton.faces.size(); ++f) {
    const auto first =
        made.patches.first_triangle.begin() + static_cast<std::ptrdiff_t>(skeleton.regions.size() + f);
    if (std::any_of(made.fine.sides.begin() + first[0], made.fine.sides.begin() + first[1],
                    [&](const simplex<2>& t) {
                      return smallest_corner_angle(corners(span_of(made.fine.points), t)) < threshold_deg;
                    }))
      faces.push_back(static_cast<local_id>(f));
  }
  return faces;
}

} // namespace detail

DOVETAIL_INLINE std::size_t match_segments(const any_geometry& model, std::span<const vec3> coarse_points,
                                           coarse_skeleton& skeleton, const numbered_lines& lines,
                                           const remeshed_skeleton& made, const refined_sizing& size,
                                           double threshold_deg) {
  if (!made.patches.failures.empty())
    return 0;
  const auto faces = detail::faces_with_small_angles(skeleton, made, threshold_deg);
  if (!faces.empty())
    detail::segment_matcher(model, coarse_points, skeleton, lines.lines, size, threshold_deg).run(faces);
  return static_cast<std::size_t>(
      std::count_if(skeleton.lines.begin(), skeleton.lines.end(),
                    [](const skeleton_line& line) { return line.segments != 0; }));
}

} // namespace dovetail
