/// Details far smaller than the size: what is given up, what stays, and that what is left is a model.
#include "dovetail/models/occt_model.hpp"
#include "dovetail/models/virtual/block_vector.hpp"
#include "dovetail/models/virtual_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/kept_details.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "models/discrete_shapes.hpp"
#include "models/virtual_shapes.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepFilletAPI_MakeChamfer.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRep_Builder.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <doctest/doctest.h>
#include <gp_Ax2.hxx>
#include <gp_Circ.hxx>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

using namespace dovetail;
using namespace dovetail::testing;
using kind = suppressed_detail::kind;

namespace {

constexpr double limit = 0.25;

/// At size 1: narrower than a quarter is a detail. No faces are joined.
virtual_model without_details(const any_geometry& given, double size = 1) {
  virtual_model made(given, uniform_size(size), {.share_of_joined = 0});
  CHECK(virtual_checks(made, given, 0.25 * size).faults() == "");
  return made;
}

std::vector<kind> kinds_of(const virtual_model& model) {
  std::vector<kind> kinds;
  for (const auto& one : model.suppressed())
    kinds.push_back(one.what);
  return kinds;
}

void check_kept_whole(const any_geometry& given) {
  const virtual_model made = without_details(given);
  CHECK(made.suppressed().empty());
  CHECK(counts_of(made.topology()) == counts_of(given.topology()));
}

/// Between the curves of a face's only loop, where they meet.
double sharpest_corner_deg(const any_geometry& model, local_id face) {
  const auto& loop = model.topology().faces[face].coedges;
  const auto direction = [&](std::size_t k, bool at_end) {
    const auto& passed = loop[k % loop.size()];
    const auto& t = model.topology().curves[passed.curve].t;
    const vec3 along = model.curve_frame(passed.curve, t[at_end != passed.reversed ? 1 : 0]).derivative;
    return normalized(passed.reversed ? -along : along);
  };
  double sharpest = 180;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const double between = std::acos(-dot(direction(k, true), direction(k + 1, false)));
    sharpest = std::min(sharpest, degrees_per_radian * between);
  }
  return sharpest;
}

occt_model model_of(const TopoDS_Shape& shape) {
  return occt_shape_from(shape).model;
}

/// Edges of a shape whose middle is so.
template <class Predicate>
std::vector<TopoDS_Edge> edges_where(const TopoDS_Shape& shape, Predicate&& is_so) {
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  std::vector<TopoDS_Edge> found;
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(i));
    const BRepAdaptor_Curve curve(edge);
    if (const gp_Pnt p = curve.Value(0.5 * (curve.FirstParameter() + curve.LastParameter()));
        is_so(vec3{p.X(), p.Y(), p.Z()}))
      found.push_back(edge);
  }
  return found;
}

template <class Predicate>
TopoDS_Shape chamfered(const TopoDS_Shape& shape, double width, Predicate&& is_so) {
  BRepFilletAPI_MakeChamfer made(shape);
  for (const TopoDS_Edge& edge : edges_where(shape, is_so))
    made.Add(width, edge);
  return made.Shape();
}

/// A cylinder on one of another radius, turned against it.
TopoDS_Shape stepped_cylinder(double radius, double turn, double upper_radius = 5) {
  const gp_Ax2 turned(gp_Pnt(0, 0, 4), gp_Dir(0, 0, 1), gp_Dir(std::cos(turn), std::sin(turn), 0));
  return BRepAlgoAPI_Fuse(BRepPrimAPI_MakeCylinder(radius, 4).Shape(),
                          BRepPrimAPI_MakeCylinder(turned, upper_radius, 4).Shape())
      .Shape();
}

TopoDS_Shape run_out_fillet() {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(10, 10, 10).Shape();
  BRepFilletAPI_MakeFillet made(box);
  for (const TopoDS_Edge& edge : edges_where(box, [](vec3 p) { return p.x > 9 && p.y > 9; }))
    made.Add(0.01, 3, edge);
  return made.Shape();
}

/// A cube with a chamfer that begins at a point, and a round hole in it.
TopoDS_Shape run_out_chamfer_with_hole() {
  const gp_Dir normal(1, 1, 0.1), along(1, -1, 0);
  const gp_Pnt corner =
      gp_Pnt(10, 10, 0).Translated(-20 * gp_Vec(along) - 20 * gp_Vec(normal.Crossed(along)));
  const TopoDS_Shape beyond = BRepPrimAPI_MakeBox(gp_Ax2(corner, normal, along), 40, 40, 10).Shape();
  const TopoDS_Shape drill = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(7.6, 7.6, 7.8), normal), 0.2, 9).Shape();
  const TopoDS_Shape cut = BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(10, 10, 10).Shape(), beyond).Shape();
  return BRepAlgoAPI_Cut(cut, drill).Shape();
}

} // namespace

