#include "dovetail/decomposition/decompose.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/graph/disjoint_sets.hpp"
#include "dovetail/partition/apportion.hpp"
#include "dovetail/partition/connectivity.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/simplification/none.hpp"
#include "dovetail/simplification/paper.hpp"
#include "dovetail/simplification/simplify.hpp"
#include "support/jittered_meshes.hpp"
#include "support/subdomain_boundary.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <map>
#include <numeric>
#include <set>

using namespace dovetail;
using namespace dovetail_test;

namespace {

/// Every element a super-element of its own.
struct plain {
  std::vector<local_id> super;
  csr_graph graph;
};
template <int D>
plain element_graph(const simplicial_mesh<D>& mesh, const side_table<D>& sides) {
  plain p;
  p.super.resize(mesh.elements.size());
  std::iota(p.super.begin(), p.super.end(), 0);
  std::vector<weighted_edge> edges;
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (sides.is_interior(static_cast<local_id>(s)))
      edges.push_back({sides.elements[s][0], sides.elements[s][1], 1});
  p.graph = make_csr_graph(std::vector<double>(mesh.elements.size(), 1.0), edges);
  return p;
}

/// Points where the boundary of one part is not manifold, from the definition: an edge with other than two
/// boundary triangles, or boundary triangles around a point that are not one chain.
std::set<local_id> non_manifold_points_of(const simplicial_mesh<3>& mesh, const std::vector<local_id>& part,
                                          local_id p) {
  std::map<simplex<2>, int> count;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (part[e] == p)
      for (const auto& local : numbering::sides<3>)
        ++count[sorted_vertices(detail::pick(mesh.elements[e], local))];
  std::map<simplex<1>, int> edges;
  std::map<local_id, std::vector<simplex<1>>> links;
  for (const auto& [t, n] : count)
    if (n == 1)
      for (std::size_t i = 0; i < 3; ++i) {
        const simplex<1> opposite{t[i == 0 ? 1 : 0], t[i == 2 ? 1 : 2]};
        ++edges[opposite];
        links[t[i]].push_back(opposite);
      }
  std::set<local_id> found;
  for (const auto& [edge, n] : edges)
    if (n != 2)
      found.insert(edge.begin(), edge.end());
  for (const auto& [v, link] : links) {
    std::set<local_id> reached{link[0][0]};
    for (std::size_t round = 0; round < link.size(); ++round)
      for (const auto& [a, b] : link)
        if (reached.count(a) + reached.count(b) == 1)
          reached.insert({a, b});
    for (const auto& [a, b] : link)
      if (reached.count(a) == 0)
        found.insert(v);
  }
  return found;
}

std::set<local_id> non_manifold_points(const simplicial_mesh<3>& mesh, const std::vector<local_id>& part,
                                       int parts) {
  std::set<local_id> all;
  for (local_id p = 0; p < parts; ++p)
    all.merge(non_manifold_points_of(mesh, part, p));
  return all;
}

/// Connected through sides, non-empty, one material each.
template <int D>
void check_parts(const simplicial_mesh<D>& mesh, const side_table<D>& sides, const decomposition& d) {
  std::vector<std::uint8_t> cut(sides.size(), 0);
  disjoint_sets sets(mesh.elements.size());
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto [a, b] = sides.elements[s];
    if (sides.is_interior(static_cast<local_id>(s)) && d.part_of_element[a] == d.part_of_element[b])
      sets.unite(a, b);
  }
  CHECK(sets.number_sets().count == d.parts);
  std::set<local_id> used(d.part_of_element.begin(), d.part_of_element.end());
  CHECK(used.size() == static_cast<std::size_t>(d.parts));
  CHECK(*used.rbegin() == d.parts - 1);
  if (!mesh.tags.empty())
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
      REQUIRE(mesh.tags[e] == d.material_of_part[d.part_of_element[e]]);
}

/// A partitioner that cuts badly: parts by a hash of the node, so parts are scattered.
struct scattered {
  std::uint64_t seed = 1;
  std::vector<local_id> operator()(const csr_graph& graph, int parts) const {
    random_numbers random(seed);
    std::vector<local_id> part(graph.node_weights.size());
    for (local_id& p : part)
      p = static_cast<local_id>(random.bits() % static_cast<std::uint64_t>(parts));
    detail::fill_empty_parts(graph, part, parts);
    return part;
  }
};

} // namespace

