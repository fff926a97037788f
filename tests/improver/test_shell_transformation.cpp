/// @file
/// Shell transformation: what it accepts is better, what it gives up is as if nothing had been tried.
#include "dovetail/improver/tetrahedra/mesh_exchange.hpp"
#include "dovetail/improver/tetrahedra/shell_transformation.hpp"
#include "improver_checks.hpp"

#include <doctest/doctest.h>

using namespace dovetail::improvement;
using namespace improver_checks;

namespace {

using measure = minimum_dihedral;

tet_complex evaluated(mesh_type mesh) {
  auto complex = take_mesh(mesh, {});
  for (local_id e = 0; e < complex.element_slots(); ++e) {
    const auto& v = complex.vertices(e);
    complex.set_value(e, static_cast<float>(measure_of<measure>(complex.point(v[0]), complex.point(v[1]),
                                                                complex.point(v[2]), complex.point(v[3]))));
  }
  return complex;
}

/// All that an operation could change, in order of numbers.
struct state {
  std::vector<simplex<3>> elements;
  std::vector<std::array<half_side, 4>> across;
  std::vector<float> values;
  std::vector<std::uint32_t> changed_at;
  bool operator==(const state&) const = default;
};
state state_of(const tet_complex& mesh) {
  state s;
  for (local_id e = 0; e < mesh.element_slots(); ++e)
    if (mesh.is_alive(e)) {
      s.elements.push_back(mesh.vertices(e));
      s.across.push_back({mesh.across(e, 0), mesh.across(e, 1), mesh.across(e, 2), mesh.across(e, 3)});
      s.values.push_back(mesh.value(e));
    }
  for (local_id v = 0; v < mesh.vertex_slots(); ++v)
    s.changed_at.push_back(mesh.changed_at(v));
  return s;
}

std::size_t shell_size(const tet_complex& mesh, local_id a, local_id b) {
  std::size_t size = 0;
  for (local_id e = 0; e < mesh.element_slots(); ++e) {
    const auto& v = mesh.vertices(e);
    size +=
        mesh.is_alive(e) && std::count(v.begin(), v.end(), a) > 0 && std::count(v.begin(), v.end(), b) > 0;
  }
  return size;
}

/// The values of what `after` has and `before` has not.
float worst_of_new(const state& before, const state& after) {
  const std::set<simplex<3>> old(before.elements.begin(), before.elements.end());
  float worst = 2;
  for (std::size_t i = 0; i < after.elements.size(); ++i)
    if (old.count(after.elements[i]) == 0)
      worst = std::min(worst, after.values[i]);
  return worst;
}

} // namespace

TEST_CASE("a transformed edge is gone and all new elements beat its shell; else nothing has changed") {
  int removed = 0, beyond_plain_removal = 0, given_up = 0;
  shell_transformation<measure> transformation;
  edge_removal<measure> plain;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    const auto input = squeezed_cubes(3, seed, seed % 3 == 0 ? 0.3 : 0.8);
    const auto volume = volume_per_tag(input).at(0);
    auto mesh = evaluated(input);
    for (local_id e = 0; e < mesh.element_slots(); ++e)
      for (int edge = 0; edge < 6 && mesh.is_alive(e); ++edge) {
        edge_shell shell;
        if (!collect_shell(mesh, e, edge, shell))
          continue;
        const float bar = worst_value(mesh, shell.elements.view());
        local_change change;
        const bool plain_helps = plain.find(mesh, shell, bar, change);
        const auto before = state_of(mesh);
        if (!transformation.improve(mesh, e, edge, {})) {
          const bool missed = plain_helps && size_band{}.admits(mesh, change);
          CHECK_FALSE(missed);
          CHECK(state_of(mesh) == before);
          ++given_up;
          continue;
        }
        ++removed;
        beyond_plain_removal += plain_helps ? 0 : 1;
        CHECK(shell_size(mesh, shell.a, shell.b) == 0);
        CHECK(worst_of_new(before, state_of(mesh)) > bar);
      }
    REQUIRE(mesh.is_consistent());
    mesh_type after;
    give_back(mesh, after);
    const auto validity = dovetail::check_validity(after);
    CHECK_MESSAGE(validity.valid(), validity.text());
    CHECK(volume_per_tag(after).at(0) == doctest::Approx(volume));
    CHECK(outer_and_material_sides(after) == outer_and_material_sides(input));
  }
  MESSAGE(removed << " removed, " << beyond_plain_removal << " of them beyond plain removal; " << given_up);
  CHECK(given_up > 100);
  CHECK(beyond_plain_removal > 10);
}

TEST_CASE("elements that will be replaced in their turn need only be positive") {
  // Random rings: with the edge between two ring vertices passing, more can be removed, never less.
  int more = 0;
  edge_removal<measure> removal;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    auto mesh = evaluated(squeezed_cubes(3, seed, 0.5));
    for (local_id e = 0; e < mesh.element_slots(); ++e)
      for (int edge = 0; edge < 6; ++edge) {
        edge_shell shell;
        if (!collect_shell(mesh, e, edge, shell))
          continue;
        const float bar = worst_value(mesh, shell.elements.view());
        local_change strict, lenient;
        const edge_ends passing{shell.a, shell.ring[0]};
        const bool alone = removal.find(mesh, shell, bar, strict);
        const bool with = removal.find(mesh, shell, bar, lenient, {&passing, 1});
        CHECK((with || !alone));
        more += with && !alone;
        for (int i = 0; with && i < lenient.fresh.size; ++i) {
          const auto& v = lenient.fresh[i];
          const bool passes = std::count(v.begin(), v.end(), passing[0]) > 0 &&
                              std::count(v.begin(), v.end(), passing[1]) > 0;
          CHECK(lenient.values[i] > (passes ? 0.0F : bar));
        }
      }
  }
  CHECK(more > 10);
}