TEST_CASE("a chamfer far narrower than the size becomes the edge that it was made of") {
  const discrete_model given = chamfered_cube(0.1, 0.1).model();
  const virtual_model made = without_details(given);
  REQUIRE(kinds_of(made) == std::vector{kind::narrow_face});
  const auto& [what, face, place, width] = made.suppressed()[0];
  CHECK(distance(place, {9.95, 9.95, 5}) < 0.1);
  CHECK(distance(given.face_point(face, given.curve_uv(face, 0, 0)), {9.95, 9.95, 5}) < 5.1);
  CHECK(width == doctest::Approx(0.1 * std::numbers::sqrt2));
  CHECK(counts_of(given.topology()) == entity_counts{7, 15, 10});
  CHECK(counts_of(made.topology()) == entity_counts{6, 12, 8});
  CHECK(made.summary().get("narrow_faces") == 1);
  CHECK(made.summary().get("short_edges") == 0);
  CHECK(made.summary().get("largest") == width);
}

TEST_CASE("a strip stays where the faces at both of its sides would fold onto a hole of theirs") {
  const TopoDS_Shape strip =
      chamfered(BRepPrimAPI_MakeBox(10, 10, 10).Shape(), 0.1, [](vec3 p) { return p.x > 9 && p.y > 9; });
  // Each hole begins beside the strip, but not at it, and is far too long to be a detail.
  const auto drilled = [](const TopoDS_Shape& shape, gp_Pnt from, const gp_Dir& inwards) {
    const gp_Ax2 axis(from, inwards);
    return BRepAlgoAPI_Cut(shape, BRepPrimAPI_MakeCylinder(axis, 0.14, 1).Shape()).Shape();
  };
  const TopoDS_Shape one_hole = drilled(strip, gp_Pnt(10, 9.75, 5), gp_Dir(-1, 0, 0));
  const TopoDS_Shape two_holes = drilled(one_hole, gp_Pnt(9.75, 10, 7.5), gp_Dir(0, -1, 0));
  CHECK(kinds_of(without_details(model_of(strip))) == std::vector{kind::narrow_face});
  CHECK(kinds_of(without_details(model_of(one_hole))) == std::vector{kind::narrow_face});
  CHECK(kinds_of(without_details(model_of(two_holes))).empty());
}

TEST_CASE("of many strips in a row some stay: no face is moved by more than one may be wide") {
  outline row{{0, 0}, {10, 0}};
  for (int i = 0; i <= 6; ++i)
    row.push_back({10, 3 + 0.12 * i});
  row.insert(row.end(), {{10, 10}, {0, 10}});
  const virtual_model made =
      without_details(prism(row, row, {5, 5}, {0, 10}, [](std::size_t side, std::size_t) {
                        return static_cast<local_id>(side % 2); // there are large faces in both groups
                      }).model());
  CHECK(made.suppressed().size() >= 2);
  CHECK(made.suppressed().size() < 6);
}

TEST_CASE("a step in a side is the edge between what is before and behind it") {
  const outline stepped{{0, 0}, {5, 0}, {5.05, -0.1}, {10, -0.1}, {10, 10}, {0, 10}};
  const virtual_model made = without_details(prism(stepped, stepped, {5, 5}, {0, 10}).model());
  CHECK(kinds_of(made) == std::vector{kind::narrow_face});
  CHECK(counts_of(made.topology()) == entity_counts{7, 15, 10});
}

TEST_CASE("a short edge between long ones becomes the vertex of theirs that has more curves") {
  polygon_surface jog = prism({{0, 0}, {5, 0}, {10, 0}, {10, 10}, {5.1, 10}, {0, 10}},
                              {{0, 0}, {5, 0}, {10, 0}, {10, 10}, {5.1, 10}, {0, 10}}, {5, 5}, {0, 10});
  const auto is_top = [&](const simplex<2>& t) {
    return std::all_of(t.begin(), t.end(), [&](local_id v) { return jog.points[v].z == 10; });
  };
  std::erase_if(jog.triangles, is_top);
  jog.ids.assign(jog.triangles.size(), no_id);
  jog.add({{0, 0, 10}, {5, 0, 10}, {5, 5, 10}, {5.1, 5, 10}, {5.1, 10, 10}, {0, 10, 10}}, {2, 5, 10}, 1);
  jog.add({{10, 0, 10}, {10, 10, 10}, {5.1, 10, 10}, {5.1, 5, 10}, {5, 5, 10}, {5, 0, 10}}, {8, 5, 10}, 2);
  const discrete_model given = jog.model();
  const virtual_model made = without_details(given);
  REQUIRE(kinds_of(made) == std::vector{kind::short_edge});
  CHECK(made.suppressed()[0].length == doctest::Approx(0.1));
  CHECK(distance(made.suppressed()[0].place, {5.05, 5, 10}) < 1e-9);
  CHECK(distance(given.curve_point(made.suppressed()[0].entity, 0), {5.05, 5, 10}) < 0.051);
  CHECK(made.summary().get("short_edges") == 1);
  const auto before = counts_of(given.topology()), after = counts_of(made.topology());
  CHECK(after == entity_counts{before.faces, before.curves - 1, before.vertices - 1});
}

