#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/models/occt/shape.hpp"
#include "dovetail/models/occt/touching_faces.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "models/model_checks.hpp"
#include "models/rings.hpp"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shape.hxx>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace dovetail;
using testing::ring_with_slit;
using testing::ring_with_tip;

namespace {

occt_read_result read(const TopoDS_Shape& shape, const std::optional<double>& join_within = {}) {
  occt::attributed_shape input;
  input.shape = shape;
  input.source = "ring";
  return occt_model_from(std::move(input), occt::wanted::solids, join_within);
}

/// Meshes it in one piece.
generated<3> mesh(const occt_model& model, double size = 0.5) {
  return generate<3>(model, uniform_size(size), parameters<>{}.with_options({.subdomains = 1}));
}

/// How many faces pass each curve most often.
int most_passages(const geometry_topology& topology) {
  std::vector<int> passages(topology.curves.size());
  for (const auto& face : topology.faces)
    for (const auto& coedge : face.coedges)
      ++passages[coedge.curve];
  return *std::max_element(passages.begin(), passages.end());
}

} // namespace

TEST_CASE("a solid that touches itself along a line is joined there, where that is wanted") {
  const auto as_drawn = read(ring_with_tip(3));
  CHECK_FALSE(as_drawn.joined);
  CHECK(most_passages(as_drawn.model.topology()) == 2);
  CHECK_THROWS_AS(mesh(as_drawn.model), intersection_error);

  const auto joined = read(ring_with_tip(3), 0.0);
  CHECK(joined.joined);
  CHECK(most_passages(joined.model.topology()) ==
        4); // two walls of the tip, and the face on both sides of it
  CHECK(testing::faults_of(joined.model).empty());
  const auto made = mesh(joined.model);
  CHECK(made.failures.empty());
  CHECK(io::check_distributed(made.mesh).valid());
  CHECK(made.quality.min_dihedral_deg > 12);
}

TEST_CASE("a slit narrower than the length is closed, a wider one stays") {
  const double ring = 4 * 4 - 2 * 2;
  const auto closed = read(ring_with_slit(1e-3), 2e-3);
  CHECK(closed.joined);
  CHECK(most_passages(closed.model.topology()) == 2);
  CHECK(closed.model.volume().value() == doctest::Approx(ring).epsilon(1e-3));
  const auto made = mesh(closed.model);
  CHECK(made.failures.empty());
  CHECK(made.quality.min_dihedral_deg > 12);
  CHECK(made.quality.elements < 5000); // none of them is as small as the slit was

  const auto open = read(ring_with_slit(1e-3), 1e-4);
  CHECK_FALSE(open.joined);
  CHECK(open.model.volume().value() < closed.model.volume().value());
}

TEST_CASE("names of faces and solids outlast the joining") {
  occt::attributed_shape input;
  input.shape = ring_with_tip(3);
  input.source = "ring";
  input.names[input.shape].name = "ring";
  const TopTools_IndexedMapOfShape faces = occt::sub_shapes(input.shape, TopAbs_FACE);
  for (int f = 1; f <= faces.Extent(); ++f)
    input.names[faces(f)].name = "side " + std::to_string(f);
  const auto joined = occt_model_from(input, occt::wanted::solids, 0.0);
  REQUIRE(joined.joined);
  const auto& topology = joined.model.topology();
  CHECK(topology.solids[0].name == "ring");
  CHECK(std::none_of(topology.faces.begin(), topology.faces.end(),
                     [](const auto& face) { return face.name.empty(); }));
  CHECK(topology.faces.size() > static_cast<std::size_t>(faces.Extent()));
}

TEST_CASE("a gap between curved faces, where their triangles cross, is closed") {
  const auto as_drawn = read(testing::pin_in_hole(5e-5));
  CHECK_THROWS_AS(mesh(as_drawn.model, 0.4), intersection_error);
  CHECK_FALSE(read(testing::pin_in_hole(5e-5), 0.0).joined);
  const auto closed = read(testing::pin_in_hole(5e-5), 1e-4);
  CHECK(closed.joined);
  CHECK(closed.model.volume().value() == doctest::Approx(18));
  const auto made = mesh(closed.model);
  CHECK(made.failures.empty());
  CHECK(made.quality.min_dihedral_deg > 12);
}

TEST_CASE("surfaces that pass through each other are not joined") {
  for (const double length : {0.0, 1e-3}) {
    CAPTURE(length);
    const auto crossing = read(testing::ring_through_itself(), length);
    CHECK_FALSE(crossing.joined);
    CHECK_THROWS_AS(mesh(crossing.model), intersection_error);
  }
}

