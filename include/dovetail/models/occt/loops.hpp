/// @file
/// The loops of one face: its coedges in order, closed in the parameter plane, domain on the left.
#pragma once

#include "dovetail/models/occt/brep.hpp"
#include "dovetail/models/plane/segments.hpp"

#include <TopExp.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::occt {

/// A coedge with the edge it belongs to (as oriented in the FORWARD face).
struct loop_edge {
  TopoDS_Edge edge;   ///< as oriented in the FORWARD face
  coedge_curve curve; ///< its parameters on the face
};

/// The boundary of a face.
struct face_loops {
  /// The loops, each in the order that keeps the domain on the left.
  std::vector<std::vector<loop_edge>> loops;
  std::vector<std::string> faults; ///< what keeps the face from being meshed; empty when nothing does
  std::string note = {};           ///< what was done beyond what every face needs
  bool crosses_itself = false;     ///< still
};

/// The rectangle around loops in the parameter plane, by samples.
inline std::array<std::array<double, 2>, 2> box_of_loops(const face_loops& face,
                                                         const face_surface& surface) {
  constexpr int samples = 24;
  constexpr double far = std::numeric_limits<double>::max();
  std::array<std::array<double, 2>, 2> box{{{far, -far}, {far, -far}}};
  for (const auto& loop : face.loops) {
    for (const auto& item : loop) {
      const auto& range = item.curve.edge_range();
      for (int i = 0; i <= samples; ++i) {
        const vec2 uv = item.curve.at(range[0] + (range[1] - range[0]) * i / samples, surface);
        box[0] = {std::min(box[0][0], uv.x), std::max(box[0][1], uv.x)};
        box[1] = {std::min(box[1][0], uv.y), std::max(box[1][1], uv.y)};
      }
    }
  }
  return box;
}

/// Whether loops, closed as `close_gaps` closes them, cross or touch themselves or each other when each
/// coedge is made `parts` straight parts. An edge passed there and back in the same place is none.
inline bool loops_cross(const face_loops& face, const face_surface& surface, int parts) {
  std::vector<detail::drawn_segment> segments;
  for (const auto& loop : face.loops) {
    std::vector<coedge_curve> closed;
    for (const auto& item : loop)
      closed.push_back(item.curve);
    close_gaps(closed, surface);
    std::vector<vec2> points;
    for (const auto& curve : closed) {
      const auto [from, to] = curve.edge_range();
      for (int i = 0; i < parts; ++i) {
        const double s = static_cast<double>(curve.reversed() ? parts - i : i) / parts;
        const vec2 uv = curve.at(from + s * (to - from), surface);
        if (points.empty() || points.back() != uv)
          points.push_back(uv);
      }
    }
    for (std::size_t i = 0; i < points.size(); ++i)
      if (const vec2 next = points[(i + 1) % points.size()]; next != points[i])
        segments.push_back({points[i], next, 0, segments.size()});
  }
  return detail::first_meeting(segments,
                               [](const auto& s, const auto& t) {
                                 return !(s.from == t.to && s.to == t.from) && detail::segments_meet(s, t);
                               })
      .has_value();
}

/// How loops are made of a face's edges.
struct loop_manner {
  bool with_projection = true; ///< of parameter curves that stray from their 3D curves
  /// Small edges without a 3D curve whose images are longer than this share of the model are no poles.
  double longest_pole = 5e-7;
  /// The same for those that cross much of the face's parameter plane, as a pole does.
  double longest_wide_pole = 1e-4;
};

/// Orders and closes the loops of one face.
class loop_builder {
public:
  /// `size` is the diagonal of the model. Edges inside the face of which `is_loop` is true are loops too,
  /// there and back; others are left out, as they bound nothing.
  loop_builder(const TopoDS_Face& forward_face, const face_surface& surface, double size,
               std::function<bool(const TopoDS_Edge&)> is_loop)
      : face_(forward_face), surface_(surface), size_(size), worth_projecting_(1e-9 * size),
        is_loop_(std::move(is_loop)) {
    for (std::size_t k = 0; k < 2; ++k)
      width_[k] = std::max(surface.box()[k][1] - surface.box()[k][0], 1e-300);
  }

  /// Parameter curves that stray from their 3D curves are projected, and small edges that are no poles left
  /// out, unless the loops then fail to close. Where loops cross themselves, shorter ones are left out too.
  face_loops build() {
    face_loops made = build_once({});
    for (const loop_manner& manner : if_open)
      if (!made.faults.empty())
        if (face_loops other = build_once(manner); other.faults.empty())
          made = std::move(other);
    if (!made.faults.empty() || !crosses(made))
      return made;
    face_loops other = build_once({true, 0});
    if (!other.faults.empty() || crosses(other)) {
      made.crosses_itself = true;
      return made;
    }
    other.note = "its boundary crossed itself in the parameter plane; " + other.note;
    return other;
  }

private:
  static constexpr double same_parameter = 1e-6;
  static constexpr double small = 1e-3, much = 0.4; // of a face's rectangle
  static constexpr double unreachable = std::numeric_limits<double>::infinity();
  static constexpr std::array<loop_manner, 2> if_open{
      {{true, unreachable, unreachable}, {false, unreachable, unreachable}}};