TEST_CASE("a short edge stays where a corner of a face would be sharp without it") {
  const auto with_corner = [](double degrees) {
    const double end = 5.1 + 5 * std::tan(degrees * std::numbers::pi / 180);
    const outline base{{0, 0}, {5, 0}, {end, 0}, {10, 0}, {10, 10}, {0, 10}};
    polygon_surface made = prism(base, base, {5, 5}, {0, 10});
    const auto is_top = [&](const simplex<2>& t) {
      return std::all_of(t.begin(), t.end(), [&](local_id v) { return made.points[v].z == 10; });
    };
    std::erase_if(made.triangles, is_top);
    made.ids.assign(made.triangles.size(), no_id);
    made.add({{5, 0, 10}, {end, 0, 10}, {5.1, 5, 10}, {5, 5, 10}}, {5.5, 2, 10}, 1);
    made.add({{end, 0, 10}, {10, 0, 10}, {10, 10, 10}, {5.1, 5, 10}}, {8, 2, 10}, 2);
    made.add({{5.1, 5, 10}, {10, 10, 10}, {0, 10, 10}, {0, 0, 10}, {5, 0, 10}, {5, 5, 10}}, {4, 6, 10}, 2);
    return made.model();
  };
  CHECK(kinds_of(without_details(with_corner(33))) == std::vector{kind::short_edge});
  CHECK(kinds_of(without_details(with_corner(24))).empty());
}

TEST_CASE("where a neighbour's vertex is on one side of a strip only, the other side gets one") {
  for (const std::size_t side : {1U, 3U}) { // before and behind it
    const auto cube = chamfered_cube(0.1, 0.15, {0, 2, 5, 8, 10}, [side](std::size_t s, std::size_t layer) {
      return s == side ? static_cast<local_id>(layer) : no_id;
    });
    const discrete_model given = cube.model();
    const virtual_model made = without_details(given);
    CHECK(kinds_of(made) == std::vector{kind::narrow_face});
    CHECK(made.topology().curves.size() == given.topology().curves.size() + 3);
    CHECK(counts_of(made.topology()) == entity_counts{9, 9 + 12, 8 + 6});
  }
}

TEST_CASE("a strip that is all that is left of a named group stays") {
  outline both = chamfered_square(0.1);
  both[0] = {0.1, 0};
  both.push_back({0, 0.1});
  const auto groups = [&](local_id first, local_id second) {
    return prism(both, both, {5, 5}, {0, 10},
                 [=](std::size_t s, std::size_t) { return s == 2   ? first
                                                          : s == 5 ? second
                                                                   : no_id; })
        .model();
  };
  CHECK(without_details(groups(no_id, no_id)).suppressed().size() == 2);
  CHECK(without_details(groups(7, no_id)).suppressed().size() == 1);
  CHECK(without_details(groups(7, 8)).suppressed().empty());
  CHECK(without_details(groups(7, 7)).suppressed().size() == 1);
}

TEST_CASE("the end of a face that begins at a point is cut where it is wide enough") {
  const discrete_model given = chamfered_cube(0, 1).model();
  const virtual_model made = without_details(given);
  REQUIRE(kinds_of(made) == std::vector{kind::narrow_end});
  const auto& [what, face, place, width] = made.suppressed()[0];
  CHECK(made.topology().faces[face].coedges.size() == 3);
  CHECK(width == doctest::Approx(0.9 * limit).epsilon(0.01));
  CHECK(place.z == doctest::Approx(0.5 * 0.9 * limit * 10 / std::numbers::sqrt2).epsilon(0.05));
  CHECK(made.summary().get("narrow_ends") == 1);
  CHECK(counts_of(made.topology()) == entity_counts{7, 15, 10});
  check_kept_whole(chamfered_cube(0, 10.0 / 2).model()); // wide at once
}

TEST_CASE("what is left of a strip whose end was cut is blunt there, however short") {
  for (const double width : {0.4, 0.55, 0.7}) {
    CAPTURE(width);
    const double across = width * std::numbers::sqrt2;
    const virtual_model made(any_geometry(chamfered_cube(width, width).model()),
                             [&](vec3 p) { return (p.z < 3 ? 1.3 : 0.5) * across / 0.25; });
    REQUIRE(kinds_of(made) == std::vector{kind::narrow_end});
    CHECK(made.suppressed()[0].place.z < 3);
    CHECK(sharpest_corner_deg(any_geometry(made), made.suppressed()[0].entity) > 18);
  }
}

TEST_CASE("a curve whose vertex goes along it goes on, and turns no more than it may") {
  for (const double length : {0.5, 0.7, 0.9, 5.0}) {
    CAPTURE(length);
    // An undercut step between two sides that are so long: one of them goes back over it to the other.
    const double end = 4.95 + length;
    const outline drawn{{5 - length, 0}, {5, 0}, {4.95, -0.1}, {end, -0.1}, {end, 10}, {5 - length, 10}};
    const virtual_model made = without_details(prism(drawn, drawn, {5.4, 0.5}, {0, 10}).model());
    REQUIRE(kinds_of(made) == std::vector{kind::narrow_face});
    for (std::size_t c = 0; c < made.topology().curves.size(); ++c) {
      const auto id = static_cast<local_id>(c);
      const auto& t = made.topology().curves[c].t;
      const vec3 along = made.curve_point(id, t[1]) - made.curve_point(id, t[0]);
      constexpr int steps = 64;
      for (int i = 0; i < steps; ++i) {
        const auto at = [&](int k) { return made.curve_point(id, t[0] + (t[1] - t[0]) * k / steps); };
        const vec3 step = at(i + 1) - at(i);
        CHECK(dot(step, along) > 0.25 * norm_squared(along) / steps);
        CHECK(dot(step, along) > std::cos(35 / degrees_per_radian) * norm(step) * norm(along));
      }
    }
  }
}

