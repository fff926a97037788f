#include "dovetail/adapters/cgal_mesh_3.hpp"
#include "mesher/mesher_contract.hpp"

#include <doctest/doctest.h>

#include <array>
#include <thread>
#include <vector>

using namespace dovetail;

// That it promises no boundary is a static_assert at its definition.

namespace {

mesher_result<3> meshed(const shapes::surface& boundary, double h) {
  return mesher::cgal_mesh_3{}({boundary, 5}, [h](vec3) { return h; });
}

/// What a mesher of whole domains promises; within 2 % of the volume.
void check_domain(const shapes::surface& boundary, double h) {
  const auto result = meshed(boundary, h);
  const auto faults = check_validity(result.mesh);
  CHECK_MESSAGE(faults.valid(), faults.text());
  CHECK(contract::volume_of(result.mesh) ==
        doctest::Approx(enclosed_volume(boundary.points, boundary.elements)).epsilon(0.02));
  CHECK(contract::mean_edge(result.mesh) == doctest::Approx(h).epsilon(0.06));
  CHECK(result.mesh.tags == std::vector<local_id>(result.mesh.elements.size(), 5));
  CHECK(result.summary.get("elements") == static_cast<double>(result.mesh.elements.size()));
}

} // namespace

TEST_CASE("Mesh_3 fills bodies and spares their voids, at the size asked for") {
  check_domain(shapes::cube(4), 0.1);
  check_domain(shapes::sphere(3), 0.15);
  auto with_void = shapes::cube(4);
  shapes::append(with_void, shapes::sphere(3, 0.3, {0.5, 0.5, 0.5}), true);
  check_domain(with_void, 0.08);
}

TEST_CASE("Mesh_3 keeps ridges as lines: the mesh of a cube is the cube") {
  CHECK(contract::volume_of(meshed(shapes::cube(3), 0.15).mesh) == doctest::Approx(1).epsilon(1e-9));
}

TEST_CASE("Mesh_3 repeats itself, also in one process") {
  contract::check_repeats(mesher::cgal_mesh_3{});
}

TEST_CASE("Mesh_3 gives the same mesh in several threads") {
  static_assert(mesher::cgal_mesh_3::traits.thread_safe);
  const auto boundary = shapes::sphere(2);
  const auto expected = meshed(boundary, 0.3).mesh;
  std::array<simplicial_mesh<3>, 4> made;
  std::vector<std::thread> workers;
  for (auto& mine : made)
    workers.emplace_back([&] { mine = meshed(boundary, 0.3).mesh; });
  for (auto& worker : workers)
    worker.join();
  for (const auto& mine : made) {
    CHECK(mine.points == expected.points);
    CHECK(mine.elements == expected.elements);
  }
}

TEST_CASE("Mesh_3's failures are typed") {
  contract::check_errors(mesher::cgal_mesh_3{});
  contract::check_self_intersection(mesher::cgal_mesh_3{});
}
