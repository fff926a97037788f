/// @file
/// Numbers of segments that suit each other. Lines of nearly the same length whose numbers of segments come
/// out differently by rounding leave an interface face with a small angle at a corner that no triangulation
/// of the face can mend; other numbers of segments for its lines can.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/coarse_skeleton.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/parallel/kept.hpp"
#include "dovetail/parallel/task_model.hpp"
#include "dovetail/skeleton/fine_lines.hpp"
#include "dovetail/skeleton/line_segments.hpp"
#include "dovetail/skeleton/matched_skeleton.hpp"
#include "dovetail/skeleton/patches.hpp"
#include "dovetail/skeleton/remesh_skeleton.hpp"
#include "dovetail/skeleton/segment_trials.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// Mends faces as if one by one, in their order; those side by side that are apart.
template <geometry_model Geometry, surface_mesher Mesher, executor Executor>
class segment_matcher {
public:
  segment_matcher(const Geometry& model, std::span<const vec3> coarse_points, coarse_skeleton& coarse,
                  remeshed_lines lines, const refined_sizing& size, double threshold, const Mesher& mesher,
                  const Executor& run, matched_faces& made, const progress& on_progress)
      : model_(model), coarse_points_(coarse_points), coarse_(coarse), lines_(std::move(lines.lines)),
        size_(size), threshold_(threshold), mesher_(mesher), run_(run), made_(made),
        on_progress_(on_progress), lines_of_face_(lines_of_faces(coarse)),
        faces_of_line_(faces_of_lines(lines_of_face_, coarse.lines.size())),
        fine_of_line_(std::move(lines.names)) {
    if (fine_of_line_.empty())
      for (const skeleton_line& line : coarse.lines)
        fine_of_line_.push_back(kept_line(line, coarse_points, size));
  }

  /// Faces around what changed are tried in the next sweep, as they may be worse or easier to mend now.
  void run(std::vector<local_id> wanted) {
    for (int sweep = 0; sweep < sweeps && !wanted.empty(); ++sweep) {
      touched_.clear();
      const matched_skeleton skeleton = as_it_is();
      const matching_passes order(skeleton, wanted);
      for (const std::vector<faces_in_turn>& pass : order.passes())
        mend(pass);
      wanted.swap(touched_);
      sort_unique(wanted);
    }
  }

private:
  static constexpr int sweeps = 3;
  static constexpr double triangles_per_task = 512; // each meshed some hundred times

  matched_skeleton as_it_is() const {
    return {coarse_points_, coarse_, lines_, size_, threshold_, lines_of_face_, faces_of_line_};
  }

  /// The segments for faces, which are a function of these and of all that lies beside them.
  kept<std::vector<face_segments>> kept_segments(const matched_skeleton& skeleton,
                                                 const faces_in_turn& faces) const {
    std::vector<std::array<vec3, 3>> corners;
    std::vector<kept<fine_line>> lines;
    std::vector<std::vector<size_ball>> sizes;
    const auto add = [&](local_id other) {
      corners.push_back(skeleton.corners(other));
      for (const local_id line : skeleton.sides(other))
        lines.push_back(fine_of_line_[line]);
      sizes.push_back(size_.balls_near(skeleton.place(other)));
    };
    for (const local_id f : faces) {
      add(f);
      skeleton.for_each_beside(f, add);
    }
    return kept<std::vector<face_segments>>::of(threshold_, corners, lines, sizes);
  }

  static double triangles_in(const matched_skeleton& skeleton, const faces_in_turn& faces) {
    double sum = 0;
    for (const local_id f : faces) {
      double segments = 3;
      for (const local_id line : skeleton.sides(f))
        segments += static_cast<double>(skeleton.points_of(line).size());
      sum += triangles_within(segments);
    }
    return sum;
  }

  void mend(const std::vector<faces_in_turn>& pass) {
    const matched_skeleton skeleton = as_it_is();
    std::vector<kept<std::vector<face_segments>>> wanted;
    std::vector<double> costs;
    for (const faces_in_turn& faces : pass) {
      wanted.push_back(kept_segments(skeleton, faces));
      costs.push_back(triangles_in(skeleton, faces));
    }
    const auto failures = made_.make_missing(
        wanted, costs, triangles_per_task,
        [&](const std::vector<std::size_t>& missing) {
          const task_model own(model_, run_);
          std::vector<std::vector<face_segments>> chosen;
          for (const std::size_t i : missing)
            chosen.push_back(segments_for(pass[i], own.get(), skeleton));
          return chosen;
        },
        run_, run_options{.on_progress = on_progress_, .stage = "matching"});
    if (!failures.empty())
      throw mesher_error("trials of other segments for the lines of an interface face failed: " +
                         failures.front().reason);
    made_.for_each(wanted, [&](std::size_t i, const std::vector<face_segments>& chosen) {
      for (std::size_t k = 0; k < chosen.size(); ++k)
        accept(pass[i][k], chosen[k]);
    });
  }

