#include "archetypes.hpp"

#include "dovetail/geometry/discrete_model.hpp"
#include "dovetail/io/distributed_validity.hpp"
#include "dovetail/io/mesh_hash.hpp"
#include "dovetail/mesher/by_regions.hpp"
#include "dovetail/mesher/tetgen.hpp"
#include "dovetail/pipeline/generate.hpp"

#include <doctest/doctest.h>

#include <functional>

// What each concept rejects is in compile_fail/.

namespace dovetail {
namespace {

static_assert(graph_partitioner<archetype::partitioner>);
static_assert(graph_partitioner<std::function<std::vector<local_id>(const csr_graph&, int)>>);
static_assert(sizing_field<archetype::sizing> && sizing_field<any_sizing>);
static_assert(sizing_field<decltype([](vec3 p) { return p.x; })>);
static_assert(piece_mesher<archetype::mesher, 3> && boundary_keeping_mesher<archetype::mesher, 3>);
static_assert(!piece_mesher<archetype::mesher, 2>, "it makes tetrahedra");
static_assert(surface_mesher<archetype::surface_mesher_as<remesh::patch_remesher>, any_surface>);
static_assert(improver<archetype::improver, 3>);
static_assert(!improver<archetype::improver, 2>, "it improves tetrahedra");
static_assert(executor<archetype::executor>);
static_assert(geometry_model<archetype::geometry>);
static_assert(mesh_writer<archetype::writer> && mesh_reader<archetype::reader>);
static_assert(!mesh_writer<archetype::reader> && !mesh_reader<archetype::writer>);

/// The unit cube, two triangles per face.
discrete_model unit_cube() {
  triangle_soup soup;
  for (const double z : {0.0, 1.0})
    for (const double y : {0.0, 1.0})
      for (const double x : {0.0, 1.0})
        soup.points.push_back({x, y, z});
  soup.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  soup.patches.assign(soup.triangles.size(), no_id);
  return discrete_model(repaired(soup));
}

TEST_CASE("archetypes do what their concept's semantics say") {
  csr_graph path;
  path.offsets = {0, 1, 3, 4};
  path.neighbours = {1, 0, 2, 1};
  CHECK(archetype::partitioner(0)(path, 3) == std::vector<local_id>{0, 1, 2});

  const archetype::executor executor;
  const auto outcomes = executor.run(2, [](std::size_t i) { return byte_buffer(i); }, {});
  REQUIRE(outcomes.size() == 2);
  CHECK(outcomes[1].ok);
  CHECK(outcomes[1].result.size() == 1);
}

TEST_CASE("the pipeline needs no more of any policy than its concept says") {
  const discrete_model cube = unit_cube();
  const archetype::geometry_as geometry(cube);
  using improver = archetype::improver;
  using partitioner = archetype::partitioner;
  using mesher = archetype::mesher_as<dovetail::mesher::tetgen>;
  generate_options options;
  options.subdomains = 3;
  const parameters<mesher, partitioner, improver, archetype::executor> given{
      mesher(dovetail::mesher::tetgen{}), partitioner(0), improver(0), archetype::executor(), options};
  const auto result = generate<3>(geometry, archetype::sizing(0), given);
  CHECK(result.failures.empty());
  CHECK(result.mesh.counts.size() == 3);
  CHECK(io::check_distributed(result.mesh).valid());
}

TEST_CASE("pieces of triangles need no more of a surface mesher than its concept says") {
  using surface_mesher = archetype::surface_mesher_as<remesh::patch_remesher>;
  const surface_mesher held(remesh::patch_remesher{});
  const auto result = generate<2>(
      unit_cube(), archetype::sizing(0),
      parameters<>{}.with_mesher(mesher::by_regions<surface_mesher>{held}).with_options({.subdomains = 3}));
  CHECK(result.failures.empty());
  CHECK(io::check_distributed(result.mesh).valid());
  CHECK(io::mesh_hash(result.mesh) ==
        io::mesh_hash(
            generate<2>(unit_cube(), archetype::sizing(0), parameters<>{}.with_options({.subdomains = 3}))
                .mesh));
}

} // namespace
} // namespace dovetail
