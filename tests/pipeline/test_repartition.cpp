#include "dovetail/decomposition/extract_skeleton.hpp"
#include "dovetail/decomposition/skeleton_part.hpp"
#include "dovetail/parallel/kept.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/pipeline/fine_angles.hpp"
#include "dovetail/pipeline/realize.hpp"
#include "dovetail/pipeline/repartition_rounds.hpp"
#include "dovetail/simplification/angles_of_rule.hpp"
#include "dovetail/skeleton/patches.hpp"
#include "pipeline/decomposed_shell.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <utility>
#include <vector>

using namespace dovetail;
using dovetail::testing::decomposed_shell;

namespace {

/// The points of the background mesh within a radius of one.
std::vector<bool> points_near(const decomposed_shell& given, vec3 center, double radius) {
  std::vector<bool> are_near;
  for (const vec3& p : given.background.mesh.points())
    are_near.push_back(distance(p, center) < radius);
  return are_near;
}

/// What of the places has one of some points.
places_of_angles places_at(const places_of_angles& places, const side_table<3>& sides,
                           const std::vector<bool>& points) {
  places_of_angles found;
  std::copy_if(places.begin(), places.end(), std::back_inserter(found), [&](const auto& place) {
    return std::any_of(place.begin(), place.end(), [&](local_id side) {
      const auto& vertices = sides.vertices[side];
      return std::any_of(vertices.begin(), vertices.end(), [&](local_id v) { return points[v]; });
    });
  });
  return found;
}

places_of_angles small_angles(const decomposed_shell& given, const realized<3>& made) {
  return detail::places_of_small_angles(
      made, detail::fine_interface_angles(made, given.background.mesh, given.divided, given.background.size,
                                          wanted_angles_of<3>(given.given.simplify_by), parallel::serial{}));
}

/// A crossing without a place, as of lines.
std::optional<std::vector<vec3>> somewhere_if(bool crosses) {
  return crosses ? std::optional(std::vector<vec3>{}) : std::nullopt;
}

/// As if the same came out for other subdomains.
realized<3> with_subdomains(realized<3> made, const std::vector<local_id>& subdomain_of_element,
                            bool is_part) {
  made.subdomain_of_element = subdomain_of_element;
  made.is_part = is_part;
  return made;
}

} // namespace

TEST_CASE("Interfaces move away from small angles, but not to where something crosses") {
  decomposed_shell given(0.5, 16);
  std::set<kept<patch_mesh>> loops; // of the patches where interfaces stay
  given.given.mesh_surface =
      any_surface_mesher([&loops](const any_surface& s, const patch_boundary& b, const any_sizing& h) {
        loops.insert(kept<patch_mesh>::of(b.points));
        return remesh::patch_remesher{}(s, b, h);
      });
  const auto stays = given.rounds(0.05).realize_boundaries().value();
  CHECK(stays.summary.get("repartitioned") == 0);
  CHECK(stays.summary.get("repartition_seconds") == 0);

  given.want(28);
  given.given.mesh_surface = {};
  auto rounds = given.rounds(0.05);
  const auto goes = rounds.realize_boundaries().value();
  CHECK(goes.summary.get("repartitioned") > 0);
  CHECK(goes.summary.get("repartition_seconds") > 0);
  CHECK(goes.subdomain_of_element != stays.subdomain_of_element);
  const auto small_angles = [](const interface_angles& angles) {
    return angles.violations.size() - angles.count(violation_cause::forced);
  };
  const std::size_t left = small_angles(rounds.take_fine_angles());

  given.given.mesh_surface =
      any_surface_mesher([&loops](const any_surface& s, const patch_boundary& b, const any_sizing& h) {
        patch_mesh mesh = remesh::patch_remesher{}(s, b, h);
        if (!loops.contains(kept<patch_mesh>::of(b.points)))
          mesh.crossings = {{0, 1}};
        return mesh;
      });
  auto refused = given.rounds(0.05);
  const auto back = refused.realize_boundaries().value();
  CHECK(back.summary.get("repartition_rounds") == 1);
  CHECK(back.summary.get("repartitioned") == 0);
  CHECK(back.subdomain_of_element == stays.subdomain_of_element);
  CHECK(back.fine.points == stays.fine.points);
  CHECK(refused.merges().merged() == 0);
  CHECK(left < small_angles(refused.take_fine_angles()));

  given.given.mesh_surface = {};
  given.divided.angles.violations.resize(1); // a rule that lets such interfaces be
  given.divided.angles.violations[0].cause = violation_cause::remeshing;
  CHECK(given.rounds(0.05).realize_boundaries()->subdomain_of_element == stays.subdomain_of_element);
}

