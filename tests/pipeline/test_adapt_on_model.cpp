/// Meshes made anew on the model that they are meshes of: nothing drifts, ids and materials are found again.
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/models/occt/triangulation.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/models/plane/svg_path.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "dovetail/solver/adapt.hpp"
#include "dovetail/solver/gather.hpp"
#include "support/refusal.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shape.hxx>
#include <doctest/doctest.h>
#include <gp_Ax2.hxx>
#include <gp_Pnt.hxx>

#include <algorithm>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace dovetail;
using testing::has;

namespace {

auto by_tetgen() {
  generate_options options;
  options.subdomains = 2;
  return parameters<>{}.with_mesher(mesher::tetgen{}).with_options(options);
}

/// A cylinder, and beside it a ball.
occt_model two_bodies(double radius = 0.7) {
  TopoDS_Compound both;
  const BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, BRepPrimAPI_MakeCylinder(radius, 2.0).Shape());
  builder.Add(both, BRepPrimAPI_MakeSphere(gp_Pnt(2, 0, 1), 0.8).Shape());
  return occt_shape_from(both).model;
}

double volume_inside(const simplicial_mesh<3>& mesh) {
  const auto at = [&](local_id v) { return mesh.points[v]; };
  double sum = 0;
  for (const auto& [a, b, c, d] : mesh.elements)
    sum += signed_volume(at(a), at(b), at(c), at(d));
  return sum;
}

/// With materials and ids of its own: 7 and 3, and those of faces and 100.
adaptable_mesh<3> first_mesh(const occt_model& model, double size) {
  auto whole = io::gather(generate<3>(model, uniform_size(size), by_tetgen()).mesh);
  for (local_id& tag : whole.mesh.tags)
    tag = tag == 0 ? 7 : 3;
  for (local_id& id : whole.side_hosts)
    id += 100;
  return {std::move(whole.mesh), std::move(whole.sides), std::move(whole.side_hosts)};
}

std::map<local_id, double> volumes(const simplicial_mesh<3>& mesh) {
  std::map<local_id, simplicial_mesh<3>> parts;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    auto& part = parts[mesh.tags[e]];
    part.points = mesh.points;
    part.elements.push_back(mesh.elements[e]);
  }
  std::map<local_id, double> found;
  for (const auto& [tag, part] : parts)
    found[tag] = volume_inside(part);
  return found;
}

std::map<local_id, double> areas(const adaptable_mesh<3>& mesh) {
  std::map<local_id, double> sum;
  for (std::size_t s = 0; s < mesh.sides.size(); ++s) {
    const auto at = [&](std::size_t k) { return mesh.mesh.points[mesh.sides[s][k]]; };
    sum[mesh.side_ids[s]] += 0.5 * norm(cross(at(1) - at(0), at(2) - at(0)));
  }
  return sum;
}

} // namespace

TEST_CASE("rounds of refinement on a model come nearer to its volume; ids and materials stay") {
  const occt_model model = two_bodies();
  const auto exact = occt_solid_volumes(model);
  auto mesh = first_mesh(model, 0.6);
  const auto areas_before = areas(mesh);
  double volume = volume_inside(mesh.mesh);
  for (const double size : {0.45, 0.35, 0.27, 0.2}) {
    CAPTURE(size);
    const std::vector<double> sizes(mesh.mesh.points.size(), size);
    const auto made = adapt<3>(model, mesh, sizes, by_tetgen());
    REQUIRE(made.failures.empty());
    CHECK(io::check_distributed(made.mesh).text() == "");
    CHECK(made.summary.warnings.empty());
    const report& change = made.summary.find("adaptation");
    CHECK(change.warnings.empty());
    CHECK(change.get("volume_before") == doctest::Approx(volume).epsilon(1e-12));
    mesh = dovetail::whole_mesh(made);
    CHECK(volume_inside(mesh.mesh) > volume);
    volume = volume_inside(mesh.mesh);
    CHECK(change.get("volume_after") == doctest::Approx(volume).epsilon(1e-9));
    const auto by_material = volumes(mesh.mesh);
    REQUIRE(by_material.size() == 2);
    CHECK(by_material.at(7) == doctest::Approx(exact[0]).epsilon(0.1));
    CHECK(by_material.at(3) == doctest::Approx(exact[1]).epsilon(0.1));
    const auto now = areas(mesh);
    REQUIRE(now.size() == areas_before.size());
    for (const auto& [id, area] : areas_before)
      CHECK(now.at(id) == doctest::Approx(area).epsilon(0.15));
  }
  const auto fresh = io::gather(generate<3>(model, uniform_size(0.2), by_tetgen()).mesh);
  CHECK(volume == doctest::Approx(volume_inside(fresh.mesh)).epsilon(2e-3));
}

