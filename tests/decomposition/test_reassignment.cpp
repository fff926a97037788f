/// The bookkeeping of parts that change, against what is found anew; and the refinement that stands on it.
#include "dovetail/decomposition/connected_refinement.hpp"
#include "dovetail/graph/contraction.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/simplification/paper.hpp"
#include "dovetail/simplification/simplify.hpp"
#include "support/jittered_meshes.hpp"

#include <doctest/doctest.h>

#include <numeric>
#include <set>

using namespace dovetail;
using namespace dovetail_test;

namespace {

std::size_t at(local_id id) {
  return static_cast<std::size_t>(id);
}

/// The components of a part without those that leave, from the definition, each sorted.
std::vector<std::set<local_id>> components_without(const csr_graph& graph, const std::vector<local_id>& part,
                                                   const std::vector<local_id>& leaving) {
  std::vector<local_id> label = part;
  for (const local_id s : leaving)
    label[s] = no_id;
  const auto components = components_within(graph, label);
  std::vector<std::set<local_id>> all(at(components.count));
  for (std::size_t v = 0; v < label.size(); ++v)
    if (label[v] == part[leaving[0]])
      all[components.of_node[v]].insert(static_cast<local_id>(v));
  std::vector<std::set<local_id>> beside; // those that leave were beside them
  for (const auto& component : all)
    if (std::any_of(leaving.begin(), leaving.end(), [&](local_id s) {
          const auto row = graph.row(s);
          return std::any_of(row.begin(), row.end(), [&](local_id v) { return component.count(v) > 0; });
        }))
      beside.push_back(component);
  return beside;
}

struct partitioned_mesh {
  simplicial_mesh<3> mesh;
  side_table<3> sides;
  simplification simplified;
  std::vector<local_id> part;
  std::vector<double> limits;

  partitioned_mesh(std::uint64_t seed, int parts, double imbalance)
      : mesh(shuffled(jittered_cubes(7, 0.15, seed), seed)), sides(build_sides(mesh)),
        simplified(simplify<3>(mesh, mesh_duals<3>(mesh, sides), simplifier::paper{},
                               {.subdomains = static_cast<double>(parts)})),
        part(partition::greedy{.imbalance = 1.3, .seed = seed}(simplified.graph, parts)) {
    join(parts);
    const double total = static_cast<double>(mesh.elements.size());
    limits.assign(at(parts), imbalance * total / parts);
  }
  void join(int parts) {
    const auto components = components_within(simplified.graph, part);
    REQUIRE(components.count == parts); // greedy's parts of these are connected
  }
  reassignable_parts<3> reassignable() {
    return {mesh, sides, simplified.super_of_element, simplified.graph, part, limits};
  }
};

/// Moves super-elements to neighbouring parts at random, as long as these stay connected.
void disturb(reassignable_parts<3>& parts, random_numbers& random, int moves) {
  for (int k = 0; k < moves; ++k) {
    const auto s = static_cast<local_id>(random.bits() % static_cast<std::uint64_t>(parts.super_count()));
    const auto beside = parts.parts_beside(std::array{s});
    if (!beside.empty() && parts.keeps_connected(std::array{s}))
      parts.assign(std::array{s}, beside[random.bits() % beside.size()]);
  }
}

/// What `reassignable_parts` keeps up to date is what a new one finds.
void check_bookkeeping(partitioned_mesh& given, reassignable_parts<3>& parts) {
  auto fresh = given.reassignable();
  for (local_id p = 0; at(p) < parts.part_count(); ++p) {
    CHECK(parts.weight_of_part(p) == doctest::Approx(fresh.weight_of_part(p)));
    const auto sorted = [](std::span<const local_id> border) {
      return std::set<local_id>(border.begin(), border.end());
    };
    CHECK(sorted(parts.border_of(p)) == sorted(fresh.border_of(p)));
    CHECK(parts.border_of(p).size() == fresh.border_of(p).size());
  }
  CHECK(parts.overweight() == fresh.overweight());
  for (std::size_t v = 0; v < given.mesh.points.size(); ++v)
    REQUIRE(parts.defects_at(static_cast<local_id>(v)) == fresh.defects_at(static_cast<local_id>(v)));
}

/// Defects, cut and excess, found anew.
partition_standing standing_of(partitioned_mesh& given) {
  auto fresh = given.reassignable();
  partition_standing found = fresh.standing();
  found.cut = edge_cut(given.simplified.graph, given.part);
  for (std::size_t v = 0; v < given.mesh.points.size(); ++v)
    found.defects += fresh.defects_at(static_cast<local_id>(v));
  return found;
}

} // namespace