TEST_CASE("defects agree with the definition of a manifold on random partitions") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto mesh = jittered_cubes(3, 0.15, seed);
    const auto sides = build_sides(mesh);
    random_numbers random(seed);
    std::vector<local_id> part(mesh.elements.size());
    const bool by_cell = seed % 2 == 0; // whole cells make mild defects, single elements wild ones
    for (std::size_t e = 0; e < part.size(); ++e)
      part[e] = by_cell && e % 6 != 0 ? part[e - 1] : static_cast<local_id>(random.bits() % 2);
    boundary_defects<3> defects(mesh, sides);
    std::set<local_id> found;
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
      if (defects.count_at(static_cast<local_id>(v), [&](local_id e) { return part[e]; }).any())
        found.insert(static_cast<local_id>(v));
    CHECK(found == non_manifold_points(mesh, part, 2));
    CHECK(!found.empty());
  }
}

TEST_CASE("two tetrahedra of one part that touch in a point, an edge, a face") {
  simplicial_mesh<3> mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  const auto defects_with = [&](simplex<3> second) {
    mesh.elements = {{0, 1, 2, 3}, second};
    const auto sides = build_sides(mesh);
    boundary_defects<3> defects(mesh, sides);
    defect_count total;
    for (local_id v = 0; v < 7; ++v)
      total += defects.count_at(v, [](local_id) { return 0; });
    return total;
  };
  CHECK(defects_with({0, 5, 4, 6}) == defect_count{0, 1}); // one fan too many at the point
  CHECK(defects_with({0, 4, 5, 3}) == defect_count{2, 0}); // a pair of sides too many, seen from both ends
  CHECK(defects_with({0, 2, 1, 6}) == defect_count{});
}

TEST_CASE("D = 2: parts that touch in a point have a defect there") {
  simplicial_mesh<2> mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  mesh.elements = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
  const auto sides = build_sides(mesh);
  boundary_defects<2> defects(mesh, sides);
  CHECK(defects.count_at(0, [](local_id e) { return e % 2; }) == defect_count{0, 2}); // both parts
  CHECK(defects.count_at(0, [](local_id e) { return e / 2; }) == defect_count{});
  CHECK(defects.count_at(0, [](local_id) { return 0; }) == defect_count{});
}

TEST_CASE("stray components join the neighbour of largest interface, and every part is connected") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto mesh = jittered_cubes(4, 0.1, seed);
    const auto sides = build_sides(mesh);
    const plain p = element_graph(mesh, sides);
    for (const int parts : {2, 5, 20}) {
      std::vector<local_id> part = scattered{seed}(p.graph, parts);
      join_stray_components(p.graph, part, parts);
      CHECK(components_within(p.graph, part).count == parts);
      CHECK(std::set<local_id>(part.begin(), part.end()).size() == static_cast<std::size_t>(parts));
    }
  }
  // A path 0-1-2-3-4 with parts a b a b b: 0 and 2 are strays or mains of a; the heavier, 2, is main.
  const std::vector<weighted_edge> path{{0, 1, 5}, {1, 2, 1}, {2, 3, 1}, {3, 4, 1}};
  const csr_graph graph = make_csr_graph({1, 1, 3, 2, 2}, path);
  std::vector<local_id> part{0, 1, 0, 1, 1};
  CHECK(join_stray_components(graph, part, 2) == 2);
  CHECK(part ==
        std::vector<local_id>{0, 0, 0, 1, 1}); // 0 joins 1 over the edge of weight 5, both then go to 2
  // Between two neighbours that are as near, the first.
  const csr_graph between =
      make_csr_graph({5, 5, 1, 5}, std::vector<weighted_edge>{{0, 1, 1}, {1, 2, 1}, {2, 3, 1}});
  part = {0, 1, 0, 2};
  CHECK(join_stray_components(between, part, 3) == 1);
  CHECK(part == std::vector<local_id>{0, 1, 1, 2});
  // As many components as parts, of which one is empty and another in two pieces.
  part = {0, 1, 0, 0};
  CHECK(join_stray_components(between, part, 3) == 1);
  CHECK(components_within(between, part).count == 2);
}

TEST_CASE("scattered partitions become connected parts; defects that are left are listed exactly") {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    auto mesh = jittered_cubes(5, 0.15, seed);
    if (seed == 2)
      for (std::size_t e = 0; e < mesh.elements.size(); ++e)
        mesh.tags.push_back(e < mesh.elements.size() / 3 ? 4 : 9);
    const auto sides = build_sides(mesh);
    const plain p = element_graph(mesh, sides);
    const auto d = decompose<3>(mesh, sides, p.super, p.graph, mesh.tags, scattered{seed}, 6);
    check_parts(mesh, sides, d);
    const auto expected = non_manifold_points(mesh, d.part_of_element, d.parts);
    CHECK(std::set<local_id>(d.defective_points.begin(), d.defective_points.end()) == expected);
    // Parts that start as wild as these cannot always be mended, but there is little left.
    CHECK(d.defective_points.size() <= 4);
    CHECK(d.non_manifold_edges <= 2);
    if (mesh.tags.empty())
      CHECK(d.summary.warnings.empty() == expected.empty());
    CHECK(std::accumulate(d.part_weights.begin(), d.part_weights.end(), 0.0) ==
          doctest::Approx(static_cast<double>(mesh.elements.size())));
  }
}

