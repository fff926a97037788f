#include "dovetail/core/encoding.hpp"
#include "dovetail/mesh/poor_elements.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/mesh/skeleton_index.hpp"
#include "files/distribute.hpp"
#include "support/jittered_meshes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

using namespace dovetail;

namespace {

const auto on_the_surface = [](const auto&) { return host{2, 0}; };

template <class HostOf>
poor_elements all_poor(const simplicial_mesh<3>& mesh, const std::vector<local_id>& parts,
                       const HostOf& host_of) {
  auto tagged = mesh;
  tagged.tags.assign(mesh.elements.size(), 0);
  const auto cut = testing::distribute(tagged, parts, host_of);
  const io::sides_by_subdomain<3> sides(cut);
  poor_elements found;
  for (std::size_t p = 0; p < cut.counts.size(); ++p) {
    const auto s = static_cast<local_id>(p);
    found.merge(find_poor_elements(cut.load(s), cut.skeleton, sides[s]));
  }
  const auto sum = [](const auto& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
  };
  const auto quality = measure_quality(mesh);
  CHECK(sum(found.low) == quality.min_dihedrals.below(low_dihedral_deg));
  CHECK(sum(found.bad) == quality.min_dihedrals.below(bad_dihedral_deg));
  return found;
}
poor_elements all_poor(const simplicial_mesh<3>& mesh) {
  return all_poor(mesh, std::vector<local_id>(mesh.elements.size(), 0), on_the_surface);
}

/// A tetrahedron of two right triangles that meet in an angle whose tangent is `height`.
simplicial_mesh<3> wedge(double height) {
  simplicial_mesh<3> mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 1, height}};
  mesh.elements = {{0, 1, 2, 3}};
  return mesh;
}

/// The lowest layer of a cube of 5 x 5 x 5 cells, each of six tetrahedra.
simplicial_mesh<3> slab(double thickness) {
  auto mesh = dovetail_test::jittered_cubes(5, 0);
  std::erase_if(mesh.elements, [&](const simplex<3>& element) {
    return std::any_of(element.begin(), element.end(), [&](local_id v) { return mesh.points[v].z > 0.3; });
  });
  for (vec3& p : mesh.points)
    p.z *= 5 * thickness;
  return mesh;
}

/// The slab, as thick as `thickness` says, at points where that is 0 too.
template <class Thickness>
simplicial_mesh<3> thinned(const Thickness& thickness) {
  auto mesh = slab(1);
  std::vector<local_id> kept(mesh.points.size());
  for (std::size_t v = 0; v < kept.size(); ++v) {
    vec3& p = mesh.points[v];
    p.z *= thickness(p);
    const auto same = std::find_if(mesh.points.begin(), mesh.points.begin() + static_cast<long>(v),
                                   [&](vec3 q) { return distance(p, q) < 1e-9; });
    kept[v] = static_cast<local_id>(same - mesh.points.begin());
  }
  for (simplex<3>& element : mesh.elements)
    for (local_id& v : element)
      v = kept[v];
  std::erase_if(mesh.elements, [](simplex<3> element) {
    std::sort(element.begin(), element.end());
    return std::adjacent_find(element.begin(), element.end()) != element.end();
  });
  return mesh;
}

/// From an edge at x = 0 on.
simplicial_mesh<3> blade() {
  return thinned([](vec3 p) { return 0.05 * p.x; });
}

/// Each element divided by a vertex in its middle; the first of its parts takes its place.
simplicial_mesh<3> with_middles(simplicial_mesh<3> mesh) {
  for (std::size_t e = 0, n = mesh.elements.size(); e < n; ++e) {
    const simplex<3> whole = mesh.elements[e];
    const auto middle = static_cast<local_id>(mesh.points.size());
    const auto p = corners(std::span<const vec3>(mesh.points), whole);
    mesh.points.push_back(0.25 * (p[0] + p[1] + p[2] + p[3]));
    for (std::size_t k = 0; k < 4; ++k) {
      simplex<3> part = whole;
      part[k] = middle;
      if (k == 0)
        mesh.elements[e] = part;
      else
        mesh.elements.push_back(part);
    }
  }
  return mesh;
}

/// With boundary triangles on the faces that `face_of` says.
template <class Face>
poor_elements by_faces(const simplicial_mesh<3>& mesh, const Face& face_of) {
  return all_poor(mesh, std::vector<local_id>(mesh.elements.size(), 0), [&](const auto& vertices) {
    return host{2, static_cast<local_id>(face_of(vertices))};
  });
}

enum face_of_blade { above, below, left, right, end };