TEST_CASE("the model of the first adaptation serves the others") {
  auto mesh = first_mesh(two_bodies(), 0.3);
  const auto first = adapt<3>(mesh, uniform_size(0.25), by_tetgen());
  mesh = dovetail::whole_mesh(first);
  const double volume = volume_inside(mesh.mesh);
  for (int round = 0; round < 4; ++round)
    mesh = dovetail::whole_mesh(
        adapt<3>(first.model, mesh, uniform_size(round % 2 == 0 ? 0.3 : 0.25), by_tetgen()));
  CHECK(volume_inside(mesh.mesh) == doctest::Approx(volume).epsilon(1e-3));
  CHECK(volumes(mesh.mesh).size() == 2);
}

TEST_CASE("what is lost without a model is in the report, with a warning where chords do not explain it") {
  const auto rough = first_mesh(two_bodies(), 0.6);
  const auto finer = adapt<3>(rough, uniform_size(0.35), by_tetgen());
  const report& gained = finer.summary.find("adaptation");
  CHECK(gained.warnings.empty());
  const double volume = gained.get("volume_before");
  CHECK(gained.get("volume_after") - volume == doctest::Approx(gained.get("explained_change")).epsilon(0.5));

  auto larger = model_of_boundary(rough);
  larger.before.volume *= 1.1; // as if the boundary had lost so much
  const any_parameters<3> given(by_tetgen());
  const auto lost = mesh_again<3>(std::move(larger), uniform_size(0.6), given);
  const report& told = lost.summary.find("adaptation");
  REQUIRE(told.warnings.size() == 1);
  CHECK(has(told.warnings[0], "where chords of these sizes explain"));
  CHECK(has(told.warnings[0], "adapt on the model"));

  auto on_model = model_of_mesh<3>(two_bodies(), rough);
  on_model.before.volume *= 1.1;
  const auto told_of_model =
      mesh_again<3>(std::move(on_model), uniform_size(0.6), given).summary.find("adaptation").warnings;
  REQUIRE(told_of_model.size() == 1);
  CHECK(has(told_of_model[0], "%; take smaller sizes"));
}

TEST_CASE("a model that is not the mesh's, and ids on parts of its faces, are refused") {
  const occt_model model = two_bodies();
  const auto mesh = first_mesh(model, 0.4);
  const auto told = [&](const occt_model& on, const adaptable_mesh<3>& old) {
    return testing::refusal_of<mesh_error>([&] { return adapt<3>(on, old, uniform_size(0.4), by_tetgen()); });
  };
  CHECK(has(told(two_bodies(2.0), mesh), "the mesh is not one of the model"));
  const TopoDS_Shape cube = BRepPrimAPI_MakeBox(2, 2, 2).Shape();
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(gp_Pnt(1, 1, 1), 0.5).Shape();
  const auto hollow = first_mesh(occt_shape_from(BRepAlgoAPI_Cut(cube, ball).Shape()).model, 0.4);
  CHECK(has(told(occt_shape_from(cube).model, hollow), "the model has nothing"));
  auto parts = mesh;
  for (std::size_t s = 0; s < parts.sides.size(); ++s)
    if (parts.mesh.points[parts.sides[s][0]].z > 1)
      parts.side_ids[s] += 50;
  CHECK(has(told(model, parts), "a whole face has one id: adapt without the model"));
  auto materials = mesh;
  for (std::size_t e = 0; e < materials.mesh.elements.size(); ++e)
    if (materials.mesh.points[materials.mesh.elements[e][0]].z > 1)
      materials.mesh.tags[e] = 9;
  CHECK(has(told(model, materials), "a whole solid has one material"));
  auto inverted = mesh;
  std::swap(inverted.mesh.elements[5][0], inverted.mesh.elements[5][1]);
  CHECK(has(told(model, inverted), "not valid"));
}

TEST_CASE("triangles are adapted on their model, with ids of faces and edges") {
  const plane_domain ring(drawing_from_svg_path("M1 0 A1 1 0 0 1 -1 0 A1 1 0 0 1 1 0 Z"));
  const auto whole = io::gather(generate<2>(ring, uniform_size(0.5), parameters<>{}).mesh);
  adaptable_mesh<2> mesh{whole.mesh, whole.sides, whole.side_hosts};
  for (local_id& tag : mesh.mesh.tags)
    tag += 40;
  for (local_id& id : mesh.side_ids)
    id += 60;
  std::vector<local_id> ids = mesh.side_ids;
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  double before = 0;
  for (const double size : {0.3, 0.2, 0.1}) {
    const auto made = adapt<2>(ring, mesh, uniform_size(size), parameters<>{});
    CHECK(made.summary.warnings.empty());
    const double area = made.summary.find("adaptation").get("area_after");
    CHECK(area > before);
    before = area;
    mesh = dovetail::whole_mesh(made);
    for (const local_id tag : mesh.mesh.tags)
      REQUIRE(tag == 40);
    std::vector<local_id> now = mesh.side_ids;
    std::sort(now.begin(), now.end());
    now.erase(std::unique(now.begin(), now.end()), now.end());
    CHECK(now == ids);
  }
  CHECK(before == doctest::Approx(std::numbers::pi).epsilon(3e-3));
}
