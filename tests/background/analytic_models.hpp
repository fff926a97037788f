/// @file
/// Small models with known answers, without a CAD kernel.
#pragma once

#include "dovetail/geometry/concepts.hpp"

#include <cmath>
#include <numbers>

namespace dovetail::test {

inline constexpr double pi = std::numbers::pi;

/// What the analytic models share: curves and faces are given by functions, topology is filled by the model.
class analytic_model {
public:
  const geometry_topology& topology() const { return topology_; }
  bool thread_safe() const { return true; }
  double project_to_curve(local_id, vec3, double t) const { return t; }
  vec2 project_to_face(local_id, vec3, vec2 uv) const { return uv; }

protected:
  local_id add_curve(local_id from, local_id to, double t0, double t1, bool degenerate = false) {
    topology_.curves.push_back({{from, to}, {t0, t1}, 0, degenerate, {}});
    return static_cast<local_id>(topology_.curves.size()) - 1;
  }
  void add_face(const std::vector<std::vector<geometry_topology::coedge>>& loops, bool reversed,
                const std::string& name) {
    geometry_topology::face face;
    face.loops = loops;
    for (const auto& loop : loops)
      face.coedges.insert(face.coedges.end(), loop.begin(), loop.end());
    face.reversed = reversed;
    face.solids = {0, no_id};
    face.name = name;
    topology_.faces.push_back(face);
  }

