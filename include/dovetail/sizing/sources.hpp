/// @file
/// Grid sources: points, lines and triangles around which elements are small.
///
/// After N. P. Weatherill and O. Hassan, Int. J. Numer. Meth. Eng. 37 (1994) 2005-2039, and the programs
/// FELISA and HEDP/PRE: a source asks for its spacing within its inner radius, and the spacing grows
/// exponentially with the distance from there on. Where several sources reach a point the smallest spacing
/// counts.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/candidate_octree.hpp"
#include "dovetail/sizing/bounds.hpp"

#include <array>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace dovetail {

/// How the spacing grows outside the inner radius.
enum class source_growth {
  /// Geometrically, so that the ambient size is reached at the outer radius: the outer radius is the extent.
  to_ambient,
  /// The literature's law: the spacing doubles from the inner to the outer radius, and goes on at that rate
  /// until it
  /// reaches the ambient size.
  doubling,
};

/// A point (dimension 0), line (1) or triangle (2) with, at each corner, the radii and spacing; they vary
/// linearly in between. Radii and spacing in the unit of the model.
struct grid_source {
  int dimension = 0;                    ///< corners in use: dimension + 1
  std::array<vec3, 3> corners{};        ///< a point uses the first, a line two
  std::array<double, 3> inner_radius{}; ///< by corner; the size is `spacing` within it
  std::array<double, 3> outer_radius{}; ///< by corner; how far the source reaches, as `growth` says
  std::array<double, 3> spacing{};      ///< by corner; the size inside
  source_growth growth = source_growth::to_ambient; ///< how the size grows between the radii
  std::string name = {};                            ///< for messages; may be empty
};

/// A source of equal radii and spacing at all its corners.
inline grid_source point_source(vec3 at, double inner, double outer, double spacing) {
  return {0, {at, at, at}, {inner, inner, inner}, {outer, outer, outer}, {spacing, spacing, spacing}};
}
/// A line from `a` to `b` with the same radii and spacing at both ends.
inline grid_source line_source(vec3 a, vec3 b, double inner, double outer, double spacing) {
  return {1, {a, b, b}, {inner, inner, inner}, {outer, outer, outer}, {spacing, spacing, spacing}};
}
/// A triangle with the same radii and spacing at its corners.
inline grid_source triangle_source(vec3 a, vec3 b, vec3 c, double inner, double outer, double spacing) {
  return {2, {a, b, c}, {inner, inner, inner}, {outer, outer, outer}, {spacing, spacing, spacing}};
}

/// The ambient size with any number of grid sources in it. Built in O(n log n). An evaluation visits only the
/// sources that reach the point, found through a tree of boxes: O(log n + sources that reach it). Throws
/// `sizing_error`, naming the source, for a size that is not positive, radii that are negative or out of
/// order, and anything that is not finite.
class source_field {
public:
  /// `largest_slope`: the size grows with the distance from a source by at most this per length, so that a
  /// source reaches further than its outer radius if need be. Exact where the corners of a source are equal
  /// (the limit of a minimum is the minimum of the limits); a tapered source adds its own taper along itself.
  /// No limit by default.
  source_field(double ambient, std::vector<grid_source> sources,
               double largest_slope = std::numeric_limits<double>::infinity());

  double operator()(vec3 p) const;

  /// Lower bound over a box: every source at its distance from the box.
  double smallest_size_in(const box3& box) const;

  /// Of the sources that count in the box.
  source_field within(const box3& box) const;

  double ambient() const { return ambient_; }                          ///< the size outside of all sources
  const std::vector<grid_source>& sources() const { return sources_; } ///< as they were given

  /// The length beyond which a mesh would step over a source: half the smallest of, over the sources that
  /// reach p, the inner radius or the distance to the source, whichever is larger. Infinite where none
  /// reaches.
  double feature_size(vec3 p) const;

private:
  using weights = std::array<double, 3>;