  std::vector<face_segments> segments_for(const faces_in_turn& faces, const Geometry& model,
                                          matched_skeleton skeleton) const {
    std::vector<face_segments> chosen;
    std::optional<segment_trials<Geometry, Mesher>> trials;
    for (const local_id f : faces) {
      if (!trials)
        trials.emplace(model, skeleton, mesher_);
      chosen.push_back(trials->mend(f));
      if (chosen.back() == face_segments{})
        continue;
      trials.reset(); // what it knows holds for the lines as they were
      skeleton.change(model, f, chosen.back());
    }
    return chosen;
  }

  void accept(local_id f, const face_segments& chosen) {
    const auto& sides = lines_of_face_[f];
    for (std::size_t i = 0; i < 3; ++i)
      if (chosen[i].count != 0) {
        const local_id l = sides[i];
        auto changed = as_it_is().with_segments(model_, l, chosen[i]);
        coarse_.lines[l] = changed.line;
        lines_[l] = std::move(changed.fine);
        fine_of_line_[l] = kept_line(changed.line, coarse_points_, size_);
        append(touched_, std::as_const(faces_of_line_)[l]);
      }
  }

  const Geometry& model_;
  std::span<const vec3> coarse_points_;
  coarse_skeleton& coarse_;
  std::vector<fine_line> lines_;
  const refined_sizing& size_;
  double threshold_;
  const Mesher& mesher_;
  const Executor& run_;
  matched_faces& made_;
  const progress& on_progress_;
  std::vector<std::array<local_id, 3>> lines_of_face_;
  compressed_rows<local_id> faces_of_line_;
  std::vector<kept<fine_line>> fine_of_line_;
  std::vector<local_id> touched_; ///< faces at lines that a sweep changed
};

} // namespace detail

/// Gives lines other numbers of segments, or uneven ones (`skeleton_line::segments`, `bias`), where that
/// lifts the smallest angle of an interface face towards `threshold_deg` and costs the faces beside it less.
/// `faces`, growing, are those with smaller angles on the present `lines` (`faces_with_small_angles`). They
/// are tried with `mesher`, in their order, and side by side through `run` where they are apart: the
/// result is a function of the skeleton, the model, the sizes and the mesher. `made` carries what was found
/// for faces from one call to the next. Names of lines, where there are any, are of the present ones. Returns
/// the number of lines with such segments. Costs up to some hundred meshes of each face with a smaller angle,
/// fewer where its corners tell that they cannot help. Throws `mesher_error` when a trial cannot be
/// evaluated.
template <geometry_model Geometry, surface_mesher Mesher, executor Executor>
std::size_t match_segments(const Geometry& model, std::span<const vec3> coarse_points,
                           coarse_skeleton& skeleton, remeshed_lines lines, std::vector<local_id> faces,
                           const refined_sizing& size, double threshold_deg, const Mesher& mesher,
                           const Executor& run, matched_faces& made, const progress& on_progress = {}) {
  if (faces.empty())
    return 0;
  detail::segment_matcher(model, coarse_points, skeleton, std::move(lines), size, threshold_deg, mesher, run,
                          made, on_progress)
      .run(std::move(faces));
  return static_cast<std::size_t>(
      std::count_if(skeleton.lines.begin(), skeleton.lines.end(),
                    [](const skeleton_line& line) { return line.segments != 0; }));
}

/// Gives the lines of patches that failed the segments that the sizes ask for; where none of these has
/// others, the lines nearest to them, from line to line. Returns how many had. Linear for each step.
/// \param failures what came of patches on matched lines
/// \param surface the coarse surface that regions are of
/// \param skeleton whose lines change
inline std::size_t unmatch_segments(std::span<const patch_failure> failures, const surface_mesh& surface,
                                    coarse_skeleton& skeleton) {
  std::set<local_id> points; // of what failed
  const auto take = [&](const auto& vertices) { points.insert(vertices.begin(), vertices.end()); };
  for (const patch_failure& failure : failures) {
    if (failure.face != no_id)
      take(skeleton.faces[failure.face].vertices);
    if (failure.region != no_id)
      for (const local_id t : skeleton.regions[failure.region].triangles)
        take(surface.mesh.elements[t]);
  }
  for (;;) {
    std::size_t changed = 0;
    for (skeleton_line& line : skeleton.lines)
      if (line.segments != 0 && points.contains(line.vertices[0]) && points.contains(line.vertices[1])) {
        line.segments = 0;
        line.bias = 0;
        ++changed;
      }
    std::set<local_id> more;
    for (const skeleton_line& line : skeleton.lines)
      for (const std::size_t k : {0U, 1U})
        if (points.contains(line.vertices[k]) && !points.contains(line.vertices[1 - k]))
          more.insert(line.vertices[1 - k]);
    if (changed > 0 || more.empty())
      return changed;
    points.merge(more);
  }
}

} // namespace dovetail
