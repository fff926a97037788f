#include "dovetail/models/occt/repair.hpp"
#include "dovetail/models/occt/triangulation.hpp"
#include "dovetail/models/occt_model.hpp"
#include "models/model_checks.hpp"
#include "models/triangulation_checks.hpp"

#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRepBuilderAPI_GTransform.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepPrimAPI_MakeWedge.hxx>
#include <BRep_Builder.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <doctest/doctest.h>
#include <gp_Ax1.hxx>
#include <gp_Ax2.hxx>
#include <gp_GTrsf.hxx>
#include <gp_Pln.hxx>
#include <gp_Trsf.hxx>
#include <gp_Vec.hxx>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace dovetail;
using std::numbers::pi;

namespace {

void check_solid(const TopoDS_Shape& shape, double volume, double area) {
  const occt_read_result result = occt_shape_from(shape);
  const occt_model& model = result.model;
  CHECK(testing::joined(testing::faults_of(model)) == "");
  CHECK(occt_solid_volumes(model).front() == doctest::Approx(volume).epsilon(1e-6));
  double sum = 0;
  for (const double a : occt_face_areas(model))
    sum += a;
  CHECK(sum == doctest::Approx(area).epsilon(1e-6));
  const surface_mesh surface = occt_triangulation(model);
  CHECK(testing::open_edges(model.topology(), surface) == 0);
  CHECK(testing::enclosed_volumes(model.topology(), surface).front() ==
        doctest::Approx(volume).epsilon(0.02));
}

/// Reads two bodies together.
occt_model both_of(const TopoDS_Shape& one, const TopoDS_Shape& other) {
  TopoDS_Compound both;
  const BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, one);
  builder.Add(both, other);
  return occt_shape_from(both).model;
}

/// How often faces pass along each curve.
std::vector<int> passages_of_curves(const geometry_topology& topology) {
  std::vector<int> passages(topology.curves.size(), 0);
  for (const auto& face : topology.faces)
    for (const auto& coedge : face.coedges)
      ++passages[coedge.curve];
  return passages;
}

TopLoc_Location away() {
  gp_Trsf move;
  move.SetTranslation(gp_Vec(9, 0, 0));
  return {move};
}

} // namespace

TEST_CASE("a box is a model") {
  check_solid(BRepPrimAPI_MakeBox(1, 2, 3).Shape(), 6, 22);
}

TEST_CASE("a complete sphere is a model: one face with a seam and two poles") {
  const TopoDS_Shape shape = BRepPrimAPI_MakeSphere(2.0).Shape();
  check_solid(shape, 4.0 / 3.0 * pi * 8, 4 * pi * 4);
  const occt_model model = occt_shape_from(shape).model;
  REQUIRE(model.topology().faces.size() == 1);
  CHECK(model.topology().faces[0].coedges.size() == 4);
  int poles = 0;
  for (const auto& curve : model.topology().curves)
    poles += curve.degenerate ? 1 : 0;
  CHECK(poles == 2);
  CHECK(model.bounds().diagonal() == doctest::Approx(4 * std::sqrt(3.0)).epsilon(1e-5));
  for (const vec2 uv : {vec2{1, 0}, vec2{3, 1.4}, vec2{2, pi / 2}})
    CHECK(model.face_curvature(0, uv) == doctest::Approx(0.5).epsilon(1e-6));
}

TEST_CASE("a complete torus is a model: seams in both directions, no pole") {
  check_solid(BRepPrimAPI_MakeTorus(3.0, 1.0).Shape(), 2 * pi * pi * 3, 4 * pi * pi * 3);
}

TEST_CASE("a cone with its apex is a model") {
  check_solid(BRepPrimAPI_MakeCone(1.0, 0.0, 2.0).Shape(), 2 * pi / 3, pi * (1 + std::sqrt(5.0)));
}

TEST_CASE("a cylinder is a model") {
  check_solid(BRepPrimAPI_MakeCylinder(1.0, 2.0).Shape(), 2 * pi, 6 * pi);
}

