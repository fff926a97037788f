/// @file
/// What `dovetail check` finds in elements of second order.
#pragma once

#include "files/bent_edges.hpp"

#include "dovetail/files/second_order_nodes.hpp"
#include "dovetail/files/streamed_middles.hpp"
#include "dovetail/files/streamed_validity.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace dovetail::testing {

/// Of corners and middles.
struct second_order_verdict {
  std::string faults{};
  std::uint64_t corners = 0;
  std::uint64_t middles = 0;
};

/// Of the pieces that `for_each(visitor)` goes through.
template <class ForEach>
second_order_verdict check_second_order(const ForEach& for_each) {
  io::streamed_validity corners;
  io::streamed_middles<3> middles;
  for_each([&](const io::loaded_mesh& piece, const std::filesystem::path& file) {
    CHECK(piece.middles.size() == piece.mesh.elements.size());
    corners.add(io::corners_of(piece), file.filename().string());
    middles.add(piece, file.filename().string());
  });
  second_order_verdict result{corners.faults()};
  if (result.faults.empty())
    result.faults = middles.faults();
  result.corners = corners.points();
  result.middles = middles.points();
  return result;
}

/// Expects a valid mesh of second order with so many nodes as one of first order has points and edges.
inline void expect_second_order(const second_order_verdict& found, const simplicial_mesh<3>& linear) {
  CHECK(found.faults == "");
  CHECK(found.corners == linear.points.size());
  CHECK(found.middles == build_edges<3>(span_of(linear.elements), linear.points.size()).vertices.size());
}

/// Expects the middles of edges where `with_bent_edges` puts them.
inline void expect_bent_edges(const io::loaded_mesh& read) {
  REQUIRE(read.middles.size() == read.mesh.elements.size());
  const auto at = [&](local_id v) { return read.mesh.points[v]; };
  double apart = 0;
  for (std::size_t e = 0; e < read.middles.size(); ++e)
    for (std::size_t k = 0; k < read.middles[e].size(); ++k) {
      const auto [a, b] = vertices_of_edge(read.mesh.elements[e], numbering::edges<3>[k]);
      apart = std::max(apart, norm(at(read.middles[e][k]) - bent_middle(at(a), at(b))));
    }
  CHECK(apart < 1e-12);
}

} // namespace dovetail::testing
