/// @file
/// All contractions of free edges of small random meshes, against brute force.
#include "dovetail/improver/tetrahedra/edge_contraction.hpp"
#include "dovetail/improver/tetrahedra/mesh_exchange.hpp"
#include "random_meshes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

using namespace dovetail::improvement;
using namespace random_meshes;

namespace {

using measure = minimum_dihedral;

double value_of(const mesh_type& mesh, const simplex<3>& v) {
  const auto p = dovetail::corners(std::span(mesh.points), v);
  return measure_of<measure>(p[0], p[1], p[2], p[3]);
}

/// The outer tetrahedron's corners come first, so that every other point can be removed.
mesh_type random_mesh(std::uint64_t seed) {
  random_numbers random(seed);
  growing_mesh grown;
  for (int i = 0; i < 20; ++i)
    grown.insert(0.5 * vec3{random.signed_unit(), random.signed_unit(), random.signed_unit()});
  return grown.mesh;
}

tet_complex complex_from(mesh_type mesh) {
  const mesh_type plain = mesh;
  tet_complex complex = take_mesh(mesh, {});
  for (local_id e = 0; e < complex.element_slots(); ++e)
    complex.set_value(e, static_cast<float>(value_of(plain, complex.vertices(e))));
  complex.set_sizes(present_sizes(complex));
  complex.set_target(static_cast<float>(measure::from_angle(35)));
  return complex;
}

bool has(const simplex<3>& element, local_id v) {
  return std::find(element.begin(), element.end(), v) != element.end();
}

std::vector<simplex<3>> sorted(std::vector<simplex<3>> elements) {
  for (auto& v : elements)
    std::sort(v.begin(), v.end());
  std::sort(elements.begin(), elements.end());
  return elements;
}

/// What an edge's contraction by its definition would do.
struct contracted {
  std::vector<simplex<3>> elements; ///< of the whole mesh
  bool is_positive = true;          ///< all of those that the move of the vertex changed
  double worst_before = 2, worst_after = 2;
  double lacking_before = 0, lacking_after = 0;
  int bad_before = 0, bad_after = 0;
  bool is_close_call = false; ///< a value so near a limit that rounding decides

  bool pays() const {
    return bad_after != bad_before ? bad_after < bad_before : lacking_after < lacking_before;
  }
  bool helps() const { return is_positive && worst_after > worst_before && pays(); }
  bool is_undecided() const {
    return is_close_call || std::abs(worst_after - worst_before) < 1e-5 ||
           std::abs(lacking_after - lacking_before) < 1e-7;
  }
};

/// Every `from` becomes `to`; elements that had both are gone.
contracted contract(const mesh_type& mesh, local_id from, local_id to) {
  contracted result;
  const double bad = measure::from_angle(12);
  const auto count = [&](double value, double& worst, double& lacking, int& bad_ones) {
    worst = std::min(worst, value);
    lacking += std::pow(std::max(0.0, measure::from_angle(35) - value), 3);
    bad_ones += value < bad;
    result.is_close_call = result.is_close_call || std::abs(value - bad) < 1e-5;
  };
  for (auto element : mesh.elements) {
    if (has(element, from)) {
      count(value_of(mesh, element), result.worst_before, result.lacking_before, result.bad_before);
      if (has(element, to))
        continue;
      std::replace(element.begin(), element.end(), from, to);
      const auto p = dovetail::corners(std::span(mesh.points), element);
      result.is_positive = result.is_positive && dovetail::orient3d(p[0], p[1], p[2], p[3]) > 0;
      count(value_of(mesh, element), result.worst_after, result.lacking_after, result.bad_after);
    }
    result.elements.push_back(element);
  }
  return result;
}

struct tally {
  int tried = 0, accepted = 0, inverting = 0, useless = 0;
};

/// Contracts one edge of a copy and compares.
void try_edge(const mesh_type& plain, const tet_complex& original, local_id from, local_id to,
              tally& counts) {
  CAPTURE(from);
  CAPTURE(to);
  const contracted expected = contract(plain, from, to);
  if (expected.is_undecided())
    return;
  ++counts.tried;
  counts.inverting += !expected.is_positive;
  counts.useless += expected.is_positive && !expected.helps();
  tet_complex complex = original;
  const bool accepted =
      edge_contraction<measure>().improve(complex, from, to, {.shortest = 0, .longest = 1e9});
  REQUIRE(accepted == expected.helps());
  counts.accepted += accepted;
  CHECK(complex.is_consistent());
  mesh_type after{plain.points, {}, {}};
  const auto old = sorted(plain.elements);
  double worst = 2; // of the elements that were not there before
  for (local_id e = 0; e < complex.element_slots(); ++e)
    if (complex.is_alive(e)) {
      after.elements.push_back(complex.vertices(e));
      const auto value = static_cast<double>(complex.value(e));
      CHECK(std::abs(value - value_of(plain, complex.vertices(e))) < 1e-6);
      if (!std::binary_search(old.begin(), old.end(), sorted({complex.vertices(e)}).front()))
        worst = std::min(worst, value);
    }
  CHECK(sorted(after.elements) == (accepted ? sorted(expected.elements) : old));
  if (!accepted)
    return;
  CHECK(complex.is_gap(from));
  CHECK(std::abs(worst - expected.worst_after) < 1e-6);
  give_back(complex, after);
  CHECK(after.points.size() == plain.points.size() - 1);
  const auto validity = dovetail::check_validity(after);
  CHECK_MESSAGE(validity.valid(), validity.text());
  CHECK(outer_and_material_sides(after) == outer_and_material_sides(plain));
  CHECK(volume_per_tag(after).at(0) == doctest::Approx(volume_per_tag(plain).at(0)).epsilon(1e-12));
}

} // namespace

TEST_CASE("an edge is contracted exactly when brute force says that it helps, with the values it predicts") {
  tally counts;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    CAPTURE(seed);
    const mesh_type mesh = random_mesh(seed);
    const tet_complex complex = complex_from(mesh);
    std::set<std::array<local_id, 2>> edges;
    for (const auto& v : mesh.elements)
      for (const local_id from : v)
        for (const local_id to : v)
          if (from != to && complex.is_free(from))
            edges.insert({from, to});
    for (const auto& [from, to] : edges)
      try_edge(mesh, complex, from, to, counts);
  }
  MESSAGE(counts.tried << " edges: " << counts.accepted << " contracted, " << counts.inverting
                       << " would invert elements, " << counts.useless << " would not help");
  CHECK(counts.accepted > 100);
  CHECK(counts.inverting > 1000);
  CHECK(counts.useless > 1000);
}
