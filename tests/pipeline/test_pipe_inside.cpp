#include "dovetail/models/occt_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <doctest/doctest.h>
#include <gp_Ax2.hxx>

#include <algorithm>
#include <cstddef>

using namespace dovetail;

namespace {

/// A pipe of a thin wall, into which a cylinder is drilled obliquely.
occt_model drilled_pipe() {
  const gp_Ax2 along(gp_Pnt(-1, 0, 0), gp_Dir(1, 0, 0));
  const TopoDS_Shape pipe = BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(along, 0.3, 2.0).Shape(),
                                            BRepPrimAPI_MakeCylinder(along, 0.295, 2.0).Shape())
                                .Shape();
  const gp_Ax2 oblique(gp_Pnt(0, 0, 0), gp_Dir(1, 0, 1));
  return occt_shape_from(BRepAlgoAPI_Cut(pipe, BRepPrimAPI_MakeCylinder(oblique, 0.15, 1.0).Shape()).Shape())
      .model;
}

double longest_edge(const distributed_simplicial_mesh<2>& mesh) {
  double longest = 0;
  for (std::size_t p = 0; p < mesh.counts.size(); ++p) {
    const auto piece = mesh.load(static_cast<local_id>(p)).mesh;
    for (const auto& triangle : piece.elements)
      for (std::size_t k = 0; k < 3; ++k)
        longest = std::max(longest, distance(piece.points[triangle[k]], piece.points[triangle[(k + 1) % 3]]));
  }
  return longest;
}

} // namespace

TEST_CASE("the inside of a pipe has triangles of the size in its middle, too, and not at its rims only") {
  for (const double size : {0.03, 0.015}) {
    CAPTURE(size);
    const auto made = generate<2>(drilled_pipe(), uniform_size(size), parameters<>{});
    REQUIRE(made.failures.empty());
    CHECK(longest_edge(made.mesh) < 2.2 * size);
  }
}
