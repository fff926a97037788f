#include "plane_meshes.hpp"

#include "dovetail/distributed/processes.hpp"
#include "dovetail/experiments/builtin_models.hpp"
#include "dovetail/files/msh_writer.hpp"
#include "dovetail/files/read_mesh.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "dovetail/intersection/crossing_triangles.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/parallel/checkpointed.hpp"
#include "dovetail/sizing/sources.hpp"
#include "files/scratch_folder.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>

using namespace dovetail;
using namespace dovetail::testing;

namespace {

template <executor E = parallel::serial>
generated<2> mesh_shell(const TopoDS_Shape& shape, double size, int parts, E run = {}) {
  return generate<2>(occt_shape_from(shape).model, uniform_size(size),
                     parameters<>{}.with_executor(run).with_options(in_parts(parts)));
}

} // namespace

TEST_CASE("a sphere: closed, every vertex on it") {
  const auto result = mesh_shell(BRepPrimAPI_MakeSphere(2.0).Shape(), 0.15, 6);
  const auto mesh = require_valid(result);
  CHECK(euler_characteristic(mesh) == 2);
  for (const auto& [id, p] : mesh.points)
    REQUIRE(norm(p) == doctest::Approx(2).epsilon(1e-9));
  CHECK(area_of(mesh) == doctest::Approx(16 * std::numbers::pi).epsilon(5e-3));
  CHECK(result.coarse_angles.violations.empty());
  CHECK(result.fine_angles.min_dihedral_deg() > 48);
}

TEST_CASE("the report has all stages in their order, each with what it did") {
  const auto summary = mesh_shell(BRepPrimAPI_MakeSphere(2.0).Shape(), 0.3, 4).summary;
  const std::vector<std::pair<std::string, std::string>> stages{
      {"background", "elements"},  {"simplification", "super_elements"},
      {"partition", "subdomains"}, {"skeleton", "lines"},
      {"intersection", ""},        {"meshing", "elements"}};
  REQUIRE(summary.children.size() == stages.size());
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const std::string& name = stages[k].first; // named, since clang 14 captures no structured binding
    const std::string& counter = stages[k].second;
    CAPTURE(name);
    CHECK(summary.children[k].name == name);
    if (!counter.empty()) {
      CHECK(summary.find(name).get(counter) > 0);
      CHECK(summary.children[k].seconds > 0);
    }
  }
}

TEST_CASE("a part of a report is found by its name, the nearest to the root") {
  const report first{"leaf", 1, {}, {}, {}}, second{"leaf", 2, {}, {}, {}}, deep{"deep", 3, {}, {}, {}};
  const report root{"root", 0, {}, {}, {{"a", 0, {}, {}, {first, deep}}, second}};
  CHECK(root.find("leaf").seconds == 2);
  CHECK(root.find("deep").seconds == 3);
  CHECK(root.find("nothing").name.empty());
}

TEST_CASE(
    "from the background mesh that an earlier run has kept comes the same mesh, within the same bounds") {
  const scratch_folder folder("kept_background");
  const auto run = [&](const spool& disk) {
    // Larger than the curvature allows: the bounds of the surface are the sizes.
    return generate<2>(occt_shape_from(BRepPrimAPI_MakeTorus(2.0, 0.7).Shape()).model, uniform_size(1.5),
                       parameters<>{}
                           .with_executor(parallel::checkpointed(parallel::serial{}, disk))
                           .with_options(in_parts(3)));
  };
  const auto first = run(spool::start(folder, {}));
  const auto hash = io::mesh_hash(first.mesh);
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (const auto name = entry.path().filename().string();
        name.starts_with("piece_") || name.starts_with("skeleton_"))
      std::filesystem::remove(entry.path());
  const auto second = run(spool::resume(folder, {}));
  CHECK(second.summary.children[0].get("kept") == 1);
  CHECK(second.summary.children.back().get("reused") == 0);
  CHECK(io::mesh_hash(second.mesh) == hash);
}

