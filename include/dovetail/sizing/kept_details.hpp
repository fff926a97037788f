/// @file
/// Sizes that fit the details of a model that are much smaller than the size, and stay all the same.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/sizing/compose.hpp"
#include "dovetail/sizing/erased.hpp"
#include "dovetail/sizing/point_sizes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace dovetail {

/// Which details sizes are to fit, and how far that goes.
struct kept_detail_options {
  double share_of_size = 0.25;   ///< up to this share of the size there a length is a detail's
  double touching_share = 0.001; ///< vertices nearer to a curve than this share of the size are on it
  double growth = 0.4;           ///< of the size per length away from details
  double most_elements = 2e5;    ///< where fitting all of them needs more, about, none is fitted
};

namespace sizing {

/// The details of a model that are small for a size, as places where that should be smaller.
template <geometry_model G>
class kept_details {
public:
  /// All must outlive the object.
  kept_details(const G& model, const any_sizing& size, const kept_detail_options& options)
      : model_(model), size_(size), options_(options), chords_of_(model.topology().curves.size()) {
    for (std::size_t c = 0; c < chords_of_.size(); ++c)
      if (!model.topology().curves[c].degenerate) {
        chords_of_[c] = chords_of_curve(static_cast<local_id>(c));
        find_if_short(chords_of_[c]);
      }
    for (std::size_t f = 0; f < model.topology().faces.size(); ++f)
      find_narrow_places(static_cast<local_id>(f));
  }

  /// Where sizes should be so small.
  const std::vector<sized_point>& points() const { return points_; }
  /// About how many elements that makes beyond those of the size.
  double elements() const { return elements_; }

private:
  /// A part of a curve as a straight line.
  struct chord {
    std::array<vec3, 2> ends; ///< in the curve's direction
    double middle = 0;        ///< parameter of the curve
    local_id curve = no_id;
    int coedge = 0; ///< of the face that is looked at
    box3 box() const {
      box3 around;
      around.include(ends[0]);
      around.include(ends[1]);
      return around;
    }
  };

  double limit_at(vec3 p) const { return options_.share_of_size * size_(p); }

  /// About half as long as the size in the middle.
  std::vector<chord> chords_of_curve(local_id c) const {
    constexpr int fewest = 8, most = 1024;
    const auto& range = model_.topology().curves[static_cast<std::size_t>(c)].t;
    const auto point = [&](double share) {
      return model_.curve_point(c, range[0] + share * (range[1] - range[0]));
    };
    double rough = 0;
    for (int k = 0; k < fewest; ++k)
      rough += distance(point(1.0 * k / fewest), point((k + 1.0) / fewest));
    const double wanted = std::ceil(2 * rough / size_(point(0.5)));
    const int count = wanted < most ? std::max(fewest, static_cast<int>(wanted)) : most;
    std::vector<chord> chords;
    vec3 from = point(0);
    for (int k = 1; k <= count; ++k) {
      const vec3 to = point(1.0 * k / count);
      chords.push_back({{from, to}, range[0] + (k - 0.5) / count * (range[1] - range[0]), c});
      from = to;
    }
    return chords;
  }

  void find_if_short(const std::vector<chord>& chords) {
    double length = 0;
    for (const chord& one : chords)
      length += distance(one.ends[0], one.ends[1]);
    const vec3 middle = chords[chords.size() / 2].ends[0];
    if (!(length > 0) || length > limit_at(middle))
      return;
    for (const vec3 p : {chords.front().ends[0], middle, chords.back().ends[1]})
      points_.push_back({p, length});
    count_elements(length, middle);
  }

