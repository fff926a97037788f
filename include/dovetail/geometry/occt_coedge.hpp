/// @file
/// One passage of a face's boundary along an edge: its curve in the face's parameter plane.
#pragma once

#include "dovetail/geometry/occt_shape.hpp"

#include <Geom2dAdaptor_Curve.hxx>
#include <Geom2d_Curve.hxx>

#include <array>

namespace dovetail::occt {

/// The parameter curve of a coedge as a function of the parameter of the edge's 3D curve.
///
/// Files keep the ends of consecutive parameter curves together only up to a tolerance, and sometimes only up
/// to a period of the surface. `end_shift` moves both ends (and linearly what is between) so that the loop
/// closes exactly.
struct coedge_curve {
  Geom2dAdaptor_Curve curve;
  std::array<double, 2> range{0, 1};      ///< of `curve`
  std::array<double, 2> edge_range{0, 1}; ///< of the edge's 3D curve
  std::array<vec2, 2> end_shift{};        ///< added at edge_range[0] and edge_range[1]
  bool reversed = false;                  ///< passed from edge_range[1] to edge_range[0]

  vec2 at(double t) const {
    const double s = (t - edge_range[0]) / (edge_range[1] - edge_range[0]);
    const bool same_range = range == edge_range;
    const gp_Pnt2d p = curve.Value(same_range ? t : range[0] + s * (range[1] - range[0]));
    return vec2{p.X(), p.Y()} + ((1 - s) * end_shift[0] + s * end_shift[1]);
  }
  vec2 start() const { return at(edge_range[reversed ? 1 : 0]); }
  vec2 end() const { return at(edge_range[reversed ? 0 : 1]); }

  void shift(vec2 by) {
    end_shift[0] = end_shift[0] + by;
    end_shift[1] = end_shift[1] + by;
  }
  void shift_start(vec2 by) {
    vec2& shift = end_shift[reversed ? 1 : 0];
    shift = shift + by;
  }
  void shift_end(vec2 by) {
    vec2& shift = end_shift[reversed ? 0 : 1];
    shift = shift + by;
  }
};

} // namespace dovetail::occt