TEST_CASE("a torus and a cylinder: seams, an edge between faces") {
  const auto torus = require_valid(mesh_shell(BRepPrimAPI_MakeTorus(2.0, 0.7).Shape(), 0.15, 5));
  CHECK(euler_characteristic(torus) == 0);
  for (const auto& [id, p] : torus.points)
    REQUIRE(std::hypot(std::hypot(p.x, p.y) - 2, p.z) == doctest::Approx(0.7).epsilon(1e-8));

  const auto result = mesh_shell(BRepPrimAPI_MakeCylinder(1.0, 2.0).Shape(), 0.1, 5);
  const auto cylinder = require_valid(result);
  CHECK(euler_characteristic(cylinder) == 2);
  for (std::size_t t = 0; t < cylinder.triangles.size(); ++t) {
    vec3 normal =
        cross(cylinder.points.at(cylinder.triangles[t][1]) - cylinder.points.at(cylinder.triangles[t][0]),
              cylinder.points.at(cylinder.triangles[t][2]) - cylinder.points.at(cylinder.triangles[t][0]));
    REQUIRE(dot(normal, cylinder.points.at(cylinder.triangles[t][0]) - vec3{0, 0, 1}) > 0); // outwards
  }
}

TEST_CASE("the shell's mesh is the same for any number of workers") {
  const auto sphere = BRepPrimAPI_MakeSphere(1.0).Shape();
  const auto expected = io::mesh_hash(mesh_shell(sphere, 0.08, 6).mesh);
  for (const int workers : {1, 2, 4})
    CHECK(io::mesh_hash(mesh_shell(sphere, 0.08, 6, parallel::processes{.worker_count = workers}).mesh) ==
          expected);
}

namespace {

std::size_t crossings_of(const generated<2>& result) {
  const auto mesh = require_valid(result);
  std::vector<vec3> points;
  for (const auto& [id, p] : mesh.points)
    points.push_back(p);
  std::vector<simplex<2>> triangles;
  for (const auto& [a, b, c] : mesh.triangles)
    triangles.push_back({static_cast<local_id>(a), static_cast<local_id>(b), static_cast<local_id>(c)});
  return crossing_triangles(points, triangles, {}, parallel::serial{}).size();
}

TopoDS_Shape pipe(double inner_radius) {
  const auto outside = BRepPrimAPI_MakeCylinder(1.0, 2.0).Shape();
  return BRepAlgoAPI_Cut(outside, BRepPrimAPI_MakeCylinder(inner_radius, 2.0).Shape()).Shape();
}

double found(const generated<2>& result, const char* counter) {
  return result.summary.children.at(4).get(counter);
}

} // namespace

TEST_CASE("with a size as large as the model, sheets that are near to each other do not cross") {
  const auto result = mesh_shell(pipe(0.85), 3.4, 2);
  CHECK(euler_characteristic(require_valid(result)) == 0);
  CHECK(crossings_of(result) == 0);
}

TEST_CASE("finished pieces that cross are made again with a smaller size there") {
  const auto thin = pipe(0.99);
  const auto result = mesh_shell(thin, 3.0, 2);
  CHECK(crossings_of(result) == 0);
  CHECK(found(result, "crossings") > 0);
  CHECK(found(result, "refinements") > 0);
  CHECK(result.summary.children.at(4).name == "intersection");
  CHECK(io::mesh_hash(mesh_shell(thin, 3.0, 2, parallel::processes{.worker_count = 2}).mesh) ==
        io::mesh_hash(result.mesh));
}

TEST_CASE("with the pieces in a spool the same crossings are found and mended") {
  const scratch_folder folder("shell_spool");
  const auto disk = spool::start(folder / "spool", {{"test", "crossing"}});
  const auto model = occt_shape_from(pipe(0.99)).model;
  const auto stored = generate<2>(model, uniform_size(3.0),
                                  parameters<>{}
                                      .with_executor(parallel::checkpointed(parallel::serial{}, disk))
                                      .with_options(in_parts(2)));
  CHECK(crossings_of(stored) == 0);
  CHECK(io::mesh_hash(stored.mesh) == io::mesh_hash(mesh_shell(pipe(0.99), 3.0, 2).mesh));
}

TEST_CASE("pieces that still cross when no round is left are an error that names both faces") {
  const auto model = occt_shape_from(pipe(0.9)).model;
  generate_options options = in_parts(6);
  options.refinement_rounds = 0;
  CHECK_THROWS_WITH_AS(generate<2>(model, uniform_size(3.0), parameters<>{}.with_options(options)),
                       doctest::Contains(" and face "), intersection_error);
}

