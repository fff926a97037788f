/// @file
/// Evaluation of and projection to the surface of one face.
#pragma once

#include "dovetail/geometry/concepts.hpp"
#include "dovetail/models/occt/shape.hpp"

#include <BRepTools.hxx>
#include <ElSLib.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_Surface.hxx>
#include <ShapeAnalysis_Surface.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace dovetail::occt {

/// A surface with the parameter rectangle of the face cut out of it. Queries change OCCT's evaluation cache,
/// so one object serves one thread.
class face_surface {
public:
  face_surface() = default;
  explicit face_surface(const TopoDS_Face& face) {
    Handle(Geom_Surface) surface = BRep_Tool::Surface(face); // in place: the location is applied
    // A trimmed surface hides that its basis is periodic, and the face's curves may leave its rectangle.
    while (surface->IsKind(STANDARD_TYPE(Geom_RectangularTrimmedSurface)))
      surface = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface)->BasisSurface();
    adaptor_.Load(surface);
    surface->Bounds(natural_[0][0], natural_[0][1], natural_[1][0], natural_[1][1]);
    period_ = {surface->IsUPeriodic() ? surface->UPeriod() : 0,
               surface->IsVPeriodic() ? surface->VPeriod() : 0};
    std::array<std::array<double, 2>, 2> box{};
    BRepTools::UVBounds(face, box[0][0], box[0][1], box[1][0], box[1][1]);
    set_box(box);
  }

  /// The rectangle around the face in the parameter plane; projections stay in it and a margin.
  void set_box(const std::array<std::array<double, 2>, 2>& box) {
    box_ = box;
    for (std::size_t k = 0; k < 2; ++k) {
      const double margin = search_margin * (box_[k][1] - box_[k][0]);
      search_[k] = {box_[k][0] - margin, box_[k][1] + margin};
      if (period_[k] == 0)
        search_[k] = {std::max(search_[k][0], natural_[k][0]), std::min(search_[k][1], natural_[k][1])};
    }
    const surface_frame middle = frame({0.5 * (box_[0][0] + box_[0][1]), 0.5 * (box_[1][0] + box_[1][1])});
    typical_ = {norm_squared(middle.du), norm_squared(middle.dv)};
  }
  /// The parameter rectangle of the face: for u and v the smallest and the largest.
  const std::array<std::array<double, 2>, 2>& box() const { return box_; }
  /// The period of the surface in u and v; 0 where it has none.
  const std::array<double, 2>& period() const { return period_; }
  const GeomAdaptor_Surface& adaptor() const { return adaptor_; } ///< for what else OCCT says of it
  /// A copy with a cache of its own.
  face_surface independent_copy() const {
    face_surface copy = *this;
    copy.adaptor_ = GeomAdaptor_Surface(adaptor_.Surface());
    return copy;
  }

  vec3 point(vec2 uv) const { return to_vec3(adaptor_.Value(uv.x, uv.y)); } ///< of the surface

  /// The point and its first derivatives.
  surface_frame frame(vec2 uv) const {
    gp_Pnt p;
    gp_Vec du, dv;
    adaptor_.D1(uv.x, uv.y, p, du, dv);
    return {to_vec3(p), to_vec3(du.XYZ()), to_vec3(dv.XYZ())};
  }

  /// Largest absolute principal curvature. At a singular parameter (a pole) it is taken a little inside.
  double curvature(vec2 uv) const {
    const vec2 middle{0.5 * (box_[0][0] + box_[0][1]), 0.5 * (box_[1][0] + box_[1][1])};
    for (const double inwards : {0.0, 1e-4, 1e-3, 1e-2, 1e-1}) {
      const auto k = regular_curvature((1 - inwards) * uv + inwards * middle);
      if (k)
        return *k;
    }
    return 0;
  }

  /// Parameters of the point of the surface nearest `p`, near the seed: on a periodic surface the result is
  /// the representative nearest the seed. Parameters stay inside the face's rectangle plus a margin.
  vec2 project(vec3 p, vec2 seed) const {
    const vec2 periods{whole_periods(seed.x, 0), whole_periods(seed.y, 1)};
    const vec2 inside = seed - periods;
    if (const auto uv = project_elementary(p, inside))
      return clamped(*uv) + periods;
    if (const auto uv = project_by_newton(p, clamped(inside)))
      return *uv + periods;
    return project_by_kernel(p, inside) + periods;
  }

