/// @file
/// Sizes that fit the details of a model that are much smaller than the size, and stay all the same.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/sizing/checked_size.hpp"
#include "dovetail/sizing/compose.hpp"
#include "dovetail/sizing/erased.hpp"
#include "dovetail/sizing/point_sizes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace dovetail {

/// Which details sizes are to fit, and how far that goes.
struct kept_detail_options {
  double share_of_size = 0.25;   ///< up to this share of the size there a length is a detail's; at most 1
  double touching_share = 0.001; ///< vertices nearer to a curve than this share of the size are on it
  double least_size = 0;         ///< no size becomes smaller, nor than `touching_share` of what it was
  double growth = 0.4;           ///< of the size per length away from details
  double most_elements = 2e5;    ///< details that need more, about, stay as they are, the costly ones first
  int dimension = 3;             ///< of the elements
};

namespace sizing {

/// About how many elements a size that grows from a place on a surface makes more than the one that it grows
/// to: the integral of the inverse cube over half a ball, or of the inverse square over a disk, of which a
/// plane domain has only half. O(1), throws nothing.
/// \param from the size at the place
/// \param to the size that it grows to; larger
/// \param growth of the size per length
/// \param dimension of the elements, 3 or 2
inline double elements_of_growth(double from, double to, double growth, int dimension = 3) {
  const double share = from / to, reached = 1 - share;
  if (dimension == 2) {
    constexpr double per_square = 4 / std::numbers::sqrt3; // of regular triangles
    const double inside = -std::log(share) - reached, before = reached * reached / 2;
    return per_square * 2 * std::numbers::pi * (inside - before) / (growth * growth);
  }
  constexpr double per_cube = 6 * std::numbers::sqrt2; // of regular tetrahedra
  const double inside = -std::log(share) + 2 * share - 0.5 * share * share - 1.5;
  const double before = reached * reached * reached / 3;
  return per_cube * 2 * std::numbers::pi * (inside - before) / std::pow(growth, 3);
}

/// A detail that sizes are to fit.
struct kept_detail {
  double size;              ///< how small they should be
  std::vector<vec3> places; ///< where
  double elements;          ///< about how many elements fitting it adds
};

/// The details of a model that are small for a size.
template <geometry_model G>
class kept_details {
public:
  /// All must outlive the object.
  kept_details(const G& model, const any_sizing& size, const kept_detail_options& options)
      : model_(model), size_(size), options_(options), chords_of_(model.topology().curves.size()),
        joined_to_(model.topology().vertices.size()) {
    for (std::size_t c = 0; c < chords_of_.size(); ++c)
      if (!model.topology().curves[c].degenerate) {
        chords_of_[c] = chords_of_curve(static_cast<local_id>(c));
        find_if_short(static_cast<local_id>(c));
      }
    for (std::size_t f = 0; f < model.topology().faces.size(); ++f)
      find_narrow_places(static_cast<local_id>(f));
  }

  /// All of them.
  const std::vector<kept_detail>& list() const { return details_; }

private:
  /// A part of a curve as a straight line.
  struct chord {
    std::array<vec3, 2> ends; ///< in the curve's direction
    double middle = 0;        ///< parameter of the curve
  };
  /// A chord as a face passes it.
  struct passed_chord {
    const chord* line;
    local_id curve;
    int coedge;
  };
  /// The nearest place across a face that is found so far.
  struct nearest_place {
    double distance;
    const passed_chord* on = nullptr;
  };

  const geometry_topology& topology() const { return model_.topology(); }
  double size_at(vec3 p) const { return checked_size(size_, p); }

  /// Half as long as the size in the middle of the curve, but for a least and a largest number of them.
  std::vector<chord> chords_of_curve(local_id c) const {
    constexpr int fewest = 8, most = 1024;
    const auto& range = topology().curves[c].t;
    const auto parameter = [&](double share) { return range[0] + share * (range[1] - range[0]); };
    const auto point = [&](double share) { return model_.curve_point(c, parameter(share)); };
    double rough = 0;
    for (int k = 0; k < fewest; ++k)
      rough += distance(point(1.0 * k / fewest), point((k + 1.0) / fewest));
    const double wanted = std::ceil(2 * rough / size_at(point(0.5)));
    const int count = wanted < most ? std::max(fewest, static_cast<int>(wanted)) : most;
    std::vector<chord> chords;
    vec3 from = point(0);
    for (int k = 1; k <= count; ++k) {
      const vec3 to = point(1.0 * k / count);
      chords.push_back({{from, to}, parameter((k - 0.5) / count)});
      from = to;
    }
    return chords;
  }

  void find_if_short(local_id c) {
    const auto& chords = chords_of_[c];
    const auto& ends = topology().curves[c].vertices;
    double length = 0;
    for (const chord& one : chords)
      length += distance(one.ends[0], one.ends[1]);
    if (ends[0] == ends[1])
      length /= 3; // edges that a closed curve has at least
    const vec3 middle = chords[chords.size() / 2].ends[0];
    if (!(length > 0) || length > options_.share_of_size * size_at(middle))
      return;
    add(length, {chords.front().ends[0], middle, chords.back().ends[1]});
    joined_to_[ends[0]].push_back(ends[1]);
    joined_to_[ends[1]].push_back(ends[0]);
  }

