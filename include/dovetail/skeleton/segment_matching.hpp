/// @file
/// Numbers of segments that suit each other. Lines of nearly the same length whose numbers of segments come
/// out differently by rounding leave an interface face with a small angle at a corner that no triangulation
/// of the face can mend; other numbers of segments for its lines can.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/coarse_skeleton.hpp"
#include "dovetail/parallel/task_model.hpp"
#include "dovetail/skeleton/fine_lines.hpp"
#include "dovetail/skeleton/line_segments.hpp"
#include "dovetail/skeleton/patches.hpp"
#include "dovetail/skeleton/remesh_skeleton.hpp"
#include "dovetail/skeleton/segment_trials.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// Mends the faces in an order, those side by side whose trials and changes have no line in common.
template <surface_mesher Mesher>
class segment_matcher {
public:
  segment_matcher(const any_geometry& model, matched_skeleton skeleton, const Mesher& mesher,
                  const any_executor& run, batched_entities<face_segments>& made, const progress& on_progress)
      : model_(model), skeleton_(std::move(skeleton)), mesher_(mesher), run_(run), made_(made),
        on_progress_(on_progress) {
    for (const skeleton_line& line : skeleton_.coarse.lines)
      line_keys_.push_back(dovetail::key_of(line, skeleton_.coarse_points, skeleton_.size));
  }

  /// Faces around what changed are tried in the next sweep, as they may be worse or easier to mend now.
  void run(std::vector<local_id> wanted) {
    for (int sweep = 0; sweep < sweeps && !wanted.empty(); ++sweep) {
      touched_.clear();
      for (const std::vector<local_id>& level : levels_of(wanted))
        mend(level);
      wanted.swap(touched_);
      sort_unique(wanted);
    }
  }

private:
  static constexpr int sweeps = 3;
  static constexpr double faces_per_task = 16;

  /// A face comes behind all before it that change what it looks at, or look at what it changes.
  std::vector<std::vector<local_id>> levels_of(const std::vector<local_id>& faces) const {
    std::vector<std::vector<local_id>> levels;
    std::map<local_id, std::size_t> changed, seen; // per line: the first level that is free of it
    for (const local_id f : faces) {
      std::size_t level = 0;
      const auto lines = skeleton_.sides(f);
      skeleton_.for_each_beside(f, [&](local_id other) {
        for (const local_id line : skeleton_.sides(other))
          level = std::max(level, changed[line]);
      });
      for (const local_id line : lines)
        level = std::max(level, seen[line]);
      levels.resize(std::max(levels.size(), level + 1));
      levels[level].push_back(f);
      skeleton_.for_each_beside(f, [&](local_id other) {
        for (const local_id line : skeleton_.sides(other))
          seen[line] = std::max(seen[line], level + 1);
      });
      for (const local_id line : lines)
        changed[line] = level + 1;
    }
    return levels;
  }

  /// All that the trials of a face are a function of but the model, the plain sizes and the mesher.
  content_key key_of(local_id f) const {
    key_maker make;
    make(skeleton_.threshold);
    const auto add = [&](local_id other) {
      for (const vec3& p : skeleton_.corners(other))
        make(p.x)(p.y)(p.z);
      for (const local_id line : skeleton_.sides(other))
        make(static_cast<std::int64_t>(line_keys_[line].value));
      make(static_cast<std::int64_t>(skeleton_.size.key_near(skeleton_.place(other)).value));
    };
    add(f);
    skeleton_.for_each_beside(f, add);
    return make.key();
  }

  void mend(const std::vector<local_id>& faces) {
    std::vector<content_key> keys;
    for (const local_id f : faces)
      keys.push_back(key_of(f));
    const auto failures = made_.make_missing(
        keys, std::vector<double>(faces.size(), 1), faces_per_task,
        [&](const std::vector<std::size_t>& wanted) {
          const task_model own(model_, run_);
          segment_trials trials(own.get(), skeleton_, mesher_);
          std::vector<face_segments> chosen;
          for (const std::size_t i : wanted)
            chosen.push_back(trials.mend(faces[i]));
          return chosen;
        },
        run_, run_options{.on_progress = on_progress_, .stage = "matching"});
    if (!failures.empty())
      throw mesher_error("trials of other segments for the lines of an interface face failed: " +
                         failures.front().reason);
    made_.for_each(keys, [&](std::size_t i, const face_segments& chosen) { accept(faces[i], chosen); });
  }

  void accept(local_id f, const face_segments& chosen) {
    const std::array<local_id, 3> sides = skeleton_.sides(f);
    for (std::size_t i = 0; i < 3; ++i)
      if (chosen[i].count != 0) {
        skeleton_line& line = skeleton_.coarse.lines[sides[i]];
        line.segments = chosen[i].count;
        line.bias = chosen[i].bias;
        skeleton_.lines[sides[i]] =
            remesh_line(model_, line, skeleton_.coarse_points, skeleton_.size_near(sides[i]));
        line_keys_[sides[i]] = dovetail::key_of(line, skeleton_.coarse_points, skeleton_.size);
        append(touched_, skeleton_.faces_of_line[sides[i]]);
      }
  }

  const any_geometry& model_;
  matched_skeleton skeleton_;
  const Mesher& mesher_;
  const any_executor& run_;
  batched_entities<face_segments>& made_;
  const progress& on_progress_;
  std::vector<content_key> line_keys_;
  std::vector<local_id> touched_; ///< faces at lines that a sweep changed
};

} // namespace detail

/// Gives lines other numbers of segments, or uneven ones (`skeleton_line::segments`, `bias`), where that
/// lifts the smallest angle of an interface face towards `threshold_deg` and costs the faces beside it less.
/// `faces` are those with smaller angles on the present `lines` (`faces_with_small_angles`). They are tried
/// with `mesher`, in their order, and side by side through `run` where they do not touch: the
/// result is a function of the skeleton, the model, the sizes and the mesher. `made` carries what was found
/// for a face from one call to the next. Returns the number of lines with such segments. Costs up to some
/// hundred meshes of each face with a smaller angle, fewer where its corners tell that they cannot help.
/// Throws `mesher_error` when a trial cannot be evaluated.
template <surface_mesher Mesher>
std::size_t match_segments(const any_geometry& model, std::span<const vec3> coarse_points,
                           coarse_skeleton& skeleton, std::vector<fine_line> lines,
                           std::vector<local_id> faces, const refined_sizing& size, double threshold_deg,
                           const Mesher& mesher, const any_executor& run,
                           batched_entities<face_segments>& made, const progress& on_progress = {}) {
  if (faces.empty())
    return 0;
  detail::segment_matcher(
      model, {coarse_points, skeleton, std::move(lines), size, threshold_deg, faces_of_lines(skeleton)},
      mesher, run, made, on_progress)
      .run(std::move(faces));
  return static_cast<std::size_t>(
      std::count_if(skeleton.lines.begin(), skeleton.lines.end(),
                    [](const skeleton_line& line) { return line.segments != 0; }));
}

} // namespace dovetail
