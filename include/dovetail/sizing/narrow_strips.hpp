/// @file
/// Where a face is far narrower than the size between two of its curves, such as the rim of a thin plate.
#pragma once

#include "dovetail/geometry/concepts.hpp"
#include "dovetail/sizing/checked_size.hpp"
#include "dovetail/sizing/curve_chords.hpp"
#include "dovetail/sizing/erased.hpp"
#include "dovetail/sizing/kept_detail.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace dovetail::sizing {

/// Finds, along every curve of a face, how far it is across the face to another one. Curves that narrow down
/// to a corner are left out: the width between them vanishes, and no size fits it.
/// Flat triangles seldom make flat tetrahedra. So for tetrahedra strips are left as they are between two
/// curves with a common vertex, and where they are no wider than the tolerances of the curves.
template <geometry_model G>
class narrow_strips {
public:
  /// All must outlive the object.
  narrow_strips(const G& model, const any_sizing& size, const kept_detail_options& options)
      : model_(model), size_(size), options_(options), chords_(model, size) {}

  /// Adds a detail for each face with strips. About n log n in the chords of each face.
  void add_to(std::vector<kept_detail>& details) const {
    for (std::size_t f = 0; f < model_.topology().faces.size(); ++f) {
      const auto face = static_cast<local_id>(f);
      const face_chords chords = chords_.passed_by(face);
      kept_detail strips;
      for (const passed_chord& along : chords.passed) {
        const vec3 p = model_.curve_point(along.curve, along.line->middle);
        const double size = checked_size(size_, p);
        if (const auto width = width_at(face, along, chords, p, size))
          add_places(along, *width, size, strips);
      }
      if (strips.elements > 0)
        details.push_back(std::move(strips));
    }
  }

private:
  /// Edges across a strip have this many times its width; triangles of one row are well shaped.
  static constexpr double widths_per_size = 2;

  /// Of the size there; twice that of lengths which sizes fit as they are.
  double narrow_share() const { return widths_per_size * options_.share_of_size; }

  const geometry_topology& topology() const { return model_.topology(); }

  bool ends_at(local_id curve, local_id v) const {
    const auto& ends = topology().curves[curve].vertices;
    return ends[0] == v || ends[1] == v;
  }
  bool have_common_vertex(local_id a, local_id b) const {
    const auto& ends = topology().curves[a].vertices;
    return std::any_of(ends.begin(), ends.end(), [&](local_id v) { return ends_at(b, v); });
  }

  /// Whether two curves may be the sides of a strip.
  bool may_be_sides(local_id a, local_id b) const {
    return a != b && (options_.dimension == 2 || !have_common_vertex(a, b));
  }

  /// Whether two curves have a common vertex so near that the angle between them explains how far `p`, on the
  /// first one, is from the other.
  bool narrow_to_corner(const passed_chord& from, const passed_chord& to, vec3 p, double width) const {
    if (!have_common_vertex(from.curve, to.curve))
      return false;
    const vec3 along = model_.curve_frame(from.curve, from.line->middle).derivative;
    const vec3 beside = model_.curve_frame(to.curve, chords_.foot_parameter(to, p)).derivative;
    const double sine = norm(cross(normalized(along), normalized(beside)));
    const auto& ends = topology().curves[from.curve].vertices;
    return std::any_of(ends.begin(), ends.end(), [&](local_id v) {
      return ends_at(to.curve, v) && sine * distance(topology().vertices[v].point, p) > 0.5 * width;
    });
  }

  /// Up to which width faces between two curves stay as they are.
  double unresolved_width(const passed_chord& a, const passed_chord& b) const {
    if (options_.dimension == 2)
      return 0;
    return topology().curves[a.curve].tolerance + topology().curves[b.curve].tolerance;
  }

  /// The width of the face at the middle `p` of a chord, where it is a small share of the size there.
  std::optional<double> width_at(local_id face, const passed_chord& along, const face_chords& chords, vec3 p,
                                 double size) const {
    const passed_chord* nearest = nullptr;
    double width = narrow_share() * size;
    chords.tree.for_each_near(
        p, [&](const box3& box, std::size_t) { return distance_squared(box, p) < width * width; },
        [&](local_id k) {
          const passed_chord& other = chords.passed[k];
          const vec3 foot = foot_on(*other.line, p);
          if (const double away = distance(foot, p); away < width && may_be_sides(along.curve, other.curve) &&
                                                     is_across(face, along, other, p, foot) &&
                                                     !narrow_to_corner(along, other, p, away)) {
            width = away;
            nearest = &other;
          }
        });
    if (nearest == nullptr)
      return std::nullopt;
    width = distance(chords_.foot_on(*nearest, p), p);
    const double touching = std::max(options_.touching_share * size, unresolved_width(along, *nearest));
    if (!(width > touching && width < narrow_share() * size))
      return std::nullopt;
    return width;
  }

  /// Whether the way from a chord to a foot on another leads through the face.
  bool is_across(local_id face, const passed_chord& from, const passed_chord& to, vec3 p, vec3 foot) const {
    constexpr double least_cosine = 0.5;
    const vec3 way = normalized(foot - p);
    return dot(chords_.into_face(face, from), way) > least_cosine &&
           dot(chords_.into_face(face, to), -way) > least_cosine;
  }

  /// Places along a chord so near to each other that sizes are small between them, too. A strip has two
  /// sides, each of which counts half of its elements.
  void add_places(const passed_chord& along, double width, double size, kept_detail& strips) const {
    const curve_chord& line = *along.line;
    const double fitted =
        std::max({widths_per_size * width, options_.least_size, options_.touching_share * size});
    if (!(fitted < size))
      return;
    strips.elements +=
        0.5 * line.length() * elements_of_growth_along(fitted, size, options_.growth, options_.dimension);
    if (strips.elements > options_.most_elements)
      return; // it is left as it is
    const double count = std::ceil(line.length() / fitted);
    for (double k = 0; k < count; ++k) {
      const double share = (k + 0.5) / count;
      strips.places.push_back({(1 - share) * line.ends[0] + share * line.ends[1], fitted});
    }
  }

  const G& model_;
  const any_sizing& size_;
  const kept_detail_options& options_;
  const curve_chords<G> chords_;
};

} // namespace dovetail::sizing