  /// Where, across a face, a vertex of it is near to a curve of it that does not end there.
  void find_narrow_places(local_id f) {
    const auto& coedges = topology().faces[f].coedges;
    std::vector<passed_chord> passed;
    std::vector<local_id> vertices;
    for (std::size_t k = 0; k < coedges.size(); ++k) {
      const local_id c = coedges[k].curve;
      for (const chord& one : chords_of_[c])
        passed.push_back({&one, c, static_cast<int>(k)});
      if (!chords_of_[c].empty())
        for (const local_id v : topology().curves[c].vertices)
          vertices.push_back(v);
    }
    sort_unique(vertices);
    std::vector<box3> boxes(passed.size());
    for (std::size_t k = 0; k < passed.size(); ++k)
      for (const vec3 end : passed[k].line->ends)
        boxes[k].include(end);
    const box_tree tree(boxes);
    for (const local_id v : vertices)
      find_narrow_place(f, v, passed, tree);
  }

  void find_narrow_place(local_id f, local_id v, const std::vector<passed_chord>& passed,
                         const box_tree& tree) {
    const vec3 p = topology().vertices[v].point;
    const double size = size_at(p);
    const auto ways_in = ways_into_face(f, v);
    nearest_place best{options_.share_of_size * size};
    tree.for_each_near(
        p,
        [&](const box3& box, std::size_t) {
          return distance_squared(box, p) < best.distance * best.distance;
        },
        [&](local_id k) {
          const vec3 foot = foot_on(*passed[k].line, p);
          const double away = distance(foot, p);
          if (away < best.distance && !is_joined(v, passed[k].curve) &&
              away > touching_distance(v, passed[k].curve, size) &&
              is_across_face(f, passed[k], ways_in, p, foot))
            best = {away, &passed[k]};
        });
    if (best.on == nullptr)
      return;
    const vec3 foot = foot_on(best.on->curve, best.on->line->middle, p);
    if (const double away = distance(foot, p);
        away > touching_distance(v, best.on->curve, size) && away < options_.share_of_size * size)
      add(away, {p, foot});
  }

  /// Whether a curve ends at a vertex, or at one that a short edge joins it to.
  bool is_joined(local_id v, local_id c) const {
    const auto& ends = topology().curves[c].vertices;
    return std::any_of(ends.begin(), ends.end(), [&](local_id end) {
      return end == v || std::find(joined_to_[v].begin(), joined_to_[v].end(), end) != joined_to_[v].end();
    });
  }

  /// Up to which a vertex is on a curve.
  double touching_distance(local_id v, local_id c, double size) const {
    return std::max(options_.touching_share * size,
                    topology().curves[c].tolerance + topology().vertices[v].tolerance);
  }

  static vec3 foot_on(const chord& line, vec3 p) {
    const auto [a, b] = nearest_on_segment(line.ends[0], line.ends[1], p);
    return a * line.ends[0] + b * line.ends[1];
  }
  vec3 foot_on(local_id c, double seed, vec3 p) const {
    const auto& range = topology().curves[c].t;
    return model_.curve_point(c, std::clamp(model_.project_to_curve(c, p, seed), range[0], range[1]));
  }

  /// From the passages of a face that end at a vertex, square to them into the face.
  std::vector<vec3> ways_into_face(local_id f, local_id v) const {
    std::vector<vec3> ways;
    const auto& coedges = topology().faces[f].coedges;
    for (std::size_t k = 0; k < coedges.size(); ++k) {
      const local_id c = coedges[k].curve;
      const auto& ends = topology().curves[c].vertices;
      for (const std::size_t end : {std::size_t{0}, std::size_t{1}})
        if (ends[end] == v && !chords_of_[c].empty())
          ways.push_back(into_face(
              f, {end == 0 ? &chords_of_[c].front() : &chords_of_[c].back(), c, static_cast<int>(k)}));
    }
    return ways;
  }
  /// Whether the way from a vertex to a foot leaves the vertex into the face, whose corner may be a reflex
  /// one, and arrives across the face: not through a gap beside it, nor along its boundary.
  bool is_across_face(local_id f, const passed_chord& at_foot, const std::vector<vec3>& ways_in, vec3 p,
                      vec3 foot) const {
    constexpr double least_leaving = 0.05, least_arriving = 0.3; // cosines
    const vec3 way = normalized(foot - p);
    return std::any_of(ways_in.begin(), ways_in.end(),
                       [&](vec3 in) { return dot(in, way) > least_leaving; }) &&
           dot(into_face(f, at_foot), -way) > least_arriving;
  }
  /// From a passage of a face, square to it into the face; of unit length.
  vec3 into_face(local_id f, const passed_chord& along) const {
    const surface_frame frame = model_.face_frame(f, model_.curve_uv(f, along.coedge, along.line->middle));
    const vec3 run = along.line->ends[1] - along.line->ends[0];
    const vec3 inward = normalized(cross(cross(frame.du, frame.dv), run));
    return topology().faces[f].coedges[along.coedge].reversed ? -inward : inward;
  }