TEST_CASE("what is cut off a part agrees with its components") {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    random_numbers random(seed);
    const int n = 10 + static_cast<int>(seed % 60);
    std::vector<double> weights;
    std::vector<weighted_edge> edges; // a random tree has many articulations; few more edges
    const auto before = [&](local_id v) {
      return static_cast<local_id>(random.bits() % static_cast<std::uint64_t>(v));
    };
    for (local_id v = 0; v < n; ++v) {
      weights.push_back(random.unit());
      if (v > 0)
        edges.push_back({v, before(v), 1});
      if (v > 1 && random.unit() < 0.01 * static_cast<double>(seed % 40))
        edges.push_back({v, before(v), 1});
    }
    const csr_graph graph = make_csr_graph(weights, edges);
    std::vector<local_id> part(at(n), 0);
    for (int k = 0; k < n / 10; ++k)
      part[random.bits() % part.size()] = 1;
    cut_off_components search(graph, part);
    for (local_id s = 0; s < n; ++s) {
      std::vector<local_id> leaving{s};
      for (const local_id other : graph.row(s))
        if (seed % 3 == 0 && part[other] == part[s] && leaving.size() < 3)
          leaving.push_back(other);
      const auto components = components_without(graph, part, leaving);
      REQUIRE(search.stays_connected(leaving) == (components.size() == 1));
      const auto weight_of = [&](const std::set<local_id>& component) {
        return std::accumulate(component.begin(), component.end(), 0.0,
                               [&](double sum, local_id v) { return sum + weights[v]; });
      };
      // The weight that the search is told is that of the components beside; others have nothing to do with
      // it.
      double total = 0;
      for (const auto& component : components)
        total += weight_of(component);
      for (const local_id v : leaving)
        total += weights[v];
      const auto heaviest =
          std::max_element(components.begin(), components.end(),
                           [&](const auto& a, const auto& b) { return weight_of(a) < weight_of(b); });
      std::set<local_id> expected;
      for (auto it = components.begin(); it != components.end(); ++it)
        if (it != heaviest)
          expected.insert(it->begin(), it->end());
      const auto found = search.cut_off_by(leaving, total);
      REQUIRE(found.size() == expected.size());
      REQUIRE(std::set<local_id>(found.begin(), found.end()) == expected);
    }
  }
}

TEST_CASE("borders, weights and defects are kept through changes and returns") {
  partitioned_mesh given(3, 6, 1.02);
  auto parts = given.reassignable();
  const auto start = given.part;
  const auto place = parts.mark();
  random_numbers random(5);
  for (int k = 0; k < 200; ++k) {
    const auto s = static_cast<local_id>(random.bits() % given.part.size());
    const auto to = static_cast<local_id>(random.bits() % 6);
    if (given.part[s] != to && parts.keeps_connected(std::array{s}))
      parts.assign(std::array{s}, to);
    if (k % 40 == 0)
      check_bookkeeping(given, parts);
  }
  check_bookkeeping(given, parts);
  CHECK(given.part != start);
  parts.go_back_to(place);
  CHECK(given.part == start);
  check_bookkeeping(given, parts);
}

