// Algorithm 2 of the paper: the fine surface is cut in two until every subdomain is small.
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/distributed/by_elements.hpp"
#include "dovetail/distributed/improve_pieces.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/experiments/baselines/generate_bisected.hpp"
#include "dovetail/experiments/baselines/recursive_bisection/spanning_surface.hpp"
#include "dovetail/experiments/builtin_models.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/remesh/patch_remesher.hpp"
#include "dovetail/sizing/compose.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "pipeline/solid_meshes.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Compound.hxx>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

using namespace dovetail;
using namespace dovetail::testing;

namespace {

any_parameters<3> policies(const any_executor& run = parallel::serial{}) {
  return parameters<>{}.with_mesher(mesher::tetgen{}).with_executor(run);
}

generated<3> bisected(const TopoDS_Shape& shape, double size, std::size_t most_faces,
                      const any_executor& run = parallel::serial{}) {
  return baselines::generate_bisected(any_geometry(occt_shape_from(shape).model),
                                      erased_sizing(uniform_size(size)), policies(run),
                                      {.most_faces = most_faces});
}

const report& bisection_report(const generated<3>& made) {
  return made.summary.find("recursive bisection");
}

/// `chords`: by what part of it chords of curved faces may make the volume smaller.
void check_bisected(const generated<3>& made, double volume, std::size_t most_faces, double chords = 1e-9) {
  REQUIRE(made.failures.empty());
  CHECK(io::check_distributed(made.mesh).text() == "");
  CHECK(volume_of(made.mesh) == doctest::Approx(volume).epsilon(chords));
  CHECK(made.quality.elements > 0);
  const report& cuts = bisection_report(made);
  CHECK(cuts.get("most_faces") <= static_cast<double>(most_faces));
  CHECK(cuts.get("subdomains") == static_cast<double>(made.mesh.counts.size()));
  CHECK(cuts.get("least_dihedral_deg") >= 8);
  CHECK(cuts.get("least_dihedral_deg") >= made.fine_angles.min_dihedral_deg() - 1e-9);
}

} // namespace

TEST_CASE("a cube and a ball are divided until every subdomain has few faces") {
  const auto cube = bisected(BRepPrimAPI_MakeBox(1.0, 1.0, 1.0).Shape(), 0.08, 700);
  check_bisected(cube, 1, 700);
  CHECK(bisection_report(cube).get("cuts") >= 4);
  const auto ball = bisected(BRepPrimAPI_MakeSphere(1.0).Shape(), 0.12, 900);
  check_bisected(ball, 4 * std::numbers::pi / 3, 900, 0.01);
}

TEST_CASE("loops in one another, voids, bodies that a cut leaves apart, and several materials") {
  const auto hollow = bisected(
      BRepAlgoAPI_Cut(BRepPrimAPI_MakeSphere(1.0).Shape(), BRepPrimAPI_MakeSphere(0.4).Shape()).Shape(), 0.12,
      900);
  check_bisected(hollow, 4 * std::numbers::pi / 3 * (1 - 0.4 * 0.4 * 0.4), 900, 0.01);
  const auto off_centre =
      bisected(BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(1.0, 1.0, 1.0).Shape(),
                               BRepPrimAPI_MakeSphere(gp_Pnt(0.2, 0.3, 0.25), 0.1).Shape())
                   .Shape(),
               0.06, 1000);
  check_bisected(off_centre, 1 - 4 * std::numbers::pi / 3 * 0.1 * 0.1 * 0.1, 1000, 0.001);
  const auto torus = bisected(BRepPrimAPI_MakeTorus(1.0, 0.3).Shape(), 0.1, 500);
  check_bisected(torus, 2 * std::numbers::pi * std::numbers::pi * 0.3 * 0.3, 500, 0.03);
  const auto fork =
      bisected(BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(1.0, 0.4, 3.0).Shape(),
                               BRepPrimAPI_MakeBox(gp_Pnt(0.3, -1, 0.5), gp_Pnt(0.7, 2, 4)).Shape())
                   .Shape(),
               0.1, 700);
  check_bisected(fork, 1.2 - 0.4 * 0.4 * 2.5, 700);
  CHECK(bisection_report(fork).get("subdomains") > bisection_report(fork).get("cuts") + 1); // its prongs

  TopoDS_Compound both;
  BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(1, 1, 1)).Shape());
  builder.Add(both, BRepPrimAPI_MakeBox(gp_Pnt(1, 0.2, 0.1), gp_Pnt(2, 0.8, 0.9)).Shape());
  const auto two = bisected(both, 0.1, 500);
  check_bisected(two, 1.48, 500);
  CHECK(std::any_of(two.mesh.counts.begin(), two.mesh.counts.end(),
                    [](const piece_counts& piece) { return piece.material == 1; }));
}

