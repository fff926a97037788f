#include "improvable_mesh.hpp"

#include "dovetail/files/read_mesh.hpp"
#include "dovetail/files/write_msh.hpp"
#include "dovetail/files/write_vtu.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/quality.hpp"
#include "files/scratch_folder.hpp"
#include "files/stacked_cubes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

using namespace dovetail;
using namespace dovetail::app;

namespace {

using place = std::tuple<double, double, double>;
place place_of(const io::loaded_mesh& mesh, local_id v) {
  const vec3 p = mesh.mesh.points[v];
  return {p.x, p.y, p.z};
}

/// Two regions, four subdomains across them, and 37 groups of triangles on the boundary, between the regions
/// and here and there inside.
io::loaded_mesh with_everything() {
  constexpr int groups = 37;
  io::loaded_mesh made;
  made.mesh = testing::stacked_cubes{.cells = 6, .cuts = 2, .solids = 2, .jitter = 0.8}.whole();
  const auto& points = made.mesh.points;
  const auto sides = build_sides(made.mesh);
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (const auto [first, second] = sides.elements[s];
        second == no_id || s % 40 == 0 || made.mesh.tags[first] != made.mesh.tags[second]) {
      made.triangles.push_back(sides.vertices[s]);
      made.triangle_tags.push_back(static_cast<local_id>(s % groups));
    }
  for (local_id g = 0; g < groups; ++g)
    made.triangle_names.emplace_back(g, "group " + std::to_string(g));
  made.material_names = {{0, "lower"}, {1, "upper"}};
  for (std::size_t v = 0; v < points.size(); ++v)
    made.node_ids.push_back(1000 - 2 * static_cast<global_id>(v));
  for (const simplex<3>& t : made.mesh.elements) {
    vec3 center{};
    for (const local_id v : t)
      center += points[v] / 4.0;
    made.subdomains.push_back(static_cast<local_id>(center.x > 0.5) +
                              2 * static_cast<local_id>(center.y > 0.5));
  }
  return made;
}

/// Per triangle, by the places of its corners: its tag.
std::map<std::set<place>, local_id> groups_of(const io::loaded_mesh& mesh) {
  std::map<std::set<place>, local_id> found;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::set<place> corners;
    for (const local_id v : mesh.triangles[t])
      corners.insert(place_of(mesh, v));
    found[corners] = mesh.triangle_tags.at(t);
  }
  return found;
}

std::map<std::array<local_id, 2>, double> volumes_of(const io::loaded_mesh& mesh) {
  std::map<std::array<local_id, 2>, double> found;
  const auto& p = mesh.mesh.points;
  for (std::size_t e = 0; e < mesh.mesh.elements.size(); ++e) {
    const auto& [a, b, c, d] = mesh.mesh.elements[e];
    const auto at = [&](local_id v) { return p[v]; };
    found[{mesh.mesh.tags.at(e), mesh.subdomains.at(e)}] +=
        dot(cross(at(b) - at(a), at(c) - at(a)), at(d) - at(a)) / 6;
  }
  return found;
}

/// The numbers of the points of triangles.
std::map<global_id, place> numbers_of(const io::loaded_mesh& mesh) {
  std::map<global_id, place> found;
  for (const auto& triangle : mesh.triangles)
    for (const local_id v : triangle)
      found[mesh.node_ids.at(v)] = place_of(mesh, v);
  return found;
}

void check_kept(const io::loaded_mesh& before, const io::loaded_mesh& after) {
  CHECK(groups_of(after) == groups_of(before));
  std::set<simplex<2>> sides;
  for (const simplex<2>& side : build_sides(after.mesh).vertices)
    sides.insert(sorted_vertices(side));
  CHECK(std::all_of(after.triangles.begin(), after.triangles.end(),
                    [&](const simplex<2>& triangle) { return sides.contains(sorted_vertices(triangle)); }));
  CHECK(numbers_of(after) == numbers_of(before));
  auto names = after.triangle_names;
  std::sort(names.begin(), names.end());
  CHECK(names.size() == 37);
  CHECK(names == before.triangle_names);
  CHECK(after.material_names == before.material_names);
  const auto expected = volumes_of(before), found = volumes_of(after);
  REQUIRE(found.size() == 8);
  for (const auto& [key, volume] : expected)
    CHECK(found.at(key) == doctest::Approx(volume).epsilon(1e-9));
  const std::set<global_id> numbers(after.node_ids.begin(), after.node_ids.end());
  CHECK(numbers.size() == after.mesh.points.size());
}

} // namespace