TEST_CASE(
    "a ring far thinner than the size: sizes are small along it, so that its surface never crosses itself") {
  const auto model = occt_shape_from(BRepPrimAPI_MakeTorus(50, 0.3).Shape()).model;
  const auto result = generate<2>(model, uniform_size(8.0), parameters<>{}.with_options(in_parts(2)));
  CHECK(euler_characteristic(require_valid(result)) == 0);
  CHECK(crossings_of(result) == 0);
  CHECK(result.summary.find("background").find("coarse surface").get("refinement_rounds") == 0);
}

/// Folds over beside segments of fine length near one place of a rim, as surfaces do that turn sharply there.
struct folding_at_a_place {
  patch_mesh operator()(const any_surface& surface, const patch_boundary& boundary,
                        const any_sizing& size) const {
    patch_mesh made = remesh::patch_remesher{}(surface, boundary, size);
    for (const auto& [a, b] : boundary.segments) {
      const vec3 from = boundary.points[a], to = boundary.points[b];
      const double length = distance(from, to);
      if (length < 0.1 || length > 0.3 || distance(midpoint(from, to), place) > 0.3)
        continue;
      for (std::size_t t = 0; t < made.triangles.size() && made.folded.empty(); ++t)
        if (std::find(made.triangles[t].begin(), made.triangles[t].end(), a) != made.triangles[t].end())
          made.folded.push_back(static_cast<local_id>(t));
    }
    return made;
  }
  static constexpr vec3 place{1, 0, 2};
};

TEST_CASE("where a piece stays folded over its lines become finer, and nothing else does") {
  const auto model = occt_shape_from(BRepPrimAPI_MakeCylinder(1.0, 2.0).Shape()).model;
  generate_options options = in_parts(3);
  options.coarse_scale = 4;
  const auto folding = parameters<>{}.with_surface_mesher(folding_at_a_place{});
  const auto plain = generate<2>(model, uniform_size(0.2), parameters<>{}.with_options(options));
  const auto finer = generate<2>(model, uniform_size(0.2), folding.with_options(options));
  CHECK(finer.failures.empty());
  CHECK(finer.summary.find("intersection").get("refinements") > 0);
  CHECK(finer.summary.find("intersection").get("merged_after_failure") == 0);
  CHECK(finer.mesh.counts.size() == plain.mesh.counts.size());
  const auto mesh = require_valid(finer);
  CHECK(mesh.triangles.size() > require_valid(plain).triangles.size());
  CHECK(mesh.triangles.size() < 2 * require_valid(plain).triangles.size());

  options.refinement_rounds = 0; // then it is merged, and fails
  CHECK_FALSE(generate<2>(model, uniform_size(0.2), folding.with_options(options)).failures.empty());
}

TEST_CASE("written to VTU and MSH files, a shell reads back as the same mesh, with its faces") {
  const auto result = mesh_shell(BRepPrimAPI_MakeCylinder(1.0, 2.0).Shape(), 0.2, 3);
  std::map<local_id, std::size_t> of_face;
  for (const local_id face : require_valid(result).faces)
    ++of_face[face];
  REQUIRE(of_face.size() == 3);
  const scratch_folder folder("shell_files");
  io::vtu_writer{}(result.mesh, folder / "vtu");
  io::vtu_writer{.files = 2}(result.mesh, folder / "vtu2");
  io::msh_writer{}(result.mesh, folder / "msh");
  for (const char* name : {"vtu", "vtu2", "msh"}) {
    const auto read = io::read_mesh(folder / name);
    INFO(name);
    CHECK(read.mesh.elements.empty());
    CHECK(io::mesh_hash(read) == io::mesh_hash(result.mesh));
    std::map<local_id, std::size_t> read_of_face;
    for (const local_id face : read.triangle_tags)
      ++read_of_face[face];
    CHECK(read_of_face == of_face);
  }
}

TEST_CASE("the aircraft in its box: several closed shells") {
  auto built = builtin_model("aircraft");
  for (auto& source : built.sources)
    for (auto& spacing : source.spacing)
      spacing *= 2;
  const auto result = generate<2>(built.model, source_field(2 * built.size, built.sources),
                                  parameters<>{}.with_options(in_parts(8)));
  const auto mesh = require_valid(result);
  const auto passed = passages(mesh);
  for (const auto& [edge, count] : passed)
    REQUIRE(passed.contains({edge[1], edge[0]})); // closed
  CHECK(result.mesh.counts.size() >= 8);
}