/// Whether a condition holds at all of the vertices.
template <class Holds>
bool all_at(const simplicial_mesh<3>& mesh, std::span<const local_id> vertices, const Holds& holds) {
  return std::all_of(vertices.begin(), vertices.end(), [&](local_id v) { return holds(mesh.points[v]); });
}

/// Of a blade or slab, by place.
face_of_blade face_at(const simplicial_mesh<3>& mesh, std::span<const local_id> vertices) {
  return all_at(mesh, vertices, [](vec3 p) { return p.z < 1e-9; })       ? below
         : all_at(mesh, vertices, [](vec3 p) { return p.y < 1e-9; })     ? left
         : all_at(mesh, vertices, [](vec3 p) { return p.y > 1 - 1e-9; }) ? right
         : all_at(mesh, vertices, [](vec3 p) { return p.x > 1 - 1e-9; }) ? end
                                                                         : above;
}

} // namespace

TEST_CASE("an element in a small angle of the model is the model's") {
  const auto found = all_poor(wedge(0.1));
  CHECK(found.bad_by(poor_cause::model_angle) == 1);
  CHECK(all_poor(wedge(0.3)).low_by(poor_cause::model_angle) == 1); // 17 degrees
  CHECK(all_poor(wedge(0.3)).bad_by(poor_cause::model_angle) == 0);
}

TEST_CASE("an element between an interface and the surface is the interface's") {
  auto mesh = wedge(0.1);
  mesh.points.push_back({0.5, -1, 1}); // above the upper side
  mesh.elements.push_back({0, 1, 3, 4});
  const auto host_of = [](const auto& vertices) {
    const bool between = vertices.size() == 3 && std::all_of(vertices.begin(), vertices.end(),
                                                             [](local_id v) { return v != 2 && v != 4; });
    return between ? host{3, 0} : host{2, 0};
  };
  const auto found = all_poor(mesh, {0, 1}, host_of);
  CHECK(found.bad_by(poor_cause::interface_angle) == 1);
  CHECK(found.bad_by(poor_cause::model_angle) == 0);
}

TEST_CASE("elements across a thin wall are the wall's, and where it is thinnest is told") {
  const auto found = all_poor(slab(0.01));
  CHECK(found.bad_by(poor_cause::thin_wall) > 0);
  CHECK(found.bad_by(poor_cause::boundary_triangle) > 0); // at the rim
  CHECK(found.bad_by(poor_cause::inside) == 0);
  CHECK(found.thinnest_wall <= 0.01);
  CHECK(found.thinnest_wall > 0.005);
  CHECK(found.thinnest_place.z < 0.01);

  const auto between_interfaces =
      all_poor(slab(0.01), std::vector<local_id>(slab(0.01).elements.size(), 0), [](const auto& vertices) {
        return vertices.size() == 1 ? host{3, 0} : host{2, 0};
      });
  CHECK(between_interfaces.bad_by(poor_cause::thin_piece) == found.bad_by(poor_cause::thin_wall));
  CHECK(all_poor(slab(0.2)).bad_by(poor_cause::thin_wall) == 0);

  // Two faces that meet at right angles around it do not make it an angle.
  const auto sheet = slab(0.01);
  const auto of_two_faces =
      all_poor(sheet, std::vector<local_id>(sheet.elements.size(), 0), [&](const auto& vertices) {
        const bool below = std::all_of(vertices.begin(), vertices.end(),
                                       [&](local_id v) { return sheet.points[v].z < 1e-9; });
        return host{2, below ? 1 : 0};
      });
  CHECK(of_two_faces.bad_by(poor_cause::thin_wall) == found.bad_by(poor_cause::thin_wall));
}

TEST_CASE("where two faces run into each other elements between them are in an angle of the model") {
  const auto mesh = blade();
  const auto below = [&](const auto& vertices) {
    return std::all_of(vertices.begin(), vertices.end(), [&](local_id v) { return mesh.points[v].z < 1e-9; });
  };
  const auto of_one = by_faces(mesh, [](const auto&) { return 0; });
  const auto of_two = by_faces(mesh, [&](const auto& vertices) { return below(vertices) ? 1 : 0; });
  CHECK(of_two.bad_by(poor_cause::thin_wall) == 0);
  CHECK(of_two.bad_by(poor_cause::model_angle) > of_one.bad_by(poor_cause::model_angle));
  CHECK(of_one.bad_by(poor_cause::thin_wall) > 0);

  // A vertex between them, and none beside it, changes nothing.
  const auto split = with_middles(mesh);
  const auto split_of_one = by_faces(split, [](const auto&) { return 0; });
  const auto split_of_two = by_faces(split, [&](const auto& vertices) { return below(vertices) ? 1 : 0; });
  CHECK(split_of_one.bad_by(poor_cause::thin_wall) > of_one.bad_by(poor_cause::thin_wall));
  CHECK(split_of_one.bad_by(poor_cause::inside) == 0);
  CHECK(std::isinf(split_of_one.thinnest_wall)); // no element goes from one side to the other
  CHECK(split_of_two.bad_by(poor_cause::thin_wall) == 0);
  CHECK(split_of_two.bad_by(poor_cause::inside) == 0);
}

