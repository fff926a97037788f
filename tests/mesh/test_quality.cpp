#include "dovetail/core/encoding.hpp"
#include "dovetail/mesh/quality.hpp"
#include "support/jittered_meshes.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <numeric>
#include <random>

using namespace dovetail;

namespace {

const simplicial_mesh<3> regular{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2, 3}}, {}};

/// The dihedral angle measured in the plane across the edge: an independent formula.
double dihedral_by_projection(const std::array<vec3, 4>& p, std::size_t ridge) {
  const auto& edge = numbering::ridges<3>[ridge];
  const auto& opposite = numbering::sides_of_ridge<3>[ridge]; // side i is opposite vertex i
  const vec3 a = p[edge[0]];
  const vec3 axis = normalized(p[edge[1]] - a);
  const auto across = [&](int v) {
    const vec3 d = p[v] - a;
    return d - dot(d, axis) * axis;
  };
  return degrees_per_radian * angle_between(across(opposite[0]), across(opposite[1]));
}

} // namespace

TEST_CASE("a regular tetrahedron has dihedral angles of 70.53 degrees and face angles of 60") {
  for (const double degrees : dihedral_angles(corners(std::span(regular.points), regular.elements[0])))
    CHECK(degrees == doctest::Approx(70.528779365509308));
  const auto statistics = measure_quality(regular);
  CHECK(statistics.min_face_deg == doctest::Approx(60));
  CHECK(statistics.min_dihedrals.bins[70] == 1);
}

TEST_CASE("dihedral angles agree with projection along the edge") {
  const auto mesh = dovetail_test::jittered_cubes(4);
  for (const auto& element : mesh.elements) {
    const auto at = corners(std::span(mesh.points), element);
    const auto angles = dihedral_angles(at);
    for (std::size_t r = 0; r < 6; ++r)
      REQUIRE(angles[r] == doctest::Approx(dihedral_by_projection(at, r)));
  }
}

TEST_CASE("angles of a triangle sum to 180 degrees") {
  const auto mesh = dovetail_test::jittered_squares(6);
  for (const auto& element : mesh.elements) {
    const auto angles = dihedral_angles(corners(std::span(mesh.points), element));
    CHECK(std::accumulate(angles.begin(), angles.end(), 0.0) == doctest::Approx(180));
    CHECK(smallest_corner_angle(corners(std::span(mesh.points), element)) ==
          doctest::Approx(*std::min_element(angles.begin(), angles.end())));
  }
}

TEST_CASE("a sliver's tiny angle is accurate") {
  const double height = 1e-9;
  const std::array<vec3, 4> sliver{vec3{0, 0, 0}, vec3{1, 0, 0}, vec3{0, 1, 0}, vec3{1. / 3, 1. / 3, height}};
  const auto angles = dihedral_angles(sliver);
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
    const auto angles = dihedral_angles(at);
    smallest.add(*std::min_element(angles.begin(), angles.end()));
    largest.add(*std::max_element(angles.begin(), angles.end()));
    for (const auto& side : numbering::sides<3>)
      for (const double degrees : dihedral_angles(std::array<vec3, 3>{at[side[0]], at[side[1]], at[side[2]]}))
        min_face = std::min(min_face, degrees);
  }
  CHECK(statistics.min_dihedrals.bins == smallest.bins);
  CHECK(statistics.max_dihedrals.bins == largest.bins);
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
  CHECK(merged.min_dihedral_deg == expected.min_dihedral_deg);
  CHECK(merged.max_dihedral_deg == expected.max_dihedral_deg);
  CHECK(merged.min_face_deg == expected.min_face_deg);
  CHECK(merged.worst_element == expected.worst_element);
  CHECK(merged.min_dihedrals.bins == expected.min_dihedrals.bins);
  CHECK(merged.max_dihedrals.bins == expected.max_dihedrals.bins);
  CHECK(merged.mean_min_dihedral_deg() == doctest::Approx(expected.mean_min_dihedral_deg()));
}

TEST_CASE("counts under 6, 12, 18 and 24 degrees are exact at the bounds") {
  quality_statistics statistics;
  statistics.elements = 5;
  for (const double degrees : {5.999, 6.0, 12.0, 23.999, 24.0})
    statistics.min_dihedrals.add(degrees);
  CHECK(statistics.under_6_12_18_24() == std::array<std::int64_t, 4>{1, 2, 3, 4});
  CHECK(statistics.per_million_under(12) == doctest::Approx(4e5));
}

TEST_CASE("statistics come back from few bytes as they were") {
  std::mt19937 random(7);
  std::normal_distribution<double> small(45, 9), large(100, 15);
  quality_statistics many;
  many.elements = 100000;
  many.min_dihedral_deg = 0.1 + 0.2;
  many.max_dihedral_deg = 179.9;
  many.min_face_deg = 1e-300;
  many.sum_of_min_dihedral_deg = 4.5e6;
  many.worst_element = 99999;
  for (int e = 0; e < 100000; ++e) {
    many.min_dihedrals.add(small(random));
    many.max_dihedrals.add(large(random));
  }
  quality_statistics ends; // of both histograms
  ends.min_dihedrals.bins.front() = 1;
  ends.max_dihedrals.bins.back() = std::int64_t{1} << 62;
  quality_statistics full;
  full.min_dihedrals.bins.fill(127);
  full.max_dihedrals.bins.fill(128);
  for (const quality_statistics& quality : {many, ends, full, quality_statistics{}}) {
    const byte_buffer bytes = encoded(quality);
    byte_reader from(bytes);
    const auto back = decode<quality_statistics>(from);
    CHECK(from.at_end());
    CHECK(back.elements == quality.elements);
    CHECK(back.min_dihedral_deg == quality.min_dihedral_deg);
    CHECK(back.max_dihedral_deg == quality.max_dihedral_deg);
    CHECK(back.min_face_deg == quality.min_face_deg);
    CHECK(back.sum_of_min_dihedral_deg == quality.sum_of_min_dihedral_deg);
    CHECK(back.worst_element == quality.worst_element);
    CHECK(back.min_dihedrals.bins == quality.min_dihedrals.bins);
    CHECK(back.max_dihedrals.bins == quality.max_dihedrals.bins);
    if (quality.elements == 100000)
      CHECK(bytes.size() < 450);
    const byte_buffer cut(bytes.begin(), bytes.end() - 1);
    byte_reader early(cut);
    CHECK_THROWS_AS((void)decode<quality_statistics>(early), input_error);
  }
}

TEST_CASE("bytes that are no histogram are refused") {
  const auto refused = [](std::uint64_t first, std::uint64_t count) {
    byte_writer to;
    to.count(first);
    to.count(count);
    for (int k = 0; k < 200; ++k)
      to.count(0);
    const byte_buffer bytes = to.take();
    byte_reader from(bytes);
    CHECK_THROWS_AS((void)decode<angle_histogram>(from), input_error);
  };
  refused(181, 0);
  refused(0, 181);
  refused(100, 81);
  refused(~std::uint64_t{0}, 2);
  const byte_buffer bytes(20, std::byte{255});
  byte_reader from(bytes);
  CHECK_THROWS_AS((void)from.count(), input_error);
}
