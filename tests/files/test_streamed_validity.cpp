#include "dovetail/files/read_mesh.hpp"
#include "dovetail/files/streamed_validity.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "files/scratch_folder.hpp"
#include "files/stacked_cubes.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <string>

using namespace dovetail;

namespace {

const testing::stacked_cubes cubes{.cells = 6, .cuts = 2, .solids = 2, .jitter = 0.3};

struct verdict {
  std::string faults;
  std::uint64_t elements = 0;
  std::uint64_t points = 0;
};

verdict streamed(const std::filesystem::path& folder) {
  io::streamed_validity found;
  REQUIRE(io::for_each_piece_file(folder, nullptr, [&](const io::loaded_mesh& piece, const auto& file) {
    found.add(piece, file.filename().string());
  }));
  verdict result{found.faults()};
  result.elements = found.elements();
  result.points = found.points();
  return result;
}

/// Writes the cubes with some pieces changed; both ways to read them must find fault, or neither.
std::string faults_of(const std::function<void(mesh_piece&)>& spoil, const std::string& name,
                      int points_more = 0) {
  const testing::scratch_folder folder("streamed_" + name);
  auto mesh = cubes.distributed();
  for (auto& counts : mesh.counts)
    counts.inner_points += points_more;
  mesh.load = [load = mesh.load, spoil](local_id p) {
    auto piece = load(p);
    spoil(piece);
    return piece;
  };
  io::vtu_writer{}(mesh, folder);
  const auto found = streamed(folder);
  const auto whole = check_validity(io::read_mesh(folder).mesh);
  INFO(whole.text(), " | ", found.faults);
  CHECK(whole.valid() == found.faults.empty());
  return found.faults;
}

} // namespace

TEST_CASE("a mesh in several files is checked as if it were in one") {
  const testing::scratch_folder folder("streamed_valid");
  for (const int files : {0, 3}) {
    io::vtu_writer{.files = files}(cubes.distributed(), folder);
    const auto found = streamed(folder);
    CHECK(found.faults == "");
    CHECK(found.elements == 6 * 6 * 6 * 6);
    CHECK(found.points == 7 * 7 * 7);
  }
}

TEST_CASE("faults inside a piece name its file") {
  CHECK(faults_of(
            [](mesh_piece& piece) {
              if (piece.subdomain == 3)
                std::swap(piece.mesh.elements[17][0], piece.mesh.elements[17][1]);
            },
            "inverted")
            .starts_with("mesh_0003.vtu: 1 x inverted element (17)"));
  CHECK(faults_of(
            [](mesh_piece& piece) {
              piece.mesh.points.push_back(vec3{2, 2, piece.subdomain + 0.5});
            },
            "isolated", 1)
            .starts_with("8 x isolated point (point "));
}

TEST_CASE("faults between pieces are found") {
  const auto corner = [](mesh_piece& piece, local_id of) { // an element more, with all its points on the seam
    if (piece.subdomain != of)
      return;
    auto& elements = piece.mesh.elements;
    for (auto& element : elements)
      if (std::count_if(element.begin(), element.end(), [&](local_id v) {
            return static_cast<std::size_t>(v) < piece.skeleton_points.size();
          }) == 4) {
        elements.back() = element; // twice there, and another one missing
        return;
      }
    FAIL("no element has all its points on the boundary");
  };
  CHECK(faults_of([&](mesh_piece& piece) { corner(piece, 2); }, "twice") != "");

  // Two pieces hold the same elements.
  const testing::scratch_folder folder("streamed_seams");
  io::vtu_writer{}(cubes.distributed(), folder);
  std::filesystem::copy_file(folder / "mesh_0005.vtu", folder / "mesh_0004.vtu",
                             std::filesystem::copy_options::overwrite_existing);
  CHECK_FALSE(check_validity(io::read_mesh(folder).mesh).valid());
  CHECK(streamed(folder).faults.find("a point is inside two pieces") != std::string::npos);

  // A sheet that both sides pass in the same direction: one piece mirrored, elements and all.
  io::streamed_validity found;
  io::loaded_mesh one, other;
  one.mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {0}};
  one.node_ids = {0, 1, 2, 3};
  other.mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 2}}, {{0, 1, 2, 3}}, {0}};
  other.node_ids = {0, 1, 2, 4};
  found.add(one, "one");
  found.add(other, "other");
  CHECK(found.faults() == "1 x misoriented side (point 0)");

  // Three elements at a side; a point with another number at the same place.
  auto third = other;
  third.mesh.points[3] = {0.3, 0.3, -2};
  std::swap(third.mesh.elements[0][0], third.mesh.elements[0][1]);
  third.node_ids[3] = 5;
  found.add(third, "third");
  CHECK(found.faults() == "1 x non-manifold side (point 0)");
  io::streamed_validity apart;
  apart.add(one, "one");
  other.node_ids = {6, 7, 8, 9};
  apart.add(other, "other");
  CHECK(apart.faults() == "3 x coincident point (point 6)");

  // A point inside one piece is a corner of another.
  io::streamed_validity pierced;
  io::loaded_mesh around = one;
  around.mesh.points.push_back({0.2, 0.2, 0.2});
  around.mesh.elements = {{4, 1, 2, 3}, {0, 4, 2, 3}, {0, 1, 4, 3}, {0, 1, 2, 4}};
  around.mesh.tags = {0, 0, 0, 0};
  around.node_ids = {0, 1, 2, 3, 9};
  io::loaded_mesh inside = one;
  inside.mesh.points = {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {0.2, 0.2, 0.2}};
  inside.node_ids = {6, 7, 8, 9};
  pierced.add(around, "around");
  CHECK(pierced.faults() == "");
  CHECK(pierced.points() == 5);
  pierced.add(inside, "inside");
  CHECK(pierced.faults() == "1 x point inside one piece that another has (point 9)");

  // One number for two places.
  io::streamed_validity torn;
  other.node_ids = {0, 7, 8, 9};
  other.mesh.points[0].x = 1e-9;
  torn.add(one, "one");
  torn.add(other, "other");
  CHECK_THROWS_WITH_AS(torn.faults(), doctest::Contains("global number 0"), input_error);
}

TEST_CASE("numbers as ranges") {
  io::number_ranges numbers;
  CHECK(numbers.count() == 0);
  for (const global_id id : {5, 6, 7, 20})
    numbers.add(id);
  for (const global_id id : {0, 8, 9})
    numbers.add(id);
  CHECK(numbers.disjoint());
  CHECK(numbers.count() == 7);
  CHECK(numbers.contains(7));
  CHECK_FALSE(numbers.contains(10));
  for (const global_id id : {6, 7, 8, 10})
    numbers.add(id);
  CHECK_FALSE(numbers.disjoint());
  CHECK(numbers.count() == 8);
}
