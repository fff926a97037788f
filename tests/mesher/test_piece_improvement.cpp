#include "dovetail/improver/native.hpp"
#include "dovetail/meshing/piece_improvement.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace dovetail;

namespace {

/// A flat rhombus of four points of lines, meshed with its long diagonal.
mesher_input<2> rhombus() {
  const remesh::plane_surface plane{};
  mesher_input<2> input;
  input.boundary.points = {{0, -1, 0}, {3, 0, 0}, {0, 1, 0}, {-3, 0, 0}};
  input.boundary.elements = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  surface_region region;
  region.surface = {[plane](vec2 uv) { return plane.frame(uv); },
                    [plane](vec3 p, vec2 seed) { return plane.project(p, seed); }, plane};
  region.face = 0;
  input.regions.push_back(region);
  return input;
}

bool has_short_diagonal(const mesher_input<2>& input) {
  mesher_result<2> made;
  made.mesh = {input.boundary.points, {{0, 1, 3}, {1, 2, 3}}, {0, 0}};
  detail::improve_piece(made, input, improvement::native{}, any_sizing([](vec3) { return 3.0; }));
  REQUIRE(made.mesh.elements.size() == 2);
  return std::all_of(made.mesh.elements.begin(), made.mesh.elements.end(), [](const simplex<2>& t) {
    return std::count(t.begin(), t.end(), 0) == 1 && std::count(t.begin(), t.end(), 2) == 1;
  });
}

} // namespace

TEST_CASE("an improved piece has no side between points of lines that another region might have") {
  auto input = rhombus();
  CHECK(has_short_diagonal(input));
  input.regions.front().forbids = [](local_id a, local_id b) {
    return std::min(a, b) == 0 && std::max(a, b) == 2;
  };
  CHECK_FALSE(has_short_diagonal(input));
  input.regions.front().forbids = [](local_id, local_id) { return false; };
  CHECK(has_short_diagonal(input));
}
