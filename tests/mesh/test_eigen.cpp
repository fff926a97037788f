/// Eigen's views of meshes.
#include "files/stacked_cubes.hpp"

#include "dovetail/adapters/eigen.hpp"

#include <doctest/doctest.h>

using namespace dovetail;

TEST_CASE("points and elements are seen where they are") {
  const auto mesh = testing::stacked_cubes{.cells = 2}.whole();
  const auto points = as_matrix(mesh.points);
  const auto elements = as_matrix(mesh.elements);
  REQUIRE(points.rows() == static_cast<Eigen::Index>(mesh.points.size()));
  REQUIRE(elements.rows() == static_cast<Eigen::Index>(mesh.elements.size()));
  CHECK(points.data() == &mesh.points.front().x);
  CHECK(points(5, 1) == mesh.points[5].y);
  CHECK(points(26, 2) == mesh.points[26].z);
  CHECK(elements(7, 3) == mesh.elements[7][3]);
  CHECK(as_matrix(std::vector<vec3>{}).rows() == 0);
}

TEST_CASE("the zero matrix has an entry for each pair of points of an element, and takes sums in place") {
  const auto mesh = testing::stacked_cubes{.cells = 2}.whole();
  auto matrix = zero_matrix(mesh);
  const auto rows = point_neighbours(mesh);
  CHECK(matrix.isCompressed());
  CHECK(matrix.nonZeros() == static_cast<Eigen::Index>(rows.items.size()));
  for (const auto& element : mesh.elements)
    for (const local_id v : element)
      for (const local_id w : element)
        matrix.coeffRef(v, w) += 1;
  CHECK(matrix.isCompressed()); // no entry was added
  CHECK(matrix.sum() == doctest::Approx(16.0 * static_cast<double>(mesh.elements.size())));
  CHECK(matrix.coeff(0, 26) == 0);
}
