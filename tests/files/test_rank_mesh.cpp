// What ranks hold: together the mesh, each in the order of solvers, agreeing about what they share.
#include "files/bent_edges.hpp"
#include "files/stacked_cubes.hpp"

#include "dovetail/models/plane/svg_path.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "dovetail/solver/check_rank_meshes.hpp"
#include "dovetail/solver/gather.hpp"
#include "dovetail/solver/make_rank_mesh.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

using namespace dovetail;

namespace {

template <int D>
std::vector<rank_mesh<D>> all_ranks(const distributed_simplicial_mesh<D>& mesh,
                                    const std::vector<local_id>& rank_of_piece, local_id ranks, bool ghosts) {
  const auto numbers = io::number_by_ranks(mesh, rank_of_piece, ranks);
  std::vector<rank_mesh<D>> all;
  for (local_id q = 0; q < ranks; ++q) {
    all.push_back(io::make_rank_mesh<D>(mesh, numbers, q, ghosts));
    const auto counts = io::count_rank_mesh<D>(mesh, numbers, q, ghosts);
    CHECK(counts.vertices == all.back().mesh.points.size());
    CHECK(counts.elements == all.back().mesh.elements.size());
    CHECK(counts.sides == all.back().sides.size());
  }
  return all;
}

template <int D>
std::string faults_of(const std::vector<rank_mesh<D>>& ranks) {
  std::string text;
  for (const auto& fault : io::check_rank_meshes<D>(ranks))
    text += fault + "\n";
  return text;
}

/// The elements of all ranks at their numbers in the mesh, as numbers of points.
template <int D>
std::vector<std::array<global_id, D + 1>> put_together(const std::vector<rank_mesh<D>>& ranks) {
  std::size_t count = 0;
  for (const auto& rank : ranks)
    count += rank.owned_elements;
  std::vector<std::array<global_id, D + 1>> elements(count);
  for (const auto& rank : ranks)
    for (std::size_t e = 0; e < rank.owned_elements; ++e)
      for (std::size_t k = 0; k <= D; ++k)
        elements.at(rank.element_numbers[e])[k] = rank.vertex_numbers[rank.mesh.elements[e][k]];
  return elements;
}

template <int D>
std::array<global_id, D> by_number(const rank_mesh<D>& rank, const simplex<D - 1>& side) {
  std::array<global_id, D> numbers;
  for (std::size_t k = 0; k < D; ++k)
    numbers[k] = rank.vertex_numbers[side[k]];
  return numbers;
}

/// Is it a side of the element, and where it must be, turned outwards?
template <int D>
bool has_side(const simplex<D>& element, const simplex<D - 1>& side, bool outwards) {
  for (const auto& local : numbering::sides<D>) {
    simplex<D - 1> at;
    for (std::size_t k = 0; k < D; ++k)
      at[k] = element[local[k]];
    if (!outwards && sorted_vertices(at) == sorted_vertices(side))
      return true;
    for (int turn = 0; turn < (D == 3 ? 3 : 1); ++turn) {
      if (at == side)
        return true;
      std::rotate(at.begin(), at.begin() + 1, at.end());
    }
  }
  return false;
}

template <int D>
void check_all_of(const distributed_simplicial_mesh<D>& mesh, const std::vector<local_id>& rank_of_piece,
                  local_id ranks) {
  const auto plain = all_ranks(mesh, rank_of_piece, ranks, false);
  const auto with_ghosts = all_ranks(mesh, rank_of_piece, ranks, true);
  CHECK(faults_of(plain) == "");
  CHECK(faults_of(with_ghosts) == "");
  const auto whole =
      io::gather(mesh); // every point of the skeleton is in an element: its numbers are the mesh's
  const auto elements = put_together(plain);
  REQUIRE(elements.size() == whole.mesh.elements.size());
  bool same = true;
  for (std::size_t e = 0; e < elements.size(); ++e)
    same = same && std::equal(elements[e].begin(), elements[e].end(), whole.mesh.elements[e].begin());
  CHECK(same);
  std::set<std::pair<std::array<global_id, D>, local_id>> hosts;
  for (std::size_t s = 0; s < whole.sides.size(); ++s) {
    std::array<global_id, D> key;
    std::copy(whole.sides[s].begin(), whole.sides[s].end(), key.begin());
    std::sort(key.begin(), key.end());
    hosts.insert({key, whole.side_hosts[s]});
  }
  io::mesh_hasher hasher;
  std::size_t sides = 0;
  for (const auto& rank : plain) {
    io::hash_rank_mesh(hasher, rank);
    for (std::size_t v = 0; v < rank.mesh.points.size(); ++v)
      same = same && rank.mesh.points[v] == whole.mesh.points[rank.vertex_numbers[v]];
    for (std::size_t e = 0; e < rank.owned_elements; ++e) {
      const auto number = static_cast<std::size_t>(rank.element_numbers[e]);
      same = same && rank.mesh.tags[e] == whole.mesh.tags[number] &&
             rank.subdomains[e] == whole.subdomains[number];
    }
    for (const auto& elements_of_side : rank.side_elements)
      sides += elements_of_side[1] == no_id ? 1 : 2;
    for (std::size_t s = 0; s < rank.sides.size(); ++s) {
      auto key = by_number(rank, rank.sides[s]);
      std::sort(key.begin(), key.end());
      same = same && hosts.count({key, rank.side_hosts[s]}) == 1;
      for (const local_id e : rank.side_elements[s])
        same = same && (e == no_id ||
                        has_side<D>(rank.mesh.elements[e], rank.sides[s], e == rank.side_elements[s][0]));
    }
  }
  CHECK(same);
  CHECK(hasher.value() == io::mesh_hash(mesh));
  std::size_t sides_of_whole = 0; // seen from each of their elements
  for (const auto& elements_of_side : whole.side_elements)
    sides_of_whole += elements_of_side[1] == no_id ? 1 : 2;
  CHECK(sides == sides_of_whole);
}

/// A second-order mesh with all its nodes and elements at their numbers.
template <int D>
struct numbered_nodes {
  std::vector<vec3> points;
  std::vector<std::vector<global_id>> elements;