TEST_CASE("a solid with a void has two closed shells") {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(gp_Pnt(-2, -2, -2), gp_Pnt(2, 2, 2)).Shape();
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(1.0).Shape();
  check_solid(BRepAlgoAPI_Cut(box, ball).Shape(), 64 - 4.0 / 3.0 * pi, 96 + 4 * pi);
}

TEST_CASE("a solid that is inside out is turned") {
  check_solid(BRepPrimAPI_MakeBox(1, 1, 1).Shape().Reversed(), 1, 6);
}

TEST_CASE("the volume of a solid with spline faces is that of its shape") {
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(1.0).Shape();
  gp_GTrsf stretch;
  stretch.SetValue(1, 1, 4);
  stretch.SetValue(2, 2, 0.5);
  const occt_model model = occt_shape_from(BRepBuilderAPI_GTransform(ball, stretch).Shape()).model;
  REQUIRE(model.volume());
  CHECK(*model.volume() == doctest::Approx(4.0 / 3 * pi * 2).epsilon(3e-6));
}

TEST_CASE("solids that touch get a common face") {
  TopoDS_Compound both;
  const BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(2, 2, 2)).Shape());
  builder.Add(both, BRepPrimAPI_MakeBox(gp_Pnt(0.5, 0.5, 2), gp_Pnt(1.5, 1.5, 3)).Shape());
  const occt_model model = occt_shape_from(both).model;
  CHECK(testing::joined(testing::faults_of(model)) == "");
  CHECK(model.topology().solids.size() == 2);
  CHECK(model.topology().faces.size() == 12); // 6 + 6 - 1 common + 1 for the hole around it
  int common = 0;
  for (const auto& face : model.topology().faces)
    common += face.solids[1] != no_id ? 1 : 0;
  CHECK(common == 1);
  const std::vector<double> volumes = testing::enclosed_volumes(model.topology(), occt_triangulation(model));
  CHECK(volumes[0] == doctest::Approx(8));
  CHECK(volumes[1] == doctest::Approx(1));
}

TEST_CASE("solids that touch along a line have it in common, inside a face of one of them") {
  const TopoDS_Shape plate = BRepPrimAPI_MakeBox(1, 1, 1).Shape();
  const TopoDS_Shape roller =
      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0.3, 0.5, 1.2), gp_Dir(1, 0, 0)), 0.2, 0.4).Shape();
  const occt_model model = both_of(plate, roller);
  CHECK(testing::joined(testing::faults_of(model)) == "");
  const geometry_topology& topology = model.topology();
  REQUIRE(topology.solids.size() == 2);
  const std::vector<int> passages =
      passages_of_curves(topology); // twice by the plate's face, by two of the roller
  REQUIRE(std::count(passages.begin(), passages.end(), 4) == 1);
  const auto shared =
      static_cast<local_id>(std::find(passages.begin(), passages.end(), 4) - passages.begin());
  const auto& range = topology.curves[shared].t;
  for (const double t : {range[0], 0.5 * (range[0] + range[1]), range[1]})
    CHECK(distance(model.curve_point(shared, t), {model.curve_point(shared, t).x, 0.5, 1}) < 1e-9);
  CHECK(distance(model.curve_point(shared, range[0]), model.curve_point(shared, range[1])) ==
        doctest::Approx(0.4));
}