TEST_CASE("the end that is cut leaves no short edge, nor a face that is all but gone") {
  const auto split_neighbour = [](std::size_t side, std::size_t layer) {
    return side == 1 ? static_cast<local_id>(layer) : no_id;
  };
  // Cut at 1.59 the second side would have a rest of 0.01.
  const virtual_model made = without_details(chamfered_cube(0, 1, {0, 1.6, 10}, split_neighbour).model());
  REQUIRE(kinds_of(made) == std::vector{kind::narrow_end});
  CHECK(made.suppressed()[0].length == doctest::Approx(0.9 * limit * (1.6 - limit) / 1.59).epsilon(0.01));
  CHECK(counts_of(made.topology()) == entity_counts{8, 18, 12});
  const auto split_chamfer = [](std::size_t side, std::size_t layer) {
    return side == 2 ? static_cast<local_id>(layer) : no_id;
  };
  check_kept_whole(chamfered_cube(0, 1, {0, 1.8, 10}, split_chamfer).model());
}

TEST_CASE("an end is no wider than the least limit along it") {
  const discrete_model given = chamfered_cube(0, 1).model();
  const virtual_model made(given, [](vec3 p) { return 0.4 + 0.2 * p.z; });
  REQUIRE(kinds_of(made) == std::vector{kind::narrow_end});
  CHECK(made.suppressed()[0].length == doctest::Approx(0.9 * limit * 0.4).epsilon(0.02));
}

TEST_CASE("an end is narrow as far as it is so, into whatever curves its sides are cut") {
  const auto box = [](double x, double y, double z, double dx, double dy, double dz) {
    return BRepPrimAPI_MakeBox(gp_Pnt(x, y, z), dx, dy, dz).Shape();
  };
  // Two blocks beside each other, nearly as high as the one behind them: a strip of its side is left above
  // them, 0.1 high, and the first of the curves below it is shorter than three limits.
  BRepAlgoAPI_Fuse with_first(box(0, 0, 0, 10, 10, 10), box(0, -3, 0, 0.6, 3, 9.9));
  BRepAlgoAPI_Fuse with_both(with_first.Shape(), box(0.6, -2, 0, 5.4, 2, 9.9));
  const occt_model given = model_of(with_both.Shape());
  const virtual_model made = without_details(given);
  CHECK(kinds_of(made) == std::vector{kind::narrow_end, kind::narrow_end});
  for (const auto& one : made.suppressed())
    CHECK(one.length == doctest::Approx(0.1));
}

TEST_CASE("what is large enough stays, and so does everything at no share of the size") {
  check_kept_whole(chamfered_cube(0.2, 0.2).model());
  check_kept_whole(
      discrete_model(box_soup({0, 0, 0}, {1, 1, 1}, 2).points, box_soup({0, 0, 0}, {1, 1, 1}, 2).triangles));
  const discrete_model given = chamfered_cube(0.1, 0.1).model();
  CHECK(virtual_model(given, uniform_size(1.0), {.share_of_size = 0}).suppressed().empty());
  CHECK(virtual_model(given, uniform_size(0.5)).suppressed().empty());
  CHECK(virtual_model(given, uniform_size(0.5), {.share_of_size = 0.5}).suppressed().size() == 1);
  const auto small_there = [](vec3 p) { return p.x > 9 && p.y > 9 ? 0.5 : 1.0; };
  CHECK(virtual_model(given, small_there).suppressed().empty());
  for (const double share : {-0.1, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(virtual_model(given, uniform_size(1.0), {.share_of_size = share}), sizing_error);
  CHECK_THROWS_AS(virtual_model(given, uniform_size(1.0), {.least_angle_deg = -1}), sizing_error);
  CHECK_THROWS_AS(virtual_model(given, uniform_size(1.0), {.least_corner_deg = -1}), sizing_error);
}

namespace {

/// A wall that bends outwards, with a flat face between two round ones, so wide: where they meet the surface
/// turns back on itself.
TopoDS_Shape wall_with_fold(double width) {
  const auto line = [](gp_Pnt a, gp_Pnt b) { return BRepBuilderAPI_MakeEdge(a, b).Edge(); };
  const auto arc = [](gp_Pnt centre, gp_Pnt from, gp_Pnt to, bool turns_left) {
    const gp_Circ circle(gp_Ax2(centre, gp_Dir(0, 0, turns_left ? 1 : -1)), 1);
    return BRepBuilderAPI_MakeEdge(circle, from, to).Edge();
  };
  const double foot = 1 - width;
  BRepBuilderAPI_MakeWire wire;
  wire.Add(line({0, 0, 0}, {3, 0, 0}));
  wire.Add(arc({3, 1, 0}, {3, 0, 0}, {4, 1, 0}, true));
  wire.Add(line({4, 1, 0}, {4, foot, 0}));
  wire.Add(arc({5, foot, 0}, {4, foot, 0}, {5, foot + 1, 0}, false));
  wire.Add(line({5, foot + 1, 0}, {5, 4, 0}));
  wire.Add(line({5, 4, 0}, {0, 4, 0}));
  wire.Add(line({0, 4, 0}, {0, 0, 0}));
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp_Vec(0, 0, 1)).Shape();
}

} // namespace

TEST_CASE("a face along which the surface turns back on itself is a detail up to the size itself") {
  const occt_model given = model_of(wall_with_fold(0.1));
  const virtual_model made(given, uniform_size(0.3));
  CHECK(virtual_checks(made, given, 0.3).faults() == "");
  CHECK(kinds_of(made) == std::vector{kind::narrow_face});
  CHECK(made.suppressed().front().length == doctest::Approx(0.1));
  CHECK(virtual_model(given, uniform_size(0.3), {.share_of_folded = 0.25}).suppressed().empty());
  CHECK(virtual_model(given, uniform_size(0.3), {.share_of_size = 0}).suppressed().empty());
  CHECK(virtual_model(given, uniform_size(0.09)).suppressed().empty());
  CHECK(generate<3>(made, uniform_size(0.3), parameters<>{}.with_options({.subdomains = 1}))
            .quality.min_dihedral_deg > 12);
  // A face as wide between two that go on is none.
  CHECK(virtual_model(chamfered_cube(0.1, 0.1).model(), uniform_size(0.3)).suppressed().empty());
  CHECK_THROWS_AS(virtual_model(given, uniform_size(1.0), {.share_of_folded = -1}), sizing_error);
}

namespace {

/// The prism over an outline that goes along the upper side of a bar: corners of x and height.
TopoDS_Shape bar_with_profile(const std::vector<vec2>& profile) {
  BRepBuilderAPI_MakePolygon outline;
  for (const vec2 p : profile)
    outline.Add(gp_Pnt(p.x, 0, p.y));
  outline.Add(gp_Pnt(20, 0, -5));
  outline.Add(gp_Pnt(0, 0, -5));
  outline.Close();
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(outline.Wire()).Face(), gp_Vec(0, 4, 0)).Shape();
}

} // namespace

