/// Fields are transferred: linear ones exactly, integrals to rounding, materials apart.
#include "dovetail/core/error.hpp"
#include "dovetail/solver/transfer.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

using namespace dovetail;

namespace {

/// A box of n^3 cells of six tetrahedra each, whose inner points are moved; tags: below and above z = 0.5.
simplicial_mesh<3> box_of_tetrahedra(int n, double side, double jitter) {
  simplicial_mesh<3> mesh;
  const auto id = [&](int i, int j, int k) { return static_cast<local_id>((k * (n + 1) + j) * (n + 1) + i); };
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const auto moved = [&](int at, int seed) {
          return at == 0 || at == n || 2 * at == n ? 0
                                                   : jitter * std::sin(12.9 * (i + 7 * j + 31 * k) + seed);
        };
        mesh.points.push_back((side / n) * vec3{i + moved(i, 1), j + moved(j, 2), k + moved(k, 3)});
      }
  constexpr std::array<std::array<int, 3>, 6> paths{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (const auto& path : paths) { // from corner to corner of a cell along its edges
          std::array<int, 3> at{i, j, k};
          simplex<3> element{id(i, j, k), 0, 0, 0};
          for (std::size_t step = 0; step < 3; ++step) {
            ++at[path[step]];
            element[step + 1] = id(at[0], at[1], at[2]);
          }
          const auto p = [&](std::size_t c) { return mesh.points[element[c]]; };
          if (signed_volume(p(0), p(1), p(2), p(3)) < 0)
            std::swap(element[2], element[3]);
          mesh.elements.push_back(element);
          mesh.tags.push_back(2 * k < n ? 4 : 9);
        }
  return mesh;
}

/// Part of a cylinder around the y axis, of radius 1.
simplicial_mesh<2> curved_sheet(int n) {
  simplicial_mesh<2> mesh;
  const auto id = [&](int i, int j) { return static_cast<local_id>(j * (n + 1) + i); };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      mesh.points.push_back({std::sin(1.0 * i / n), 1.0 * j / n, std::cos(1.0 * i / n)});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      mesh.elements.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.elements.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  return mesh;
}

template <int D>
std::vector<double> measures(const simplicial_mesh<D>& mesh) {
  std::vector<double> result;
  for (const auto& e : mesh.elements) {
    const auto p = [&](std::size_t c) { return mesh.points[e[c]]; };
    if constexpr (D == 3)
      result.push_back(signed_volume(p(0), p(1), p(2), p(3)));
    else
      result.push_back(0.5 * norm(cross(p(1) - p(0), p(2) - p(0))));
  }
  return result;
}

double integral(const std::vector<double>& measure, const std::vector<double>& values) {
  return std::inner_product(measure.begin(), measure.end(), values.begin(), 0.0);
}

/// A value of its own for each element.
template <int D>
std::vector<double> waves(const simplicial_mesh<D>& mesh) {
  std::vector<double> values;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    values.push_back(1.5 + std::sin(7.0 * static_cast<double>(e)));
  return values;
}

} // namespace

TEST_CASE(
    "values at points: a linear field is exact inside, beside the mesh it is that of the nearest point") {
  const auto mesh = box_of_tetrahedra(4, 1, 0.2);
  std::vector<double> values; // two components
  const auto first = [](vec3 p) { return 3 + 2 * p.x - p.y + 0.5 * p.z; };
  for (const vec3 p : mesh.points) {
    values.push_back(first(p));
    values.push_back(p.z);
  }
  const std::vector<vec3> inside{{0.1, 0.2, 0.3}, {0.77, 0.5, 0.25}, {0, 1, 0}, {0.999, 0.001, 0.5}};
  const auto at = transferred_to_points<3>(mesh, values, inside, 2);
  for (std::size_t i = 0; i < inside.size(); ++i) {
    CHECK(at[2 * i] == doctest::Approx(first(inside[i])).epsilon(1e-12));
    CHECK(at[2 * i + 1] == doctest::Approx(inside[i].z).epsilon(1e-12));
  }
  const std::vector<vec3> outside{{1.5, 0.2, 0.3}, {-1, -1, -1}};
  const auto beside = transferred_to_points<3>(mesh, values, outside, 2);
  CHECK(beside[0] == doctest::Approx(first({1, 0.2, 0.3})).epsilon(1e-12));
  CHECK(beside[2] == doctest::Approx(first({0, 0, 0})).epsilon(1e-12));

  const auto sheet = curved_sheet(5);
  std::vector<double> heights;
  for (const vec3 p : sheet.points)
    heights.push_back(p.y);
  const std::vector<vec3> above{{0, 0.35, 2}};
  CHECK(transferred_to_points<2>(sheet, heights, above)[0] == doctest::Approx(0.35).epsilon(1e-12));
}

