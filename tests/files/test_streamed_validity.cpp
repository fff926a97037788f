#include "dovetail/files/msh_writer.hpp"
#include "dovetail/files/read_mesh.hpp"
#include "dovetail/files/streamed_validity.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "files/scratch_folder.hpp"
#include "files/second_order_verdict.hpp"
#include "files/stacked_cubes.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

using namespace dovetail;
using testing::coarse_cubes_in_eight;

namespace {

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
  auto mesh = coarse_cubes_in_eight.distributed();
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
    io::vtu_writer{.files = files}(coarse_cubes_in_eight.distributed(), folder);
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
  io::vtu_writer{}(coarse_cubes_in_eight.distributed(), folder);
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

TEST_CASE("elements of second order in one file and in several") {
  const auto mesh = testing::with_bent_edges(coarse_cubes_in_eight.distributed());
  const testing::scratch_folder folder("streamed_second_order");
  for (const int files : {0, 3}) {
    io::vtu_writer{.files = files}(mesh, folder);
    testing::expect_second_order(testing::check_second_order([&](const auto& f) {
                                   io::for_each_piece_file(folder, nullptr, f, io::element_order::any);
                                 }),
                                 coarse_cubes_in_eight.whole());
  }
  CHECK_THROWS_WITH_AS(io::read_mesh(folder), doctest::Contains("quadratic tetrahedron"), input_error);
  io::msh_writer{}(mesh, folder);
  CHECK_THROWS_WITH_AS(io::read_mesh(folder / "mesh.msh"), doctest::Contains("elements of type"),
                       input_error);
  for (const char* name : {"mesh.pvtu", "mesh.msh"}) {
    CAPTURE(name);
    const auto read = io::read_mesh(folder / name, nullptr, false, io::element_order::any);
    testing::expect_bent_edges(read);
    CHECK(read.triangle_middles.size() == read.triangles.size());
    testing::expect_second_order(testing::check_second_order([&](const auto& f) { f(read, "whole"); }),
                                 coarse_cubes_in_eight.whole());
  }
}

TEST_CASE("damaged middles of edges are found") {
  const testing::scratch_folder folder("streamed_middles");
  io::vtu_writer{}(testing::with_bent_edges(coarse_cubes_in_eight.distributed()), folder);
  std::vector<io::loaded_mesh> pieces;
  io::for_each_piece_file(
      folder, nullptr, [&](const auto& piece, const auto&) { pieces.push_back(piece); },
      io::element_order::any);
  const auto faults = [&](std::size_t p, const std::function<void(io::loaded_mesh&)>& spoil) {
    io::streamed_middles<3> middles;
    for (std::size_t q = 0; q < pieces.size(); ++q) {
      io::loaded_mesh piece = pieces[q];
      if (q == p)
        spoil(piece);
      middles.add(piece, "piece " + std::to_string(q));
    }
    return middles.faults();
  };
  CHECK(faults(0, [](io::loaded_mesh&) {}) == "");

  // Of piece 3: an edge inside it, and one that other pieces have too; the element and its edge.
  const auto find_edge = [&](bool inside) {
    const auto& piece = pieces[3];
    std::vector<bool> on_boundary(piece.mesh.points.size(), false);
    const auto sides = build_sides(piece.mesh);
    for (std::size_t s = 0; s < sides.size(); ++s)
      if (sides.is_boundary(static_cast<local_id>(s)))
        for (const local_id v : sides.vertices[s])
          on_boundary[v] = true;
    const auto elsewhere = [&](local_id v) {
      for (std::size_t q = 0; q < pieces.size(); ++q)
        if (const auto& ids = pieces[q].node_ids;
            q != 3 && std::find(ids.begin(), ids.end(), piece.node_ids[v]) != ids.end())
          return true;
      return false;
    };
    for (std::size_t e = 0; e < piece.middles.size(); ++e)
      for (std::size_t k = 0; k < 6; ++k) {
        const local_id a = piece.mesh.elements[e][numbering::edges<3>[k][0]];
        if (inside ? !on_boundary[a] : elsewhere(piece.middles[e][k]))
          return std::pair(e, k);
      }
    FAIL("there is no such edge");
    return std::pair(std::size_t{0}, std::size_t{0});
  };
  for (const bool inside : {true, false}) {
    CAPTURE(inside);
    const auto [e, k] = find_edge(inside);
    const auto middle = [&, e = e, k = k](io::loaded_mesh& piece) -> local_id& {
      return piece.middles[e][k];
    };
    if (inside) {
      const std::string said = faults(3, [&](io::loaded_mesh& piece) {
        piece.mesh.points[middle(piece)] += vec3{0.9, 0, 0};
      });
      CHECK(said.starts_with("piece 3: "));
      CHECK(said.find(" x element that its middles may invert (") != std::string::npos);
    }
    const auto doubled = [&](io::loaded_mesh& piece) {
      piece.mesh.points.push_back(piece.mesh.points[middle(piece)]);
      piece.node_ids.push_back(99999);
      middle(piece) = static_cast<local_id>(piece.node_ids.size() - 1);
    };
    CHECK(faults(3, doubled).find("1 x edge with more than one middle (from point ") != std::string::npos);
    CHECK(faults(3, [&, e = e](io::loaded_mesh& piece) {
            middle(piece) = piece.mesh.elements[e][0];
          }).find("a corner is also the middle of an edge (point ") != std::string::npos);
    CHECK(faults(3, [&](io::loaded_mesh& piece) {
            piece.mesh.points.emplace_back();
            piece.node_ids.push_back(99999);
          }) == "1 x isolated point");
  }
  const auto [e, k] = find_edge(false);
  CHECK(faults(3,
               [&, e = e, k = k](io::loaded_mesh& piece) { // in all elements of this piece
                 piece.node_ids[piece.middles[e][k]] = 99999;
               })
            .starts_with("1 x edge with more than one middle (from point "));
  CHECK(faults(3, [&, e = e, k = k](io::loaded_mesh& piece) {
          piece.node_ids[piece.middles[e][k]] = pieces[5].node_ids.back();
        }) != "");
  CHECK_THROWS_WITH_AS(
      faults(3,
             [&, e = e, k = k](io::loaded_mesh& piece) { piece.mesh.points[piece.middles[e][k]].x += 1e-9; }),
      doctest::Contains("but not the same coordinates"), input_error);
  CHECK(faults(3, [](io::loaded_mesh& piece) { piece.middles.clear(); }) ==
        std::to_string(pieces[3].mesh.elements.size()) +
            " x element of first order among those of second order");
  CHECK(faults(3, [](io::loaded_mesh& piece) { piece.middles.pop_back(); }) ==
        "1 x element of first order among those of second order");
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