TEST_CASE("the built-in aircraft, and what follows meshing") {
  auto built = builtin_model("aircraft");
  const double volume = built.model.volume().value();
  const any_geometry model(std::move(built.model));
  const erased_sizing size(keep_bounds(scaled(source_field(built.size, std::move(built.sources)), 3)));
  const auto made = baselines::generate_bisected(model, size, policies(), {.most_subdomains = 16});
  check_bisected(made, volume, 20000, 0.01);
  CHECK(made.mesh.counts.size() == 1);
  const auto divided =
      baselines::generate_bisected(model, size, policies(), {.most_faces = 100, .most_subdomains = 16});
  check_bisected(divided, volume, 20000, 0.01);
  CHECK(divided.mesh.counts.size() >= 16);
  CHECK(bisection_report(divided).get("planes") > bisection_report(divided).get("cuts"));
  CHECK(bisection_report(divided).get("too_sharp") > 0);
  const auto even = redistribution_by::elements{}(divided.mesh, 3);
  const auto improved = improve_pieces(*even.mesh, improvement::native{}, {}, parallel::serial{});
  CHECK(io::check_distributed(improved.mesh).text() == "");
  CHECK(improved.quality.min_dihedrals.below(24) <= divided.quality.min_dihedrals.below(24));
}

TEST_CASE("the same mesh by every executor") {
  const auto sphere = BRepPrimAPI_MakeSphere(1.0).Shape();
  const auto by_two = bisected(sphere, 0.2, 300, parallel::processes{.worker_count = 2});
  CHECK(io::mesh_hash(by_two.mesh) == io::mesh_hash(bisected(sphere, 0.2, 300).mesh));
}

namespace {

/// A surface mesher that spoils what the native one makes.
struct spoiling_mesher {
  void (*spoil)(patch_mesh&) = nullptr;

  patch_mesh operator()(const any_surface& surface, const patch_boundary& boundary,
                        const any_sizing& size) const {
    patch_mesh made = remesh::patch_remesher{}(surface, boundary, size);
    spoil(made);
    return made;
  }
};

} // namespace

TEST_CASE("where no plane makes a cut the subdomain stays whole, and the reason is counted") {
  const any_sizing size = uniform_size(0.1);
  const auto cube = bisected(BRepPrimAPI_MakeBox(1.0, 1.0, 1.0).Shape(), 0.1, 100000);
  const fine_skeleton surface = cube.mesh.skeleton;
  const auto divided = [&](const baselines::recursive_bisection& by) { return by(surface, {0}, size); };
  const auto check_whole = [&](const baselines::recursive_bisection& by, const char* reason) {
    CAPTURE(reason);
    const auto made = divided(by);
    CHECK(made.summary.get("subdomains") == 1);
    CHECK(made.summary.get("whole") == 1);
    CHECK(made.summary.get("planes") == 15);
    CHECK(made.summary.get(reason) == 15);
    CHECK(made.fine.sides == surface.sides);
  };
  CHECK(divided({.most_faces = 1000}).summary.get("subdomains") > 1);
  check_whole({.most_faces = 1000, .least_dihedral_deg = 100}, "too_sharp");
  check_whole({.most_faces = 1000, .least_share = 0.6}, "uneven");
  check_whole(
      {.most_faces = 1000, .mesh_interface = spoiling_mesher{[](patch_mesh& made) { made.misplaced = {0}; }}},
      "unspanned");

  // A void with a tip behind the plane: its triangles are on one side, and it crosses what spans the loop.
  fine_skeleton tipped = surface;
  const auto first = static_cast<local_id>(tipped.points.size());
  for (const vec3 p : {vec3{0.3, 0.5, 0.5}, {0.9, 0.4, 0.4}, {0.9, 0.6, 0.4}, {0.9, 0.5, 0.6}})
    tipped.points.own().push_back(p);
  for (const simplex<2> side : {simplex<2>{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}})
    tipped.sides.own().push_back({first + side[0], first + side[1], first + side[2]});
  tipped.subdomains.own().resize(tipped.sides.size(), {0, no_id});
  tipped.side_hosts.own().resize(tipped.sides.size(), 0);
  tipped.point_hosts.own().resize(tipped.points.size(), {2, 0});
  CHECK(baselines::recursive_bisection{.most_faces = 1000}(tipped, {0}, size).summary.get("crossing") > 0);
}