TEST_CASE("a sheet as thin as the length stays") {
  const double thin = 2e-4;
  const auto fin =
      testing::prism({{0, 0}, {1, 0}, {1, 1}, {0.5 + thin, 1}, {0.5 + thin, 2}, {0.5, 2}, {0.5, 1}, {0, 1}});
  CHECK_FALSE(read(fin, 1e-3).joined);
}

TEST_CASE("sectors of a solid around an edge are beside each other, or in each other") {
  using occt::sectors_are_apart;
  const double half_turn = std::numbers::pi;
  CHECK(sectors_are_apart({{0, 1}, {half_turn / 2, -1}, {-half_turn, 1}, {-half_turn / 2, -1}}));
  CHECK(sectors_are_apart({{1, -1}, {2, 1}, {3, -1}, {-1, 1}}));
  // Two planes that cross, the solid below both: between them it is there twice.
  CHECK_FALSE(sectors_are_apart({{0, -1}, {0.5, -1}, {half_turn, 1}, {0.5 - half_turn, 1}}));
  // A sector in another one.
  CHECK_FALSE(sectors_are_apart({{-1, 1}, {-0.5, 1}, {0.5, -1}, {1, -1}}));
  // Two cylinders that touch: their faces are tangent to each other, whatever order rounding puts them in.
  for (const double off : {1e-9, 0.0, -1e-9}) {
    CHECK(sectors_are_apart(
        {{half_turn / 2, -1}, {half_turn / 2 + off, 1}, {-half_turn / 2, 1}, {-half_turn / 2 + off, -1}}));
    CHECK(sectors_are_apart({{half_turn, -1}, {off - half_turn, 1}, {0, 1}, {off, -1}}));
  }
}

TEST_CASE("what does not touch itself stays as it is") {
  for (const double length : {0.0, 1e-3}) {
    CAPTURE(length);
    CHECK_FALSE(read(BRepPrimAPI_MakeBox(1, 2, 3).Shape(), length).joined);
    CHECK_FALSE(read(ring_with_tip(2.5), length).joined);
  }
}

namespace {

std::size_t most_loops(const occt_model& model) {
  std::size_t most = 0;
  for (const auto& face : model.topology().faces)
    most = std::max(most, face.loops.size());
  return most;
}

TopoDS_Shape compound_of(const std::vector<TopoDS_Shape>& shapes) {
  const BRep_Builder builder;
  TopoDS_Compound all;
  builder.MakeCompound(all);
  for (const TopoDS_Shape& shape : shapes)
    builder.Add(all, shape);
  return all;
}

/// Whether faces of a shape have overlapping edges, before anything is done about them.
bool overlaps(const TopoDS_Shape& shape, double within = 1e-6) {
  occt::attributed_shape input;
  input.shape = shape;
  report made;
  return !occt::faces_with_overlapping_edges(occt::repaired_brep(input, made), within).empty();
}

/// A plate whose outline has a line and an arc of a circle so large that are tangent where they meet.
TopoDS_Shape plate_with_cusp(double radius, double length) {
  const gp_Pnt cusp(0, 0, 0), end(length, 0, 0);
  const gp_Circ circle(gp_Ax2(gp_Pnt(0, radius, 0), gp_Dir(0, 0, 1)), radius);
  const double angle = length / radius;
  const gp_Pnt above(radius * std::sin(angle), radius * (1 - std::cos(angle)), 0);
  BRepBuilderAPI_MakeWire wire;
  wire.Add(BRepBuilderAPI_MakeEdge(cusp, end).Edge());
  for (const auto& [from, to] :
       {std::pair(end, gp_Pnt(1, -1, 0)), {gp_Pnt(1, -1, 0), gp_Pnt(1, 1, 0)}, {gp_Pnt(1, 1, 0), above}})
    wire.Add(BRepBuilderAPI_MakeEdge(from, to).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(circle, cusp, above).Edge());
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire(), true).Face(), gp_Vec(0, 0, 1)).Shape();
}

/// A cylinder with a bar at its seam whose upper side is so far below the cylinder's.
TopoDS_Shape cylinder_with_flush_bar(double below) {
  return BRepAlgoAPI_Fuse(BRepPrimAPI_MakeCylinder(2, 3).Shape(),
                          BRepPrimAPI_MakeBox(gp_Pnt(1, -0.5, 1), gp_Pnt(4, 0.5, 3 - below)).Shape())
      .Shape();
}

} // namespace

