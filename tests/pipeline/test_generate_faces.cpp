#include "plane_meshes.hpp"

#include "dovetail/models/occt/shape.hpp"
#include "dovetail/models/occt_model.hpp"
#include "files/scratch_folder.hpp"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepTools.hxx>
#include <STEPControl_Writer.hxx>
#include <TopoDS_Compound.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>

#include <algorithm>
#include <numbers>
#include <set>

using namespace dovetail;
using namespace dovetail::testing;

namespace {

constexpr double height = 0.5;

/// A 4 x 3 rectangle with a round hole, in the plane z = height.
TopoDS_Face drilled_plate() {
  const gp_Pln plane(gp_Pnt(0, 0, height), gp_Dir(0, 0, 1));
  BRepBuilderAPI_MakePolygon outline(gp_Pnt(0, 0, height), gp_Pnt(4, 0, height), gp_Pnt(4, 3, height),
                                     gp_Pnt(0, 3, height), true);
  BRepBuilderAPI_MakeFace face(plane, outline.Wire());
  const gp_Circ circle(gp_Ax2(gp_Pnt(1, 1.5, height), gp_Dir(0, 0, 1)), 0.5);
  BRepBuilderAPI_MakeWire hole(BRepBuilderAPI_MakeEdge(circle).Edge());
  face.Add(TopoDS::Wire(hole.Wire().Reversed()));
  return face.Face();
}

TopoDS_Edge segment(gp_Pnt a, gp_Pnt b) {
  return BRepBuilderAPI_MakeEdge(a, b).Edge();
}
const gp_Pnt crack_start(2, 1, height), crack_end(3, 2, height);

/// The plate with an edge inside that bounds nothing.
TopoDS_Face cracked_plate() {
  TopoDS_Face face = drilled_plate();
  const BRep_Builder builder;
  BRepBuilderAPI_MakeWire crack(segment(crack_start, crack_end));
  TopoDS_Wire wire = crack.Wire();
  TopoDS_Wire inner;
  builder.MakeWire(inner);
  for (TopExp_Explorer edges(wire, TopAbs_EDGE); edges.More(); edges.Next())
    builder.Add(inner, edges.Current().Oriented(TopAbs_INTERNAL));
  builder.Add(face, inner.Oriented(TopAbs_FORWARD));
  BRepLib::BuildCurve3d(TopoDS::Edge(TopExp_Explorer(inner, TopAbs_EDGE).Current()));
  return face;
}

TopoDS_Compound compound_of(std::initializer_list<TopoDS_Shape> shapes) {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  for (const TopoDS_Shape& shape : shapes)
    builder.Add(all, shape);
  return all;
}

void write_step(const TopoDS_Shape& shape, const std::filesystem::path& file) {
  const occt::silenced quiet;
  STEPControl_Writer writer;
  REQUIRE(writer.Transfer(shape, STEPControl_AsIs) == IFSelect_RetDone);
  REQUIRE(writer.Write(file.c_str()) == IFSelect_RetDone);
}

occt_model read_faces(const std::filesystem::path& file) {
  return read_occt_model(file, {.entities = occt::wanted::faces}).model;
}

generated<2> mesh_of(const occt_model& model, double size, int parts) {
  return generate<2>(model, uniform_size(size), parameters<>{}.with_options(in_parts(parts)));
}

constexpr double plate_area = 12 - 0.25 * std::numbers::pi;

/// Length of the mesh's edges on the straight line between two points; the edges of a line are in the
/// skeleton.
double length_along(const generated<2>& result, vec3 from, vec3 to) {
  const auto& skeleton = result.mesh.skeleton;
  const auto is_on = [&](local_id v) {
    const vec3 p = skeleton.points[v];
    return distance(from, p) + distance(p, to) < distance(from, to) + 1e-9;
  };
  std::set<simplex<1>> edges;
  double sum = 0;
  for (std::size_t e = 0; e < skeleton.sides.size(); ++e)
    if (const auto [a, b] = skeleton.sides[e]; skeleton.side_hosts[e] != no_id && is_on(a) && is_on(b))
      if (edges.insert({std::min(a, b), std::max(a, b)}).second)
        sum += distance(skeleton.points[a], skeleton.points[b]);
  return sum;
}

} // namespace

TEST_CASE("a planar face with a hole, from BREP and STEP files, is a plane domain") {
  const scratch_folder folder("plane_face");
  BRepTools::Write(drilled_plate(), (folder / "plate.brep").c_str());
  write_step(drilled_plate(), folder / "plate.step");
  for (const char* name : {"plate.brep", "plate.step"}) {
    INFO(name);
    const occt_model model = read_faces(folder / name);
    REQUIRE(model.topology().faces.size() == 1);
    CHECK(model.topology().solids.empty());
    CHECK(model.plane_of_face(0).has_value());
    const auto result = mesh_of(model, 0.1, 4);
    const auto mesh = require_valid(result);
    CHECK(result.mesh.counts.size() == 4);
    CHECK(area_of(mesh) == doctest::Approx(plate_area).epsilon(1e-3));
    CHECK(euler_characteristic(mesh) == 0);
    for (const auto& [id, p] : mesh.points)
      REQUIRE(p.z == doctest::Approx(height).epsilon(1e-12));
    CHECK(result.quality.min_dihedral_deg > 25);
  }
}

TEST_CASE("inner edges of a face, and free edges beside it, are lines of the mesh") {
  const scratch_folder folder("inner_edges");
  BRepTools::Write(cracked_plate(), (folder / "inner.brep").c_str());
  const auto with_edge = compound_of({drilled_plate(), segment(crack_start, crack_end)});
  BRepTools::Write(with_edge, (folder / "beside.brep").c_str());
  write_step(with_edge, folder / "beside.step");
  for (const char* name : {"inner.brep", "beside.brep", "beside.step"}) {
    INFO(name);
    const auto result = mesh_of(read_faces(folder / name), 0.1, 5);
    const auto mesh = require_valid(result);
    CHECK(area_of(mesh) == doctest::Approx(plate_area).epsilon(1e-3));
    CHECK(euler_characteristic(mesh) == 0);
    CHECK(length_along(result, {2, 1, height}, {3, 2, height}) == doctest::Approx(std::numbers::sqrt2));
  }
}

TEST_CASE("an edge from side to side divides a face in two that share its points") {
  const auto both = compound_of({drilled_plate(), segment(gp_Pnt(2, -1, height), gp_Pnt(2, 4, height))});
  const auto model = occt_shape_from(both, "plate", occt::wanted::faces).model;
  CHECK(model.topology().faces.size() == 2);
  const auto result = mesh_of(model, 0.1, 4);
  CHECK(euler_characteristic(require_valid(result)) == 0);
  CHECK(length_along(result, {2, 0, height}, {2, 3, height}) == doctest::Approx(3));
}

TEST_CASE("a box without its lid: an open shell") {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 1, 1).Shape();
  TopoDS_Compound five;
  const BRep_Builder builder;
  builder.MakeCompound(five);
  TopExp_Explorer faces(box, TopAbs_FACE);
  for (faces.Next(); faces.More(); faces.Next())
    builder.Add(five, faces.Current());
  CHECK_THROWS_AS(occt_shape_from(five), geometry_error);
  const auto model = occt_shape_from(five, "five sides", occt::wanted::faces).model;
  REQUIRE(model.topology().faces.size() == 5);
  const auto mesh = require_valid(mesh_of(model, 0.1, 3));
  CHECK(area_of(mesh) == doctest::Approx(5).epsilon(1e-12));
  CHECK(euler_characteristic(mesh) == 1);
}