  explicit numbered_nodes(const distributed_simplicial_mesh<D>& mesh) {
    const auto numbers = io::number_nodes(mesh);
    for (std::size_t v = 0; v < skeleton_nodes(mesh); ++v)
      points.push_back(skeleton_node(mesh, static_cast<local_id>(v)));
    for (std::size_t p = 0; p < mesh.counts.size(); ++p) {
      const auto piece = mesh.load(static_cast<local_id>(p));
      const piece_nodes<D> nodes(mesh, piece);
      append(points, nodes.own());
      for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e)
        for (auto& of = elements.emplace_back(); const local_id v : nodes.of_element(e))
          of.push_back(io::global_node(nodes, numbers, static_cast<local_id>(p), v));
    }
  }
};

/// Of a mesh with middles of edges: the ranks have its nodes, bit for bit, owned corners first as without
/// middles.
template <int D>
void check_second_order(const distributed_simplicial_mesh<D>& mesh,
                        const std::vector<local_id>& rank_of_piece, local_id ranks) {
  const numbered_nodes<D> whole(mesh);
  auto linear = mesh;
  linear.mid_nodes = {};
  for (const bool ghosts : {false, true}) {
    CAPTURE(ghosts);
    const auto of_corners = all_ranks(linear, rank_of_piece, ranks, ghosts);
    const auto all = all_ranks(mesh, rank_of_piece, ranks, ghosts);
    CHECK(faults_of(all) == "");
    std::size_t vertices = 0, elements = 0;
    bool same = true;
    for (const auto& rank : all) {
      const auto& corners = of_corners[rank.rank];
      vertices += rank.owned_vertices;
      elements += rank.owned_elements;
      for (std::size_t v = 0; v < rank.mesh.points.size(); ++v)
        same = same && rank.mesh.points[v] == whole.points[rank.vertex_numbers[v]];
      for (std::size_t e = 0; e < rank.mesh.elements.size(); ++e) {
        std::vector<global_id> nodes;
        for_each_node(rank, e, [&](local_id v) { nodes.push_back(rank.vertex_numbers[v]); });
        same = same && nodes == whole.elements[rank.element_numbers[e]];
      }
      same = same && rank.owned_corners == corners.owned_vertices &&
             std::equal(corners.mesh.points.begin(),
                        corners.mesh.points.begin() + static_cast<std::ptrdiff_t>(rank.owned_corners),
                        rank.mesh.points.begin());
      same = same && rank.element_ids == corners.element_ids && rank.mesh.tags == corners.mesh.tags &&
             rank.side_hosts == corners.side_hosts && rank.side_middles.size() == rank.sides.size();
      for (std::size_t s = 0; s < rank.side_middles.size(); ++s)
        for (std::size_t k = 0; k < edges_per_element<D - 1>; ++k) {
          const auto [a, b] = vertices_of_edge(rank.sides[s], numbering::edges<D - 1>[k]);
          const auto at = [&](local_id v) { return rank.mesh.points[v]; };
          same = same && at(rank.side_middles[s][k]) == testing::bent_middle(at(a), at(b));
        }
    }
    CHECK(same);
    CHECK(vertices == whole.points.size());
    CHECK(elements == whole.elements.size());
  }
}