  void add(double length, const std::vector<vec3>& places) {
    const double size = size_at(places.front());
    const double fitted = std::max({length, options_.least_size, options_.touching_share * size});
    if (!(fitted < size))
      return;
    details_.push_back(
        {fitted, places, elements_of_growth(fitted, size, options_.growth, options_.dimension)});
  }

  const G& model_;
  const any_sizing& size_;
  const kept_detail_options& options_;
  std::vector<std::vector<chord>> chords_of_;    ///< by curve; none of degenerate ones
  std::vector<std::vector<local_id>> joined_to_; ///< by vertex: those at the other ends of short edges
  std::vector<kept_detail> details_;
};

} // namespace sizing

/// The details of a model that sizes are to fit, and what that takes.
struct detail_fit {
  std::vector<sized_point> places; ///< of those that are fitted: how small the size is where
  std::size_t fitted = 0;          ///< details among these
  std::size_t left = 0;            ///< further details, which would have needed too many elements
  double elements = 0;             ///< about how many elements those fitted add
  double elements_of_all = 0;      ///< about how many all would

  using fields =
      field_list<&detail_fit::fitted, &detail_fit::left, &detail_fit::elements, &detail_fit::elements_of_all>;
};

namespace sizing {

/// Throws `sizing_error` for options out of range.
inline void check(const kept_detail_options& options) {
  checked_length(options.share_of_size, "the share of the size that details have");
  checked_length(options.touching_share, "the share of the size by which vertices are off curves");
  checked_length(options.least_size, "the least size at details");
  checked_size(options.growth, "the growth of sizes from details");
  if (options.share_of_size > 1)
    throw sizing_error("details are smaller than the size; give a share of at most 1");
  if (!(options.most_elements >= 0))
    throw sizing_error("give a number of elements that details may need");
  if (options.dimension != 2 && options.dimension != 3)
    throw sizing_error("elements are of dimension 2 or 3");
}

} // namespace sizing

/// The details of a model that sizes should fit: edges far shorter than the size, and vertices of a face far
/// nearer, across the face, to another curve of it. Triangles there would have an angle of about the ratio of
/// both. Those that need the fewest elements come first, as far as the elements allowed are enough.
/// Complexity: about n log n in the curves of each face and their lengths in sizes. Throws `sizing_error` for
/// options out of range, and for sizes that are not positive and finite.
/// \param model all of whose details are to be kept; with a `virtual_model` those that it leaves
/// \param size the field, asked at the middle of each curve and at vertices
/// \param options what is a detail, and how many elements may be spent
template <geometry_model G>
detail_fit details_to_fit(const G& model, const any_sizing& size, const kept_detail_options& options = {}) {
  sizing::check(options);
  const sizing::kept_details<G> found(model, size, options);
  std::vector<const sizing::kept_detail*> details;
  for (const sizing::kept_detail& detail : found.list())
    details.push_back(&detail);
  stable_sort_all(details, [](const auto* a, const auto* b) { return a->elements < b->elements; });
  detail_fit fit;
  for (const sizing::kept_detail* detail : details) {
    fit.elements_of_all += detail->elements;
    if (!(fit.elements_of_all <= options.most_elements)) {
      ++fit.left;
      continue;
    }
    ++fit.fitted;
    fit.elements = fit.elements_of_all;
    for (const vec3 p : detail->places)
      fit.places.push_back({p, detail->size});
  }
  return fit;
}

/// A field that at some places is as small as they say, grows from there, and is the one given elsewhere.
/// Complexity: n log n in the places; an evaluation takes about log n.
/// Throws `sizing_error` for a size or growth that is not positive and finite.
/// \param size the field
/// \param places such as those of `details_to_fit`; without any the result is the field given
/// \param growth of the size per length, which has no unit
inline any_sizing finer_at(const any_sizing& size, const std::vector<sized_point>& places, double growth) {
  if (places.empty())
    return size;
  return keep_bounds(
      minimum_of(erased_sizing(size), point_sizes(places, growth, std::numeric_limits<double>::max())));
}

/// Both: a field that fits those details of a model for which the elements allowed are enough, and is the one
/// given where there are none. Complexity: that of `details_to_fit`. Throws `sizing_error` as that does.
/// \param model as there
/// \param size the field
/// \param options what is a detail, and how many elements may be spent
template <geometry_model G>
any_sizing finer_at_details(const G& model, const any_sizing& size, const kept_detail_options& options = {}) {
  return finer_at(size, details_to_fit(model, size, options).places, options.growth);
}

} // namespace dovetail
