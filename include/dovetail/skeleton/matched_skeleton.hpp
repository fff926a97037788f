/// @file
/// A skeleton whose lines get other numbers of segments, and which of its faces have to wait for each other.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/graph/disjoint_sets.hpp"
#include "dovetail/mesh/coarse_skeleton.hpp"
#include "dovetail/sizing/refined_sizing.hpp"
#include "dovetail/skeleton/fine_lines.hpp"
#include "dovetail/skeleton/line_segments.hpp"
#include "dovetail/skeleton/patches.hpp"
#include "dovetail/skeleton/remesh_lines.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <unordered_map>
#include <vector>

namespace dovetail::detail {

/// Looks at lines as they are but for those that it has changed itself, so that each task has its own.
class matched_skeleton {
public:
  matched_skeleton(std::span<const vec3> coarse_points, const coarse_skeleton& coarse,
                   std::span<const fine_line> lines, const refined_sizing& size, double threshold,
                   std::span<const std::array<local_id, 3>> lines_of_face,
                   const compressed_rows<local_id>& faces_of_line)
      : coarse_points_(coarse_points), coarse_(coarse), lines_(lines), size_(size), threshold_(threshold),
        lines_of_face_(lines_of_face), faces_of_line_(faces_of_line) {}

  double threshold() const { return threshold_; }
  const refined_sizing& size() const { return size_; }
  vec3 point(local_id v) const { return coarse_points_[v]; }

  const skeleton_line& line(local_id l) const {
    const auto found = changed_.find(l);
    return found == changed_.end() ? coarse_.lines[l] : found->second.line;
  }
  const std::vector<vec3>& points_of(local_id l) const {
    const auto found = changed_.find(l);
    return found == changed_.end() ? lines_[l].points : found->second.fine.points;
  }
  any_sizing size_near(local_id l) const { return size_.near(place_of(line(l), coarse_points_)); }

  simplex<2> key(local_id face) const { return key_order(coarse_.faces[face]); }
  const std::array<local_id, 3>& sides(local_id face) const { return lines_of_face_[face]; }
  std::array<vec3, 3> corners(local_id face) const {
    const simplex<2> vertices = key(face);
    return {point(vertices[0]), point(vertices[1]), point(vertices[2])};
  }
  box3 place(local_id face) const { return roomy_box_around(corners(face)); }
  std::span<const local_id> faces_at(local_id l) const { return faces_of_line_[l]; }
  /// Calls `visit(other)` for the faces at the lines of a face; itself is one of them, for each line.
  template <class Visit>
  void for_each_beside(local_id face, const Visit& visit) const {
    for (const local_id side : sides(face))
      for (const local_id other : faces_at(side))
        visit(other);
  }

  /// What a line is with other segments.
  struct changed_line {
    skeleton_line line;
    fine_line fine;
  };
  template <geometry_model Geometry>
  changed_line with_segments(const Geometry& model, local_id l, line_segments wanted) const {
    skeleton_line changed = line(l);
    changed.segments = wanted.count;
    changed.bias = wanted.bias;
    return {changed, remesh_line(model, changed, coarse_points_, size_near(l))};
  }
  /// Gives the lines of a face the segments that were chosen for it.
  template <geometry_model Geometry>
  void change(const Geometry& model, local_id face, const face_segments& chosen) {
    const auto& its = sides(face);
    for (std::size_t i = 0; i < 3; ++i)
      if (chosen[i].count != 0)
        changed_[its[i]] = with_segments(model, its[i], chosen[i]);
  }

private:
  std::span<const vec3> coarse_points_;
  const coarse_skeleton& coarse_;
  std::span<const fine_line> lines_;
  const refined_sizing& size_;
  double threshold_;
  std::span<const std::array<local_id, 3>> lines_of_face_;
  const compressed_rows<local_id>& faces_of_line_;
  std::map<local_id, changed_line> changed_;
};

/// Faces of which each one is mended on what the ones before it have left.
using faces_in_turn = std::vector<local_id>;

/// Faces that have to be mended in their order, in passes one after the other, so that what comes out is what
/// it were if they were mended one by one: all that is in a pass at once is apart from the rest of it. A face
/// changes its own lines, and looks at those of the faces beside it. Costs faces times passes, of which there
/// are few unless many wait for each other in a row.
class matching_passes {
public:
  matching_passes(const matched_skeleton& skeleton, std::vector<local_id> faces) : skeleton_(skeleton) {
    while (!faces.empty())
      faces = left_by_pass(faces);
  }

  const std::vector<std::vector<faces_in_turn>>& passes() const { return passes_; }

private:
  /// More faces that wait for each other in one place are left to later passes.
  static constexpr double most_in_turn = 32;

  /// Makes a pass of those of these faces that need not wait for another pass; returns those that are left.
  /// Of two that look at what the other one changes, both are in turn, or the later one is left, or both are.
  std::vector<local_id> left_by_pass(const std::vector<local_id>& faces) {
    std::unordered_map<local_id, local_id> changed_by; // per line: a face in the pass, or no_id for one left
    disjoint_sets together(faces.size());
    std::vector<local_id> left, taken; // places in `faces`
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const auto place = static_cast<local_id>(i);
      const std::set<local_id> before = groups_before(faces[i], changed_by, together);
      const auto weight = [&](double sum, local_id group) { return sum + together.weight(group); };
      const bool is_left =
          before.contains(no_id) || std::accumulate(before.begin(), before.end(), 1.0, weight) > most_in_turn;
      (is_left ? left : taken).push_back(place);
      for (const local_id line : skeleton_.sides(faces[i]))
        changed_by[line] = is_left ? no_id : place;
      if (!is_left)
        for (const local_id group : before)
          together.unite(group, place);
    }
    passes_.push_back(groups_of(faces, taken, together));
    for (local_id& place : left)
      place = faces[place];
    return left;
  }

  /// The groups in which faces before this one change what it looks at; no_id for those that are left.
  std::set<local_id> groups_before(local_id face, const std::unordered_map<local_id, local_id>& changed_by,
                                   disjoint_sets& together) const {
    std::set<local_id> groups;
    skeleton_.for_each_beside(face, [&](local_id other) {
      for (const local_id line : skeleton_.sides(other))
        if (const auto found = changed_by.find(line); found != changed_by.end())
          groups.insert(found->second == no_id ? no_id : together.find(found->second));
    });
    return groups;
  }

  static std::vector<faces_in_turn> groups_of(const std::vector<local_id>& faces,
                                              const std::vector<local_id>& taken, disjoint_sets& together) {
    std::vector<faces_in_turn> groups;
    std::unordered_map<local_id, std::size_t> number; // of a group, by its root
    for (const local_id place : taken) {
      const auto [group, is_new] = number.try_emplace(together.find(place), groups.size());
      if (is_new)
        groups.emplace_back();
      groups[group->second].push_back(faces[place]);
    }
    return groups;
  }

  const matched_skeleton& skeleton_;
  std::vector<std::vector<faces_in_turn>> passes_;
};

} // namespace dovetail::detail