  /// Where, across a face, a vertex of it is near to a curve of it that does not end there.
  void find_narrow_places(local_id f) {
    const auto& topology = model_.topology();
    const auto& coedges = topology.faces[static_cast<std::size_t>(f)].coedges;
    std::vector<chord> chords;
    std::vector<local_id> vertices;
    for (std::size_t k = 0; k < coedges.size(); ++k) {
      const auto c = static_cast<std::size_t>(coedges[k].curve);
      for (chord one : chords_of_[c]) {
        one.coedge = static_cast<int>(k);
        chords.push_back(one);
      }
      vertices.insert(vertices.end(), topology.curves[c].vertices.begin(), topology.curves[c].vertices.end());
    }
    sort_unique(vertices);
    std::vector<box3> boxes;
    for (const chord& one : chords)
      boxes.push_back(one.box());
    const box_tree tree(boxes);
    for (const local_id v : vertices)
      find_narrow_place(f, v, chords, tree);
  }

  void find_narrow_place(local_id f, local_id v, const std::vector<chord>& chords, const box_tree& tree) {
    const vec3 p = model_.topology().vertices[static_cast<std::size_t>(v)].point;
    double least = limit_at(p);
    vec3 foot = p;
    tree.for_each([&](const box3& box, std::size_t) { return distance_squared(box, p) < least * least; },
                  [&](local_id k) {
                    const chord& one = chords[static_cast<std::size_t>(k)];
                    const auto& ends = model_.topology().curves[static_cast<std::size_t>(one.curve)].vertices;
                    if (ends[0] == v || ends[1] == v)
                      return;
                    const auto [a, b] = nearest_on_segment(one.ends[0], one.ends[1], p);
                    const vec3 there = a * one.ends[0] + b * one.ends[1];
                    if (const double away = distance(there, p);
                        away < least && dot(into_face(f, one), p - there) > 0) {
                      least = away;
                      foot = there;
                    }
                  });
    if (foot == p || least < options_.touching_share * size_(p))
      return;
    points_.push_back({p, least});
    points_.push_back({foot, least});
    count_elements(least, p);
  }

  /// From a passage of a face into it, of any length.
  vec3 into_face(local_id f, const chord& along) const {
    const surface_frame frame = model_.face_frame(f, model_.curve_uv(f, along.coedge, along.middle));
    const auto& coedges = model_.topology().faces[static_cast<std::size_t>(f)].coedges;
    const double sign = coedges[static_cast<std::size_t>(along.coedge)].reversed ? -1 : 1;
    return sign * cross(cross(frame.du, frame.dv), along.ends[1] - along.ends[0]);
  }

  /// Around a place on a surface, where sizes grow from a length.
  void count_elements(double length, vec3 place) {
    constexpr double elements_per_cube = 6 * std::numbers::sqrt2; // of regular tetrahedra
    elements_ += elements_per_cube * 2 * std::numbers::pi * std::log(size_(place) / length) /
        std::pow(options_.growth, 3);
  }

  const G& model_;
  const any_sizing& size_;
  const kept_detail_options& options_;
  std::vector<std::vector<chord>> chords_of_; ///< by curve
  std::vector<sized_point> points_;
  double elements_ = 0;
};

} // namespace sizing

/// A field that at each detail of a model is as small as that, grows from there, and is the one given
/// elsewhere. Details are edges far shorter than the size, and vertices of a face far nearer, across the face, to
/// another curve of it: triangles there would have an angle of about the ratio of both. The field given, where there are
/// none.
/// Throws `sizing_error` for options out of range.
/// About n log n in the curves of each face and their lengths in sizes.
/// \param model all of whose details are to be kept; with a `virtual_model` those that it leaves
/// \param size the field, asked along all curves
/// \param options what is a detail
template <geometry_model G>
any_sizing finer_at_details(const G& model, const any_sizing& size, const kept_detail_options& options = {}) {
  sizing::checked_length(options.share_of_size, "the share of the size that details have");
  sizing::checked_length(options.touching_share, "the share of the size that vertices on curves are away");
  sizing::checked_size(options.growth, "the growth of sizes from details");
  const sizing::kept_details<G> found(model, size, options);
  if (found.points().empty() || found.elements() > options.most_elements)
    return size;
  const point_sizes around(found.points(), options.growth, std::numeric_limits<double>::max());
  return keep_bounds(minimum_of(erased_sizing(size), around));
}

} // namespace dovetail