  geometry_topology topology_;
};

/// A cylinder of radius 1 along z with two plane caps. Faces: 0 the side (one seam), 1 the lower cap, 2 the
/// upper one. Curves: 0 the lower circle, 1 the upper circle, 2 the seam.
class capped_cylinder : public analytic_model {
public:
  explicit capped_cylinder(double height) : height_(height) {
    topology_.vertices = {{{1, 0, 0}, 0}, {{1, 0, height}, 0}};
    topology_.solids.push_back({"cylinder"});
    add_curve(0, 0, 0, 2 * pi);
    add_curve(1, 1, 0, 2 * pi);
    add_curve(0, 1, 0, height);
    add_face({{{0, false}, {2, false}, {1, true}, {2, true}}}, false, "side");
    add_face({{{0, false}}}, true, "below");
    add_face({{{1, false}}}, false, "above");
  }
  dovetail::curve_frame curve_frame(local_id c, double t) const {
    if (c == 2)
      return {{1, 0, t}, {0, 0, 1}};
    return {{std::cos(t), std::sin(t), c == 0 ? 0 : height_}, {-std::sin(t), std::cos(t), 0}};
  }
  vec3 curve_point(local_id c, double t) const { return curve_frame(c, t).point; }
  vec2 curve_uv(local_id f, int k, double t) const {
    if (f > 0)
      return {std::cos(t), std::sin(t)};
    return k == 0 ? vec2{t, 0} : k == 1 ? vec2{2 * pi, t} : k == 2 ? vec2{t, height_} : vec2{0, t};
  }
  surface_frame face_frame(local_id f, vec2 uv) const {
    if (f > 0)
      return {{uv.x, uv.y, f == 1 ? 0 : height_}, {1, 0, 0}, {0, 1, 0}};
    return {{std::cos(uv.x), std::sin(uv.x), uv.y}, {-std::sin(uv.x), std::cos(uv.x), 0}, {0, 0, 1}};
  }
  vec3 face_point(local_id f, vec2 uv) const { return face_frame(f, uv).point; }
  double face_curvature(local_id f, vec2) const { return f == 0 ? 1 : 0; }
  box3 bounds() const { return {{-1, -1, 0}, {1, 1, height_}}; }

private:
  double height_;
};

/// The unit ball: one face with a seam (curve 0) and a pole at each end (curves 1 and 2).
class ball : public analytic_model {
public:
  ball() {
    topology_.vertices = {{{0, 0, -1}, 0}, {{0, 0, 1}, 0}};
    topology_.solids.push_back({"ball"});
    add_curve(0, 1, -pi / 2, pi / 2);
    add_curve(0, 0, 0, 2 * pi, true);
    add_curve(1, 1, 0, 2 * pi, true);
    add_face({{{1, false}, {0, false}, {2, true}, {0, true}}}, false, "sphere");
  }
  dovetail::curve_frame curve_frame(local_id c, double t) const {
    if (c > 0)
      return {{0, 0, c == 1 ? -1.0 : 1.0}, {}};
    return {{std::cos(t), 0, std::sin(t)}, {-std::sin(t), 0, std::cos(t)}};
  }
  vec3 curve_point(local_id c, double t) const { return curve_frame(c, t).point; }
  vec2 curve_uv(local_id, int k, double t) const {
    return k == 0 ? vec2{t, -pi / 2} : k == 1 ? vec2{2 * pi, t} : k == 2 ? vec2{t, pi / 2} : vec2{0, t};
  }
  surface_frame face_frame(local_id, vec2 uv) const {
    const double c = std::cos(uv.x), s = std::sin(uv.x), cv = std::cos(uv.y), sv = std::sin(uv.y);
    return {{c * cv, s * cv, sv}, {-s * cv, c * cv, 0}, {-c * sv, -s * sv, cv}};
  }
  vec3 face_point(local_id f, vec2 uv) const { return face_frame(f, uv).point; }
  double face_curvature(local_id, vec2) const { return 1; }
  box3 bounds() const { return {{-1, -1, -1}, {1, 1, 1}}; }
};

/// A plate of thickness `gap` between two discs whose rim is a pair of half circles each: narrow side faces.
/// Curves 0, 1: half circles below; 2, 3: above; 4, 5: the two uprights.
class thin_disc : public analytic_model {
public:
  explicit thin_disc(double gap) : gap_(gap) {
    topology_.vertices = {{{1, 0, 0}, 0}, {{-1, 0, 0}, 0}, {{1, 0, gap}, 0}, {{-1, 0, gap}, 0}};
    topology_.solids.push_back({"disc"});
    add_curve(0, 1, 0, pi);
    add_curve(1, 0, pi, 2 * pi);
    add_curve(2, 3, 0, pi);
    add_curve(3, 2, pi, 2 * pi);
    add_curve(0, 2, 0, gap);
    add_curve(1, 3, 0, gap);
    add_face({{{0, false}, {1, false}}}, true, "below");
    add_face({{{2, false}, {3, false}}}, false, "above");
    add_face({{{0, false}, {5, false}, {2, true}, {4, true}}}, false, "rim 1");
    add_face({{{1, false}, {4, false}, {3, true}, {5, true}}}, false, "rim 2");
  }
  dovetail::curve_frame curve_frame(local_id c, double t) const {
    if (c >= 4)
      return {{c == 4 ? 1.0 : -1.0, 0, t}, {0, 0, 1}};
    return {{std::cos(t), std::sin(t), c < 2 ? 0 : gap_}, {-std::sin(t), std::cos(t), 0}};
  }
  vec3 curve_point(local_id c, double t) const { return curve_frame(c, t).point; }
  vec2 curve_uv(local_id f, int k, double t) const {
    if (f < 2)
      return {std::cos(t), std::sin(t)};
    const double u0 = f == 2 ? 0 : pi;
    return k == 0 ? vec2{t, 0} : k == 1 ? vec2{u0 + pi, t} : k == 2 ? vec2{t, gap_} : vec2{u0, t};
  }
  surface_frame face_frame(local_id f, vec2 uv) const {
    if (f < 2)
      return {{uv.x, uv.y, f == 0 ? 0 : gap_}, {1, 0, 0}, {0, 1, 0}};
    return {{std::cos(uv.x), std::sin(uv.x), uv.y}, {-std::sin(uv.x), std::cos(uv.x), 0}, {0, 0, 1}};
  }
  vec3 face_point(local_id f, vec2 uv) const { return face_frame(f, uv).point; }
  double face_curvature(local_id f, vec2) const { return f < 2 ? 0 : 1; }
  box3 bounds() const { return {{-1, -1, 0}, {1, 1, gap_}}; }

private:
  double gap_;
};

static_assert(geometry_model<capped_cylinder> && geometry_model<ball> && geometry_model<thin_disc>);

} // namespace dovetail::test