  /// Curves cross where all samplings do: a coarse one crosses where curves are close to each other, and what
  /// only fine ones see is smaller than elements are.
  bool crosses(const face_loops& made) const {
    return loops_cross(made, surface_, 8) && loops_cross(made, surface_, 32) &&
           loops_cross(made, surface_, 128);
  }

  face_loops build_once(const loop_manner& how) {
    result_ = {};
    inner_ = {};
    how_ = how;
    for (TopoDS_Iterator wires(face_); wires.More(); wires.Next())
      if (wires.Value().ShapeType() == TopAbs_WIRE)
        add_wire(TopoDS::Wire(wires.Value()));
    if (result_.loops.empty() && result_.faults.empty())
      result_.faults.emplace_back("has no boundary");
    if (result_.faults.empty())
      check_orientation();
    std::move(inner_.begin(), inner_.end(), std::back_inserter(result_.loops));
    return std::move(result_);
  }

  /// Wires may list their edges in any order; consecutive coedges share a vertex and a parameter point.
  void add_wire(const TopoDS_Wire& wire) {
    std::vector<loop_edge> left;
    for (TopoDS_Iterator edges(wire); edges.More(); edges.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(edges.Value());
      if (edge.Orientation() != TopAbs_FORWARD && edge.Orientation() != TopAbs_REVERSED) {
        if (edge.Orientation() == TopAbs_INTERNAL && is_loop_(edge))
          add_inner_edge(edge);
        continue;
      }
      loop_edge made{edge, {}};
      if (!make_coedge_curve(edge, face_, made.curve)) {
        result_.faults.emplace_back("has an edge without a curve in its parameter plane");
        return;
      }
      if (BRep_Tool::Degenerated(edge) && !is_pole(made.curve)) {
        if (extent_of(made.curve) > same_parameter)
          result_.note = "edges without a curve in space that are no poles were left out";
        continue;
      }
      if (how_.with_projection)
        improve(made);
      left.push_back(std::move(made));
    }
    while (!left.empty()) {
      std::vector<loop_edge> loop = take_loop(left);
      if (!is_closed_but_for_tolerances(loop))
        return;
      result_.loops.push_back(std::move(loop));
    }
  }

  /// A pole has an extent in the parameter plane, and none in space.
  bool is_pole(const coedge_curve& curve) const {
    const double extent = extent_of(curve);
    if (extent > small && extent < much)
      return true;
    return extent > same_parameter &&
           length_on_surface(curve) <= (extent < much ? how_.longest_pole : how_.longest_wide_pole) * size_;
  }

  double extent_of(const coedge_curve& curve) const {
    return gap(curve.start(surface_), curve.end(surface_));
  }

  double length_on_surface(const coedge_curve& curve) const {
    constexpr int samples = 16;
    const auto [from, to] = curve.edge_range();
    double length = 0;
    vec3 before = surface_.point(curve.at(from, surface_));
    for (int i = 1; i <= samples; ++i) {
      const vec3 now = surface_.point(curve.at(from + (to - from) * i / samples, surface_));
      length += distance(before, now);
      before = now;
    }
    return length;
  }

  void add_inner_edge(const TopoDS_Edge& edge) {
    std::vector<loop_edge> there_and_back;
    for (const TopAbs_Orientation direction : {TopAbs_FORWARD, TopAbs_REVERSED}) {
      loop_edge made{TopoDS::Edge(edge.Oriented(direction)), {}};
      if (!make_coedge_curve(made.edge, face_, made.curve)) {
        result_.faults.emplace_back("has an inner edge without a curve in its parameter plane");
        return;
      }
      there_and_back.push_back(std::move(made));
    }
    inner_.push_back(std::move(there_and_back));
  }

  /// Replaces a parameter curve that strays from its 3D curve by the projection of that curve, if that helps.
  /// The two passages of a seam stay on the rims of the parameter plane.
  void improve(loop_edge& made) const {
    const double stray = made.curve.deviation(surface_);
    if (stray <= worth_projecting_ || BRep_Tool::IsClosed(made.edge, face_))
      return;
    made.curve.set_projected(true);
    if (!(made.curve.deviation(surface_) < 0.5 * stray))
      made.curve.set_projected(false);
  }

