/// A distributed mesh as one in memory: the whole mesh again, its sides on CAD entities, rows of neighbours.
#include "files/stacked_cubes.hpp"

#include "dovetail/mesh/point_neighbours.hpp"
#include "dovetail/mesh/validity.hpp"
#include "dovetail/models/plane/svg_path.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "dovetail/solver/gather.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

using namespace dovetail;

namespace {

/// Elements by the coordinates of their points: the same for any numbering of points and elements.
std::vector<std::vector<std::array<double, 3>>> by_coordinates(const simplicial_mesh<3>& mesh) {
  std::vector<std::vector<std::array<double, 3>>> elements;
  for (const auto& element : mesh.elements) {
    auto& corners = elements.emplace_back();
    for (const local_id v : element) {
      const vec3 p = mesh.points[v];
      corners.push_back({p.x, p.y, p.z});
    }
  }
  std::sort(elements.begin(), elements.end());
  return elements;
}

vec3 point(const simplicial_mesh<3>& mesh, local_id v) {
  return mesh.points[v];
}

vec3 centre(const simplicial_mesh<3>& mesh, const simplex<3>& element) {
  vec3 sum{};
  for (const local_id v : element)
    sum += point(mesh, v);
  return sum / 4;
}

/// Positive when the side faces outwards of the element behind it.
double outwardness(const io::gathered_mesh<3>& whole, std::size_t side) {
  const auto& [a, b, c] = whole.sides[side];
  const auto& behind = whole.mesh.elements[whole.side_elements[side][0]];
  const vec3 p = point(whole.mesh, a);
  const vec3 u = point(whole.mesh, b) - p, v = point(whole.mesh, c) - p, w = p - centre(whole.mesh, behind);
  return w.x * (u.y * v.z - u.z * v.y) + w.y * (u.z * v.x - u.x * v.z) + w.z * (u.x * v.y - u.y * v.x);
}

} // namespace

TEST_CASE("gathering gives the whole mesh again, with its materials and subdomains") {
  const testing::stacked_cubes cubes{.cells = 4, .cuts = 2, .solids = 2, .jitter = 0.2};
  const auto whole = cubes.whole();
  const auto gathered = io::gather(cubes.distributed());
  CHECK(gathered.mesh.points.size() == whole.points.size());
  CHECK(by_coordinates(gathered.mesh) == by_coordinates(whole));
  REQUIRE(gathered.mesh.tags.size() == gathered.mesh.elements.size());
  REQUIRE(gathered.subdomains.size() == gathered.mesh.elements.size());
  for (std::size_t e = 0; e < gathered.mesh.elements.size(); ++e) {
    const vec3 at = centre(gathered.mesh, gathered.mesh.elements[e]);
    CHECK(gathered.mesh.tags[e] == (at.z < 0.5 ? 0 : 1));
    CHECK(gathered.subdomains[e] == (at.z < 0.5 ? 0 : 4) + (at.y < 0.5 ? 0 : 2) + (at.x < 0.5 ? 0 : 1));
  }
  CHECK(gathered.material_names.size() == 2);
}

TEST_CASE("sides on CAD faces are there once, between their elements, facing outwards, with their groups") {
  const testing::stacked_cubes cubes{.cells = 4, .cuts = 2, .solids = 2};
  const auto whole = io::gather(cubes.distributed());
  const std::size_t squares = 4 * 4;
  REQUIRE(whole.sides.size() == 2 * squares * 7); // the six faces of the cube, and the one between the solids
  REQUIRE(whole.side_hosts.size() == whole.sides.size());
  std::size_t between_solids = 0;
  std::set<std::string> met;
  for (std::size_t s = 0; s < whole.sides.size(); ++s) {
    CHECK(outwardness(whole, s) > 0);
    const auto [behind, front] = whole.side_elements[s];
    CHECK((front == no_id) == (whole.side_hosts[s] != 1)); // face 1 lies between the solids
    between_solids += front == no_id ? 0 : 1;
    if (front != no_id)
      CHECK(whole.mesh.tags[behind] != whole.mesh.tags[front]);
    for (const local_id v : whole.sides[s]) {
      const double z = point(whole.mesh, v).z;
      if (whole.side_hosts[s] <= 2)
        CHECK(z == doctest::Approx(0.5 * whole.side_hosts[s]));
      const auto& element = whole.mesh.elements[behind];
      CHECK(std::find(element.begin(), element.end(), v) != element.end());
    }
    const auto group = whole.group_of_face.at(whole.side_hosts[s]);
    met.insert(whole.group_names.at(group));
  }
  CHECK(between_solids == 2 * squares);
  CHECK(met == std::set<std::string>{"floor", "cad face 1", "roof", "side walls"});
}