TEST_CASE("where two faces touch at a point elements between them are in an angle of the model") {
  const auto mesh = thinned([](vec3 p) { return 0.05 * std::hypot(p.x - 0.4, p.y - 0.4); });
  const auto of_one = by_faces(mesh, [](const auto&) { return 0; });
  const auto of_two = by_faces(mesh, [&](const auto& t) { return face_at(mesh, t) == below ? 1 : 0; });
  CHECK(of_one.bad_by(poor_cause::thin_wall) > 0);
  CHECK(of_two.bad_by(poor_cause::thin_wall) == 0);
  CHECK(of_two.bad_by(poor_cause::model_angle) > of_one.bad_by(poor_cause::model_angle));

  // Corners of the lower face in the plane of another one touch nothing.
  const auto sheet = slab(0.01);
  const auto in_quarters = by_faces(sheet, [&](const auto& t) {
    const auto in = [&](bool first_x, bool first_y) {
      return all_at(sheet, t, [&](vec3 p) {
        return (first_x ? p.x < 0.41 : p.x > 0.39) && (first_y ? p.y < 0.41 : p.y > 0.39);
      });
    };
    return face_at(sheet, t) != below ? 0 : in(true, true) ? 1 : in(false, false) ? 2 : 3;
  });
  const auto as_one = by_faces(sheet, [](const auto&) { return 0; }).bad_by(poor_cause::thin_wall);
  REQUIRE(as_one > 0);
  CHECK(in_quarters.bad_by(poor_cause::thin_wall) == as_one);
}

TEST_CASE("the vertices that an interface has in a wedge are in it, and those in a wall are in no wall") {
  const auto whole = blade();
  const auto first_between = static_cast<local_id>(whole.points.size());
  const auto mesh = with_middles(whole);
  std::vector<local_id> parts(mesh.elements.size(), 1); // a quarter of each element is in the other piece
  std::fill(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(whole.elements.size()), local_id{0});
  const auto by_face_below = [&](local_id face) {
    return all_poor(mesh, parts, [&](const auto& vertices) {
      const bool between =
          std::any_of(vertices.begin(), vertices.end(), [&](local_id v) { return v >= first_between; });
      return between ? host{3, 0} : host{2, face_at(mesh, vertices) == below ? face : 0};
    });
  };
  const auto of_one = by_face_below(0), of_two = by_face_below(1);
  CHECK(of_one.bad_by(poor_cause::thin_wall) == 0);
  CHECK(std::isinf(of_one.thinnest_wall));
  CHECK(of_one.bad_by(poor_cause::thin_piece) > 0);
  CHECK(of_two.bad_by(poor_cause::thin_piece) == 0);
  CHECK(of_two.bad_by(poor_cause::model_angle) > of_one.bad_by(poor_cause::model_angle));
}

TEST_CASE("narrow triangles where two curves of a face run into each other are in an angle of the model") {
  const auto mesh = blade();
  const auto triangles_by = [&](const auto& face_of) {
    return by_faces(mesh, face_of).bad_by(poor_cause::boundary_triangle);
  };
  CHECK(triangles_by([&](const auto& t) { return face_at(mesh, t) == below ? 1 : 0; }) > 0);
  CHECK(triangles_by([&](const auto& t) { return face_at(mesh, t); }) == 0);
  // Beside both curves is the same face: a groove that ends in a point.
  CHECK(triangles_by([&](const auto& t) { return face_at(mesh, t) == above ? below : face_at(mesh, t); }) ==
        0);
  // Of the upper curve only the first half runs into the lower one.
  CHECK(triangles_by([&](const auto& t) {
          const bool in_first_half = all_at(mesh, t, [](vec3 p) { return p.x < 0.5; });
          return face_at(mesh, t) == above && in_first_half ? 9 : face_at(mesh, t);
        }) > 0);
  // Without a face at one of the sides there are two curves no more.
  CHECK(triangles_by([&](const auto& t) { return face_at(mesh, t) == left ? above : face_at(mesh, t); }) > 0);

  // Corners of a sheet explain nothing.
  const auto sheet = slab(0.01);
  CHECK(by_faces(sheet, [&](const auto& t) {
          return face_at(sheet, t);
        }).bad_by(poor_cause::boundary_triangle) == by_faces(sheet, [](const auto&) {
                                                      return 0;
                                                    }).bad_by(poor_cause::boundary_triangle));
}

