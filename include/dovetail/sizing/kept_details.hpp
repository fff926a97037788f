/// @file
/// Sizes that fit the details of a model that are much smaller than the size, and stay all the same.
#pragma once

#include "dovetail/core/fields.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/sizing/checked_size.hpp"
#include "dovetail/sizing/compose.hpp"
#include "dovetail/sizing/curve_chords.hpp"
#include "dovetail/sizing/erased.hpp"
#include "dovetail/sizing/kept_detail.hpp"
#include "dovetail/sizing/narrow_strips.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace dovetail {

namespace sizing {

/// The details of a model that are small for a size, but for strips.
template <geometry_model G>
class kept_details {
public:
  /// All must outlive the object.
  kept_details(const G& model, const any_sizing& size, const kept_detail_options& options)
      : model_(model), size_(size), options_(options), chords_(model, size),
        joined_to_(model.topology().vertices.size()) {
    for (std::size_t c = 0; c < model.topology().curves.size(); ++c)
      if (!model.topology().curves[c].degenerate)
        find_if_short(static_cast<local_id>(c));
    for (std::size_t f = 0; f < model.topology().faces.size(); ++f)
      find_narrow_places(static_cast<local_id>(f));
  }

  /// All of them.
  const std::vector<kept_detail>& list() const { return details_; }

private:
  /// The nearest place across a face that is found so far.
  struct nearest_place {
    double distance;
    const passed_chord* on = nullptr;
  };

  const geometry_topology& topology() const { return model_.topology(); }
  double size_at(vec3 p) const { return checked_size(size_, p); }

  void find_if_short(local_id c) {
    const auto& chords = chords_.of(c);
    const auto& ends = topology().curves[c].vertices;
    double length = 0;
    for (const curve_chord& one : chords)
      length += one.length();
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
    std::vector<local_id> vertices;
    for (const auto& coedge : topology().faces[f].coedges)
      if (!chords_.of(coedge.curve).empty())
        for (const local_id v : topology().curves[coedge.curve].vertices)
          vertices.push_back(v);
    sort_unique(vertices);
    const face_chords chords = chords_.passed_by(f);
    for (const local_id v : vertices)
      find_narrow_place(f, v, chords);
  }

  void find_narrow_place(local_id f, local_id v, const face_chords& chords) {
    const vec3 p = topology().vertices[v].point;
    const double size = size_at(p);
    const auto ways_in = ways_into_face(f, v);
    nearest_place best{options_.share_of_size * size};
    chords.tree.for_each_near(
        p,
        [&](const box3& box, std::size_t) {
          return distance_squared(box, p) < best.distance * best.distance;
        },
        [&](local_id k) {
          const passed_chord& chord = chords.passed[k];
          const vec3 foot = foot_on(*chord.line, p);
          const double away = distance(foot, p);
          if (away < best.distance && !is_joined(v, chord.curve) &&
              away > touching_distance(v, chord.curve, size) && is_across_face(f, chord, ways_in, p, foot))
            best = {away, &chord};
        });
    if (best.on == nullptr)
      return;
    const vec3 foot = chords_.foot_on(*best.on, p);
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

  /// From the passages of a face that end at a vertex, square to them into the face.
  std::vector<vec3> ways_into_face(local_id f, local_id v) const {
    std::vector<vec3> ways;
    const auto& coedges = topology().faces[f].coedges;
    for (std::size_t k = 0; k < coedges.size(); ++k) {
      const local_id c = coedges[k].curve;
      const auto& ends = topology().curves[c].vertices;
      for (const std::size_t end : {std::size_t{0}, std::size_t{1}})
        if (const auto& chords = chords_.of(c); ends[end] == v && !chords.empty())
          ways.push_back(
              chords_.into_face(f, {end == 0 ? &chords.front() : &chords.back(), c, static_cast<int>(k)}));
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
           dot(chords_.into_face(f, at_foot), -way) > least_arriving;
  }

  void add(double length, const std::vector<vec3>& places) {
    const double size = size_at(places.front());
    const double fitted = std::max({length, options_.least_size, options_.touching_share * size});
    if (!(fitted < size))
      return;
    kept_detail& added = details_.emplace_back();
    added.elements = elements_of_growth(fitted, size, options_.growth, options_.dimension);
    for (const vec3 p : places)
      added.places.push_back({p, fitted});
  }

  const G& model_;
  const any_sizing& size_;
  const kept_detail_options& options_;
  curve_chords<G> chords_;
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

namespace sizing {

/// All details. A strip is narrow for the sizes that fit the others: its ends are short edges, beside which
/// they grow.
template <geometry_model G>
std::vector<kept_detail> details_and_strips(const G& model, const any_sizing& size,
                                            const kept_detail_options& options) {
  std::vector<kept_detail> details = kept_details<G>(model, size, options).list();
  std::vector<sized_point> places;
  for (const kept_detail& detail : details)
    append(places, detail.places);
  const any_sizing fitted = finer_at(size, places, options.growth);
  narrow_strips<G>(model, fitted, options).add_to(details);
  return details;
}

} // namespace sizing

/// The details of a model that sizes should fit: edges far shorter than the size, vertices of a face far
/// nearer, across the face, to another curve of it, and faces far narrower between two curves. Triangles
/// there would have an angle of about the ratio of both. Those that need the fewest elements come first, as
/// far as the elements allowed are enough.
/// Complexity: about n log n in the curves of each face and their lengths in sizes.
/// Throws `sizing_error` for options out of range, and for sizes that are not positive and finite.
/// \param model all of whose details are to be kept; with a `virtual_model` those that it leaves
/// \param size the field, asked along curves and at vertices
/// \param options what is a detail, and how many elements may be spent
template <geometry_model G>
detail_fit details_to_fit(const G& model, const any_sizing& size, const kept_detail_options& options = {}) {
  sizing::check(options);
  const std::vector<sizing::kept_detail> found = sizing::details_and_strips(model, size, options);
  std::vector<const sizing::kept_detail*> details;
  for (const sizing::kept_detail& detail : found)
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
    fit.places.insert(fit.places.end(), detail->places.begin(), detail->places.end());
  }
  return fit;
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