TEST_CASE("where a model is not manifold itself no decomposition is blamed") {
  simplicial_mesh<2> mesh; // four pairs of triangles around one edge, which the surface passes through twice
  mesh.points = {{0, 0, 0}, {0, 0, 1}};
  for (const auto& [x, y] : {std::array{1, 0}, {0, 1}, {-1, 0}, {0, -1}}) {
    const auto n = static_cast<local_id>(mesh.points.size());
    mesh.points.push_back({1.0 * x, 1.0 * y, 0});
    mesh.points.push_back({1.0 * x, 1.0 * y, 1});
    mesh.elements.push_back({0, n, n + 1});
    mesh.elements.push_back({0, n + 1, 1});
  }
  const auto sides = build_sides(mesh);
  std::vector<local_id> pair_of_triangle;
  csr_graph graph;
  graph.offsets = {0};
  for (local_id pair = 0; pair < 4; ++pair) { // each beside two others, as where two surfaces touch
    pair_of_triangle.insert(pair_of_triangle.end(), 2, pair);
    graph.node_weights.push_back(2);
    for (const local_id other : {(pair + 1) % 4, (pair + 3) % 4}) {
      graph.neighbours.push_back(other);
      graph.edge_weights.push_back(1);
    }
    graph.offsets.push_back(static_cast<std::int64_t>(graph.neighbours.size()));
  }
  const auto whole = decompose<2>(mesh, sides, pair_of_triangle, graph, {}, partition::greedy{}, 1);
  CHECK(whole.defective_points == std::vector<local_id>{0, 1});
  CHECK(whole.summary.warnings.empty());
}

TEST_CASE("a simplified mesh is decomposed along sides that may be interfaces, in balance") {
  auto mesh = shuffled(jittered_cubes(10, 0.15, 3), 4);
  for (vec3& point : mesh.points)
    point.z *= 0.8;
  const auto sides = build_sides(mesh);
  for (const int parts : {2, 8, 13}) {
    const auto simplified = simplify<3>(mesh, mesh_duals<3>(mesh, sides), simplifier::paper{},
                                        {.subdomains = static_cast<double>(parts)});
    const auto d = decompose<3>(mesh, sides, simplified.super_of_element, simplified.graph, {},
                                partition::greedy{}, parts);
    CAPTURE(parts);
    CHECK(d.parts == parts);
    check_parts(mesh, sides, d);
    CHECK(d.defective_points.empty());
    CHECK(d.summary.get("imbalance") <= 1.05);
    const auto boundary = subdomain_boundary<3>(mesh, sides, d.part_of_element);
    for (std::size_t k = 0; k < boundary.sides.size(); ++k) {
      const auto state = simplified.side_states[boundary.side_ids[k]];
      REQUIRE(state != side_state::removed);
      REQUIRE((boundary.on_surface[k] != 0) == (boundary.subdomains[k][1] == no_id));
    }
    const auto again = decompose<3>(mesh, sides, simplified.super_of_element, simplified.graph, {},
                                    partition::greedy{}, parts);
    CHECK(again.part_of_element == d.part_of_element);
  }
}

TEST_CASE("the paper's rule leaves fewer and less small angles at interfaces of a raw mesh") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    CAPTURE(seed);
    auto mesh = shuffled(jittered_cubes(14, 0.15, seed), seed);
    for (vec3& point : mesh.points)
      point.z *= 0.7;
    const auto sides = build_sides(mesh);
    const mesh_duals<3> duals(mesh, sides);
    const auto angles_by = [&](const auto& rule) {
      const auto simplified = simplify<3>(mesh, duals, rule, {.subdomains = 8});
      const auto d = decompose<3>(mesh, sides, simplified.super_of_element, simplified.graph, {},
                                  partition::greedy{}, 8);
      return measure_interface_angles<3>({mesh, sides, simplified.side_states, d.part_of_element}, {30, 30});
    };
    const auto with = angles_by(simplifier::paper{}), without = angles_by(simplifier::none{});
    CHECK(without.min_dihedral_deg() < 30);
    CHECK(with.min_dihedral_deg() > without.min_dihedral_deg());
    CHECK(with.face_angle.angle_deg > without.face_angle.angle_deg);
    CHECK(with.violations.empty());
    CHECK(without.violations.size() > 100);
  }
}

