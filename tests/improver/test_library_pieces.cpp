/// What improvers that call a library return: checked, numbered as before, and without a point too many or
/// too few.
#include "dovetail/adapters/library_pieces.hpp"
#include "improver_checks.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <string>

using namespace dovetail;
using namespace improver_checks;

namespace {

/// Eight tetrahedra in an octahedron about a point inside, which has the first number.
mesh_type octahedron(vec3 inside) {
  mesh_type mesh{{inside, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, {}, {}};
  for (const local_id x : {1, 2})
    for (const local_id y : {3, 4})
      for (const local_id z : {5, 6}) {
        const bool turned = (x == 2) != ((y == 4) != (z == 6));
        mesh.elements.push_back(turned ? simplex<3>{0, y, x, z} : simplex<3>{0, x, y, z});
      }
  return mesh;
}

/// The octahedron of a piece without its inner point: four tetrahedra about the axis of the two points that
/// come first.
mesh_type without_inner_point(const improvement::library_piece& piece) {
  mesh_type made{{piece.mesh.points.begin(), piece.mesh.points.begin() + 6}, {}, {}};
  for (const auto& [y, z] : {std::array{2, 4}, {4, 3}, {3, 5}, {5, 2}})
    made.elements.push_back({1, 0, y, z});
  return made;
}

report improve(mesh_type& mesh, auto&& improve_piece) {
  return improvement::improve_by_library("a library", mesh, {}, improve_piece);
}

} // namespace

TEST_CASE("a point that a library dropped is made up for where the number of a fixed one comes after it") {
  const mesh_type before = octahedron({0.3, 0.3, 0.3});
  mesh_type mesh = before;
  const report made = improve(mesh, without_inner_point);
  check_kept(before, mesh);
  check_boundary_points(before, mesh);
  CHECK(made.warnings.empty());
  CHECK(mesh.elements.size() == 7); // four, of which one was cut into four
  CHECK(measure_quality(mesh).min_dihedral_deg > measure_quality(before).min_dihedral_deg + 10);
}

TEST_CASE("a piece is left as it was where making up for dropped points would make its worst element worse") {
  const mesh_type before = octahedron({});
  mesh_type mesh = before;
  const report made = improve(mesh, without_inner_point);
  CHECK(mesh.elements == before.elements);
  CHECK(mesh.points == before.points);
  REQUIRE(made.warnings.size() == 1);
  CHECK(made.warnings.front().find("its worst angle is") != std::string::npos);
}

TEST_CASE("a dropped point behind all fixed ones is gone") {
  mesh_type mesh = octahedron({});
  std::rotate(mesh.points.begin(), mesh.points.begin() + 1, mesh.points.end());
  for (auto& element : mesh.elements)
    for (local_id& v : element)
      v = v == 0 ? 6 : v - 1;
  CHECK(improve(mesh, without_inner_point).warnings.empty());
  CHECK(mesh.points.size() == 6);
  CHECK(mesh.elements.size() == 4);
}