TEST_CASE("a point of the skeleton that no element uses is left out") {
  auto mesh = testing::stacked_cubes{.cells = 2, .cuts = 2}.distributed();
  mesh.skeleton.points.own().insert(mesh.skeleton.points.own().begin(), {9, 9, 9});
  mesh.skeleton.point_hosts.own().insert(mesh.skeleton.point_hosts.own().begin(), host{});
  for (auto& side : mesh.skeleton.sides.own())
    for (auto& v : side)
      ++v;
  for (auto& edge : mesh.skeleton.curve_edges)
    for (auto& v : edge)
      ++v;
  const auto load = mesh.load;
  mesh.load = [load](local_id p) {
    auto piece = load(p);
    for (auto& s : piece.skeleton_points)
      ++s;
    return piece;
  };
  const auto whole = io::gather(mesh);
  CHECK(whole.mesh.points.size() == 27);
  for (const vec3 p : whole.mesh.points)
    CHECK(p.x <= 1);
  CHECK(by_coordinates(whole.mesh) == by_coordinates(testing::stacked_cubes{.cells = 2, .cuts = 2}.whole()));
}

TEST_CASE("a skeleton with a side that no piece has is refused") {
  auto mesh = testing::stacked_cubes{.cells = 2, .cuts = 2}.distributed();
  mesh.skeleton.sides.own().push_back({0, 1, static_cast<local_id>(mesh.skeleton.points.size()) - 1});
  mesh.skeleton.subdomains.own().push_back({0, no_id});
  mesh.skeleton.side_hosts.own().push_back(0);
  CHECK_THROWS_AS(io::gather(mesh), mesh_error);
}

TEST_CASE("triangles: a generated plane domain in one piece, its boundary edges on CAD curves") {
  const plane_domain domain(drawing_from_svg_path("M0 0 H3 V2 H0 Z M1 1 h0.5 v0.5 h-0.5 Z"));
  const auto result = generate<2>(domain, uniform_size(0.1), parameters<>{}.with_options({.subdomains = 5}));
  REQUIRE(result.mesh.counts.size() == 5);
  const auto whole = io::gather(result.mesh);
  CHECK(static_cast<global_id>(whole.mesh.elements.size()) == result.quality.elements);
  CHECK(check_validity(whole.mesh, {.closed_boundary = false}).text().empty());
  const auto sides = build_sides(whole.mesh);
  std::size_t boundary = 0;
  for (std::size_t s = 0; s < sides.size(); ++s)
    boundary += sides.is_boundary(static_cast<local_id>(s)) ? 1 : 0;
  CHECK(whole.sides.size() == boundary);
  double length = 0;
  for (std::size_t s = 0; s < whole.sides.size(); ++s) {
    CHECK(whole.side_elements[s][1] == no_id);
    CHECK(whole.side_hosts[s] >= 0);
    const auto [from, to] = whole.sides[s];
    length += norm(whole.mesh.points[to] - whole.mesh.points[from]);
  }
  CHECK(length == doctest::Approx(2 * (3 + 2) + 4 * 0.5));
  CHECK(whole.group_of_face.size() == 1);
}

TEST_CASE("triangles: an edge where three sheets meet is there once, with its first two triangles") {
  distributed_simplicial_mesh<2> mesh;
  mesh.skeleton.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  mesh.skeleton.point_hosts.own().resize(5);
  for (local_id s = 0; s < 3; ++s) {
    mesh.skeleton.sides.own().push_back({0, 1}); // once per triangle
    mesh.skeleton.subdomains.own().push_back({s, no_id});
    mesh.skeleton.side_hosts.own().push_back(6);
    for (const simplex<1>& outer : {simplex<1>{1, 2 + s}, simplex<1>{2 + s, 0}}) {
      mesh.skeleton.sides.own().push_back(outer);
      mesh.skeleton.subdomains.own().push_back({s, no_id});
      mesh.skeleton.side_hosts.own().push_back(no_id);
    }
    mesh.counts.push_back({0, 0, 1});
  }
  mesh.load = [](local_id s) {
    simplicial_piece<2> piece;
    piece.subdomain = s;
    piece.skeleton_points = {0, 1, 2 + s};
    piece.mesh = {{{0, 0, 0}, {1, 0, 0}, {0, s == 0 ? 1.0 : -1.0, 0}}, {{0, 1, 2}}, {s}};
    return piece;
  };
  const auto whole = io::gather(mesh);
  CHECK(whole.sides == std::vector<simplex<1>>{{0, 1}});
  CHECK(whole.side_hosts == std::vector<local_id>{6});
  CHECK(whole.side_elements == std::vector<std::array<local_id, 2>>{{0, 1}});
  CHECK(whole.group_names == std::vector<std::string>{"face 0", "face 1", "face 2"});
}

TEST_CASE("rows of neighbours: points that share an element, and no others") {
  const auto mesh = testing::stacked_cubes{.cells = 2}.whole();
  const auto rows = point_neighbours(mesh);
  REQUIRE(rows.size() == mesh.points.size());
  std::set<std::array<local_id, 2>> pairs;
  for (const auto& element : mesh.elements)
    for (const local_id v : element)
      for (const local_id w : element)
        pairs.insert({v, w});
  CHECK(rows.items.size() == pairs.size());
  for (std::size_t p = 0; p < rows.size(); ++p) {
    CHECK(std::is_sorted(rows[p].begin(), rows[p].end()));
    for (const local_id q : rows[p])
      CHECK(pairs.count({static_cast<local_id>(p), q}) == 1);
  }
}
