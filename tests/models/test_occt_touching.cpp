#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/models/occt/shape.hpp"
#include "dovetail/models/occt/touching_faces.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "models/model_checks.hpp"
#include "models/rings.hpp"

#include <BRepPrimAPI_MakeBox.hxx>
#include <TopoDS_Shape.hxx>
#include <doctest/doctest.h>

#include <algorithm>
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
  const double pi = std::numbers::pi;
  CHECK(sectors_are_apart({{0, 1}, {pi / 2, -1}, {-pi, 1}, {-pi / 2, -1}}));
  CHECK(sectors_are_apart({{1, -1}, {2, 1}, {3, -1}, {-1, 1}}));
  // Two planes that cross, the solid below both: between them it is there twice.
  CHECK_FALSE(sectors_are_apart({{0, -1}, {0.5, -1}, {pi, 1}, {0.5 - pi, 1}}));
  // A sector in another one.
  CHECK_FALSE(sectors_are_apart({{-1, 1}, {-0.5, 1}, {0.5, -1}, {1, -1}}));
  // Two cylinders that touch: their faces are tangent to each other, whatever order rounding puts them in.
  for (const double off : {1e-9, 0.0, -1e-9}) {
    CHECK(sectors_are_apart({{pi / 2, -1}, {pi / 2 + off, 1}, {-pi / 2, 1}, {-pi / 2 + off, -1}}));
    CHECK(sectors_are_apart({{pi, -1}, {off - pi, 1}, {0, 1}, {off, -1}}));
  }
}

TEST_CASE("what does not touch itself stays as it is") {
  for (const double length : {0.0, 1e-3}) {
    CAPTURE(length);
    CHECK_FALSE(read(BRepPrimAPI_MakeBox(1, 2, 3).Shape(), length).joined);
    CHECK_FALSE(read(ring_with_tip(2.5), length).joined);
  }
}

TEST_CASE("edges of a face that lie on each other are made one, by themselves") {
  const auto most_loops = [](const occt_model& model) {
    std::size_t most = 0;
    for (const auto& face : model.topology().faces)
      most = std::max(most, face.loops.size());
    return most;
  };
  for (const double below : {1e-8, 1e-7, 1e-6}) {
    CAPTURE(below);
    const auto joined = read(testing::block_with_flush_bar(below));
    CHECK_FALSE(joined.joined); // nobody has asked for it
    CHECK(joined.model.topology().faces.size() == 11);
    CHECK(most_loops(joined.model) == 1);
    CHECK(most_passages(joined.model.topology()) == 2);
    REQUIRE(joined.report.warnings.size() == 1);
    CHECK(joined.report.warnings[0].starts_with("edges that lie on each other"));
    CHECK(joined.model.volume().value() == doctest::Approx(9 + 2 * 0.6).epsilon(1e-5));
    const auto made = mesh(joined.model);
    CHECK(made.failures.empty());
    CHECK(made.quality.min_dihedral_deg > 12);
  }
  const auto apart = read(testing::block_with_flush_bar(0.01));
  CHECK(most_loops(apart.model) == 2);
  CHECK(apart.report.warnings.empty());
}

TEST_CASE("edges lie on each other over more than a point, or they do not") {
  const auto overlaps = [](const TopoDS_Shape& shape) {
    return occt::face_with_overlapping_edges(read(shape).model.data(), 1e-6).has_value();
  };
  CHECK_FALSE(overlaps(BRepPrimAPI_MakeBox(1, 1, 1).Shape()));
  CHECK_FALSE(overlaps(BRepPrimAPI_MakeCylinder(1, 2).Shape())); // a seam
  CHECK_FALSE(overlaps(testing::pin_in_hole(0.1)));
  CHECK_FALSE(overlaps(testing::block_with_flush_bar(1e-3)));
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