/// Of elements or pieces: one of `kinds`, each at least once.
std::vector<local_id> random_labels(std::size_t count, local_id kinds, std::mt19937& random) {
  std::vector<local_id> labels;
  for (std::size_t i = 0; i < count; ++i)
    labels.push_back(i < static_cast<std::size_t>(kinds)
                         ? static_cast<local_id>(i)
                         : static_cast<local_id>(random() % static_cast<unsigned>(kinds)));
  std::shuffle(labels.begin(), labels.end(), random);
  return labels;
}

} // namespace

TEST_CASE("ranks make up the mesh: random elements in pieces, random pieces on ranks") {
  const testing::stacked_cubes cubes{.cells = 3, .jitter = 0.2};
  const auto count = cubes.whole().elements.size();
  for (unsigned seed = 0; seed < 12; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const auto pieces = static_cast<local_id>(1 + random() % 12);
    const auto ranks = static_cast<local_id>(1 + random() % static_cast<unsigned>(pieces));
    const auto mesh = cubes.distributed(random_labels(count, pieces, random));
    const auto rank_of_piece = random_labels(static_cast<std::size_t>(pieces), ranks, random);
    check_all_of(mesh, rank_of_piece, ranks);
    check_second_order(testing::with_bent_edges(mesh), rank_of_piece, ranks);
  }
}

TEST_CASE("ranks make up the mesh: boxes of two solids, whose sides between are on both ranks") {
  const auto mesh = testing::stacked_cubes{.cells = 4, .cuts = 2, .solids = 2, .jitter = 0.3}.distributed();
  check_all_of(mesh, {0, 1, 2, 0, 1, 2, 0, 1}, 3);
  check_all_of(mesh, {0, 0, 0, 0, 1, 1, 1, 1}, 2);
  const auto halves = all_ranks(mesh, {0, 0, 0, 0, 1, 1, 1, 1}, 2, false);
  for (const auto& rank : halves) {
    CHECK(std::count(rank.side_hosts.begin(), rank.side_hosts.end(), 1) == 32); // face 1 is between them
    REQUIRE(rank.neighbours.size() == 1);
    CHECK(rank.neighbours[0].faces.size() == 32);
    CHECK(rank.neighbours[0].vertices.size() == 25);
    CHECK(rank.neighbours[0].edges.size() == 32 + 24); // of a grid of 4 x 4, each square with a diagonal
  }
  CHECK(halves[0].owned_vertices == 75); // the lower half has what lies between
  CHECK(halves[1].owned_vertices == 50);
  CHECK(halves[1].held_vertices == 75);
  const auto quadratic = all_ranks(testing::with_bent_edges(mesh), {0, 0, 0, 0, 1, 1, 1, 1}, 2, false);
  for (const auto& rank : quadratic) {
    REQUIRE(rank.neighbours.size() == 1);
    CHECK(rank.neighbours[0].vertices.size() == 25 + 32 + 24);
    CHECK(rank.neighbours[0].edges.size() == 32 + 24);
  }
  CHECK(quadratic[1].held_vertices == quadratic[1].owned_vertices + 25 + 32 + 24);
}

TEST_CASE("a rank without pieces is empty, and one rank has everything") {
  const auto mesh = testing::stacked_cubes{.cells = 2, .cuts = 2}.distributed();
  check_all_of(mesh, std::vector<local_id>(8, 1), 3);
  check_all_of(mesh, std::vector<local_id>(8, 0), 1);
  check_second_order(testing::with_bent_edges(mesh), std::vector<local_id>(8, 1), 3);
  const auto ranks = all_ranks(mesh, std::vector<local_id>(8, 1), 3, true);
  CHECK(ranks[0].mesh.points.empty());
  CHECK(ranks[1].owned_elements == 48);
  CHECK(ranks[1].neighbours.empty());
}