private:
  static constexpr double search_margin = 0.02;
  static constexpr int max_newton_steps = 40;

  struct second_order {
    surface_frame first;
    vec3 duu, dvv, duv;
  };
  second_order derivatives(vec2 uv) const {
    gp_Pnt p;
    gp_Vec du, dv, duu, dvv, duv;
    adaptor_.D2(uv.x, uv.y, p, du, dv, duu, dvv, duv);
    return {{to_vec3(p), to_vec3(du.XYZ()), to_vec3(dv.XYZ())},
            to_vec3(duu.XYZ()),
            to_vec3(dvv.XYZ()),
            to_vec3(duv.XYZ())};
  }

  /// Empty where the first fundamental form is (nearly) singular.
  std::optional<double> regular_curvature(vec2 uv) const {
    const second_order d = derivatives(uv);
    const double e = dot(d.first.du, d.first.du), f = dot(d.first.du, d.first.dv),
                 g = dot(d.first.dv, d.first.dv);
    const vec3 normal = cross(d.first.du, d.first.dv);
    const double area_squared = norm_squared(normal);
    if (!(area_squared > 1e-16 * e * g) || !(e > 1e-12 * typical_[0]) || !(g > 1e-12 * typical_[1]))
      return std::nullopt;
    const vec3 n = normal / std::sqrt(area_squared);
    const double l = dot(d.duu, n), m = dot(d.duv, n), k = dot(d.dvv, n);
    const double gauss = (l * k - m * m) / area_squared;
    const double mean = (e * k - 2 * f * m + g * l) / (2 * area_squared);
    return std::abs(mean) + std::sqrt(std::max(0.0, mean * mean - gauss));
  }

  vec2 clamped(vec2 uv) const {
    return {std::clamp(uv.x, search_[0][0], search_[0][1]), std::clamp(uv.y, search_[1][0], search_[1][1])};
  }
  /// The periods by which a parameter is outside the face's rectangle.
  double whole_periods(double value, std::size_t k) const {
    if (period_[k] == 0 || (value >= search_[k][0] && value <= search_[k][1]))
      return 0;
    return period_[k] * std::round((value - 0.5 * (box_[k][0] + box_[k][1])) / period_[k]);
  }
  static double nearest_representative(double value, double seed, double period) {
    return period > 0 ? value + period * std::round((seed - value) / period) : value;
  }

  /// The closed forms for plane, cylinder, cone, sphere and torus.
  std::optional<vec2> project_elementary(vec3 p, vec2 seed) const {
    const gp_Pnt q = to_pnt(p);
    vec2 uv;
    vec3 axis_point{}, axis{}; // where all u are equally near, the seed's u is kept
    bool has_axis = true;
    switch (adaptor_.GetType()) {
    case GeomAbs_Plane:
      ElSLib::Parameters(adaptor_.Plane(), q, uv.x, uv.y);
      return uv;
    case GeomAbs_Cylinder: {
      const gp_Cylinder s = adaptor_.Cylinder();
      ElSLib::Parameters(s, q, uv.x, uv.y);
      axis_point = to_vec3(s.Location()), axis = to_vec3(s.Axis().Direction().XYZ());
      break;
    }
    case GeomAbs_Cone: {
      const gp_Cone s = adaptor_.Cone();
      ElSLib::Parameters(s, q, uv.x, uv.y);
      axis_point = to_vec3(s.Location()), axis = to_vec3(s.Axis().Direction().XYZ());
      break;
    }
    case GeomAbs_Sphere: {
      const gp_Sphere s = adaptor_.Sphere();
      ElSLib::Parameters(s, q, uv.x, uv.y);
      axis_point = to_vec3(s.Location()), axis = to_vec3(s.Position().Direction().XYZ());
      break;
    }
    case GeomAbs_Torus: {
      const gp_Torus s = adaptor_.Torus();
      ElSLib::Parameters(s, q, uv.x, uv.y);
      axis_point = to_vec3(s.Location()), axis = to_vec3(s.Axis().Direction().XYZ());
      break;
    }
    default:
      has_axis = false;
    }
    if (!has_axis)
      return std::nullopt;
    const vec3 from_axis = (p - axis_point) - dot(p - axis_point, axis) * axis;
    if (norm_squared(from_axis) <= 1e-24 * norm_squared(p - axis_point))
      uv.x = seed.x;
    // The kernel's nearest point of a cone may lie on its other nappe.
    const vec2 result{nearest_representative(uv.x, seed.x, period_[0]),
                      nearest_representative(uv.y, seed.y, period_[1])};
    if (adaptor_.GetType() == GeomAbs_Cone && (result.y < search_[1][0] || result.y > search_[1][1]))
      return std::nullopt;
    return result;
  }

  /// Damped Newton on half the squared distance; parameters at a bound that want to leave are held there.
  std::optional<vec2> project_by_newton(vec3 p, vec2 uv) const {
    second_order d = derivatives(uv);
    double value = 0.5 * norm_squared(d.first.point - p);
    for (int step = 0; step < max_newton_steps; ++step) {
      const vec2 direction = descent_direction(d, p, uv);
      const double length = norm(direction.x * d.first.du + direction.y * d.first.dv);
      const double scale = std::sqrt(2 * value) + 1e-3 * std::sqrt(face_scale_squared(d));
      if (length <= 1e-13 * scale || (direction.x == 0 && direction.y == 0))
        return uv;
      bool improved = false;
      for (double fraction = 1; fraction > 1e-4; fraction *= 0.25) {
        const vec2 trial = clamped(uv + fraction * direction);
        const second_order trial_d = derivatives(trial);
        const double trial_value = 0.5 * norm_squared(trial_d.first.point - p);
        if (trial_value < value) {
          improved = true;
          uv = trial, d = trial_d, value = trial_value;
          break;
        }
      }
      if (!improved) // no descent left: either converged to rounding, or stuck
        return length <= 1e-6 * scale ? std::optional(uv) : std::nullopt;
    }
    return std::nullopt;
  }

  double face_scale_squared(const second_order& d) const {
    const double wu = box_[0][1] - box_[0][0], wv = box_[1][1] - box_[1][0];
    return wu * wu * norm_squared(d.first.du) + wv * wv * norm_squared(d.first.dv);
  }

  /// Newton's direction where the Hessian is positive definite, else Gauss-Newton's.
  vec2 descent_direction(const second_order& d, vec3 p, vec2 uv) const {
    const vec3 r = d.first.point - p;
    vec2 gradient{dot(r, d.first.du), dot(r, d.first.dv)};
    const double guu = dot(d.first.du, d.first.du), guv = dot(d.first.du, d.first.dv),
                 gvv = dot(d.first.dv, d.first.dv);
    double a = guu + dot(r, d.duu), b = guv + dot(r, d.duv), c = gvv + dot(r, d.dvv);
    if (!(a * c - b * b > 1e-6 * guu * gvv) || !(a > 0))
      a = guu, b = guv, c = gvv;
    const auto held = [](double at, double slope, const std::array<double, 2>& range) {
      return (at <= range[0] && slope > 0) || (at >= range[1] && slope < 0);
    };
    const bool hold_u = held(uv.x, gradient.x, search_[0]) || !(a > 0),
               hold_v = held(uv.y, gradient.y, search_[1]) || !(c > 0);
    if (hold_u && hold_v)
      return {0, 0};
    if (hold_u)
      return {0, -gradient.y / c};
    if (hold_v)
      return {-gradient.x / a, 0};
    const double determinant = a * c - b * b;
    if (!(determinant > 1e-14 * a * c)) // parallel derivatives: steepest descent, scaled per direction
      return {-0.5 * gradient.x / a, -0.5 * gradient.y / c};
    return {(b * gradient.y - c * gradient.x) / determinant, (b * gradient.x - a * gradient.y) / determinant};
  }

  vec2 project_by_kernel(vec3 p, vec2 seed) const {
    ShapeAnalysis_Surface analysis(adaptor_.Surface());
    const gp_Pnt2d found = analysis.NextValueOfUV(gp_Pnt2d(seed.x, seed.y), to_pnt(p), 1e-9);
    return clamped({nearest_representative(found.X(), seed.x, period_[0]),
                    nearest_representative(found.Y(), seed.y, period_[1])});
  }

  GeomAdaptor_Surface adaptor_;
  std::array<std::array<double, 2>, 2> box_{};     ///< of the face's boundary in the parameter plane
  std::array<std::array<double, 2>, 2> search_{};  ///< the rectangle projections stay in
  std::array<std::array<double, 2>, 2> natural_{}; ///< the surface's own parameter rectangle
  std::array<double, 2> typical_{};    ///< squared derivative lengths in the middle, the scale for singular
  std::array<double, 2> period_{0, 0}; ///< zero where not periodic
};

} // namespace dovetail::occt