TEST_CASE("undercuts, ribs, grooves, steps and teeth stay, however sharp they are") {
  const auto stays = [](const TopoDS_Shape& shape) {
    CHECK(virtual_model(model_of(shape), uniform_size(1.0)).suppressed().empty());
  };
  stays(bar_with_profile({{0, 0}, {10, 0}, {9.13, 0.23}, {20, 0.23}})); // an undercut of 15 degrees
  for (const double half : {0.15, 0.08, 0.04}) {
    CAPTURE(half);
    for (const double height : {0.95, -0.95})
      stays(bar_with_profile({{0, 0}, {10 - half, 0}, {10, height}, {10 + half, 0}, {20, 0}}));
    std::vector<vec2> teeth{{0, 0}};
    for (int k = 0; k < 5; ++k)
      for (const vec2 p : {vec2{-half, 0}, vec2{0, 0.95}})
        teeth.push_back({10 + 2 * half * k + p.x, p.y});
    teeth.push_back({10 + 9 * half, 0});
    teeth.push_back({20, 0});
    stays(bar_with_profile(teeth));
    stays(bar_with_profile({{0, 0}, {10, 0}, {10, 0.9}, {10 + half, 0.1}, {10 + 2 * half, 0.9}, {20, 0.9}}));
  }
}

TEST_CASE("copies of a sequence in blocks share what is the same in both") {
  std::vector<int> items(100);
  std::iota(items.begin(), items.end(), 0);
  virtual_topology::block_vector<int> first(items);
  auto second = first;
  second.change(40) = -1;
  second.push_back(100);
  first.push_back(7);
  CHECK(first.size() == 101);
  CHECK(second.size() == 101);
  for (std::size_t i = 0; i < 100; ++i) {
    CHECK(first[i] == static_cast<int>(i));
    CHECK(second[i] == (i == 40 ? -1 : static_cast<int>(i)));
    const bool shares = &first[i] == &second[i];
    CHECK(shares == (i < 32 || (i >= 64 && i < 96)));
  }
  CHECK(first.back() == 7);
  CHECK(second.back() == 100);
}

TEST_CASE("the rim of a plate stays, however thin, and so does a wedge") {
  const auto plate = box_soup({0, 0, 0}, {10, 10, 0.1}, 1);
  check_kept_whole(discrete_model(plate.points, plate.triangles));
  check_kept_whole(model_of(BRepPrimAPI_MakeBox(10, 10, 0.1).Shape()));
  check_kept_whole(model_of(BRepPrimAPI_MakeCylinder(5, 0.1).Shape()));
  const outline wedge{{0, 0}, {10, 0}, {10, 0.15}, {0, 3}};
  check_kept_whole(prism(wedge, wedge, {3, 1}, {0, 10}).model());
}

TEST_CASE("the ends of a bar far thinner than the size stay faces") {
  const outline square{{0, 0}, {0.05, 0}, {0.05, 0.05}, {0, 0.05}};
  const virtual_model bar(prism(square, square, {0.025, 0.025}, {0, 10}).model(), uniform_size(1));
  CHECK(bar.suppressed().empty());
}

