/// @file
/// One passage of a face's boundary along an edge: its curve in the face's parameter plane.
#pragma once

#include "dovetail/models/occt/surface.hpp"

#include <BRep_Tool.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <Geom_Curve.hxx>
#include <TopoDS_Edge.hxx>

#include <algorithm>
#include <array>
#include <cmath>

namespace dovetail::occt {

/// The parameters on a face of the points of an edge, as a function of the parameter of the edge's 3D curve.
///
/// Files keep consecutive parameter curves together only up to a tolerance, and sometimes only up to a period
/// of the surface: shifts at the two ends, fading out over a short range, close the loop exactly. Many
/// parameter curves are interpolants that stray from the 3D curve between their nodes: where `set_projected`,
/// they only seed a projection of the 3D curve's point.
class coedge_curve {
public:
  coedge_curve() = default;
  coedge_curve(const Handle(Geom2d_Curve) & curve, std::array<double, 2> range,
               const Handle(Geom_Curve) & in_space, std::array<double, 2> edge_range, bool reversed)
      : curve_(curve), range_(range), edge_range_(edge_range), reversed_(reversed) {
    if (!in_space.IsNull())
      in_space_.Load(in_space);
  }

  bool reversed() const { return reversed_; } ///< whether the loop runs against the edge
  /// The parameters of the edge's ends.
  const std::array<double, 2>& edge_range() const { return edge_range_; }
  void set_projected(bool on) { projected_ = on; }
  /// A copy with caches of its own.
  coedge_curve independent_copy() const {
    coedge_curve copy = *this;
    copy.curve_ = Geom2dAdaptor_Curve(curve_.Curve());
    if (!in_space_.Curve().IsNull())
      copy.in_space_ = GeomAdaptor_Curve(in_space_.Curve());
    return copy;
  }

  /// The parameters on the face at parameter `t` of the edge.
  vec2 at(double t, const face_surface& surface) const {
    const double s = (t - edge_range_[0]) / (edge_range_[1] - edge_range_[0]);
    const bool same_range = range_ == edge_range_;
    const gp_Pnt2d p = curve_.Value(same_range ? t : range_[0] + s * (range_[1] - range_[0]));
    vec2 uv = vec2{p.X(), p.Y()} + periods_;
    if (projected_)
      uv = surface.project(to_vec3(in_space_.Value(t)), uv);
    return uv + (fading(s) * end_shift_[0] + fading(1 - s) * end_shift_[1]);
  }
  /// Where the loop enters it; it leaves it at `end`.
  vec2 start(const face_surface& surface) const { return at(edge_range_[reversed_ ? 1 : 0], surface); }
  vec2 end(const face_surface& surface) const { return at(edge_range_[reversed_ ? 0 : 1], surface); }

  /// Largest distance, by samples, between the point in space and the point on the surface.
  double deviation(const face_surface& surface) const {
    constexpr int samples = 61; // not a multiple of the 22 intervals that OCCT's own projection interpolates
    double worst = 0;
    for (int i = 0; !in_space_.Curve().IsNull() && i <= samples; ++i) {
      const double t = edge_range_[0] + (edge_range_[1] - edge_range_[0]) * i / samples;
      worst = std::max(worst, distance(surface.point(at(t, surface)), to_vec3(in_space_.Value(t))));
    }
    return worst;
  }

  /// Adds whole periods of the surface to all its parameters.
  void shift_by_periods(vec2 periods) { periods_ = periods_ + periods; }
  void shift_start(vec2 by) { shift_end_of(reversed_ ? 1 : 0, by); } ///< moves the parameters near its start
  void shift_end(vec2 by) { shift_end_of(reversed_ ? 0 : 1, by); }   ///< moves the parameters near its end

private:
  /// 1 at s = 0, 0 from a tenth of the range on.
  static double fading(double s) { return std::clamp(1 - 10 * s, 0.0, 1.0); }
  void shift_end_of(std::size_t end, vec2 by) { end_shift_[end] = end_shift_[end] + by; }

  Geom2dAdaptor_Curve curve_;
  std::array<double, 2> range_{0, 1};      ///< of `curve_`
  GeomAdaptor_Curve in_space_;             ///< empty for a pole
  std::array<double, 2> edge_range_{0, 1}; ///< of `in_space_`
  bool reversed_ = false;                  ///< passed from edge_range_[1] to edge_range_[0]
  bool projected_ = false;
  vec2 periods_{};
  std::array<vec2, 2> end_shift_{}; ///< at edge_range_[0] and edge_range_[1]
};

/// Makes the curve of an edge on a face; false when the edge has none there.
inline bool make_coedge_curve(const TopoDS_Edge& edge, const TopoDS_Face& face, coedge_curve& made) {
  std::array<double, 2> range{};
  const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, range[0], range[1]);
  if (curve.IsNull() || !(range[1] > range[0]))
    return false;
  std::array<double, 2> edge_range = range;
  Handle(Geom_Curve) in_space;
  if (!BRep_Tool::Degenerated(edge)) {
    std::array<double, 2> own{};
    in_space = BRep_Tool::Curve(edge, own[0], own[1]);
    if (!in_space.IsNull() && own[1] > own[0])
      edge_range = own;
  }
  made = coedge_curve(curve, range, in_space, edge_range, edge.Orientation() == TopAbs_REVERSED);
  return true;
}

} // namespace dovetail::occt
