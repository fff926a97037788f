#include "dovetail/core/encoding.hpp"
#include "dovetail/files/finishing_pass.hpp"
#include "dovetail/files/msh_writer.hpp"
#include "dovetail/files/read_mesh.hpp"
#include "dovetail/files/streamed_interfaces.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "dovetail/parallel/serial.hpp"
#include "files/scratch_folder.hpp"
#include "files/stacked_cubes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

using namespace dovetail;
using testing::cubes_in_eight;

namespace {

io::read_piece<3> view_of(const io::loaded_mesh& piece) {
  return {piece.mesh, piece.node_ids, piece.subdomains};
}

/// What those who wrote the mesh say of it.
quality_at_interfaces of_writer(const distributed_mesh& mesh) {
  return io::finish_mesh<3>(mesh, {}, ".", parallel::serial{}).at_interfaces;
}

/// What whoever reads the files says, one after the other.
quality_at_interfaces streamed_quality(const std::filesystem::path& folder) {
  io::streamed_interfaces<3> interfaces;
  const auto for_each = [&](const auto& f) {
    REQUIRE(io::for_each_piece_file(folder, nullptr,
                                    [&](const io::loaded_mesh& piece, const auto&) { f(view_of(piece)); }));
  };
  for_each([&](const io::read_piece<3>& piece) { interfaces.add(piece); });
  CHECK(interfaces.has_several_subdomains());
  const auto points = interfaces.points();
  quality_at_interfaces found;
  for_each([&](const io::read_piece<3>& piece) { found.merge(io::measure_at_interfaces(piece, points)); });
  return found;
}

template <int D>
quality_at_interfaces of_whole(const simplicial_mesh<D>& mesh, const std::vector<local_id>& subdomains) {
  io::streamed_interfaces<D> interfaces;
  const io::read_piece<D> whole{mesh, {}, subdomains};
  interfaces.add(whole);
  return io::measure_at_interfaces(whole, interfaces.points());
}

/// Sums over the same elements in another order differ in the last digits.
void check_same(const quality_at_interfaces& found, const quality_at_interfaces& expected) {
  const std::array of_found{found.touching, found.next_ring, found.rest};
  const std::array of_expected{expected.touching, expected.next_ring, expected.rest};
  for (std::size_t k = 0; k < 3; ++k) {
    CAPTURE(k);
    CHECK(of_found[k].elements == of_expected[k].elements);
    CHECK(of_found[k].min_dihedral_deg == of_expected[k].min_dihedral_deg);
    CHECK(of_found[k].mean_min_dihedral_deg() ==
          doctest::Approx(of_expected[k].mean_min_dihedral_deg()).epsilon(1e-12));
    CHECK(of_found[k].min_dihedrals.bins == of_expected[k].min_dihedrals.bins);
  }
}

} // namespace

TEST_CASE("figures of files that are read are those of the mesh that was written") {
  const auto mesh = cubes_in_eight.distributed();
  const auto expected = of_writer(mesh);
  REQUIRE(expected.touching.elements > 0);
  REQUIRE(expected.next_ring.elements > 0);
  REQUIRE(expected.rest.elements > 0);
  for (const int files : {0, 3, 1}) {
    CAPTURE(files);
    const testing::scratch_folder folder("interfaces_of_files");
    io::vtu_writer{.files = files}(mesh, folder);
    const auto found = streamed_quality(folder);
    check_same(found, expected);
    if (files == 0)
      CHECK(encoded(found) == encoded(expected)); // to the last digit
    const auto whole = io::read_mesh(folder);
    check_same(of_whole(whole.mesh, whole.subdomains), expected);
  }
  const testing::scratch_folder folder("interfaces_of_msh");
  io::partitioned_msh_writer{.ghosts = true}(mesh, folder);
  const auto whole = io::read_mesh(folder);
  REQUIRE(whole.subdomains.size() == whole.mesh.elements.size());
  check_same(of_whole(whole.mesh, whole.subdomains), expected);
}

TEST_CASE("subdomains that meet in points, in edges and in several places") {
  const testing::stacked_cubes blocks{.cells = 6, .jitter = 0.2};
  const auto whole = blocks.whole();
  std::vector<local_id> parts;
  for (const auto& element : whole.elements) {
    const auto at = blocks.centroid(element); // in sixths of a cell; blocks of two cells
    parts.push_back((at[0] / 12 + 2 * (at[1] / 12) + 3 * (at[2] / 12)) % 4);
  }
  check_same(of_whole(whole, parts), of_writer(blocks.distributed(parts)));
}

TEST_CASE("without several subdomains there are no interfaces") {
  const auto mesh = cubes_in_eight.whole();
  const std::vector<local_id> one(mesh.elements.size(), 5);
  io::streamed_interfaces<3> interfaces;
  interfaces.add({mesh, {}, one});
  CHECK_FALSE(interfaces.has_several_subdomains());
  CHECK(interfaces.points().of_subdomains.empty());
  const auto found = of_whole(mesh, one);
  CHECK(found.rest.elements == static_cast<std::int64_t>(mesh.elements.size()));
  CHECK(found.touching.elements + found.next_ring.elements == 0);

  auto numbers = one;
  numbers.front() = no_id; // what MSH files say of an element in no partition
  interfaces = {};
  interfaces.add({mesh, {}, numbers});
  CHECK(interfaces.has_several_subdomains());
}

TEST_CASE("edges of triangles: two subdomains that pass one against each other have an interface there") {
  // A row of squares, each of two triangles; the first two are of subdomain 3.
  simplicial_mesh<2> row;
  for (local_id k = 0; k <= 8; ++k) {
    row.points.push_back({1.0 * k, 0, 0});
    row.points.push_back({1.0 * k, 1, 0});
    if (k == 8)
      break;
    const local_id v = 2 * k;
    row.elements.push_back({v, v + 2, v + 3});
    row.elements.push_back({v, v + 3, v + 1});
  }
  std::vector<local_id> subdomains(16, 7);
  std::fill_n(subdomains.begin(), 4, 3);
  const auto found = of_whole(row, subdomains);
  CHECK(found.touching.elements == 2 * 2);
  CHECK(found.next_ring.elements == 2 * 2);
  CHECK(found.rest.elements == 4 * 2);

  auto apart = row; // a triangle that has a point of it, but no side there
  apart.points.push_back({1.5, 2, 0});
  apart.points.push_back({2.5, 2, 0});
  apart.elements.push_back({5, 19, 18});
  auto of_apart = subdomains;
  of_apart.push_back(9);
  CHECK(of_whole(apart, of_apart).touching.elements == 2 * 2);
  CHECK(of_whole(apart, of_apart).rest.elements == 4 * 2 + 1);

  auto turned = row; // the triangles of one side face the other way, as in a skeleton no interface
  for (std::size_t e = 0; e < 4; ++e)
    std::swap(turned.elements[e][0], turned.elements[e][1]);
  CHECK(of_whole(turned, subdomains).touching.elements == 0);

  auto crowded = row; // a third triangle at the edge
  crowded.points.push_back({2, 0.5, 1});
  crowded.elements.push_back({4, 5, 18});
  subdomains.push_back(7);
  CHECK(of_whole(crowded, subdomains).touching.elements == 0);
}