TEST_CASE("so have they where it is an edge of one of them, or of none") {
  const auto four_passages = [](const TopoDS_Shape& one, const TopoDS_Shape& other) {
    const occt_model model = both_of(one, other);
    CHECK(testing::joined(testing::faults_of(model)) == "");
    const std::vector<int> passages = passages_of_curves(model.topology());
    return std::count(passages.begin(), passages.end(), 4);
  };
  gp_Trsf turn; // a box on its lower edge
  turn.SetRotation(gp_Ax1(gp_Pnt(0.3, 0.5, 1), gp_Dir(1, 0, 0)), pi / 6);
  const TopoDS_Shape plate = BRepPrimAPI_MakeBox(1, 1, 1).Shape();
  const TopoDS_Shape box =
      BRepPrimAPI_MakeBox(gp_Pnt(0.3, 0.5, 1), gp_Pnt(0.7, 0.7, 1.2)).Shape().Moved(turn);
  CHECK(four_passages(plate, box) == 1);
  const auto roller = [](double x, double y) { // along x; two of them touch beside their seams
    return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, y, 0), gp_Dir(1, 0, 0), gp_Dir(0, 0, 1)), 0.2, 1.0)
        .Shape();
  };
  CHECK(four_passages(roller(0, 0), roller(0.3, 0.4)) == 1);
}

TEST_CASE("solids that only come near each other stay as they are") {
  TopoDS_Compound both;
  const BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, BRepPrimAPI_MakeSphere(gp_Pnt(0, 0, 0), 1.0).Shape());
  builder.Add(both, BRepPrimAPI_MakeSphere(gp_Pnt(1.5, 1.5, 0), 1.0).Shape()); // only the boxes overlap
  const occt_read_result result = occt_shape_from(both);
  CHECK(result.model.topology().faces.size() == 2);
  CHECK(result.report.warnings.empty());
}

TEST_CASE("solids that overlap are divided, with a warning") {
  TopoDS_Compound both;
  const BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(2, 2, 2)).Shape());
  builder.Add(both, BRepPrimAPI_MakeBox(gp_Pnt(1, 0, 0), gp_Pnt(3, 2, 2)).Shape());
  const occt_read_result result = occt_shape_from(both);
  CHECK(result.model.topology().solids.size() == 3);
  REQUIRE(result.report.warnings.size() == 1);
  CHECK(result.report.warnings[0].find("overlap") != std::string::npos);
}

TEST_CASE("solids that are the same become one, with a warning that names them") {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  for (const double x : {0.0, 1.0, 5.0, 1.0}) // the second touches the first
    builder.Add(all, BRepPrimAPI_MakeBox(gp_Pnt(x, 0, 0), 1, 2, 3).Shape());
  const occt_read_result result = occt_shape_from(all);
  CHECK(result.model.topology().solids.size() == 3);
  REQUIRE(result.report.warnings.size() == 1);
  CHECK(result.report.warnings[0] ==
        "solid 3 of the file is the same as solid 1; they are one solid of the mesh");
}

TEST_CASE("of solids with the same faces one is left, with a warning") {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 2, 3).Shape();
  const BRep_Builder builder;
  TopoDS_Solid again;
  builder.MakeSolid(again);
  builder.Add(again, TopExp_Explorer(box, TopAbs_SHELL).Current());
  TopoDS_Compound all;
  builder.MakeCompound(all);
  for (const TopoDS_Shape& part :
       {box, TopoDS_Shape(again), BRepPrimAPI_MakeSphere(0.5).Shape().Moved(away())})
    builder.Add(all, part);
  const occt_read_result result = occt_shape_from(all);
  CHECK(result.model.topology().solids.size() == 2);
  CHECK(result.model.topology().faces.size() == 7);
  REQUIRE(result.report.warnings.size() == 1);
  CHECK(result.report.warnings[0] == "solid 1 has the faces of solid 0 and is left out");
  const std::vector<double> volumes = occt_solid_volumes(result.model);
  CHECK(volumes[0] + volumes[1] == doctest::Approx(6 + pi / 6));
}

TEST_CASE("loose faces that enclose a volume are sewn to a solid") {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 2, 3).Shape();
  TopoDS_Compound faces;
  const BRep_Builder builder;
  builder.MakeCompound(faces);
  for (TopExp_Explorer face(box, TopAbs_FACE); face.More(); face.Next())
    builder.Add(faces, BRepBuilderAPI_Copy(face.Current()).Shape()); // no common edges any more
  check_solid(faces, 6, 22);
}