TEST_CASE("a bound on removed defects never hides a gain") {
  partitioned_mesh given(4, 8, 1.05);
  random_numbers random(7);
  for (int k = 0; k < 60; ++k) // some defects
    given.part[random.bits() % given.part.size()] = static_cast<local_id>(random.bits() % 8);
  auto parts = given.reassignable();
  const auto always = [](const defect_count&) { return true; };
  const auto is_gain = [](const defect_count& removed) { return removed.edges > 0 || removed.points > 0; };
  int gains = 0;
  for (local_id s = 0; s < parts.super_count(); ++s)
    for (const local_id to : parts.parts_beside(std::array{s})) {
      const defect_count all = parts.defects_removed_by(std::array{s}, to, always);
      const defect_count bounded = parts.defects_removed_by(std::array{s}, to, is_gain);
      const auto place = parts.mark();
      const defect_count before = parts.standing().defects;
      parts.assign(std::array{s}, to);
      REQUIRE(all == before - parts.standing().defects);
      parts.go_back_to(place);
      REQUIRE(is_gain(all) == is_gain(bounded));
      if (is_gain(all)) {
        REQUIRE(all == bounded);
        ++gains;
      }
    }
  CHECK(gains > 5);
}

TEST_CASE("what is cut off goes with heavy super-elements, too, as long as it is light itself") {
  int heavy_with_light = 0, refused = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    partitioned_mesh given(seed, 5, 1.1);
    auto parts = given.reassignable();
    random_numbers random(seed);
    for (int k = 0; k < 50; ++k) {
      std::vector<local_id> group{
          static_cast<local_id>(random.bits() % static_cast<std::uint64_t>(parts.super_count()))};
      const local_id own = parts.part_of(group[0]);
      for (std::size_t next = 0; next < group.size() && parts.weight_of(group) < 0.2 * given.limits[0];
           ++next)
        for (const local_id s : given.simplified.graph.row(group[next]))
          if (parts.part_of(s) == own && std::find(group.begin(), group.end(), s) == group.end())
            group.push_back(s);
      const local_id to = (own + 1) % 5;
      const auto cut_off =
          parts.keeps_connected(group) ? std::vector<local_id>{} : parts.components_cut_off_by(group);
      const auto moved = parts.with_cut_off(group, to);
      if (parts.weight_of(cut_off) > 0.1 * given.limits[0]) {
        CHECK_FALSE(moved);
        ++refused;
      }
      if (!moved)
        continue;
      std::vector<local_id> all = group;
      append(all, cut_off);
      CHECK(*moved == all);
      CHECK(parts.keeps_connected(all));
      heavy_with_light += !cut_off.empty() && !parts.is_light(parts.weight_of(group), to) ? 1 : 0;
    }
  }
  CHECK(heavy_with_light > 5);
  CHECK(refused > 0);
}

TEST_CASE("refinement never worsens a partition's standing and keeps its parts connected") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    CAPTURE(seed);
    partitioned_mesh given(seed, 5, seed % 2 == 0 ? 1.0 : 1.1);
    random_numbers random(seed);
    auto parts = given.reassignable();
    disturb(parts, random, 1000);
    const auto before = standing_of(given);
    connected_refinement<3>(parts).run(1);
    const auto after = standing_of(given);
    CHECK(after.is_better_than(before));
    CHECK(after.excess <= before.excess + 1e-9);
    CHECK(components_within(given.simplified.graph, given.part).count == 5);
    check_bookkeeping(given, parts);
    connected_refinement<3>(parts).run(100);
    const auto assignments = parts.assignments();
    const auto refined = given.part;
    connected_refinement<3>(parts).run(1); // an attempt that is no gain leaves nothing behind
    CHECK(parts.assignments() == assignments);
    CHECK(given.part == refined);
    CHECK(components_within(given.simplified.graph, given.part).count == 5);
  }
}

TEST_CASE("a repair ends when as many super-elements were reassigned as may be") {
  partitioned_mesh given(3, 6, 1.2);
  auto parts = given.reassignable();
  random_numbers random(3);
  disturb(parts, random, 1000);
  manifold_repair<3> repair(parts);
  const auto points = repair.defective_points();
  REQUIRE(points.size() > 10);
  const auto start = parts.mark();
  const auto assigned_with = [&](auto... most) {
    repair.repair(points, most...);
    const std::size_t assigned = parts.assignments() - start.trail_length;
    parts.go_back_to(start);
    return assigned;
  };
  const std::size_t all = assigned_with();
  CHECK(assigned_with(std::size_t{0}) == 0);
  CHECK(assigned_with(std::size_t{1}) >= 1);
  CHECK(assigned_with(std::size_t{5}) >= 5);
  CHECK(assigned_with(std::size_t{5}) < all);
}