TEST_CASE("A place is one, however many edges of its lines have a small angle") {
  decomposed_shell given(0.5, 16);
  given.background.size = uniform_size(0.05);
  given.want(50);
  given.given.options.repartition_locally = false;
  auto rounds = given.rounds(0.05);
  const auto made = rounds.realize_boundaries().value();
  const interface_angles angles = rounds.take_fine_angles();
  const auto places = detail::places_of_small_angles(made, angles);
  const auto& first = made.patches.first_triangle;
  std::set<std::vector<local_id>> expected;
  std::size_t unforced = 0;
  for (const angle_violation& v : angles.violations) {
    if (v.cause == violation_cause::forced)
      continue;
    ++unforced;
    std::set<local_id> sides;
    for (std::size_t f = 0; f < made.coarse.faces.size(); ++f)
      for (const local_id triangle : v.sides) {
        const std::size_t patch = made.coarse.regions.size() + f;
        if (first[patch] <= triangle && triangle < first[patch + 1])
          sides.insert(made.coarse.faces[f].side);
      }
    expected.insert({sides.begin(), sides.end()});
  }
  CHECK(std::vector(expected.begin(), expected.end()) == places);
  CHECK(3 * places.size() < unforced);
}

TEST_CASE("Interfaces move away from 32 places, or one per hundred faces, and not from more") {
  decomposed_shell given(0.5, 16);
  auto rounds = given.rounds(0.05);
  const auto made = rounds.realize_boundaries().value();
  const auto looks_for = [&](std::size_t count, std::size_t faces) {
    repartition_rounds<3> repartition(given.background.mesh, given.divided, true);
    realized<3> start = made;
    start.counts.interface_faces = faces;
    places_of_angles places;
    for (std::size_t f = 0; f < count; ++f)
      places.push_back({made.coarse.faces[f].side});
    auto subdomains = made.subdomain_of_element;
    int looks = 0;
    double seconds = 0;
    repartition.avoid_small_angles(
        std::move(start), subdomains, 16, [&] { return made; },
        [&](const auto&, const auto&) {
          ++looks;
          return made;
        },
        [](const auto&) { return somewhere_if(true); }, [&](const auto&) { return places; }, seconds);
    return looks;
  };
  CHECK(looks_for(32, 100) == 1);
  CHECK(looks_for(33, 100) == 0);
  CHECK(looks_for(33, 3300) == 1);
  CHECK(looks_for(34, 3300) == 0);
}

TEST_CASE("A part of a skeleton is at the points asked for what the whole is") {
  decomposed_shell given(0.5, 16);
  const auto& mesh = given.background.mesh;
  const auto whole = extract_skeleton(mesh, given.sides, given.pieces.part_of_element);
  for (const vec3 center : {vec3{0.75, 0, 0}, vec3{0, -0.9, 0.1}, vec3{0.2, 0.3, -0.6}}) {
    const auto wanted = points_near(given, center, 0.3);
    const auto part = part_at_points(whole, mesh.surface, wanted);
    const auto at_wanted = [&](const auto& vertices) {
      return std::any_of(vertices.begin(), vertices.end(), [&](local_id v) { return wanted[v]; });
    };
    const auto sides_at_wanted = [&](const coarse_skeleton& of) {
      std::set<local_id> sides;
      for (const skeleton_face& face : of.faces)
        if (at_wanted(face.vertices))
          sides.insert(face.side);
      return sides;
    };
    const auto triangles_at_wanted = [&](const coarse_skeleton& of) {
      std::set<std::pair<std::vector<local_id>, std::array<local_id, 2>>> regions;
      for (const skeleton_region& region : of.regions)
        if (std::any_of(region.triangles.begin(), region.triangles.end(),
                        [&](local_id t) { return at_wanted(mesh.surface.mesh.elements[t]); }))
          regions.insert({region.triangles, region.subdomains});
      return regions;
    };
    const auto lines_at_wanted = [&](const coarse_skeleton& of) {
      std::set<std::array<local_id, 2>> lines;
      for (const skeleton_line& line : of.lines)
        if (at_wanted(line.vertices))
          lines.insert(line.vertices);
      return lines;
    };
    CHECK(sides_at_wanted(part) == sides_at_wanted(whole));
    CHECK(triangles_at_wanted(part) == triangles_at_wanted(whole));
    CHECK(lines_at_wanted(part) == lines_at_wanted(whole));
    CHECK(part.faces.size() == sides_at_wanted(whole).size());
    CHECK(part.regions.size() == triangles_at_wanted(whole).size());
    CHECK(2 * part.lines.size() < whole.lines.size());
    for (const skeleton_face& face : part.faces) // what its patches end on
      for (const local_id line : lines_of(face, part.lines))
        CHECK(line != no_id);
  }
}