TEST_CASE("an open surface is refused, naming an open edge") {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 2, 3).Shape();
  TopoDS_Compound faces;
  const BRep_Builder builder;
  builder.MakeCompound(faces);
  TopExp_Explorer face(box, TopAbs_FACE);
  for (face.Next(); face.More(); face.Next())
    builder.Add(faces, face.Current());
  CHECK_THROWS_WITH_AS(occt_shape_from(faces, "open box"), doctest::Contains("4 edges belong to one face"),
                       geometry_error);
}

TEST_CASE("a solid with a face missing is refused, naming solid and edge") {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 2, 3).Shape();
  TopoDS_Shell shell;
  TopoDS_Solid solid;
  const BRep_Builder builder;
  builder.MakeShell(shell);
  builder.MakeSolid(solid);
  TopExp_Explorer face(box, TopAbs_FACE);
  for (face.Next(); face.More(); face.Next())
    builder.Add(shell, face.Current());
  builder.Add(solid, shell);
  CHECK_THROWS_WITH_AS(occt_shape_from(solid), doctest::Contains("solid 0 is open at edge"), geometry_error);
}

TEST_CASE("faces turned the wrong way round are repaired") {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 2, 3).Shape();
  TopoDS_Shell shell;
  TopoDS_Solid solid;
  const BRep_Builder builder;
  builder.MakeShell(shell);
  builder.MakeSolid(solid);
  int count = 0;
  for (TopExp_Explorer face(box, TopAbs_FACE); face.More(); face.Next())
    builder.Add(shell, count++ % 3 == 0 ? face.Current().Reversed() : face.Current());
  builder.Add(solid, shell);
  check_solid(solid, 6, 22);
}

TEST_CASE("edges of no length collapse: a pyramid cut off a hair below its apex gets the apex") {
  const double hair = 5e-7;
  const TopoDS_Shape shape =
      BRepPrimAPI_MakeWedge(1, 1, 1, 0.5, 0.5, 0.5 + hair, 0.5 + hair).Shape(); // base at y = 0
  CHECK(occt::sub_shapes(shape, TopAbs_FACE).Extent() == 6);
  const occt_model model = occt_shape_from(shape).model;
  CHECK(model.topology().faces.size() == 5);
  CHECK(model.topology().curves.size() == 8);
  CHECK(model.topology().vertices.size() == 5);
  CHECK(testing::joined(testing::faults_of(model)) == "");
  const surface_mesh surface = occt_triangulation(model);
  CHECK(surface.mesh.points.size() == 5);
  CHECK(testing::open_edges(model.topology(), surface) == 0);
  CHECK(testing::enclosed_volumes(model.topology(), surface).front() == doctest::Approx(1.0 / 3));
}

TEST_CASE("a shape without faces is refused") {
  TopoDS_Compound nothing;
  const BRep_Builder builder;
  builder.MakeCompound(nothing);
  CHECK_THROWS_AS(occt_shape_from(nothing), geometry_error);
  CHECK_THROWS_AS(occt_shape_from(TopoDS_Shape()), geometry_error);
}

TEST_CASE("copies answer alike") {
  const occt_model model = occt_shape_from(BRepPrimAPI_MakeTorus(3.0, 1.0).Shape()).model;
  const occt_model copy = model;
  const vec2 uv{1.25, 2.5};
  CHECK(copy.face_point(0, uv) == model.face_point(0, uv));
  CHECK(copy.curve_uv(0, 1, 0.5) == model.curve_uv(0, 1, 0.5));
}

TEST_CASE("projection to a periodic face stays near the seed") {
  const occt_model model = occt_shape_from(BRepPrimAPI_MakeCylinder(1.0, 2.0).Shape()).model;
  for (local_id f = 0; f < 3; ++f) {
    if (model.topology().faces[f].coedges.size() != 4)
      continue; // a lid
    const vec3 p = model.face_point(f, {2 * pi - 0.01, 1});
    CHECK(model.project_to_face(f, p, {2 * pi - 0.02, 1}).x == doctest::Approx(2 * pi - 0.01));
    CHECK(model.project_to_face(f, p, {-0.02, 1}).x == doctest::Approx(-0.01));
  }
}