TEST_CASE("a hole far smaller than the size stays one") {
  check_kept_whole(
      model_of(BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(10, 10, 3).Shape(),
                               BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(5, 5, -1), gp_Dir(0, 0, 1)), 0.03, 5))
                   .Shape()));
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(10, 10, 3).Shape();
  const TopoDS_Shape pin = BRepPrimAPI_MakeBox(gp_Pnt(5, 5, -1), gp_Pnt(5.1, 5.1, 5)).Shape();
  check_kept_whole(model_of(BRepAlgoAPI_Cut(box, pin).Shape()));
}

TEST_CASE("sizes fit details that stay: a hole, and a vertex near to the edge of another hole") {
  const any_sizing given = uniform_size(1.0);
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(10, 10, 3).Shape();
  const auto cylinder = [](double x, double radius) {
    return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, 5, -1), gp_Dir(0, 0, 1)), radius, 5).Shape();
  };
  const any_geometry pierced = model_of(BRepAlgoAPI_Cut(box, cylinder(5, 0.03)).Shape());
  const any_sizing at_hole = finer_at_details(pierced, given);
  // A third of its circumference, around its vertex.
  CHECK(at_hole({5.03, 5, 0}) == doctest::Approx(2 * std::numbers::pi * 0.03 / 3).epsilon(0.05));
  CHECK(at_hole({1, 1, 0}) == 1);

  // A slot whose edges are 0.1 from a hole: there the upper and lower face are narrow. And they are not
  // across the hole or the slot, which is as far from its other side.
  const TopoDS_Shape slot = BRepPrimAPI_MakeBox(gp_Pnt(6.1, 5, -1), gp_Pnt(6.2, 8, 5)).Shape();
  BRepAlgoAPI_Cut with_hole(box, cylinder(5, 1));
  const any_geometry beside = model_of(BRepAlgoAPI_Cut(with_hole.Shape(), slot).Shape());
  const any_sizing fitted = finer_at_details(beside, given, {.share_of_size = 0.15});
  for (const double z : {0.0, 3.0}) {
    CHECK(fitted({6.1, 5, z}) == doctest::Approx(0.1).epsilon(0.02));
    CHECK(fitted({6, 5, z}) == doctest::Approx(0.1).epsilon(0.02));
  }
  CHECK(fitted({6.15, 8, 1.5}) < 0.8); // the slot's own short edges
  CHECK(fitted({4, 5, 0}) == doctest::Approx(0.1 + 0.4 * 2).epsilon(0.02));
}

TEST_CASE("triangles get small sizes along a strip of which one end is left out") {
  // At the bottom it is a detail, and ends in a point instead.
  const any_sizing of_details([](vec3 p) { return p.z < 3 ? 4.0 : 1.2; });
  const any_sizing given = uniform_size(2.5);
  const auto size_at_strip = [&](const any_geometry& drawn, int dimension) {
    const virtual_model model(drawn, of_details, {.share_of_joined = 0});
    REQUIRE(kinds_of(model) == std::vector{kind::narrow_end});
    return finer_at_details(any_geometry(model), given, {.dimension = dimension})({9.85, 9.85, 5});
  };
  const any_geometry chamfered(chamfered_cube(0.25, 0.45).model()); // 0.49 wide there
  CHECK(size_at_strip(chamfered, 2) == doctest::Approx(2 * 0.49).epsilon(0.1));
  CHECK(size_at_strip(chamfered, 3) == 2.5);

  const TopoDS_Shape box = BRepPrimAPI_MakeBox(10, 10, 10).Shape();
  BRepFilletAPI_MakeFillet rounded(box); // turns by a right angle
  for (const TopoDS_Edge& edge : edges_where(box, [](vec3 p) { return p.x > 9 && p.y > 9; }))
    rounded.Add(0.35, edge);
  CHECK(size_at_strip(any_geometry(model_of(rounded.Shape())), 2) == doctest::Approx(2 * 0.49).epsilon(0.1));
}

TEST_CASE("a chamfer around a cylinder, and a step all around it, become circles") {
  const TopoDS_Shape cylinder = BRepPrimAPI_MakeCylinder(5, 8).Shape();
  const auto rounded = without_details(model_of(chamfered(cylinder, 0.1, [](vec3 p) { return p.z > 7.9; })));
  CHECK(kinds_of(rounded) == std::vector{kind::narrow_face});
  CHECK(counts_of(rounded.topology()) == entity_counts{3, 3, 2});
  for (const double radius : {5.15, 4.85})
    for (const double turn : {0.0, 0.03, -0.03, 1.0, 3.0, 6.0}) {
      CAPTURE(radius);
      CAPTURE(turn);
      const auto stepped = without_details(model_of(stepped_cylinder(radius, turn)));
      CHECK(kinds_of(stepped) == std::vector{kind::narrow_face});
      const bool is_split = std::abs(turn) > 0.05;
      CHECK(counts_of(stepped.topology()) == (is_split ? entity_counts{4, 6, 4} : entity_counts{4, 5, 3}));
    }
}

