/// @file
/// Sizes from how near faces are to each other: so many elements across a wall or a gap.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/sizing/curvature.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail {

/// How the distance between faces gives sizes.
struct proximity_options {
  double elements = 2;         ///< edges across
  bool inside = true;          ///< through the solids: thin walls
  bool outside = false;        ///< through what is around them: gaps
  model_size_range range = {}; ///< no size is outside of it
};

namespace sizing {

/// Finds, for a sample, the nearest sample that faces it on one side.
class facing_search {
public:
  explicit facing_search(std::vector<surface_sample> samples)
      : samples_(std::move(samples)),
        tree_(boxes_of_points(samples_, [](const surface_sample& s) { return s.point; }), leaf_size) {
    tree_.put_in_order(samples_);
  }

  const std::vector<surface_sample>& samples() const { return samples_; } ///< the samples that it searches

  /// The sample of least height above the plane through `from` with unit normal `direction`, of at most
  /// `reach`, that looks back; `slack` is the distance between samples. Null when there is none.
  const surface_sample* find(const surface_sample& from, vec3 direction, double reach, double slack) const;

private:
  struct query {
    const surface_sample& from;
    vec3 direction;
    double height; ///< of the best so far
    double slack;
    const surface_sample* best;
  };
  static constexpr std::size_t leaf_size = 8;
  static constexpr double looks_back =
      -0.8; ///< largest cosine between the two normals; across an edge they differ by less
  static constexpr double aside = 0.5; ///< largest offset along the plane per height

  /// Whether a box may hold a point above the plane, low enough and not too far aside.
  static bool may_hold(const box3& box, const query& q);

  static void consider(const surface_sample& s, query& q);

  std::vector<surface_sample> samples_;
  box_tree tree_;
};

/// The distance from a sample to the face that another one is on, near that one.
template <geometry_model G>
double gap_to_face(const G& model, const surface_sample& from, const surface_sample& facing) {
  const vec2 foot = model.project_to_face(facing.face, from.point, facing.uv);
  const double exact = distance(model.face_point(facing.face, foot), from.point);
  const double rough = distance(facing.point, from.point);
  return exact > 0 ? std::min(exact, rough) : rough;
}

/// Sizes of gap / elements at samples that are `spacing(sample)` apart.
template <geometry_model G, class Spacing>
std::vector<sized_point> gaps_at_samples(const G& model, const proximity_options& options,
                                         const model_size_range& range, const Spacing& spacing) {
  const double reach = options.elements * range.largest;
  const facing_search search(sample_surface(model, spacing, {.per_face = 20000}));
  std::vector<sized_point> points;
  for (const surface_sample& s : search.samples()) {
    const auto& solids = model.topology().faces[s.face].solids;
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
      if (!(solids[side] == no_id ? options.outside : options.inside))
        continue;
      const vec3 direction = side == 0 ? -s.normal : s.normal;
      const surface_sample* facing = search.find(s, direction, reach, s.spacing);
      if (!facing)
        continue;
      const double size = std::max(range.smallest, gap_to_face(model, s, *facing) / options.elements);
      if (size < range.largest)
        points.push_back({s.point, size});
    }
  }
  return points;
}

/// Sizes of gap / elements on both faces of every wall or gap that asks for less than the largest size. What
/// one pass finds tells the next how near samples have to be: the last are at most two sizes apart.
template <geometry_model G>
std::vector<sized_point> proximity_points(const G& model, const proximity_options& options,
                                          const model_size_range& range) {
  checked_size(options.elements, "the number of elements across");
  constexpr int passes = 3;
  constexpr double sizes_apart = 2;
  const auto even = [&](const surface_sample&) { return range.largest; };
  auto points = gaps_at_samples(model, options, range, even);
  for (int pass = 1; pass < passes && !points.empty(); ++pass) {
    const point_sizes found(std::move(points), range.growth, range.largest);
    const auto by_size = [&](const surface_sample& s) {
      return std::min(range.largest, sizes_apart * found(s.point));
    };
    points = gaps_at_samples(model, options, range, by_size);
  }
  return points;
}

} // namespace sizing

/// The field that puts `elements` edges across walls and gaps thinner than `elements` x `range.largest`.
/// Faces are sampled `range.largest` apart; distances are then taken to the face itself. Where two faces meet
/// at a sharp angle the gap vanishes, and `range.smallest` is the size along the edge. Throws `sizing_error`
/// for options out of range.
/// About n log n in the samples.
/// \param model the model whose faces are sampled
/// \param options elements per gap, and the range of sizes
template <geometry_model G>
point_sizes proximity_size(const G& model, const proximity_options& options = {}) {
  const model_size_range range = sizing::range_for(model.bounds(), options.range);
  return {sizing::proximity_points(model, options, range), range.growth, range.largest};
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/sizing/proximity.ipp"
#endif
