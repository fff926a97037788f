/// @file
/// Sizes from how near faces are to each other: so many elements across a wall or a gap.
#pragma once

#include "dovetail/sizing/curvature.hpp"
#include "dovetail/sizing/facing_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// How the distance between faces gives sizes.
struct proximity_options {
  double elements = 2;         ///< edges across
  double least_in_walls = 0;   ///< down to there sizes of thin walls may be below the smallest; 0: none is
  bool inside = true;          ///< through the solids: thin walls
  bool outside = false;        ///< through what is around them: gaps
  model_size_range range = {}; ///< no size is outside of it, but for thin walls
};

namespace sizing {

/// Which faces have a curve in common: the gap between such vanishes there, and no size resolves it.
class meeting_faces {
public:
  explicit meeting_faces(const geometry_topology& topology);

  /// Whether two faces have one, or are the same.
  bool operator()(local_id a, local_id b) const;

private:
  std::vector<std::vector<local_id>> curves_; ///< of each face, in order
};

/// Thickness over size of a thin wall in which nearly all elements have dihedral angles of 24 degrees or
/// more, though all their vertices are on its surface (docs/sizing.md).
inline constexpr double thin_wall = 0.5;

/// The size where a gap is so wide: gap / elements, within the range. In a wall that is thin for the smallest
/// size it is gap / `thin_wall`, or what is asked for if that is larger; where even that is below the least
/// one the wall is given up, since trying would only give it more of the same.
/// \param gap a length: the width of a gap, or the thickness of a wall
/// \param is_wall whether it is solid, and its two faces do not meet
/// \param options elements across, and the least size in walls
/// \param range of sizes, without zeros
inline double size_across(double gap, bool is_wall, const proximity_options& options,
                          const model_size_range& range) {
  const double needed = gap / std::min(thin_wall, options.elements);
  if (is_wall && options.least_in_walls > 0 && needed >= options.least_in_walls && needed < range.smallest)
    return needed;
  return std::max(range.smallest, gap / options.elements);
}

/// The distance from a sample to the face that another one is on, near that one.
template <geometry_model G>
double gap_to_face(const G& model, const surface_sample& from, const surface_sample& facing) {
  const vec2 foot = model.project_to_face(facing.face, from.point, facing.uv);
  const double exact = distance(model.face_point(facing.face, foot), from.point);
  const double rough = distance(facing.point, from.point);
  return exact > 0 ? std::min(exact, rough) : rough;
}

/// A size at a gap, and how much of its face's area it stands for.
struct gap_point : sized_point {
  double area = 0; ///< of one of the two faces
};

/// Sizes of gap / elements at samples.
template <geometry_model G>
std::vector<gap_point> gaps_at(std::span<const surface_sample> samples, const G& model,
                               const proximity_options& options, const model_size_range& range,
                               const facing_search& search, const meeting_faces& meet) {
  const double reach = options.elements * range.largest;
  std::vector<gap_point> points;
  for (const surface_sample& s : samples) {
    const auto& solids = model.topology().faces[s.face].solids;
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
      if (!(solids[side] == no_id ? options.outside : options.inside))
        continue;
      // Where a limit ended the sampling, neighbours are farther apart than was asked for.
      const double slack = std::max(s.spacing, std::sqrt(std::max(0.0, s.area)));
      const surface_sample* facing = search.find(s, side, reach, slack);
      if (!facing)
        continue;
      const double gap = gap_to_face(model, s, *facing);
      const bool is_wall = gap < range.smallest && solids[side] != no_id && !meet(s.face, facing->face);
      const double size = size_across(gap, is_wall, options, range);
      if (size < range.largest)
        points.push_back({{s.point, size}, s.area});
    }
  }
  return points;
}

/// How a loop over many samples is carried out: `loop(model, count, work)` returns what `work(model, begin,
/// end)` does for all from 0 to `count`. Others may divide it, with a model for each range, and join the
/// vectors in order.
struct undivided_loop {
  /// All at once.
  template <geometry_model G, class Work>
  auto operator()(const G& model, std::size_t count, const Work& work) const {
    return work(model, std::size_t{0}, count);
  }
};

/// Sizes of gap / elements at samples that are `spacing(sample)` apart.
/// \param loop carries out the loop over the samples
template <geometry_model G, class Spacing, class Loop>
std::vector<gap_point> gaps_at_samples(const G& model, const proximity_options& options,
                                       const model_size_range& range, const Spacing& spacing,
                                       const Loop& loop) {
  const facing_search search(sample_surface(model, spacing, {.per_face = 20000}), model.topology());
  const meeting_faces meet(model.topology());
  return loop(model, search.samples().size(), [&](const G& own, std::size_t begin, std::size_t end) {
    return gaps_at(std::span(search.samples()).subspan(begin, end - begin), own, options, range, search,
                   meet);
  });
}

/// Sizes of gap / elements on both faces of every wall or gap that asks for less than the largest size. What
/// one pass finds tells the next how near samples have to be: the last are at most two sizes apart.
/// \param loop carries out the loops over samples
template <geometry_model G, class Loop = undivided_loop>
std::vector<gap_point> proximity_points(const G& model, const proximity_options& options,
                                        const model_size_range& range, const Loop& loop = {}) {
  checked_size(options.elements, "the number of elements across");
  checked_length(options.least_in_walls, "the least size in walls");
  constexpr int passes = 3;
  constexpr double sizes_apart = 2;
  const auto even = [&](const surface_sample&) { return range.largest; };
  auto points = gaps_at_samples(model, options, range, even, loop);
  for (int pass = 1; pass < passes && !points.empty(); ++pass) {
    const point_sizes found({points.begin(), points.end()}, range.growth, range.largest);
    const auto by_size = [&](const surface_sample& s) {
      return std::min(range.largest, sizes_apart * found(s.point));
    };
    points = gaps_at_samples(model, options, range, by_size, loop);
  }
  return points;
}

} // namespace sizing

/// The field that puts `elements` edges across walls and gaps thinner than `elements` x `range.largest`.
/// Faces are sampled `range.largest` apart; distances are then taken to the face itself. Where two faces meet
/// at a sharp angle the gap vanishes, and `range.smallest` is the size along the edge. So it is in a thin
/// wall, of less than half of that, unless `least_in_walls` allows sizes of twice its thickness. Throws
/// `sizing_error` for options out of range.
/// About n log n in the samples.
/// \param model the model whose faces are sampled
/// \param options elements per gap, and the range of sizes
template <geometry_model G>
point_sizes proximity_size(const G& model, const proximity_options& options = {}) {
  const model_size_range range = sizing::range_for(model.bounds(), options.range);
  const auto points = sizing::proximity_points(model, options, range);
  return {{points.begin(), points.end()}, range.growth, range.largest};
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/sizing/proximity.ipp"
#endif