TEST_CASE("only the rank's own pieces are loaded, once; for ghosts those that touch it") {
  auto mesh = testing::stacked_cubes{.cells = 6, .cuts = 3}.distributed();
  std::vector<int> loads(27, 0);
  mesh.load = [&loads, load = mesh.load](local_id p) {
    ++loads[p];
    return load(p);
  };
  std::vector<local_id> rank(27, 1);
  rank[0] = 0;
  const auto numbers = io::number_by_ranks(mesh, rank, 2);
  (void)io::make_rank_mesh<3>(mesh, numbers, 0);
  CHECK(loads[0] == 1);
  CHECK(std::accumulate(loads.begin(), loads.end(), 0) == 1);
  (void)io::make_rank_mesh<3>(mesh, numbers, 0, true);
  CHECK(std::accumulate(loads.begin(), loads.end(), 0) == 1 + 8); // the boxes around a corner of one of 27
  (void)io::count_rank_mesh<3>(mesh, numbers, 0);
  CHECK(std::accumulate(loads.begin(), loads.end(), 0) == 1 + 8);
  (void)io::count_rank_mesh<3>(mesh, numbers, 0, true);
  CHECK(std::accumulate(loads.begin(), loads.end(), 0) == 1 + 8 + 7);
}

TEST_CASE("triangles: a plane domain, and sheets that meet in an edge") {
  const plane_domain domain(drawing_from_svg_path("M0 0 H3 V2 H0 Z M1 1 h0.5 v0.5 h-0.5 Z"));
  const auto result = generate<2>(domain, uniform_size(0.2), parameters<>{}.with_options({.subdomains = 7}));
  check_all_of(result.mesh, {0, 1, 2, 0, 1, 2, 0}, 3);
  check_second_order(testing::with_bent_edges(result.mesh), {0, 1, 2, 0, 1, 2, 0}, 3);

  distributed_simplicial_mesh<2> sheets;
  sheets.skeleton.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  sheets.skeleton.point_hosts.own().resize(5);
  for (local_id s = 0; s < 3; ++s) {
    for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 2 + s), std::pair(2 + s, 0)}) {
      sheets.skeleton.sides.own().push_back({a, b});
      sheets.skeleton.subdomains.own().push_back({s, no_id});
      sheets.skeleton.side_hosts.own().push_back(6);
    }
    sheets.counts.push_back({0, 0, 1});
  }
  sheets.load = [points = sheets.skeleton.points](local_id s) {
    simplicial_piece<2> piece;
    piece.subdomain = s;
    piece.skeleton_points = {0, 1, 2 + s};
    piece.mesh = {{points[0], points[1], points[2 + s]}, {{0, 1, 2}}, {s}};
    return piece;
  };
  check_second_order(testing::with_bent_edges(sheets), {0, 1, 2}, 3);
  const auto ranks = all_ranks(sheets, {0, 1, 2}, 3, true);
  CHECK(faults_of(ranks) == "");
  for (const auto& rank : ranks) {
    REQUIRE(rank.neighbours.size() == 2);
    CHECK(rank.neighbours[0].edges.size() == 1);
    CHECK(rank.mesh.elements.size() == 3);
    CHECK(rank.sides.size() == 3);
  }
}