TEST_CASE("a sheet that lies on a face of a solid becomes a part of that face") {
  TopoDS_Compound both;
  const BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, BRepPrimAPI_MakeBox(10, 10, 10).Shape());
  builder.Add(both, BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(5, 5, 10), gp::DZ()), -2, 2, -2, 2).Face());
  const auto faces = occt_shape_from(both, "box", occt::wanted::faces).model.topology().faces;
  CHECK(faces.size() == 7);
  for (const auto& face : faces)
    CHECK(face.solids[0] != no_id);
}

TEST_CASE("a sphere with an inaccurate edge near its pole gets its poles elsewhere, any other one does not") {
  const auto quarter = [](double tolerance) {
    const TopoDS_Shape shape =
        BRepAlgoAPI_Common(BRepPrimAPI_MakeSphere(2.0).Shape(),
                           BRepPrimAPI_MakeBox(gp_Pnt(0, 0, -5), gp_Pnt(5, 5, 5)).Shape())
            .Shape();
    for (TopExp_Explorer edges(shape, TopAbs_EDGE); edges.More(); edges.Next())
      if (!BRep_Tool::Degenerated(TopoDS::Edge(edges.Current())))
        BRep_Builder().UpdateEdge(TopoDS::Edge(edges.Current()), tolerance);
    return occt_shape_from(shape);
  };
  const auto poles = [](const occt_model& model) {
    const auto& curves = model.topology().curves;
    return std::count_if(curves.begin(), curves.end(), [](const auto& curve) { return curve.degenerate; });
  };
  const auto accurate = quarter(1e-6), inaccurate = quarter(0.05);
  CHECK(poles(accurate.model) == 2);
  CHECK(poles(inaccurate.model) == 0);
  CHECK(accurate.report.warnings.empty());
  REQUIRE_FALSE(inaccurate.report.warnings.empty());
  CHECK(testing::joined(testing::faults_of(inaccurate.model)) == "");
  // The kernel is off by that much, however small the error that is asked for.
  CHECK(occt_solid_volumes(inaccurate.model).front() == doctest::Approx(8.0 / 3.0 * pi).epsilon(2e-6));
  const surface_mesh surface = occt_triangulation(inaccurate.model);
  CHECK(testing::open_edges(inaccurate.model.topology(), surface) == 0);
}

TEST_CASE("a sphere that is larger than a hemisphere stays, however inaccurate its edges are") {
  const auto knob = [](double tolerance) {
    const TopoDS_Shape shape =
        BRepAlgoAPI_Fuse(BRepPrimAPI_MakeSphere(1.0).Shape(), BRepPrimAPI_MakeCylinder(0.3, 3.0).Shape())
            .Shape();
    for (TopExp_Explorer edges(shape, TopAbs_EDGE); edges.More(); edges.Next())
      if (!BRep_Tool::Degenerated(TopoDS::Edge(edges.Current())))
        BRep_Builder().UpdateEdge(TopoDS::Edge(edges.Current()), tolerance);
    return occt_solid_volumes(occt_shape_from(shape).model).front();
  };
  CHECK(knob(1e-6) > 4.0 / 3.0 * pi);
  CHECK(knob(0.03) == doctest::Approx(knob(1e-6)).epsilon(1e-6));
}

TEST_CASE("solids that overlap by a hair get a common face, and no solid of a hair's thickness") {
  TopoDS_Compound both;
  const BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(2, 2, 2)).Shape());
  builder.Add(both, BRepPrimAPI_MakeBox(gp_Pnt(0.5, 0.5, 2 - 1e-6), gp_Pnt(1.5, 1.5, 3)).Shape());
  const occt_read_result result = occt_shape_from(both);
  CHECK(result.model.topology().solids.size() == 2);
  CHECK(result.model.topology().faces.size() == 12);
  CHECK(result.report.warnings.empty());
}
