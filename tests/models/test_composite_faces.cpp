/// Faces that go on smoothly into each other are one where one of them is narrow: which do, that the whole is
/// a face of a model, and that what lies on each is told.
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/geometry/wraps.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/models/virtual_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "dovetail/solver/second_order.hpp"
#include "models/virtual_shapes.hpp"
#include "pipeline/plane_meshes.hpp"
#include "pipeline/solid_meshes.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepFilletAPI_MakeChamfer.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace dovetail;
using namespace dovetail::testing;
using kind = suppressed_detail::kind;

namespace {

constexpr double radius = 0.4;

occt_model model_of(const TopoDS_Shape& shape) {
  return occt_shape_from(shape).model;
}

/// A cube of 10, and what `Maker` makes of its upright edge at (10, 10), so wide.
template <class Maker>
TopoDS_Shape cube_with_edge(double width) {
  const TopoDS_Shape cube = BRepPrimAPI_MakeBox(10, 10, 10).Shape();
  Maker made(cube);
  for (TopExp_Explorer edges(cube, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(edges.Current());
    const BRepAdaptor_Curve curve(edge);
    if (const gp_Pnt p = curve.Value(0.5 * (curve.FirstParameter() + curve.LastParameter()));
        p.X() > 9 && p.Y() > 9 && edge.Orientation() == TopAbs_FORWARD)
      made.Add(width, edge);
  }
  return made.Shape();
}

occt_model filleted_cube(double width = radius) {
  return model_of(cube_with_edge<BRepFilletAPI_MakeFillet>(width));
}

/// A plate that is two side by side, the second one half a unit wide: their upper and lower faces, and two
/// more, lie in one plane each.
occt_model divided_plate(double thickness) {
  return model_of(BRepAlgoAPI_Fuse(BRepPrimAPI_MakeBox(10, 10, thickness).Shape(),
                                   BRepPrimAPI_MakeBox(gp_Pnt(10, 0, 0), 0.5, 10, thickness).Shape())
                      .Shape());
}

/// A model of whose faces each has a group of its own.
struct all_in_groups : model_wraps<all_in_groups, occt_model> {
  explicit all_in_groups(occt_model given) : model_wraps(std::move(given)), named_(wrapped.topology()) {
    for (std::size_t f = 0; f < named_.faces.size(); ++f)
      named_.faces[f].group = "group " + std::to_string(f);
  }
  const geometry_topology& topology() const { return named_; }

private:
  geometry_topology named_;
};

/// However much faces turn.
virtual_model joined(const any_geometry& given, double size = 1,
                     const virtual_options& options = {.most_turn_deg = 360}) {
  virtual_model made(given, uniform_size(size), options);
  CHECK(virtual_checks(made, given, size).faults() == "");
  return made;
}

std::size_t joined_count(const virtual_model& model) {
  CHECK(model.summary().get("joined_faces") ==
        static_cast<double>(std::count_if(model.suppressed().begin(), model.suppressed().end(),
                                          [](const auto& one) { return one.what == kind::joined_face; })));
  return model.suppressed().size();
}

bool is_on_fillet(vec3 p) {
  return p.x > 10 - radius && p.y > 10 - radius;
}

/// How far a point is from the plane, or the fillet, that it is on.
double off_cube(vec3 p) {
  if (is_on_fillet(p))
    return std::abs(std::hypot(p.x - (10 - radius), p.y - (10 - radius)) - radius);
  return std::min({std::abs(p.x), std::abs(p.x - 10), std::abs(p.y), std::abs(p.y - 10), std::abs(p.z),
                   std::abs(p.z - 10)});
}

/// Points on the fillet and the faces beside it.
vec3 random_point(std::mt19937& random) {
  const auto between = [&](double a, double b) {
    return a + (b - a) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  const double z = between(0.1, 9.9), along = between(0.1, 9.9 - radius), angle = between(0.01, 1.56);
  switch (random() % 3) {
  case 0:
    return {10, along, z};
  case 1:
    return {along, 10, z};
  default:
    return {10 - radius + radius * std::cos(angle), 10 - radius + radius * std::sin(angle), z};
  }
}

} // namespace

TEST_CASE("a fillet narrower than the size is one with a face beside it") {
  const any_geometry given = filleted_cube();
  const virtual_model made = joined(given);
  REQUIRE(joined_count(made) == 1);
  const auto& [what, fillet, place, width] = made.suppressed()[0];
  CHECK(what == kind::joined_face);
  CHECK(given.face_curvature(fillet, given.curve_uv(fillet, 0, 0)) == doctest::Approx(1 / radius));
  CHECK(off_cube(place) < 1e-9);
  CHECK(width > 0.9 * radius);
  CHECK(width < 1.6 * radius);
  CHECK(counts_of(given.topology()) == entity_counts{7, 15, 10});
  CHECK(counts_of(made.topology()) == entity_counts{6, 14, 10});
  const local_id whole = made.whole_face(fillet);
  CHECK(whole != fillet);
  CHECK(made.whole_face(whole) == whole);
  CHECK(!made.plane_of_face(whole));
  CHECK(made.summary().get("largest") == 0); // nothing is left out

  const virtual_model twice = joined(made);
  CHECK(joined_count(twice) == 0);
  CHECK(twice.whole_face(fillet) == whole);
  CHECK(twice.face_at(whole, place) == made.face_at(whole, place));
  const double middle = 10 - radius + radius / std::numbers::sqrt2;
  CHECK(twice.face_at(whole, {middle, middle, 5}) == fillet);
}

TEST_CASE("a face that turns much within the size is not joined") {
  const double turn = 57.29577951308232 / radius; // within a size of 1
  CHECK(joined_count(joined(filleted_cube(), 1, {.most_turn_deg = 1.001 * turn})) == 1);
  CHECK(joined_count(joined(filleted_cube(), 1, {.most_turn_deg = 0.999 * turn})) == 0);
  CHECK(joined_count(joined(filleted_cube(), 1, {})) == 0);
  CHECK_THROWS_AS(virtual_model(filleted_cube(), uniform_size(1), {.most_turn_deg = -1}), sizing_error);
}

TEST_CASE("points of faces that are one are on the model's, and are found again") {
  const any_geometry given = filleted_cube();
  const virtual_model made = joined(given);
  REQUIRE(joined_count(made) == 1);
  const local_id fillet = made.suppressed()[0].entity, whole = made.whole_face(fillet);
  const bool has_x = std::abs(given.face_point(whole, given.curve_uv(whole, 0, 0.5)).x - 10) < 1e-6;
  std::mt19937 random(5);
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    const vec3 p = random_point(random);
    if (!is_on_fillet(p) && (p.x == 10) != has_x)
      continue;
    ++found;
    const vec2 uv = made.project_to_face(whole, p, {});
    const vec3 q = made.face_point(whole, uv);
    CHECK(distance(p, q) < 1e-9);
    CHECK(made.face_at(whole, p) == (is_on_fillet(p) ? fillet : whole));
    CHECK(made.face_curvature(whole, uv) == doctest::Approx(is_on_fillet(p) ? 1 / radius : 0));
    const surface_frame frame = made.face_frame(whole, uv);
    const vec3 outside = p + 0.3 * normalized(cross(frame.du, frame.dv)); // or inside of the fillet's axis
    CHECK(distance(made.face_point(whole, made.project_to_face(whole, outside, uv)), p) < 1e-7);
    constexpr double step = 1e-6;
    CHECK(norm(made.face_point(whole, uv + vec2{step, 0}) - q - step * frame.du) < 1e-3 * step);
    CHECK(norm(made.face_point(whole, uv + vec2{0, step}) - q - step * frame.dv) < 1e-3 * step);
  }
  CHECK(found > 100);
}

TEST_CASE("beyond its boundary the surface goes on") {
  const virtual_model made = joined(filleted_cube());
  REQUIRE(joined_count(made) == 1);
  const local_id whole = made.whole_face(made.suppressed()[0].entity);
  const auto& face = made.topology().faces[whole];
  for (std::size_t k = 0; k < face.coedges.size(); ++k) {
    const auto& t = made.topology().curves[face.coedges[k].curve].t;
    const vec2 uv = made.curve_uv(whole, static_cast<int>(k), 0.5 * (t[0] + t[1]));
    for (const vec2 away : {vec2{2, 0}, vec2{-2, 0}, vec2{0, 2}, vec2{0, -2}}) {
      const double far = distance(made.face_point(whole, uv + away), made.face_point(whole, uv));
      CHECK(far < 50);
      CHECK(far > 1.9);
    }
  }
}

TEST_CASE("what is wide, sharp, wanted or of another group is not joined") {
  CHECK(joined_count(joined(filleted_cube(0.8))) == 0);
  CHECK(joined_count(joined(model_of(cube_with_edge<BRepFilletAPI_MakeChamfer>(0.5)))) == 0);
  CHECK(joined_count(joined(filleted_cube(), 1, {.share_of_joined = 0, .most_turn_deg = 360})) == 0);
  CHECK(joined_count(joined(filleted_cube(), 1, {.share_of_joined = 0.3, .most_turn_deg = 360})) == 0);
  CHECK(joined_count(joined(all_in_groups(filleted_cube()))) == 0);
  const local_id fillet = joined(filleted_cube()).suppressed()[0].entity;
  CHECK(joined_count(joined(filleted_cube(), 1, {.most_turn_deg = 360, .kept_faces = {fillet}})) == 0);
  CHECK_THROWS_AS(virtual_model(filleted_cube(), uniform_size(1), {.share_of_joined = -1}), sizing_error);
}

TEST_CASE("faces in one plane are one plane, but in a thin wall") {
  const any_geometry given = divided_plate(4);
  const virtual_model made = joined(given);
  CHECK(joined_count(made) == 4);
  CHECK(counts_of(made.topology()) == entity_counts{6, 16, 12}); // edges are not joined
  for (const auto& one : made.suppressed()) {
    const local_id whole = made.whole_face(one.entity);
    const auto plane = made.plane_of_face(whole);
    REQUIRE(plane);
    CHECK(std::abs(dot(cross(plane->du, plane->dv), one.place - plane->point)) < 1e-9);
    CHECK(distance(made.face_point(whole, {3, 4}), plane->point + 3 * plane->du + 4 * plane->dv) < 1e-12);
    CHECK(made.face_at(whole, {10.2, 5, 2}) == one.entity);
    CHECK(made.face_at(whole, {9.8, 5, 2}) == whole);
  }
  const virtual_model thin = joined(divided_plate(0.4));
  CHECK(joined_count(thin) == 2);
  for (const auto& one : thin.suppressed())
    CHECK(std::abs(one.place.y - 5) == doctest::Approx(5)); // no upper or lower one
}

TEST_CASE("a fillet beside details that are given up is one with a face, or stays, and the model is one") {
  for (const double width : {0.05, 0.1, 0.15}) {
    CAPTURE(width);
    const TopoDS_Shape filleted = cube_with_edge<BRepFilletAPI_MakeFillet>(radius);
    BRepFilletAPI_MakeChamfer chamfered(filleted);
    for (TopExp_Explorer edges(filleted, TopAbs_EDGE); edges.More(); edges.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(edges.Current());
      const BRepAdaptor_Curve curve(edge);
      if (curve.Value(0.5 * (curve.FirstParameter() + curve.LastParameter())).Z() > 9.9 &&
          edge.Orientation() == TopAbs_FORWARD) {
        chamfered.Add(width, edge); // and what goes on from there smoothly
        break;
      }
    }
    const virtual_model made = joined(model_of(chamfered.Shape()));
    CHECK(made.summary().get("narrow_faces") > 0);
    const auto shell = generate<2>(made, uniform_size(1), parameters<>{}.with_options(in_parts(1)));
    CHECK(euler_characteristic(require_valid(shell)) == 2);
    CHECK(shell.quality.min_face_deg > 12);
  }
}

TEST_CASE("triangles of a mesh have the numbers of the faces that they are on") {
  const any_geometry given = filleted_cube();
  const virtual_model model = joined(given);
  REQUIRE(joined_count(model) == 1);
  const local_id fillet = model.suppressed()[0].entity, whole = model.whole_face(fillet);
  for (const int parts : {1, 4}) {
    CAPTURE(parts);
    auto solid = generate<3>(model, uniform_size(0.8),
                             parameters<>{}.with_mesher(mesher::tetgen{}).with_options(in_parts(parts)));
    REQUIRE(solid.failures.empty());
    CHECK(io::check_distributed(solid.mesh).valid());
    CHECK(solid.quality.min_dihedral_deg > 12);
    const double missing = (1 - 0.25 * std::numbers::pi) * radius * radius * 10;
    CHECK(volume_of(solid.mesh) == doctest::Approx(1000 - missing).epsilon(2e-3));
    const auto& skeleton = solid.mesh.skeleton;
    std::vector<int> count(given.topology().faces.size(), 0);
    for (std::size_t s = 0; s < skeleton.sides.size(); ++s) {
      const local_id f = skeleton.side_hosts[s];
      if (f == no_id)
        continue;
      ++count[f];
      const auto& [a, b, c] = skeleton.sides[s];
      const vec3 middle = (skeleton.points[a] + skeleton.points[b] + skeleton.points[c]) / 3;
      if (f == fillet || (f == whole && std::max(middle.x, middle.y) > 9)) {
        const double from_border = std::min(middle.x, middle.y) - (10 - radius);
        CHECK((std::abs(from_border) < 0.05 || (f == fillet) == (from_border > 0)));
      }
    }
    CHECK(*std::min_element(count.begin(), count.end()) > 0);
    for (std::size_t v = 0; v < skeleton.points.size(); ++v)
      CHECK((skeleton.point_hosts[v].dimension != 2 || off_cube(skeleton.points[v]) < 1e-9));
    std::vector<bool> has_triangle(skeleton.points.size(), false); // of the point's own face
    for (std::size_t s = 0; s < skeleton.sides.size(); ++s)
      for (const local_id v : skeleton.sides[s])
        has_triangle[v] = has_triangle[v] || skeleton.point_hosts[v].id == skeleton.side_hosts[s];
    for (std::size_t v = 0; v < skeleton.points.size(); ++v)
      CHECK((skeleton.point_hosts[v].dimension != 2 || has_triangle[v]));
  }
}

TEST_CASE("the middles of a mesh's edges are on the faces that were joined") {
  const virtual_model model = joined(filleted_cube());
  REQUIRE(joined_count(model) == 1);
  const local_id fillet = model.suppressed()[0].entity;
  const any_sizing fine_there([](vec3 p) { return std::min(1.5, 0.2 + std::hypot(p.x - 10, p.y - 10)); });
  auto solid =
      generate<3>(model, fine_there, parameters<>{}.with_mesher(mesher::tetgen{}).with_options(in_parts(1)));
  REQUIRE(solid.failures.empty());
  const report middles = io::add_mid_nodes(solid.mesh, any_geometry(model), parallel::serial{}, {});
  CHECK(middles.get("not_found") == 0);
  const auto& nodes = *solid.mesh.mid_nodes;
  const auto& hosts = solid.mesh.skeleton.point_hosts;
  int inside = 0, off = 0;
  for (std::size_t k = 0; k < nodes.edges.size(); ++k) {
    const auto& [a, b] = nodes.edges[k];
    if (hosts[a] != host{2, fillet} || hosts[b] != host{2, fillet})
      continue;
    ++inside;
    off += off_cube(nodes.points[k]) < 1e-9 ? 0 : 1;
  }
  CHECK(inside > 20);
  CHECK(off <= middles.get("moved_back")); // so that no element is folded
  CHECK(3 * off < inside);
}