TEST_CASE("means in tetrahedra: the same domain keeps integrals, constants and materials") {
  const auto coarse = box_of_tetrahedra(4, 1, 0.2);
  const auto fine = box_of_tetrahedra(6, 1, 0.25);
  for (const auto& [from, to] : {std::pair(coarse, fine), std::pair(fine, coarse)}) {
    const auto values = waves(from);
    const auto result = transferred_to_elements<3>(from, values, to);
    CHECK(integral(measures(to), result) == doctest::Approx(integral(measures(from), values)).epsilon(1e-12));
    for (const double value : transferred_to_elements<3>(from, std::vector<double>(values.size(), 2.5), to))
      CHECK(value == doctest::Approx(2.5).epsilon(1e-10));
    std::vector<double> of_material;
    for (const local_id tag : from.tags)
      of_material.push_back(tag);
    const auto materials = transferred_to_elements<3>(from, of_material, to);
    for (std::size_t e = 0; e < materials.size(); ++e)
      CHECK(materials[e] == doctest::Approx(to.tags[e]).epsilon(1e-10));
  }
  const auto values = waves(coarse);
  const auto same = transferred_to_elements<3>(coarse, values, coarse);
  for (std::size_t e = 0; e < same.size(); ++e)
    CHECK(same[e] == doctest::Approx(values[e]).epsilon(1e-10));
}

TEST_CASE(
    "means in tetrahedra: where the boundary has moved the integral is kept, and no element is forgotten") {
  const auto small = box_of_tetrahedra(4, 1, 0.2);
  const auto large = box_of_tetrahedra(5, 1.4, 0.2); // some elements lie outside of the small one
  for (const auto& [from, to] : {std::pair(small, large), std::pair(large, small)}) {
    const auto values = waves(from);
    const auto result = transferred_to_elements<3>(from, values, to);
    CHECK(integral(measures(to), result) == doctest::Approx(integral(measures(from), values)).epsilon(1e-12));
    for (const double value : result)
      CHECK(value > 0);
    for (const local_id material : {4, 9}) { // whose interface is elsewhere in each
      const auto of_material = [&](const simplicial_mesh<3>& mesh, std::vector<double> of) {
        for (std::size_t e = 0; e < of.size(); ++e)
          of[e] *= mesh.tags[e] == material ? 1 : 0;
        return integral(measures(mesh), of);
      };
      CHECK(of_material(to, result) == doctest::Approx(of_material(from, values)).epsilon(1e-12));
    }
  }
}

TEST_CASE("means in triangles of a curved surface: the integral is kept, a constant nearly") {
  const auto from = curved_sheet(9), to = curved_sheet(14);
  const auto values = waves(from);
  CHECK(integral(measures(to), transferred_to_elements<2>(from, values, to)) ==
        doctest::Approx(integral(measures(from), values)).epsilon(1e-12));
  for (const double value : transferred_to_elements<2>(from, std::vector<double>(values.size(), 1), to))
    CHECK(value == doctest::Approx(1).epsilon(0.01));
}

TEST_CASE("means in triangles: a little beside the other mesh they are as in it") {
  auto from = curved_sheet(8), to = curved_sheet(3);
  for (auto* mesh : {&from, &to})
    for (vec3& p : mesh->points)
      p.z = 0;
  const auto values = waves(from);
  const auto in_plane = transferred_to_elements<2>(from, values, to);
  for (vec3& p : to.points)
    p.z = 0.001;
  const auto beside = transferred_to_elements<2>(from, values, to);
  for (std::size_t e = 0; e < beside.size(); ++e)
    CHECK(beside[e] == doctest::Approx(in_plane[e]).epsilon(1e-12));
}

TEST_CASE("fields that do not fit a mesh are refused") {
  const auto mesh = box_of_tetrahedra(2, 1, 0);
  const std::vector<double> values(mesh.elements.size() - 1);
  CHECK_THROWS_WITH_AS(transferred_to_elements<3>(mesh, values, mesh),
                       doctest::Contains("47 values for 48 elements"), mesh_error);
  CHECK_THROWS_AS(transferred_to_points<3>(mesh, values, mesh.points), mesh_error);
  CHECK_THROWS_AS(transferred_to_points<3>({}, {}, mesh.points), mesh_error);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), infinite, -infinite})
    for (const vec3 nowhere : {vec3{wrong, 0, 0}, vec3{0, wrong, 0}, vec3{0, 0, wrong}})
      CHECK_THROWS_WITH_AS(transferred_to_points<3>(mesh, std::vector<double>(mesh.points.size()),
                                                    std::vector<vec3>{{0, 0, 0}, nowhere}),
                           doctest::Contains("point 1 is at"), mesh_error);
  for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), infinite, -infinite}) {
    std::vector<double> at_points(2 * mesh.points.size()), in_elements(2 * mesh.elements.size());
    at_points[11] = in_elements[46] = wrong;
    CHECK_THROWS_WITH_AS(transferred_to_points<3>(mesh, at_points, mesh.points, 2),
                         doctest::Contains("a value of point 5 is not finite"), mesh_error);
    CHECK_THROWS_WITH_AS(transferred_to_elements<3>(mesh, in_elements, mesh, 2),
                         doctest::Contains("a value of element 23 is not finite"), mesh_error);
  }
  auto flat = mesh;
  flat.points[flat.elements[3][0]] = flat.points[flat.elements[3][1]];
  CHECK_THROWS_WITH_AS(transferred_to_elements<3>(mesh, std::vector<double>(48), flat),
                       doctest::Contains("is flat"), mesh_error);
}
