#include "dovetail/core/encoding.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/mesh/background_mesh.hpp"

#include <doctest/doctest.h>

using namespace dovetail;

namespace {

simplicial_background<3> two_tetrahedra() {
  simplicial_background<3> background;
  background.volume.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  background.volume.elements = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  background.volume.tags = {4, 7};
  surface_mesh& surface = background.surface;
  surface.mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  surface.mesh.elements = {{0, 2, 1}};
  surface.mesh.tags = {5};
  surface.corner_uv = {{vec2{0, 0}, vec2{0, 1}, vec2{1, 0}}};
  surface.vertex_hosts = {{0, 1}, {1, 2}, {2, 5}, {0, 3}};
  surface.curve_edges = {{{0, 1}, 2, {0.25, 0.75}}};
  return background;
}

} // namespace

TEST_CASE("A background mesh comes back from its bytes, array by array") {
  const auto whole = two_tetrahedra();
  const byte_buffer bytes = encoded(whole);
  byte_reader from(bytes);
  const auto read = decode<simplicial_background<3>>(from);
  CHECK(from.at_end());
  CHECK(read.volume.points == whole.volume.points);
  CHECK(read.volume.elements == whole.volume.elements);
  CHECK(read.volume.tags == whole.volume.tags);
  CHECK(read.surface.mesh.points == whole.surface.mesh.points);
  CHECK(read.surface.mesh.elements == whole.surface.mesh.elements);
  CHECK(read.surface.mesh.tags == whole.surface.mesh.tags);
  CHECK(read.surface.corner_uv == whole.surface.corner_uv);
  CHECK(read.surface.vertex_hosts == whole.surface.vertex_hosts);
  REQUIRE(read.surface.curve_edges.size() == 1);
  CHECK(read.surface.curve_edges[0].vertices == whole.surface.curve_edges[0].vertices);
  CHECK(read.surface.curve_edges[0].t == whole.surface.curve_edges[0].t);
  const byte_buffer of_surface = encoded(simplicial_background<2>{whole.surface});
  CHECK(of_surface ==
        byte_buffer(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(of_surface.size())));
}

TEST_CASE("Bytes cut short anywhere are an error") {
  const byte_buffer bytes = encoded(two_tetrahedra());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const byte_buffer cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    byte_reader from(cut);
    CHECK_THROWS_AS(decode<simplicial_background<3>>(from), input_error);
  }
}

TEST_CASE("A report comes back with its counters, warnings and children") {
  report whole{"stage", 1.5, {}, {"careful"}, {}};
  whole.set("elements", 12);
  whole.children.push_back({"part", 0.5, {}, {}, {}});
  const byte_buffer bytes = encoded(whole);
  byte_reader from(bytes);
  const auto read = decode<report>(from);
  CHECK(from.at_end());
  CHECK(read.name == "stage");
  CHECK(read.seconds == 1.5);
  CHECK(read.get("elements") == 12);
  CHECK(read.warnings == whole.warnings);
  REQUIRE(read.children.size() == 1);
  CHECK(read.children[0].name == "part");
}