  struct law {
    double least = 0;     ///< the smallest spacing of the source
    double log_least = 0; ///< its logarithm
    double reach = 0;     ///< beyond this distance the source asks for the ambient size or more
    box3 reached;         ///< beyond this box likewise
    bool constant = true; ///< the same radii and spacing at all corners
    double rate = 0;      ///< of growth, where it is constant
    /// How fast they change along the source, per length; infinite on a degenerate source with unequal
    /// corners.
    double inner_slope = 0;
    double outer_slope = 0;
    double spacing_slope = 0;
  };
  struct nearest_point {
    double distance;
    weights at;
  };
  /// Of the sources below a node of the tree.
  struct node_bound {
    box3 cores;             ///< around the sources, without what they reach
    double log_least = 0;   ///< of the smallest spacing
    double least_inner = 0; ///< radius
    double most_inner = 0;
    double rate = 0;      ///< of the slowest growth
    bool constant = true; ///< all of them
  };
  /// The smallest size found so far, and whose it is.
  struct minimum {
    double log_size;
    local_id source = no_id;
  };

  static constexpr double rounding = 1e-9; ///< of logarithms: far more than there is
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  static constexpr std::size_t most_tried = 256; ///< of a list, before the tree is searched: thousands of
                                                 ///< sources may reach into every leaf of the octree

  node_bound bound_of(std::size_t i) const;

  static node_bound joined(const node_bound& a, const node_bound& b);

  /// No more than `log_size(i, p, closer)` for all sources below a node: a size that starts smaller, later
  /// and grows more slowly stays smaller.
  double least_from(const node_bound& node, vec3 p, double closer) const;

  /// Lets source i ask for its size at p. Of those that ask for the same, that of the smallest spacing has
  /// it, then the first one.
  void take(local_id i, vec3 p, minimum& found) const;

  /// As `take` for all sources.
  void search(vec3 p, minimum& found) const;

  /// Fills the octree that evaluations use; finest sources first, so that an evaluation can stop early.
  void locate();

  /// Takes out sources that ask for more than another one does, wherever in the box.
  void remove_outdone(const box3& box, std::vector<local_id>& items) const;

  static double moved(double slope, double by) { return by > 0 ? slope * by : 0; }

  static double mixed(const weights& values, const weights& w) {
    return values[0] * w[0] + values[1] * w[1] + values[2] * w[2];
  }

  static box3 core_box(const grid_source& s);

  law prepared(const grid_source& s) const;

  /// Length of the gradient of corner values along a line or triangle.
  static double slope_along(const grid_source& s, const weights& values);

  double reach_at(const grid_source& s, const weights& at) const;

  nearest_point nearest(std::size_t i, vec3 p) const;

  /// Logarithm of what source i asks for at distance max(0, |p - source| - closer). `closer` may be negative
  /// for a source that is the same everywhere.
  double log_size(local_id id, vec3 p, double closer) const;

  /// The logarithm of the size grows by this per length outside the inner radius, before it is limited.
  double growth_rate(const grid_source& s, double inner, double outer, double log_spacing) const {
    const double rise = s.growth == source_growth::doubling ? std::numbers::ln2 : log_ambient_ - log_spacing;
    return outer > inner ? rise / (outer - inner) : std::numeric_limits<double>::infinity();
  }

  /// Logarithm of the size at distance r from the inner radius: exponential until its slope reaches the
  /// limit, straight on.
  double log_grown(double log_spacing, double rate, double r) const;

  /// The distance from the inner radius at which the size is the ambient one.
  double width_of_growth(double log_spacing, double rate) const;

  static void check(const grid_source& s, std::size_t index);

  double ambient_;
  double log_ambient_;
  double largest_slope_;
  std::vector<grid_source> sources_;
  std::vector<law> laws_;
  candidate_octree located_;
  box_tree tree_;
  std::vector<node_bound> nodes_; ///< per tree node
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/sizing/sources.ipp"
#endif
