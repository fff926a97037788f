#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "files/stacked_cubes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

using namespace dovetail;
using testing::coarse_cubes_in_eight;

namespace {

std::vector<io::seam_fault> seam_kinds(const io::distributed_validity& found) {
  std::vector<io::seam_fault> kinds;
  for (const auto& faults : found.subdomains)
    for (const auto& seam : faults.seams)
      kinds.push_back(seam.kind);
  return kinds;
}

} // namespace

TEST_CASE("a mesh cut into boxes is valid") {
  const auto found = io::check_distributed(coarse_cubes_in_eight.distributed());
  INFO(found.text());
  CHECK(found.valid());
}

TEST_CASE("a sheet inside a subdomain must be an inner side of it") {
  auto mesh = testing::stacked_cubes{.cells = 4, .cuts = 1, .solids = 1}.distributed();
  const auto piece = mesh.load(0);
  const auto& element = piece.mesh.elements[100];
  for (const auto& local : numbering::sides<3>) {
    simplex<2> side;
    for (std::size_t k = 0; k < 3; ++k)
      side[k] = element[local[k]];
    if (std::all_of(side.begin(), side.end(),
                    [&](local_id v) { return static_cast<std::size_t>(v) < piece.skeleton_points.size(); }))
      continue; // on the boundary already
    auto with_sheet = mesh;
    auto changed = piece;
    // The points of the side become skeleton points: moved in front of the piece's inner points.
    std::vector<local_id> place(piece.mesh.points.size(), no_id);
    local_id next = static_cast<local_id>(piece.skeleton_points.size());
    for (local_id v = 0; v < next; ++v)
      place[v] = v;
    simplex<2> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      auto& at = place[side[k]];
      if (at == no_id) {
        at = next++;
        changed.skeleton_points.push_back(static_cast<local_id>(with_sheet.skeleton.points.size()));
        with_sheet.skeleton.points.own().push_back(piece.mesh.points[side[k]]);
        with_sheet.skeleton.point_hosts.own().push_back({2, 99});
        --with_sheet.counts[0].inner_points;
      }
      triangle[k] = changed.skeleton_points[at];
    }
    for (auto& at : place)
      if (at == no_id)
        at = next++;
    for (std::size_t v = 0; v < place.size(); ++v)
      changed.mesh.points[place[v]] = piece.mesh.points[v];
    for (auto& e : changed.mesh.elements)
      for (auto& v : e)
        v = place[v];
    with_sheet.load = [changed](local_id) { return changed; };
    with_sheet.skeleton.sides.own().push_back(triangle);
    with_sheet.skeleton.subdomains.own().push_back({0, 0});
    with_sheet.skeleton.side_hosts.own().push_back(99);
    auto found = io::check_distributed(with_sheet);
    INFO(found.text());
    CHECK(found.valid());

    auto elsewhere = with_sheet; // a sheet on points that are no side
    elsewhere.skeleton.sides.own().back()[0] = (triangle[0] + 17) % 60;
    found = io::check_distributed(elsewhere);
    CHECK(seam_kinds(found) == std::vector{io::seam_fault::missing_triangle});
  }
}

TEST_CASE("a skeleton point moved by one bit in one piece is found") {
  const auto mesh = coarse_cubes_in_eight.spoilt(
      3, [](mesh_piece& piece) { piece.mesh.points[7].y = std::nextafter(piece.mesh.points[7].y, 2.0); });
  const auto found = io::check_distributed(mesh);
  REQUIRE(found.subdomains.size() == 1);
  CHECK(found.subdomains[0].subdomain == 3);
  CHECK(seam_kinds(found) == std::vector{io::seam_fault::moved_point});
}

TEST_CASE("a missing element opens the boundary of its piece") {
  auto mesh = coarse_cubes_in_eight.spoilt(
      5, [](mesh_piece& piece) { piece.mesh.elements.pop_back(), piece.mesh.tags.pop_back(); });
  --mesh.counts[5].elements;
  CHECK_FALSE(io::check_distributed(mesh).valid());
}

TEST_CASE("elements that fit together but are turned over or flat are found, and points that nobody has") {
  const auto turned = coarse_cubes_in_eight.spoilt(3, [](mesh_piece& piece) {
    piece.mesh.points.back() = {10, 10, 10};
  });
  CHECK(io::check_distributed(turned).subdomains.at(0).inside.count(mesh_fault::inverted_element) > 0);
  const auto lonely = coarse_cubes_in_eight.spoilt(3, [](mesh_piece& piece) {
    piece.mesh.points.push_back({10, 10, 10});
  });
  auto counted = lonely;
  ++counted.counts[3].inner_points;
  CHECK(io::check_distributed(counted).subdomains.at(0).inside.count(mesh_fault::isolated_point) == 1);
}

