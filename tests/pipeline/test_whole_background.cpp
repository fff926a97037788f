#include "dovetail/adapters/cgal_mesh_3.hpp"
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesh/validity.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/pipeline/whole_background.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "solid_meshes.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <doctest/doctest.h>

#include <numbers>
#include <utility>

using namespace dovetail;

namespace {

const auto given = parameters<>{}.with_mesher(mesher::tetgen{}).with_options({.subdomains = 3});

/// Generates a mesh from a background mesh of Mesh_3; the background's boundary lies on the model.
void check_from_mesh_3(const TopoDS_Shape& shape, double h, double volume) {
  const auto model = occt_shape_from(shape).model;
  auto background = make_background_by(mesher::cgal_mesh_3{}, model, uniform_size(h), given);
  const surface_mesh& surface = background.mesh.surface;
  CHECK(check_validity(background.mesh.volume).valid());
  CHECK(testing::volume_of(background.mesh.volume) == doctest::Approx(volume).epsilon(0.05));
  for (std::size_t t = 0; t < surface.mesh.elements.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      REQUIRE(distance(model.face_point(surface.mesh.tags[t], surface.corner_uv[t][k]),
                       surface.mesh.points[surface.mesh.elements[t][k]]) < 1e-6);

  const auto result = generate_from_background<3>(model, std::move(background), given);
  CHECK(result.failures.empty());
  CHECK(result.mesh.counts.size() == 3);
  // part check
  const auto faults = io::check_distributed(result.mesh);
  CHECK_MESSAGE(faults.valid(), faults.text());
  // end
}

} // namespace

TEST_CASE("a background mesh of Mesh_3 serves the pipeline: a box") {
  check_from_mesh_3(BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(2, 1.5, 1)).Shape(), 0.12, 3);
}

TEST_CASE("a background mesh of Mesh_3 serves the pipeline: a ball, whose seam is kept as a line") {
  check_from_mesh_3(BRepPrimAPI_MakeSphere(1.0).Shape(), 0.12, 4.0 / 3 * std::numbers::pi);
}

TEST_CASE("a background mesh of Mesh_3 serves the pipeline: a drilled block") {
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(2, 1.5, 1)).Shape();
  const TopoDS_Shape drill =
      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0.8, 0.7, -1), gp_Dir(0, 0, 1)), 0.35, 3).Shape();
  check_from_mesh_3(BRepAlgoAPI_Cut(block, drill).Shape(), 0.1, 3 - std::numbers::pi * 0.35 * 0.35);
}

namespace {

struct inverting_improver {
  static constexpr improver_traits traits{};
  report operator()(simplicial_mesh<3>& mesh, const frozen_entities<3>&, const any_sizing&) const {
    std::swap(mesh.elements.front()[0], mesh.elements.front()[1]);
    return {};
  }
};

} // namespace

TEST_CASE("an improver that spoils the background mesh of Mesh_3 is named") {
  const auto model = occt_shape_from(BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(2, 1.5, 1)).Shape()).model;
  CHECK_THROWS_WITH_AS(
      make_background_by(mesher::cgal_mesh_3{}, model, uniform_size(0.2),
                         given.with_background_improver(any_improver<3>(inverting_improver{}, "mine"))),
      doctest::Contains("background improver 'mine': "), mesher_error);
}