TEST_CASE("edges of a face that lie on each other are made one, by themselves") {
  for (const double below : {1e-8, 1e-7, 1e-6}) {
    CAPTURE(below);
    CHECK(overlaps(testing::block_with_flush_bar(below), 5e-6));
    const auto joined = read(testing::block_with_flush_bar(below));
    CHECK_FALSE(joined.joined); // nobody has asked for it
    CHECK(joined.model.topology().faces.size() == 11);
    CHECK(most_loops(joined.model) == 1);
    CHECK(most_passages(joined.model.topology()) == 2);
    CAPTURE(joined.report.warnings.back());
    REQUIRE(joined.report.warnings.size() == 1);
    CHECK(joined.report.warnings[0].find("were made one") != std::string::npos);
    CHECK(joined.model.volume().value() == doctest::Approx(9 + 2 * 0.6).epsilon(1e-5));
    const auto made = mesh(joined.model);
    CHECK(made.failures.empty());
    CHECK(made.quality.min_dihedral_deg > 12);
  }
  const auto apart = read(testing::block_with_flush_bar(0.01));
  CHECK(most_loops(apart.model) == 2);
  CHECK(apart.report.warnings.empty());
}

TEST_CASE("so are they on a cylinder, though it has as many faces, edges and vertices then") {
  const TopoDS_Shape shape = cylinder_with_flush_bar(2e-6);
  REQUIRE(overlaps(shape, 5e-6));
  const auto joined = read(shape);
  REQUIRE(joined.report.warnings.size() == 1);
  CHECK(joined.report.warnings[0].find("were made one") != std::string::npos);
  CHECK(mesh(joined.model).quality.min_dihedral_deg > 12);
}

TEST_CASE("so are they of solids that touch others, and names outlast it") {
  const TopoDS_Shape bar = testing::block_with_flush_bar(1e-7);
  occt::attributed_shape input;
  input.shape = compound_of({bar, BRepPrimAPI_MakeBox(gp_Pnt(0, 3, 0), 1, 1, 1).Shape(),
                             BRepPrimAPI_MakeBox(gp_Pnt(10, 0, 0), 1, 1, 1).Shape()});
  input.source = "bar";
  const TopTools_IndexedMapOfShape faces = occt::sub_shapes(bar, TopAbs_FACE);
  for (int f = 1; f <= faces.Extent(); ++f)
    input.names[faces(f)].name = "side " + std::to_string(f);
  input.names[bar].name = "bar";
  const auto joined = occt_model_from(std::move(input));
  const auto& topology = joined.model.topology();
  CHECK(topology.solids.size() == 3);
  CHECK(topology.solids[0].name == "bar");
  for (const auto& face : topology.faces)
    CHECK(face.name.empty() == (face.solids[0] != 0));
  const auto made = mesh(joined.model);
  CHECK(made.failures.empty());
  CHECK(made.quality.min_dihedral_deg > 12);
}

TEST_CASE("edges lie on each other over more than a point, or they do not") {
  CHECK_FALSE(overlaps(BRepPrimAPI_MakeBox(1, 1, 1).Shape()));
  CHECK_FALSE(overlaps(BRepPrimAPI_MakeCylinder(1, 2).Shape())); // a seam
  CHECK_FALSE(overlaps(testing::pin_in_hole(0.1)));
  CHECK_FALSE(overlaps(testing::block_with_flush_bar(1e-3)));
  CHECK_FALSE(overlaps(cylinder_with_flush_bar(0.1)));
  for (const double radius : {1.0, 20.0, 1000.0}) {
    CAPTURE(radius);
    // A quarter of the way along they are as near as that, half way not.
    CHECK_FALSE(overlaps(plate_with_cusp(radius, std::sqrt(16e-6 * radius))));
  }
  // The corner of an opening touches the outer boundary: a point.
  const TopoDS_Shape bar =
      BRepPrimAPI_MakePrism(
          BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakePolygon(gp_Pnt(1, 1, -1), gp_Pnt(2, 0, -1),
                                                             gp_Pnt(3, 1, -1), gp_Pnt(2, 2, -1), true)
                                      .Wire())
              .Face(),
          gp_Vec(0, 0, 3))
          .Shape();
  CHECK_FALSE(overlaps(BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(4, 4, 1).Shape(), bar).Shape()));
}