TEST_CASE("pieces that fit by their points but not by their triangles are found") {
  // Flip the diagonal of one skeleton quadrilateral: both its triangles are then no sides of the pieces.
  auto mesh = coarse_cubes_in_eight.distributed();
  auto& skeleton = mesh.skeleton;
  for (std::size_t a = 0; a < skeleton.sides.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      if (skeleton.subdomains[a] != skeleton.subdomains[b] || skeleton.subdomains[a][1] == no_id)
        continue;
      auto& s = skeleton.sides.own()[a];
      auto& t = skeleton.sides.own()[b];
      for (int turn = 0; turn < 9; ++turn) {
        if (s[0] == t[1] && s[1] == t[0]) {
          const auto left = s[2], right = t[2];
          s = {s[0], right, left};
          t = {t[0], left, right};
          auto kinds = seam_kinds(io::check_distributed(mesh));
          std::sort(kinds.begin(), kinds.end());
          using enum io::seam_fault;
          CHECK(kinds == std::vector{missing_triangle, missing_triangle, surplus_side, surplus_side});
          return;
        }
        std::rotate(s.begin(), s.begin() + 1, s.end());
        if (turn % 3 == 2)
          std::rotate(t.begin(), t.begin() + 1, t.end());
      }
    }
  FAIL("no quadrilateral found");
}

TEST_CASE("a skeleton triangle turned inside out is found") {
  auto mesh = coarse_cubes_in_eight.distributed();
  std::swap(mesh.skeleton.sides.own()[0][0], mesh.skeleton.sides.own()[0][1]);
  CHECK_FALSE(io::check_distributed(mesh).valid());
}

TEST_CASE("an element of a foreign material is found") {
  const auto mesh = coarse_cubes_in_eight.spoilt(0, [](mesh_piece& piece) { piece.mesh.tags[4] = 1; });
  CHECK(seam_kinds(io::check_distributed(mesh)) == std::vector{io::seam_fault::wrong_material});
}

TEST_CASE("pieces that cannot be indexed are refused with the subdomain's number") {
  const auto wrong_index =
      coarse_cubes_in_eight.spoilt(6, [](mesh_piece& piece) { piece.mesh.elements[0][2] = 100000; });
  CHECK_THROWS_WITH_AS(io::check_distributed(wrong_index), doctest::Contains("subdomain 6"), mesh_error);
  const auto wrong_count =
      coarse_cubes_in_eight.spoilt(6, [](mesh_piece& piece) { piece.mesh.points.push_back({}); });
  CHECK_THROWS_WITH_AS(io::mesh_hash(wrong_count), doctest::Contains("subdomain 6"), mesh_error);
  auto wrong_skeleton = coarse_cubes_in_eight.distributed();
  wrong_skeleton.skeleton.subdomains.own()[0][0] = 8;
  CHECK_THROWS_AS(io::check_distributed(wrong_skeleton), mesh_error);
}

TEST_CASE("the hash does not depend on the order of elements and of their vertices") {
  const auto mesh = coarse_cubes_in_eight.spoilt(2, [](mesh_piece& piece) {
    std::reverse(piece.mesh.elements.begin(), piece.mesh.elements.end());
    for (auto& e : piece.mesh.elements)
      std::rotate(e.begin(), e.begin() + 1, e.begin() + 3);
  });
  CHECK(io::mesh_hash(mesh) == io::mesh_hash(coarse_cubes_in_eight.distributed()));
}

TEST_CASE("the hash changes with any coordinate, any connection and any orientation") {
  const auto original = io::mesh_hash(coarse_cubes_in_eight.distributed());
  CHECK(io::mesh_hash(coarse_cubes_in_eight.spoilt(4, [](mesh_piece& piece) {
          piece.mesh.points.back().z = std::nextafter(piece.mesh.points.back().z, 9.0);
        })) != original);
  CHECK(io::mesh_hash(coarse_cubes_in_eight.spoilt(4, [](mesh_piece& piece) {
          std::swap(piece.mesh.elements[3][0], piece.mesh.elements[3][1]);
        })) != original);
  CHECK(io::mesh_hash(coarse_cubes_in_eight.spoilt(4, [](mesh_piece& piece) {
          piece.mesh.elements[3][0] = piece.mesh.elements[4][1];
        })) != original);
  auto moved = coarse_cubes_in_eight.distributed();
  moved.skeleton.points.own()[5].x += 1e-15;
  CHECK(io::mesh_hash(moved) != original);
}