  /// Takes one closed chain off `left`, starting with its first edge. Where several edges continue the chain
  /// the one nearest in the parameter plane does (the two passages of a seam share their vertices).
  std::vector<loop_edge> take_loop(std::vector<loop_edge>& left) const {
    std::vector<loop_edge> loop{left.front()};
    left.erase(left.begin());
    const TopoDS_Vertex start = TopExp::FirstVertex(loop.front().edge, true);
    for (;;) {
      const TopoDS_Vertex at = TopExp::LastVertex(loop.back().edge, true);
      const vec2 uv = loop.back().curve.end(surface_);
      std::size_t best = left.size();
      double best_gap = at.IsSame(start) ? gap(uv, loop.front().curve.start(surface_)) : unreachable;
      if (at.IsSame(start) && best_gap <= same_parameter)
        return loop;
      for (std::size_t i = 0; i < left.size(); ++i) {
        if (!TopExp::FirstVertex(left[i].edge, true).IsSame(at))
          continue;
        const double g = gap(uv, left[i].curve.start(surface_));
        if (g < best_gap)
          best = i, best_gap = g;
      }
      if (best == left.size())
        return loop;
      loop.push_back(left[best]);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
    }
  }

  /// Removes whole periods between consecutive coedges; what is left must be within tolerances.
  bool is_closed_but_for_tolerances(std::vector<loop_edge>& loop) {
    for (std::size_t i = 0; i + 1 < loop.size(); ++i)
      loop[i + 1].curve.shift_by_periods(
          whole_periods(loop[i + 1].curve.start(surface_) - loop[i].curve.end(surface_)));
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const vec2 end = loop[i].curve.end(surface_);
      const loop_edge& next = loop[(i + 1) % loop.size()];
      if (!is_closable(loop[i].edge, next.edge, end, next.curve.start(surface_))) {
        result_.faults.push_back("has a boundary loop that does not close in its parameter plane near " +
                                 to_text(surface_.point(end)));
        return false;
      }
    }
    return true;
  }

  /// A gap is harmless when it is within a few tolerances in space and, so that no pole's edge is
  /// missing, clearly less than the face's width in the plane.
  bool is_closable(const TopoDS_Edge& edge, const TopoDS_Edge& next, vec2 a, vec2 b) const {
    const double g = gap(a, b);
    if (g <= same_parameter)
      return true;
    const TopoDS_Vertex vertex = TopExp::LastVertex(edge, true);
    const double tolerance = std::max({vertex.IsNull() ? 0.0 : BRep_Tool::Tolerance(vertex),
                                       BRep_Tool::Tolerance(edge), BRep_Tool::Tolerance(next)});
    return g <= 0.4 && distance(surface_.point(a), surface_.point(b)) <= 4 * tolerance + 1e-9;
  }

  vec2 whole_periods(vec2 jump) const {
    const auto part = [](double gap, double period) {
      return period > 0 ? -period * std::round(gap / period) : 0.0;
    };
    return {part(jump.x, surface_.period()[0]), part(jump.y, surface_.period()[1])};
  }

  /// Distance relative to the face's rectangle, so that both parameters count alike.
  double gap(vec2 a, vec2 b) const {
    return std::max(std::abs(a.x - b.x) / width_[0], std::abs(a.y - b.y) / width_[1]);
  }

  /// One loop must run counter-clockwise, around all others, which run clockwise.
  void check_orientation() {
    int outer = 0;
    for (const auto& loop : result_.loops)
      outer += signed_area(loop) > 0 ? 1 : 0;
    if (outer == 0)
      result_.faults.emplace_back("has no outer boundary loop that keeps the face on its left");
    if (outer > 1)
      result_.faults.emplace_back("has several outer boundary loops");
  }

  /// Area enclosed by a loop in the parameter plane, by samples; positive counter-clockwise.
  double signed_area(const std::vector<loop_edge>& loop) const {
    constexpr int samples = 24;
    double twice = 0;
    const vec2 origin = loop.front().curve.start(surface_);
    for (const auto& item : loop) {
      const auto& range = item.curve.edge_range();
      vec2 before = item.curve.start(surface_) - origin;
      for (int i = 1; i <= samples; ++i) {
        const double s = static_cast<double>(item.curve.reversed() ? samples - i : i) / samples;
        const vec2 now = item.curve.at(range[0] + s * (range[1] - range[0]), surface_) - origin;
        twice += cross(before, now);
        before = now;
      }
    }
    return 0.5 * twice;
  }

  const TopoDS_Face& face_;
  const face_surface& surface_;
  double size_;
  double worth_projecting_;
  std::function<bool(const TopoDS_Edge&)> is_loop_; ///< of edges inside the face
  loop_manner how_;
  std::array<double, 2> width_{};
  face_loops result_;
  std::vector<std::vector<loop_edge>> inner_; ///< of inner edges
};

} // namespace dovetail::occt