TEST_CASE("a request to stop ends simplification and decomposition") {
  const auto mesh = jittered_cubes(4, 0.15, 3);
  const auto sides = build_sides(mesh);
  const progress stop{{}, [] { return true; }};
  CHECK_THROWS_AS(simplify<3>(mesh, mesh_duals<3>(mesh, sides), simplifier::paper{}, {}, {}, stop),
                  cancelled);
  const auto simplified = simplify<3>(mesh, mesh_duals<3>(mesh, sides), simplifier::paper{});
  CHECK_THROWS_AS(decompose<3>(mesh, sides, simplified.super_of_element, simplified.graph, {},
                               partition::greedy{}, 4, 1.05, stop),
                  cancelled);
}

TEST_CASE("D = 2 goes through the same code") {
  const auto mesh = shuffled(jittered_squares(24, 0.2, 3), 4);
  const auto sides = build_sides(mesh);
  const auto simplified =
      simplify<2>(mesh, mesh_duals<2>(mesh, sides), simplifier::paper{}, {.subdomains = 7});
  const auto d =
      decompose<2>(mesh, sides, simplified.super_of_element, simplified.graph, {}, partition::greedy{}, 7);
  CHECK(d.parts == 7);
  check_parts(mesh, sides, d);
  CHECK(d.defective_points.empty());
}

TEST_CASE("materials are never mixed, and every component gets its share") {
  auto mesh = jittered_cubes(6);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) { // a thin layer between two thick ones
    const std::size_t layer = e / (6 * 6 * 6);
    mesh.tags.push_back(layer == 2 ? 1 : 0);
  }
  const auto sides = build_sides(mesh);
  const auto simplified =
      simplify<3>(mesh, mesh_duals<3>(mesh, sides), simplifier::paper{}, {.subdomains = 12});
  const auto d = decompose<3>(mesh, sides, simplified.super_of_element, simplified.graph, mesh.tags,
                              partition::greedy{}, 12);
  check_parts(mesh, sides, d);
  CHECK(d.summary.get("components") == 3);
  CHECK(d.parts == 12);
  CHECK(std::count(d.material_of_part.begin(), d.material_of_part.end(), 1) == 2);
  const auto one = decompose<3>(mesh, sides, simplified.super_of_element, simplified.graph, mesh.tags,
                                partition::greedy{}, 1);
  CHECK(one.parts == 3); // at least one part per component
}

TEST_CASE("parts are given out in proportion to weight") {
  const std::vector<double> weights{10, 30, 60};
  const std::vector<local_id> nodes{100, 100, 100};
  CHECK(apportion_parts(weights, nodes, 10) == std::vector<int>{1, 3, 6});
  CHECK(apportion_parts(std::vector<double>{60, 25, 25}, nodes, 6) ==
        std::vector<int>{3, 2, 1}); // ties: the first
  CHECK(apportion_parts(weights, nodes, 2) == std::vector<int>{1, 1, 1});
  CHECK(apportion_parts(weights, std::vector<local_id>{1, 2, 2}, 10) == std::vector<int>{1, 2, 2});
}

TEST_CASE("the boundary of every part is closed and encloses the part's volume") {
  auto mesh = jittered_cubes(6);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    mesh.tags.push_back(e % 6 < 3 && e > 600 ? 1 : 0);
  const auto sides = build_sides(mesh);
  const plain p = element_graph(mesh, sides);
  const auto d = decompose<3>(mesh, sides, p.super, p.graph, mesh.tags, partition::greedy{}, 5);
  const auto boundary = subdomain_boundary<3>(mesh, sides, d.part_of_element);
  std::vector<double> enclosed(static_cast<std::size_t>(d.parts), 0.0);
  std::vector<double> expected(enclosed);
  const auto at = [&](local_id v) { return mesh.points[v]; };
  for (std::size_t k = 0; k < boundary.sides.size(); ++k) {
    const auto& t = boundary.sides[k];
    // Seen from the origin outward triangles have positive volume, with the order (0, a, b, c).
    const double volume = dot(at(t[0]), cross(at(t[1]), at(t[2]))) / 6;
    enclosed[boundary.subdomains[k][0]] += volume;
    if (boundary.subdomains[k][1] != no_id)
      enclosed[boundary.subdomains[k][1]] -= volume;
  }
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto& t = mesh.elements[e];
    expected[d.part_of_element[e]] += signed_volume(at(t[0]), at(t[1]), at(t[2]), at(t[3]));
  }
  for (std::size_t part = 0; part < enclosed.size(); ++part)
    CHECK(enclosed[part] == doctest::Approx(expected[part]));
}

TEST_CASE("an empty mesh is refused") {
  const simplicial_mesh<3> mesh;
  const auto sides = build_sides(mesh);
  CHECK_THROWS_AS(decompose<3>(mesh, sides, {}, csr_graph{}, {}, partition::greedy{}, 2), partition_error);
}