TEST_CASE("A part has the small angles of the whole at the points inside of it") {
  decomposed_shell given(0.5, 16);
  given.want(50);
  given.given.options.match_segments = false; // which may reach farther
  skeleton_memo store;
  const auto& size = given.background.size;
  const auto& subdomain_of_element = given.pieces.part_of_element;
  const auto subdomains = static_cast<std::size_t>(given.pieces.parts);
  const auto whole = realize<3>(given.model, given.background.mesh, given.divided, subdomain_of_element,
                                subdomains, size, store, given.given);
  const auto of_whole = small_angles(given, whole);
  const std::size_t made = store.patches.meshes.made();
  std::size_t compared = 0;
  for (const vec3 center : {vec3{0.75, 0, 0}, vec3{0, -0.9, 0.1}, vec3{0.2, 0.3, -0.6}}) {
    const auto part =
        realize_part(given.model, given.background.mesh, given.divided, subdomain_of_element, subdomains,
                     size, store, bind_parameters<3>(given.given), points_near(given, center, 0.6));
    CHECK(part.is_part);
    CHECK(2 * part.fine.sides.size() < whole.fine.sides.size());
    const auto inside = points_near(given, center, 0.2);
    const auto expected = places_at(of_whole, given.sides, inside);
    compared += expected.size();
    CHECK(places_at(small_angles(given, part), given.sides, inside) == expected);
  }
  CHECK(compared > 1);
  CHECK(store.patches.meshes.made() == made); // they are those of the whole
}

TEST_CASE("What is better around the changes but not as a whole is taken back") {
  decomposed_shell given(0.5, 16);
  auto rounds = given.rounds(0.05);
  const auto start = rounds.realize_boundaries().value();
  const auto repartitioned = [&](bool crosses_as_a_whole, std::size_t places_then) {
    repartition_rounds<3> repartition(given.background.mesh, given.divided, true);
    auto subdomains = start.subdomain_of_element;
    int wholes = 0, parts = 0;
    double seconds = 0;
    const auto made = repartition.avoid_small_angles(
        start, subdomains, 16,
        [&] {
          ++wholes;
          return with_subdomains(start, subdomains, false);
        },
        [&](const auto& subdomain_of_element, const auto& is_wanted) {
          ++parts;
          CHECK(subdomain_of_element != start.subdomain_of_element);
          CHECK(std::count(is_wanted.begin(), is_wanted.end(), true) > 0);
          return with_subdomains(start, subdomain_of_element, true);
        },
        [&](const realized<3>& of) { return somewhere_if(crosses_as_a_whole && !of.is_part); },
        [&](const realized<3>& of) {
          places_of_angles places;
          const bool is_start = of.subdomain_of_element == start.subdomain_of_element;
          for (std::size_t f = 0; f < (of.is_part ? 0 : is_start ? 2 : places_then); ++f)
            places.push_back({start.coarse.faces[f].side});
          return places;
        },
        seconds);
    CHECK(parts > 0);
    CHECK(made.subdomain_of_element == subdomains);
    const bool is_changed = subdomains != start.subdomain_of_element;
    CHECK((made.counts.repartitioned > 0) == is_changed);
    CHECK(made.counts.repartition_rounds == parts);
    return std::pair(wholes, is_changed);
  };
  CHECK(repartitioned(false, 0) == std::pair(1, true));
  CHECK(repartitioned(false, 2) == std::pair(2, false));
  CHECK(repartitioned(true, 0) == std::pair(2, false));
}