TEST_CASE("circles whose starts are not quite beside each other become one all the same") {
  for (const double turn : {0.0, 0.19, -0.19}) {
    CAPTURE(turn);
    CHECK(without_details(model_of(stepped_cylinder(1.02, turn, 1))).suppressed().size() == 1);
    CHECK(without_details(model_of(stepped_cylinder(1.1, turn, 1))).suppressed().size() == 1);
    outline lower, upper;
    for (int i = 0; i < 48; ++i) {
      const double angle = 2 * std::numbers::pi * i / 48;
      lower.push_back({1.1 * std::cos(angle), 1.1 * std::sin(angle)});
      upper.push_back({std::cos(angle + turn), std::sin(angle + turn)});
    }
    polygon_surface pin = prism(lower, lower, {0, 0}, {0, 4});
    std::erase_if(pin.triangles, [&](const simplex<2>& t) {
      return std::all_of(t.begin(), t.end(), [&](local_id v) { return pin.points[v].z == 4; });
    });
    polygon_surface top = prism(upper, upper, {0, 0}, {0, 4});
    std::erase_if(top.triangles, [&](const simplex<2>& t) {
      return std::all_of(t.begin(), t.end(), [&](local_id v) { return top.points[v].z == 0; });
    });
    const auto first = static_cast<local_id>(pin.points.size());
    for (const vec3 p : top.points)
      pin.points.push_back(p + vec3{0, 0, 4});
    for (const auto& [a, b, c] : top.triangles)
      pin.triangles.push_back({a + first, b + first, c + first});
    pin.ids.assign(pin.triangles.size(), no_id);
    for (std::size_t i = 0; i < 48; ++i) { // the step
      const auto at = [](const outline& ring, std::size_t k) {
        return vec3{ring[k % 48].x, ring[k % 48].y, 4};
      };
      pin.add({at(lower, i), at(lower, i + 1), at(upper, i + 1), at(upper, i)},
              0.25 * (at(lower, i) + at(lower, i + 1) + at(upper, i + 1) + at(upper, i)));
    }
    const discrete_model given = pin.model();
    without_details(given);
  }
}

TEST_CASE("a step between two materials") {
  TopoDS_Compound both;
  const BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, BRepPrimAPI_MakeBox(10, 10, 10).Shape());
  builder.Add(both, BRepPrimAPI_MakeBox(gp_Pnt(10, 0.1, 0.15), gp_Pnt(20, 9.9, 9.85)).Shape());
  const virtual_model made = without_details(model_of(both));
  CHECK(counts_of(made.topology()).faces == 11);
}

namespace {

/// A block of 10 by 10 by 5, and what is cut out of it.
TopoDS_Shape block_without(const TopoDS_Shape& cut) {
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(10, 10, 5).Shape(), cut).Shape();
}

/// From corner to corner.
TopoDS_Shape box_between(vec3 a, vec3 b) {
  return BRepPrimAPI_MakeBox(gp_Pnt(a.x, a.y, a.z), gp_Pnt(b.x, b.y, b.z)).Shape();
}

} // namespace

TEST_CASE("the bottom of a slit becomes an edge, and so do its ends") {
  const auto details_in = [](const TopoDS_Shape& cut) {
    const virtual_model made = without_details(model_of(block_without(cut)));
    for (const suppressed_detail& one : made.suppressed()) {
      CHECK(one.what == kind::narrow_face);
      CHECK(one.length < 0.15); // across a corner
    }
    return made.suppressed().size();
  };
  CHECK(details_in(box_between({5, -1, 2}, {5.1, 11, 6})) == 1); // open at both ends, which stay open
  CHECK(details_in(box_between({5, -1, 2}, {5.1, 6, 6})) == 2);
  CHECK(details_in(box_between({5, 2, 2}, {5.1, 8, 6})) == 3);
  CHECK(details_in(box_between({5, 2, -1}, {5.1, 8, 6})) == 2);
  CHECK(
      details_in(BRepAlgoAPI_Cut(box_between({3, 3, 2}, {7, 7, 6}), box_between({3.1, 3.1, 1}, {6.9, 6.9, 7}))
                     .Shape()) == 1);
  const gp_Ax2 axis(gp_Pnt(5, 5, 2), gp_Dir(0, 0, 1));
  CHECK(details_in(BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(axis, 2.1, 5).Shape(),
                                   BRepPrimAPI_MakeCylinder(axis, 2, 5).Shape())
                       .Shape()) == 1);
}

TEST_CASE("a slit stays open at its ends, with walls of two heights, too") {
  const virtual_model made = without_details(
      model_of(bar_with_profile({{0, 0}, {10, 0}, {10, -3}, {10.1, -3}, {10.1, -1}, {20, -1}})));
  CHECK(kinds_of(made) == std::vector{kind::narrow_face});
}

