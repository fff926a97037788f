/// @file
/// Points along a parametric line, spaced by a sizing field.
#pragma once

#include "dovetail/geometry/concepts.hpp"
#include "dovetail/sizing/checked_size.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace dovetail::remesh {

/// Spacing of points along a line. A pure function of the line, its parameter range and the field: whoever
/// asks for a shared line gets the same points.
struct line_spacing {
  int minimum_segments = 1;                                      ///< the line has at least so many
  double largest_turn = std::numeric_limits<double>::infinity(); ///< of the tangent per segment, in radians
  double smallest_turn_size = 0; ///< the turn never asks for segments shorter than this
  /// Few segments become one, two or four, mostly two. A triangle between three lines of as many segments
  /// each falls into triangles of its own shape, while one between lines of one and two has a corner halved.
  bool even_when_few = false;
  int given_segments = 0; ///< exactly so many; 0: as the sizes ask
  double bias = 0;        ///< in (-1, 1): by so much the first segments are longer, and the last shorter

  /// Parameters t[0] = first < ... < t[n] = last, first < last. Neighbours are about one target length apart:
  /// n = max(minimum_segments, round(integral of |C'| / h)), see `even_when_few`. `curve(t)` gives a
  /// `curve_frame`. Complexity: about three evaluations of the curve and the field per segment.
  template <class Curve, sizing_field Size>
  std::vector<double> operator()(const Curve& curve, double first, double last, const Size& sizing) const {
    std::vector<leaf> leaves;
    const auto sample = [&](double t) {
      const curve_frame f = curve(t);
      return sampled{t, f.point, f.derivative, norm(f.derivative) / checked_size(sizing, f.point)};
    };
    constexpr int starting_parts = 4;
    sampled from = sample(first);
    for (int i = 1; i <= starting_parts; ++i) {
      const sampled to = sample(i == starting_parts ? last : first + (last - first) * i / starting_parts);
      integrate(sample, from, to, 2, leaves);
      from = to;
    }
    return positions(leaves, first, last);
  }

private:
  struct sampled {
    double t;
    vec3 point, derivative;
    double density; ///< segments per unit of parameter
  };
  /// A part of the range over which the number of segments grows nearly linearly.
  struct leaf {
    double t0, t1, segments;
  };

  template <class Sample>
  void integrate(const Sample& sample, const sampled& a, const sampled& b, int depth,
                 std::vector<leaf>& leaves) const {
    const sampled m = sample(0.5 * (a.t + b.t));
    const double width = b.t - a.t;
    const double simpson = width * (a.density + 4 * m.density + b.density) / 6;
    const double trapezoid = 0.5 * width * (a.density + b.density);
    const double turned =
        angle_between(a.derivative, m.derivative) + angle_between(m.derivative, b.derivative);
    const double by_turn = turn_segments(turned, distance(a.point, m.point) + distance(m.point, b.point));
    const bool smooth = std::abs(simpson - trapezoid) <= 0.02 * std::max(simpson, 0.1) && simpson <= 2 &&
                        by_turn <= std::max(0.5, 1.1 * simpson);
    constexpr int most_halvings = 16;
    if (depth < most_halvings && !smooth) {
      integrate(sample, a, m, depth + 1, leaves);
      integrate(sample, m, b, depth + 1, leaves);
      return;
    }
    leaves.push_back({a.t, b.t, std::max(simpson, by_turn)});
  }

  double turn_segments(double angle, double length) const {
    const double wanted = angle / largest_turn;
    return smallest_turn_size > 0 ? std::min(wanted, length / smallest_turn_size) : wanted;
  }

  /// The limits favour two, which lines between elements of a tenth of the final number come near; measured:
  /// a fourth to a tenth as many small corners as rounding leaves.
  double rounded(double segments) const;

  std::vector<double> positions(const std::vector<leaf>& leaves, double first, double last) const;
};

} // namespace dovetail::remesh

#ifndef DOVETAIL_COMPILED
#include "dovetail/remesh/line_spacing.ipp"
#endif