TEST_CASE("A search that ends where something crosses is the last one; its best round stays") {
  decomposed_shell given(0.5, 16);
  auto rounds = given.rounds(0.05);
  const auto start = rounds.realize_boundaries().value();
  const places_of_angles all{{start.coarse.faces[0].side},
                             {start.coarse.faces[start.coarse.faces.size() / 2].side},
                             {start.coarse.faces.back().side}};
  repartition_rounds<3> repartition(given.background.mesh, given.divided, true);
  auto subdomains = start.subdomain_of_element;
  std::vector<std::vector<local_id>> looked_at;
  double seconds = 0;
  const auto made = repartition.avoid_small_angles(
      start, subdomains, 16, [&] { return with_subdomains(start, subdomains, false); },
      [&](const auto& subdomain_of_element, const auto&) {
        looked_at.push_back(subdomain_of_element);
        return with_subdomains(start, subdomain_of_element, true);
      },
      [&](const realized<3>& of) { return somewhere_if(of.is_part && looked_at.size() == 2); },
      [&](const realized<3>& of) {
        // What was moved away from is mended; near it there is another one, so that there is a second round.
        const bool is_start = of.subdomain_of_element == start.subdomain_of_element;
        return is_start ? all : places_of_angles{{start.coarse.faces[1].side}};
      },
      seconds);
  CHECK(looked_at.size() == 2);
  CHECK(subdomains == looked_at[0]);
  CHECK(made.counts.repartition_rounds == 2);
}

TEST_CASE("Where something crosses the place next to it is given up, and the others are gone on with") {
  decomposed_shell given(0.5, 16);
  auto rounds = given.rounds(0.05);
  const auto start = rounds.realize_boundaries().value();
  const auto& faces = start.coarse.faces;
  const auto& points = given.background.mesh.points();
  const vec3 crossing = points[faces[0].vertices[0]];
  std::size_t far_off = 0;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (distance(points[faces[f].vertices[0]], crossing) >
        distance(points[faces[far_off].vertices[0]], crossing))
      far_off = f;
  const places_of_angles both{{faces[0].side}, {faces[far_off].side}};
  const auto is_inside = [&](const std::vector<local_id>& subdomain_of_element, std::size_t place) {
    const auto& [a, b] = given.sides.elements[both[place][0]];
    return subdomain_of_element[a] == subdomain_of_element[b];
  };
  repartition_rounds<3> repartition(given.background.mesh, given.divided, true);
  auto subdomains = start.subdomain_of_element;
  double seconds = 0;
  const auto made = repartition.avoid_small_angles(
      start, subdomains, 16, [&] { return with_subdomains(start, subdomains, false); },
      [&](const auto& subdomain_of_element, const auto&) {
        return with_subdomains(start, subdomain_of_element, true);
      },
      [&](const realized<3>& of) {
        return is_inside(of.subdomain_of_element, 0) ? std::optional(std::vector{crossing}) : std::nullopt;
      },
      [&](const realized<3>& of) {
        places_of_angles places;
        for (std::size_t k = 0; k < both.size(); ++k)
          if (!is_inside(of.subdomain_of_element, k))
            places.push_back(both[k]);
        return places;
      },
      seconds);
  CHECK_FALSE(is_inside(subdomains, 0));
  CHECK(is_inside(subdomains, 1));
  CHECK(made.counts.repartition_rounds == 2);
  CHECK(made.counts.repartitioned > 0);
}

TEST_CASE("Of a part only the places at the changes count, and elsewhere those of before") {
  decomposed_shell given(0.5, 16);
  auto rounds = given.rounds(0.05);
  const auto start = rounds.realize_boundaries().value();
  const std::vector<local_id> avoidable{start.coarse.faces[0].side}, unavoidable;
  const auto wholes_where = [&](bool is_left, bool is_far_off) {
    repartition_rounds<3> repartition(given.background.mesh, given.divided, true);
    auto subdomains = start.subdomain_of_element;
    std::vector<bool> wanted;
    int wholes = 0;
    double seconds = 0;
    repartition.avoid_small_angles(
        start, subdomains, 16,
        [&] {
          ++wholes;
          return with_subdomains(start, subdomains, false);
        },
        [&](const auto& subdomain_of_element, const auto& is_wanted) {
          wanted = is_wanted;
          return with_subdomains(start, subdomain_of_element, true);
        },
        [](const auto&) { return somewhere_if(false); },
        [&](const realized<3>& of) {
          if (!of.is_part)
            return of.subdomain_of_element == start.subdomain_of_element
                       ? places_of_angles{unavoidable, avoidable}
                       : places_of_angles{unavoidable};
          places_of_angles places;
          if (is_left)
            places.push_back(avoidable);
          for (const skeleton_face& face : start.coarse.faces)
            if (is_far_off && std::none_of(face.vertices.begin(), face.vertices.end(),
                                           [&](local_id v) { return wanted[v]; })) {
              places.push_back({face.side});
              break;
            }
          return places;
        },
        seconds);
    return wholes;
  };
  CHECK(wholes_where(false, false) == 1);
  CHECK(wholes_where(false, true) == 1);
  CHECK(wholes_where(true, false) == 0);
}