TEST_CASE(
    "groups, names, subdomains and the numbers of points that stay survive an improvement, in MSH and VTU") {
  const testing::scratch_folder folder("improvable");
  const io::loaded_mesh original = with_everything();
  for (const std::string name : {"a.msh", "a.vtu"}) {
    const auto written = folder / name;
    const auto write = [&](const io::loaded_mesh& mesh) {
      name == "a.msh" ? io::write_msh(mesh, written) : io::write_vtu(mesh, written);
    };
    write(original);
    const io::loaded_mesh read = io::read_mesh(written);
    CHECK(left_out(read) == "the numbers of inner points, which are others now");
    check_kept(original, read);
    improvable_mesh<3> given(read);
    const double worst = measure_quality(given.mesh).min_dihedral_deg;
    improvement::native::fast()(given.mesh, given.frozen, {});
    CHECK(measure_quality(given.mesh).min_dihedral_deg > worst);
    write(std::move(given).put_back());
    check_kept(original, io::read_mesh(written));
  }
}

TEST_CASE("what a file says beyond that is named") {
  io::loaded_mesh mesh = with_everything();
  mesh.node_ids.clear();
  CHECK(left_out(mesh).empty());
  mesh.point_scalars = {{"pressure", std::vector<double>(mesh.mesh.points.size(), 1)}};
  mesh.pass_over("the values 'porosity' of cells");
  mesh.pass_over("the values 'porosity' of cells");
  CHECK(left_out(mesh) ==
        "the values 'pressure' of points, which have moved, the values 'porosity' of cells");
  mesh.node_ids.assign(mesh.mesh.points.size(), 7);
  CHECK(left_out(mesh).starts_with("the numbers of points, which are negative or not unique, "));
  CHECK(improvable_mesh<3>(mesh).put_back().node_ids.empty());
}

TEST_CASE("triangles keep their groups, their names, and the numbers on their boundary") {
  const testing::scratch_folder folder("improvable_triangles");
  io::loaded_mesh mesh;
  for (int i = 0; i < 25; ++i) {
    mesh.mesh.points.push_back({i % 5 + (i == 12 ? 0.3 : 0.0), static_cast<double>(i / 5), 0});
    mesh.node_ids.push_back(100 + i);
  }
  for (local_id i = 0; i < 24; ++i)
    if (i % 5 < 4 && i < 20) {
      mesh.triangles.insert(mesh.triangles.end(), {{i, i + 1, i + 6}, {i, i + 6, i + 5}});
      mesh.triangle_tags.insert(mesh.triangle_tags.end(), 2, i % 5 < 2 ? 3 : 5);
    }
  mesh.triangle_names = {{3, "left"}, {5, "right"}};
  io::write_msh(mesh, folder / "a.msh");
  const io::loaded_mesh read = io::read_mesh(folder / "a.msh");
  improvable_mesh<2> given(read);
  CHECK(given.frozen.points == 19); // sixteen around and three between the groups
  improvement::native::fast()(given.mesh, given.frozen, {});
  const io::loaded_mesh after = std::move(given).put_back();
  io::write_vtu(after, folder / "a.vtu");
  for (const io::loaded_mesh& found : {after, io::read_mesh(folder / "a.vtu")}) {
    CHECK(std::count(found.triangle_tags.begin(), found.triangle_tags.end(), 3) > 0);
    for (std::size_t v = 0; v < 25; ++v)
      if (const vec3 p = mesh.mesh.points[v]; p.x == 0 || p.x == 2 || p.x == 4 || p.y == 0 || p.y == 4) {
        const auto at = std::find(found.node_ids.begin(), found.node_ids.end(), mesh.node_ids[v]);
        REQUIRE(at != found.node_ids.end());
        CHECK(found.mesh.points[at - found.node_ids.begin()] == p);
      }
  }
  CHECK(after.triangle_names == mesh.triangle_names);
}

TEST_CASE("triangles without numbers of points: what the improver removes leaves no gap") {
  io::loaded_mesh mesh; // inner points first: the boundary's, which stay, come behind the gaps
  constexpr int n = 30;
  std::vector<local_id> place;
  for (const bool inner : {true, false})
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j)
        if (((i % n != 0) && (j % n != 0)) == inner) {
          // Rows and columns that nearly meet: most of what is between them goes.
          const auto squeezed = [&](int k) { return inner && k % 2 == 1 ? k - 0.97 : 1.0 * k; };
          mesh.mesh.points.push_back({squeezed(i), squeezed(j), 0});
          place.push_back(static_cast<local_id>(i * (n + 1) + j));
        }
  std::vector<local_id> number(place.size());
  for (std::size_t v = 0; v < place.size(); ++v)
    number[place[v]] = static_cast<local_id>(v);
  const auto at = [&](int i, int j) { return number[i * (n + 1) + j]; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  const std::size_t before = mesh.mesh.points.size();
  improvable_mesh<2> given(mesh);
  improvement::native::finest()(given.mesh, given.frozen, {});
  const io::loaded_mesh after = std::move(given).put_back();
  std::set<local_id> used;
  for (const auto& triangle : after.triangles)
    used.insert(triangle.begin(), triangle.end());
  CHECK(used.size() < before); // some were removed
  CHECK(used.size() == after.mesh.points.size());
}