TEST_CASE("where a slit is filled, wide, or runs into a point, nothing is left out") {
  const TopoDS_Shape slit = box_between({5, -1, 2}, {5.1, 11, 5});
  TopoDS_Compound filled;
  const BRep_Builder builder;
  builder.MakeCompound(filled);
  builder.Add(filled, block_without(slit));
  builder.Add(filled, box_between({5, 0, 2}, {5.1, 10, 5}));
  check_kept_whole(model_of(filled));
  check_kept_whole(model_of(block_without(box_between({5, -1, 2}, {5.3, 11, 6}))));

  BRepBuilderAPI_MakePolygon outline; // of a wing, blunt in front: 5 degrees behind
  for (const gp_Pnt& corner : {gp_Pnt(2, 3, 2), gp_Pnt(8, 3, 2.26), gp_Pnt(2, 3, 2.52)})
    outline.Add(corner);
  outline.Close();
  check_kept_whole(model_of(block_without(
      BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(outline.Wire()).Face(), gp_Vec(0, 4, 0)).Shape())));
}

TEST_CASE("vertices of short edges at the end of a strip move no further than others") {
  for (const double height : {0.1, 0.15, 0.2, 0.24}) {
    CAPTURE(height);
    const auto own_groups = [](std::size_t side, std::size_t layer) { // so that they stay
      return side == 1 || side == 3 ? static_cast<local_id>(10 * side + layer) : no_id;
    };
    const auto given = chamfered_cube(0.1, 0.1, {0, height, 2 * height, 10}, own_groups).model();
    CHECK(without_details(given).suppressed().size() == (height < 0.16 ? 1 : 0));
  }
}

TEST_CASE("where a fillet or a chamfer runs out it ends in an edge, beside a hole too") {
  for (const TopoDS_Shape& shape : {run_out_fillet(), run_out_chamfer_with_hole()}) {
    const occt_model given = model_of(shape);
    const virtual_model made = without_details(given);
    CHECK(kinds_of(made) == std::vector{kind::narrow_end});
    CHECK(counts_of(made.topology()).faces == counts_of(given.topology()).faces);
  }
}

TEST_CASE("chamfers that meet at corners go together") {
  const TopoDS_Shape plate = BRepPrimAPI_MakeBox(10, 10, 2).Shape();
  const auto top = without_details(model_of(chamfered(plate, 0.1, [](vec3 p) { return p.z > 1.9; })));
  CHECK(kinds_of(top) == std::vector(4, kind::narrow_face));
  CHECK(counts_of(top.topology()) == entity_counts{6, 12, 8});
  const auto flat =
      without_details(model_of(chamfered(plate, 0.1, [](vec3 p) { return std::abs(p.z - 1) > 0.9; })));
  CHECK(counts_of(flat.topology()) == entity_counts{6, 12, 8});
  // With triangles at the corners, which become vertices first.
  const auto all = without_details(model_of(chamfered(plate, 0.1, [](vec3) { return true; })));
  CHECK(kinds_of(all) == std::vector(20, kind::narrow_face));
  CHECK(counts_of(all.topology()) == entity_counts{6, 12, 8});
}

TEST_CASE("a narrow sheet that borders on nothing stays, one beside another sheet does not") {
  polygon_surface sheet;
  sheet.add({{0, 0, 0}, {10, 0, 0}, {10, 0.1, 0}, {0, 0.1, 0}}, {5, 0.05, 0});
  const auto model = [&] {
    return discrete_model(sheet.points, sheet.triangles, sheet.ids, {.allow_sheets = true});
  };
  CHECK(virtual_model(model(), uniform_size(1.0)).suppressed().empty());
  sheet.add({{0, 0, 0}, {0, 0, 10}, {10, 0, 10}, {10, 0, 0}}, {5, 0, 5});
  const virtual_model made(model(), uniform_size(1.0));
  CHECK(kinds_of(made) == std::vector{kind::narrow_face});
  CHECK(counts_of(made.topology()) == entity_counts{1, 4, 4});
}

TEST_CASE("a virtual model of a virtual model is the same") {
  for (const any_geometry& given :
       {any_geometry(chamfered_cube(0.1, 0.1).model()), any_geometry(chamfered_cube(0, 1).model()),
        any_geometry(model_of(stepped_cylinder(5.15, 1)))}) {
    const virtual_model once(given, uniform_size(1.0));
    const virtual_model twice(once, uniform_size(1.0));
    CHECK(twice.suppressed().empty());
    CHECK(counts_of(twice.topology()) == counts_of(once.topology()));
    const auto& topology = twice.topology();
    CHECK(joined(faults_of(twice, absence::of_faces)) == "");
    for (std::size_t f = 0; f < topology.faces.size(); ++f)
      for (std::size_t k = 0; k < topology.faces[f].coedges.size(); ++k) {
        const auto& t = topology.curves[topology.faces[f].coedges[k].curve].t;
        for (const double at : {t[0], 0.3 * t[0] + 0.7 * t[1], t[1]}) {
          const auto face = static_cast<local_id>(f);
          CHECK(norm(twice.curve_uv(face, static_cast<int>(k), at) -
                     once.curve_uv(face, static_cast<int>(k), at)) < 1e-9);
        }
      }
  }
}

TEST_CASE("random solids with random details stay models") {
  std::size_t suppressed = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const discrete_model given = random_solid(random).model();
    REQUIRE(joined(faults_of(given)) == "");
    suppressed += without_details(given, 1 + seed % 5).suppressed().size();
  }
  CHECK(suppressed > 90);
}
