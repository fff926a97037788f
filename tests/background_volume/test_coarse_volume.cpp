#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/background/coarse_volume.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/mesh/validity.hpp"
#include "dovetail/mesher/boundary_sides.hpp"
#include "dovetail/parallel/serial.hpp"
#include "mesher/shapes.hpp"
#include "support/refusal.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace dovetail;

namespace {

const any_sizing quarter = [](vec3) { return 0.25; };

struct model {
  surface_mesh surface;
  geometry_topology topology;

  /// Adds triangles as one CAD face with the given solids behind and in front.
  void add_face(const shapes::surface& s, local_id behind, local_id in_front) {
    std::map<std::array<double, 3>, local_id> known;
    for (std::size_t v = 0; v < surface.mesh.points.size(); ++v)
      known[{surface.mesh.points[v].x, surface.mesh.points[v].y, surface.mesh.points[v].z}] =
          static_cast<local_id>(v);
    const auto shared = [&](local_id v) {
      const vec3 p = s.points[v];
      const auto [it, is_new] =
          known.try_emplace({p.x, p.y, p.z}, static_cast<local_id>(surface.mesh.points.size()));
      if (is_new)
        surface.mesh.points.push_back(p);
      return it->second;
    };
    for (const auto& t : s.elements) {
      surface.mesh.elements.push_back({shared(t[0]), shared(t[1]), shared(t[2])});
      surface.mesh.tags.push_back(static_cast<local_id>(topology.faces.size()));
    }
    geometry_topology::face face;
    face.solids = {behind, in_front};
    face.name = "face " + std::to_string(topology.faces.size());
    topology.faces.push_back(face);
    topology.solids.resize(
        std::max(topology.solids.size(), static_cast<std::size_t>(std::max(behind, in_front) + 1)));
  }
};

double volume_of_tag(const simplicial_mesh<3>& mesh, local_id tag) {
  double sum = 0;
  const auto at = [&](local_id v) { return mesh.points[v]; };
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (mesh.tags[e] == tag) {
      const auto& [a, b, c, d] = mesh.elements[e];
      sum += signed_volume(at(a), at(b), at(c), at(d));
    }
  return sum;
}

/// A cube with a spherical core of another material, in which there is a void.
model core_with_a_void() {
  model m;
  m.add_face(shapes::cube(4, 2, {-1, -1, -1}), 0, no_id);
  m.add_face(shapes::sphere(2, 0.7), 1, 0); // the core behind, the cube in front
  shapes::surface inwards;
  shapes::append(inwards, shapes::sphere(1, 0.4), true);
  m.add_face(inwards, 1, no_id);
  return m;
}

void check_core(const model& m, const background::coarse_volume_result& result) {
  CHECK(check_validity(result.mesh).valid());
  REQUIRE(result.mesh.points.size() >= m.surface.mesh.points.size());
  CHECK(std::equal(m.surface.mesh.points.begin(), m.surface.mesh.points.end(), result.mesh.points.begin()));
  const auto outer = shapes::sphere(2, 0.7);
  const auto inner = shapes::sphere(1, 0.4);
  const double ball = enclosed_volume(outer.points, outer.elements);
  const double hollow = enclosed_volume(inner.points, inner.elements);
  CHECK(volume_of_tag(result.mesh, 0) == doctest::Approx(8 - ball));
  CHECK(volume_of_tag(result.mesh, 1) == doctest::Approx(ball - hollow));
  // Every triangle of the surface is a side of the mesh, between the right solids.
  const auto sides = build_sides(result.mesh);
  std::map<simplex<2>, std::array<local_id, 2>> tags;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto tag = [&](local_id e) { return e == no_id ? no_id : result.mesh.tags[e]; };
    auto pair = std::array{tag(sides.elements[s][0]), tag(sides.elements[s][1])};
    std::sort(pair.begin(), pair.end());
    tags[sorted_vertices(sides.vertices[s])] = pair;
  }
  for (std::size_t t = 0; t < m.surface.mesh.elements.size(); ++t) {
    auto expected = m.topology.faces[m.surface.mesh.tags[t]].solids;
    std::sort(expected.begin(), expected.end());
    const auto found = tags.find(sorted_vertices(m.surface.mesh.elements[t]));
    REQUIRE(found != tags.end());
    CHECK(found->second == expected);
  }
}