TEST_CASE("a plane between two bodies has no loops") {
  fine_skeleton two;
  for (const double x : {0.0, 3.0})
    for (const vec3 p : {vec3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
      two.points.own().push_back(p + vec3{x, 0, 0});
  for (const local_id first : {0, 4})
    for (const simplex<2> side : {simplex<2>{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}})
      two.sides.own().push_back({first + side[0], first + side[1], first + side[2]});
  two.subdomains.own().assign(two.sides.size(), {0, no_id});
  two.side_hosts.own().assign(two.sides.size(), 0);
  two.point_hosts.own().assign(two.points.size(), {2, 0});
  const auto made = baselines::recursive_bisection{.most_faces = 4}(two, {0}, uniform_size(1.0));
  CHECK(made.summary.get("without_loops") > 0);
  CHECK(made.summary.get("whole") == 1);
}

TEST_CASE("loops are closed, come to a point once, and have what is below on their right") {
  const auto ball = bisected(BRepPrimAPI_MakeSphere(1.0).Shape(), 0.15, 100000);
  const fine_skeleton& skeleton = ball.mesh.skeleton;
  const simplicial_mesh<2> surface{
      {skeleton.points.begin(), skeleton.points.end()}, {skeleton.sides.begin(), skeleton.sides.end()}, {}};
  const auto table = build_sides(surface);
  const auto cut = baselines::cut_surface(surface, table, {{0, 0, 1}, 0.1});
  REQUIRE(cut.simple);
  std::vector<local_id> starts, ends;
  double area = 0; // of the projection, twice
  for (std::size_t k = 0; k < cut.loops.size(); ++k) {
    const auto [a, b] = cut.loops[k];
    starts.push_back(a);
    ends.push_back(b);
    const vec3 p = surface.points[a], q = surface.points[b];
    area += p.x * q.y - p.y * q.x;
    CHECK(std::abs(p.z - 0.1) < 0.15);
    CHECK(cut.above[cut.beside[k][0]] == 0);
    CHECK(cut.above[cut.beside[k][1]] == 1);
  }
  CHECK(area / 2 == doctest::Approx(std::numbers::pi).epsilon(0.1));
  sort_unique(starts);
  sort_unique(ends);
  CHECK(starts == ends);
  CHECK(starts.size() == cut.loops.size());
  // No triangle has two edges on a loop.
  std::vector<local_id> beside;
  for (const auto& pair : cut.beside)
    append(beside, pair);
  const std::size_t all = beside.size();
  sort_unique(beside);
  CHECK(beside.size() == all);

  // A fan from the middle makes nearly right angles; one from outside leaves the ball.
  const auto fan = [&](vec3 apex) {
    baselines::spanning_surface spanning{{apex}, {}};
    for (const auto& [a, b] : cut.loops)
      spanning.triangles.push_back({a, b, static_cast<local_id>(surface.points.size())});
    return baselines::least_dihedral_at_loops(surface, cut, spanning);
  };
  CHECK(fan({0, 0, 0.1}) > 45);
  CHECK(fan({0, 0, 0.1}) < 90);
  CHECK(fan({5, 0, 0.1}) < 0);
}