TEST_CASE("curves that run into each other are known by their numbers, too, whatever is beyond them") {
  const auto mesh = blade();
  const auto poor_by = [&](bool are_named, const auto& face_of) {
    return all_poor(mesh, std::vector<local_id>(mesh.elements.size(), 0), [&](const auto& vertices) {
      if (vertices.size() > 1)
        return host{2, static_cast<local_id>(face_of(vertices))};
      const vec3 p = mesh.points[vertices[0]];
      if (!are_named || p.y > 1e-9)
        return host{2, 0};
      return p.x < 1e-9 || p.x > 1 - 1e-9 ? host{0, 0} : host{1, p.z < 1e-9 ? 7 : 8};
    });
  };
  // Of the upper curve only the first half is at the same face as where it runs into the lower one.
  const auto in_halves = [&](const auto& t) {
    const bool in_first_half = all_at(mesh, t, [](vec3 p) { return p.x < 0.5; });
    return face_at(mesh, t) == above && in_first_half ? 9 : static_cast<int>(face_at(mesh, t));
  };
  const auto triangles_at_left = [&](bool are_named) {
    return poor_by(are_named, in_halves).bad_by(poor_cause::boundary_triangle);
  };
  CHECK(triangles_at_left(true) < triangles_at_left(false));

  // Elements that go across a corner are in it though no side of theirs is poor, and no wedge is known.
  const auto one_beside = [&](const auto& t) { return face_at(mesh, t) == left ? 1 : 0; };
  const auto named = poor_by(true, one_beside), unnamed = poor_by(false, one_beside);
  CHECK(named.bad_by(poor_cause::thin_wall) < unnamed.bad_by(poor_cause::thin_wall));
  CHECK(named.bad_by(poor_cause::thin_wall) > 0); // those at the other curves
}

TEST_CASE("what is in an angle of the model is not the interface's") {
  const auto mesh = blade();
  std::vector<local_id> parts(mesh.elements.size());
  for (std::size_t e = 0; e < parts.size(); ++e)
    parts[e] = static_cast<local_id>(e % 2);
  const auto poor = [&](bool are_two_faces) {
    return all_poor(mesh, parts, [&](const auto& vertices) {
      const bool between = vertices.size() == 3 && face_at(mesh, vertices) == above &&
                           !all_at(mesh, vertices, [](vec3 p) { return p.z > 0.05 * p.x - 1e-9; });
      return between ? host{3, 0} : host{2, are_two_faces && face_at(mesh, vertices) == below ? 1 : 0};
    });
  };
  const auto of_one = poor(false), of_two = poor(true);
  REQUIRE(of_one.low_by(poor_cause::interface_angle) > 0);
  CHECK(of_two.low_by(poor_cause::interface_angle) < of_one.low_by(poor_cause::interface_angle));
  CHECK(of_two.low_by(poor_cause::model_angle) > of_one.low_by(poor_cause::model_angle));
}

TEST_CASE("an element that nothing explains is the mesher's") {
  auto mesh = dovetail_test::jittered_cubes(4, 0);
  mesh.points[(2 * 5 + 2) * 5 + 2].x += 0.21; // of cells a quarter wide
  const auto found = all_poor(mesh);
  CHECK(found.bad_by(poor_cause::inside) > 0);
  CHECK(found.low_by(poor_cause::inside) == measure_quality(mesh).min_dihedrals.below(low_dihedral_deg));
}

TEST_CASE("counts of pieces add up in any order, and pass between processes") {
  const auto a = all_poor(slab(0.01)), b = all_poor(slab(0.02)), c = all_poor(wedge(0.1));
  poor_elements forwards, backwards;
  for (const auto& one : {a, b, c})
    forwards.merge(one);
  for (const auto& one : {c, b, a})
    backwards.merge(one);
  CHECK(encoded(forwards) == encoded(backwards));
  CHECK(forwards.thinnest_wall == a.thinnest_wall);
  CHECK(encoded(decoded<poor_elements>(encoded(forwards))) == encoded(forwards));
  CHECK(name_of(poor_cause::thin_wall) == "thin wall");
}