/// TetGen, but only for boundaries of one solid.
struct one_solid_mesher {
  static constexpr mesher_traits traits = mesher::tetgen::traits;
  mesher_result<3> operator()(const mesher_input<3>& in, const any_sizing& size) const {
    const boundary_sides sides(in.boundary.elements);
    if (sides.entries().size() != in.boundary.elements.size())
      std::abort();
    return mesher::tetgen{}(in, size);
  }
};

} // namespace

TEST_CASE("Solids with a shared face and a void are filled and labelled") {
  const model m = core_with_a_void();
  const auto result = background::coarse_volume(m.surface, m.topology, quarter, mesher::tetgen{},
                                                no_improver{}, parallel::serial{});
  CHECK(result.summary.get("one_by_one") == 0);
  check_core(m, result);
}

TEST_CASE("The improver works inside the boundary and the material faces") {
  const model m = core_with_a_void();
  const auto raw = background::coarse_volume(m.surface, m.topology, quarter, mesher::tetgen{}, no_improver{},
                                             parallel::serial{});
  const auto improved = background::coarse_volume(m.surface, m.topology, quarter, mesher::tetgen{},
                                                  native_improver{}, parallel::processes{2});
  check_core(m, improved);
  CHECK(improved.quality.min_dihedral_deg >= raw.quality.min_dihedral_deg);
  CHECK(improved.quality.min_dihedrals.below(24) < raw.quality.min_dihedrals.below(24));
}

TEST_CASE("Solids that cannot be meshed together are meshed one by one, crashes survived") {
  const model m = core_with_a_void();
  const auto result = background::coarse_volume(m.surface, m.topology, quarter, one_solid_mesher{},
                                                no_improver{}, parallel::processes{2});
  CHECK(result.summary.get("one_by_one") == 1);
  check_core(m, result);
}

TEST_CASE("Separate solids are all filled") {
  model m;
  m.add_face(shapes::cube(2), 0, no_id);
  m.add_face(shapes::cube(3, 1, {5, 0, 0}), 1, no_id);
  const auto result = background::coarse_volume(m.surface, m.topology, quarter, mesher::tetgen{},
                                                no_improver{}, parallel::serial{});
  CHECK(volume_of_tag(result.mesh, 0) == doctest::Approx(1));
  CHECK(volume_of_tag(result.mesh, 1) == doctest::Approx(1));
}

TEST_CASE("What bounds no solid, or is open, or crosses itself, is named") {
  const auto message = [](const model& m) {
    return testing::refusal_of<error>([&] {
      return background::coarse_volume(m.surface, m.topology, quarter, mesher::tetgen{}, no_improver{},
                                       parallel::processes{1});
    });
  };
  model sheet;
  sheet.add_face(shapes::cube(2), 0, no_id);
  sheet.add_face(shapes::cube(2, 1, {3, 0, 0}), no_id, no_id);
  CHECK(message(sheet) == "face 1 (face 1) bounds no solid; remove it from the model");

  model open;
  open.add_face(shapes::cube(2), 0, no_id);
  open.surface.mesh.elements.pop_back();
  open.surface.mesh.tags.pop_back();
  CHECK(message(open).find("open at an edge of face 0") != std::string::npos);

  model crossing;
  crossing.add_face(shapes::cube(2), 0, no_id);
  crossing.add_face(shapes::cube(2, 1, {0.9, 0.1, 0.1}), 0, no_id);
  CHECK(message(crossing).find("solid 0") != std::string::npos);

  model nothing = open;
  nothing.topology.solids.clear();
  CHECK(message(nothing).find("no solid") != std::string::npos);
}