TEST_CASE("arrays as solvers take them") {
  const auto mesh = testing::stacked_cubes{.cells = 2, .cuts = 2}.distributed();
  const auto ranks = all_ranks(mesh, {0, 0, 1, 1, 0, 0, 1, 1}, 2, true);
  std::vector<double> coordinates; // of all ranks, one behind the other: at place id
  for (const auto& rank : ranks)
    append(coordinates, owned_coordinates(rank));
  REQUIRE(coordinates.size() == 3 * 27);
  const auto volume = [&](const std::vector<global_id>& cells, std::size_t first) {
    const auto at = [&](std::size_t k) {
      const auto v = static_cast<std::size_t>(cells[first + k]);
      return vec3{coordinates[3 * v], coordinates[3 * v + 1], coordinates[3 * v + 2]};
    };
    return dot(cross(at(1) - at(0), at(2) - at(0)), at(3) - at(0)) / 6;
  };
  for (const auto& rank : ranks) {
    const auto cells = cells_by_ids(rank);
    const auto turned = cells_for_dmplex(rank);
    REQUIRE(cells.size() == 4 * rank.owned_elements);
    for (std::size_t first = 0; first < cells.size(); first += 4) {
      CHECK(volume(cells, first) == doctest::Approx(1.0 / 48));
      CHECK(volume(turned, first) == doctest::Approx(-1.0 / 48));
    }
    const auto sides = sides_by_ids(rank);
    REQUIRE(sides.size() == 3 * rank.side_hosts.size());
    bool on_cube = true; // all vertices of a side in one of its planes
    for (std::size_t first = 0; first < sides.size(); first += 3) {
      bool in_plane = false;
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (const double plane : {0.0, 1.0}) {
          const auto lies = [&](global_id v) {
            return coordinates[3 * static_cast<std::size_t>(v) + axis] == plane;
          };
          in_plane = in_plane || (lies(sides[first]) && lies(sides[first + 1]) && lies(sides[first + 2]));
        }
      on_cube = on_cube && in_plane;
    }
    CHECK(on_cube);
  }
  const auto quadratic = all_ranks(testing::with_bent_edges(mesh), {0, 0, 1, 1, 0, 0, 1, 1}, 2, false);
  coordinates.clear();
  for (const auto& rank : quadratic)
    append(coordinates, owned_coordinates(rank));
  REQUIRE(coordinates.size() ==
          3 * (27 + 98)); // a lattice of 2 x 2 x 2 cells has as many edges, with diagonals
  for (const auto& rank : quadratic) {
    const auto cells = cells_by_ids(rank);
    REQUIRE(cells.size() == 10 * rank.owned_elements);
    bool bent = true;
    for (std::size_t first = 0; first < cells.size(); first += 10)
      for (std::size_t k = 0; k < 6; ++k) {
        const auto at = [&](std::size_t i) {
          const auto v = static_cast<std::size_t>(cells[first + i]);
          return vec3{coordinates[3 * v], coordinates[3 * v + 1], coordinates[3 * v + 2]};
        };
        const auto [a, b] = numbering::edges<3>[k];
        bent = bent && at(4 + k) == testing::bent_middle(at(static_cast<std::size_t>(a)),
                                                         at(static_cast<std::size_t>(b)));
      }
    CHECK(bent);
    CHECK(sides_by_ids(rank).size() == 3 * rank.sides.size());
    CHECK_THROWS_AS(cells_for_dmplex(rank), usage_error);
    io::mesh_hasher hasher;
    CHECK_THROWS_AS(io::hash_rank_mesh(hasher, rank), usage_error);
  }
}

TEST_CASE("the check of ranks finds what is wrong") {
  const auto mesh = testing::stacked_cubes{.cells = 2, .cuts = 2}.distributed();
  const auto spoilt = [&](const std::function<void(std::vector<rank_mesh<3>>&)>& spoil) {
    auto ranks = all_ranks(mesh, {0, 0, 1, 1, 2, 2, 2, 2}, 3, true);
    spoil(ranks);
    return faults_of(ranks);
  };
  using ranks_of = std::vector<rank_mesh<3>>;
  CHECK(spoilt([](ranks_of&) {}) == "");
  CHECK(spoilt([](ranks_of& r) { ++r[1].vertex_ids[2]; }).find("vertices are not contiguous") !=
        std::string::npos);
  CHECK(spoilt([](ranks_of& r) { r[1].element_ids[3] = 0; }).find("elements are not contiguous") !=
        std::string::npos);
  CHECK(spoilt([](ranks_of& r) {
          r[1].element_numbers[0] = r[0].element_numbers[0];
        }).find("own the same vertex or element") != std::string::npos);
  CHECK(spoilt([](ranks_of& r) {
          r[1].mesh.points[r[1].owned_vertices].x += 1;
        }).find("is not as its owner has it") != std::string::npos);
  CHECK(spoilt([](ranks_of& r) {
          std::swap(r[1].neighbours[0].vertices[0], r[1].neighbours[0].vertices[1]);
        }).find("not in the same order") != std::string::npos);
  CHECK(spoilt([](ranks_of& r) {
          std::swap(r[2].neighbours[0].faces[0][1], r[2].neighbours[0].faces[0][2]);
        }).find("turned against each other") != std::string::npos);
  CHECK(spoilt([](ranks_of& r) {
          r[0].neighbours[0].edges.pop_back();
          r[1].neighbours[0].edges.pop_back();
        }).find("is not all of it") != std::string::npos);
  CHECK(spoilt([](ranks_of& r) { r[0].neighbours.pop_back(); }).find("lists 1") != std::string::npos);
  CHECK(spoilt([](ranks_of& r) {
          r[2].mesh.elements.pop_back();
          r[2].mesh.tags.pop_back();
          r[2].element_ids.pop_back();
          r[2].element_owners.pop_back();
          r[2].element_numbers.pop_back();
          r[2].subdomains.pop_back();
        }).find("its ghosts are not") != std::string::npos);
}

