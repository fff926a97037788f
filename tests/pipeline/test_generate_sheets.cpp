#include "plane_meshes.hpp"

#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/models/discrete/repair.hpp"
#include "dovetail/models/discrete_model.hpp"
#include "dovetail/parallel/threads.hpp"
#include "models/discrete_shapes.hpp"

#include <algorithm>
#include <cmath>

using namespace dovetail;
using namespace dovetail::testing;

// Open surfaces of triangles: D = 2 remeshes them and keeps their boundary; they enclose nothing for D = 3.

namespace {

discrete_model sheet(const triangle_soup& soup) {
  return discrete_model(repaired(soup, "sheet", {.allow_sheets = true}), {.allow_sheets = true});
}

/// Length of the edges with one triangle, all of whose ends satisfy `is_on_rim`.
template <class OnRim>
double rim_length(const whole_mesh& mesh, OnRim&& is_on_rim) {
  const auto count = passages(mesh);
  double sum = 0;
  for (const auto& [edge, times] : count)
    if (!count.contains({edge[1], edge[0]})) {
      const vec3 a = mesh.points.at(edge[0]), b = mesh.points.at(edge[1]);
      REQUIRE(is_on_rim(a));
      REQUIRE(is_on_rim(b));
      sum += distance(a, b);
    }
  return sum;
}

} // namespace

TEST_CASE("a box without its lid is remeshed, its rim kept") {
  const auto model = sheet(open_box_soup({0, 0, 0}, {1, 1, 1}, 2));
  const auto result = generate<2>(model, uniform_size(0.05), parameters<>{}.with_options(in_parts(4)));
  const auto mesh = require_valid(result);
  CHECK(result.mesh.counts.size() == 4);
  CHECK(area_of(mesh) == doctest::Approx(5));
  CHECK(euler_characteristic(mesh) == 1);
  CHECK(rim_length(mesh, [](vec3 p) { return p.z == 1; }) == doctest::Approx(4));
  CHECK(result.quality.min_dihedral_deg > 25);
}

TEST_CASE("a curved sheet of many charts is remeshed, its rim kept, the same by threads") {
  const auto saddle = sheet_soup(24, [](double x, double y) { return x * x - y * y; });
  const auto model = sheet(saddle);
  const auto run = [&](const auto& given) { return generate<2>(model, uniform_size(0.06), given); };
  const auto given = parameters<>{}.with_options(in_parts(5));
  const auto result = run(given);
  const auto mesh = require_valid(result);
  CHECK(euler_characteristic(mesh) == 1);
  rim_length(mesh, [](vec3 p) { return std::max(std::abs(p.x), std::abs(p.y)) > 1 - 1e-12; });
  // The area of the triangles given, but for what chords cut off.
  double area = 0;
  for (const auto& [a, b, c] : saddle.triangles) {
    const auto at = [&](local_id v) { return saddle.points[v]; };
    area += 0.5 * norm(cross(at(b) - at(a), at(c) - at(a)));
  }
  CHECK(area_of(mesh) == doctest::Approx(area).epsilon(0.01));
  CHECK(io::mesh_hash(run(given.with_executor(parallel::threads{.worker_count = 2})).mesh) ==
        io::mesh_hash(result.mesh));
}

TEST_CASE("a sheet encloses nothing to fill with tetrahedra") {
  const auto model = sheet(open_box_soup({0, 0, 0}, {1, 1, 1}, 2));
  CHECK_THROWS_AS((void)generate<3>(model, uniform_size(0.2), parameters<>{}.with_mesher(mesher::tetgen{})),
                  geometry_error);
}
