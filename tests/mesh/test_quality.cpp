#include "dovetail/mesh/quality.hpp"
#include "support/jittered_meshes.hpp"

#include <doctest/doctest.h>

#include <numeric>

using namespace dovetail;

namespace {

const simplicial_mesh<3> regular{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2, 3}}, {}};

/// The dihedral angle measured in the plane across the edge: an independent formula.
double dihedral_by_projection(const std::array<vec3, 4>& p, std::size_t ridge) {
  const auto& edge = numbering::ridges<3>[ridge];
  const auto& opposite = numbering::sides_of_ridge<3>[ridge]; // side i is opposite vertex i
  const vec3 a = p[static_cast<std::size_t>(edge[0])];
  const vec3 axis = normalized(p[static_cast<std::size_t>(edge[1])] - a);
  const auto across = [&](int v) {
    const vec3 d = p[static_cast<std::size_t>(v)] - a;
    return d - dot(d, axis) * axis;
  };
  return degrees_per_radian * angle_between(across(opposite[0]), across(opposite[1]));
}

} // namespace

TEST_CASE("a regular tetrahedron has dihedral angles of 70.53 degrees and face angles of 60") {
  for (const double degrees : wedge_angles(corners(std::span(regular.points), regular.elements[0])))
    CHECK(degrees == doctest::Approx(70.528779365509308));
  const auto statistics = measure_quality(regular);
  CHECK(statistics.min_face_deg == doctest::Approx(60));
  CHECK(statistics.min_wedges.bins[70] == 1);
}

TEST_CASE("dihedral angles agree with projection along the edge") {
  const auto mesh = dovetail_test::jittered_cubes(4);
  for (const auto& element : mesh.elements) {
    const auto at = corners(std::span(mesh.points), element);
    const auto angles = wedge_angles(at);
    for (std::size_t r = 0; r < 6; ++r)
      REQUIRE(angles[r] == doctest::Approx(dihedral_by_projection(at, r)));
  }
}

TEST_CASE("angles of a triangle sum to 180 degrees") {
  const auto mesh = dovetail_test::jittered_squares(6);
  for (const auto& element : mesh.elements) {
    const auto angles = wedge_angles(corners(std::span(mesh.points), element));
    CHECK(std::accumulate(angles.begin(), angles.end(), 0.0) == doctest::Approx(180));
    CHECK(smallest_corner_angle(corners(std::span(mesh.points), element)) ==
          doctest::Approx(*std::min_element(angles.begin(), angles.end())));
  }
}

TEST_CASE("a sliver's tiny angle is accurate") {
  const double height = 1e-9;
  const std::array<vec3, 4> sliver{vec3{0, 0, 0}, vec3{1, 0, 0}, vec3{0, 1, 0}, vec3{1. / 3, 1. / 3, height}};
  const auto angles = wedge_angles(sliver);
  const double expected = degrees_per_radian * std::atan2(height, 1. / 3);
  CHECK(angles[0] == doctest::Approx(expected).epsilon(1e-12));
}

TEST_CASE("statistics are those of every angle by itself, and of flat elements too") {
  auto mesh = dovetail_test::jittered_cubes(9);
  for (std::size_t v = 0; v < mesh.points.size(); v += 7)
    mesh.points[v].z *= 1e-3; // flat and inverted elements
  mesh.points.insert(mesh.points.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
  const auto last = static_cast<local_id>(mesh.points.size());
  mesh.elements.push_back({last - 4, last - 3, last - 2, last - 1});
  const auto statistics = measure_quality(mesh);
  angle_histogram smallest;
  angle_histogram largest;
  double min_face = 180;
  for (const auto& element : mesh.elements) {
    const auto at = corners(std::span(mesh.points), element);
    const auto angles = wedge_angles(at);
    smallest.add(*std::min_element(angles.begin(), angles.end()));
    largest.add(*std::max_element(angles.begin(), angles.end()));
    for (const auto& side : numbering::sides<3>)
      for (const double degrees : wedge_angles(std::array<vec3, 3>{at[static_cast<std::size_t>(side[0])],
                                                                   at[static_cast<std::size_t>(side[1])],
                                                                   at[static_cast<std::size_t>(side[2])]}))
        min_face = std::min(min_face, degrees);
  }
  CHECK(statistics.min_wedges.bins == smallest.bins);
  CHECK(statistics.max_wedges.bins == largest.bins);
  CHECK(statistics.min_face_deg == min_face);
}

TEST_CASE("statistics of pieces merge into those of the whole") {
  const auto whole = dovetail_test::jittered_cubes(5);
  const auto expected = measure_quality(whole);
  quality_statistics merged;
  const std::size_t cut = 211;
  simplicial_mesh<3> first{whole.points, {whole.elements.begin(), whole.elements.begin() + cut}, {}};
  simplicial_mesh<3> second{whole.points, {whole.elements.begin() + cut, whole.elements.end()}, {}};
  merged.merge(measure_quality(first), 0);
  merged.merge(measure_quality(second), cut);
  merged.merge(quality_statistics{}, 999); // an empty piece changes nothing
  CHECK(merged.elements == expected.elements);
  CHECK(merged.min_wedge_deg == expected.min_wedge_deg);
  CHECK(merged.max_wedge_deg == expected.max_wedge_deg);
  CHECK(merged.min_face_deg == expected.min_face_deg);
  CHECK(merged.worst_element == expected.worst_element);
  CHECK(merged.min_wedges.bins == expected.min_wedges.bins);
  CHECK(merged.max_wedges.bins == expected.max_wedges.bins);
  CHECK(merged.mean_min_wedge_deg() == doctest::Approx(expected.mean_min_wedge_deg()));
}

TEST_CASE("counts under 6, 12, 18 and 24 degrees are exact at the bounds") {
  quality_statistics statistics;
  statistics.elements = 5;
  for (const double degrees : {5.999, 6.0, 12.0, 23.999, 24.0})
    statistics.min_wedges.add(degrees);
  CHECK(statistics.under_6_12_18_24() == std::array<std::int64_t, 4>{1, 2, 3, 4});
  CHECK(statistics.per_million_under(12) == doctest::Approx(4e5));
}