TEST_CASE("the check of ranks finds what is wrong with middles of edges") {
  const auto mesh = testing::with_bent_edges(testing::stacked_cubes{.cells = 2, .cuts = 2}.distributed());
  const auto spoilt = [&](const std::function<void(std::vector<rank_mesh<3>>&)>& spoil) {
    auto ranks = all_ranks(mesh, {0, 0, 1, 1, 2, 2, 2, 2}, 3, true);
    spoil(ranks);
    return faults_of(ranks);
  };
  using ranks_of = std::vector<rank_mesh<3>>;
  const auto found = [&](const std::function<void(ranks_of&)>& spoil, const std::string& what) {
    const auto faults = spoilt(spoil);
    CHECK_MESSAGE(faults.find(what) != std::string::npos, faults);
  };
  const std::string differ = "middle of an edge is not the same";
  CHECK(spoilt([](ranks_of&) {}) == "");
  found([](ranks_of& r) { r[1].middles.pop_back(); }, "lengths");
  found([](ranks_of& r) { r[1].side_middles.pop_back(); }, "lengths");
  found([](ranks_of& r) { r[1].middles[0][0] = 1 << 20; }, "a vertex that is not there");
  found([](ranks_of& r) { std::swap(r[1].middles[0][0], r[1].middles[0][1]); }, differ);
  found([](ranks_of& r) { std::swap(r[1].side_middles[0][0], r[1].side_middles[0][1]); }, differ);
  found([](ranks_of& r) { ++r[0].owned_corners; }, differ);
  found([](ranks_of& r) { --r[0].owned_corners; }, differ);
  found([](ranks_of& r) { std::swap(r[1].middles.back()[0], r[1].middles.back()[1]); },
        "its ghosts are not the elements");
  found([](ranks_of& r) { r[1].mesh.points[r[1].held_vertices - 1].x += 1; }, "is not as its owner has it");
}

TEST_CASE("ranks that do not fit the pieces, and points that no element has, are refused") {
  auto mesh = testing::stacked_cubes{.cells = 2, .cuts = 2}.distributed();
  CHECK_THROWS_AS(io::number_by_ranks(mesh, {0, 1}, 2), usage_error);
  CHECK_THROWS_AS(io::number_by_ranks(mesh, std::vector<local_id>(8, 2), 2), usage_error);
  const std::vector<local_id> one(8, 0);
  auto quadratic = testing::with_bent_edges(mesh);
  auto nodes = *quadratic.mid_nodes;
  ++nodes.inner[3];
  quadratic.mid_nodes = std::make_shared<const mid_edge_nodes<3>>(nodes);
  CHECK_THROWS_WITH_AS(io::make_rank_mesh<3>(quadratic, io::number_by_ranks(quadratic, one, 1), 0),
                       doctest::Contains("subdomain 3: the loaded piece has other inner edges"), mesh_error);
  const auto load = mesh.load;
  mesh.load = [load](local_id p) {
    auto piece = load(p);
    for (auto& element : piece.mesh.elements) // the last point of each piece is left out
      for (auto& v : element)
        v = std::min(v, static_cast<local_id>(piece.mesh.points.size()) - 2);
    return piece;
  };
  CHECK_THROWS_AS(io::make_rank_mesh<3>(mesh, io::number_by_ranks(mesh, one, 1), 0), mesh_error);
}
