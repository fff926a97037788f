/// A field whose value is no length is named with the place, by whatever asks it first.
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/remesh/line_spacing.hpp"
#include "dovetail/sizing/graded.hpp"
#include "dovetail/sizing/prediction.hpp"
#include "dovetail/sizing/volume_prediction.hpp"
#include "support/jittered_meshes.hpp"
#include "support/refusal.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace dovetail;

namespace {

template <class Use>
void names_the_place(const char* who, const Use& use) {
  CAPTURE(who);
  for (const double wrong : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    CAPTURE(wrong);
    const any_sizing field = [wrong](vec3 p) { return p.x < 0.5 ? 0.2 : wrong; };
    const auto message = testing::refusal_of<sizing_error>([&] { return use(field), 0; });
    CHECK(testing::has(message, "the size at ("));
    CHECK(testing::has(message, "must be positive and finite"));
  }
  CHECK(testing::refusal_of<error>([&] { return use(any_sizing([](vec3) { return 0.2; })), 0; }) ==
        "accepted");
}

} // namespace

TEST_CASE("predictions, gradation and lines name the place of a size that is none") {
  const auto cubes = dovetail_test::jittered_cubes(2);
  const auto squares = dovetail_test::jittered_squares(3);
  names_the_place("predict_elements<3>", [&](const auto& h) { return predict_elements<3>(cubes, h); });
  names_the_place("predict_elements<2>", [&](const auto& h) { return predict_elements<2>(squares, h); });
  const auto sides = build_sides(cubes);
  simplicial_mesh<2> surface{cubes.points, {}, {}};
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (sides.is_boundary(static_cast<local_id>(s)))
      surface.elements.push_back(sides.vertices[s]);
  names_the_place("predict_volume_elements",
                  [&](const auto& h) { return predict_volume_elements(surface, h); });
  names_the_place("graded_size", [&](const auto& h) { return graded_size(h, {{0, 0, 0}, {1, 1, 1}}); });
  names_the_place("line_spacing", [&](const auto& h) {
    const auto line = [](double t) { return curve_frame{{t, 0, 0}, {1, 0, 0}}; };
    return remesh::line_spacing{}(line, 0, 1, h);
  });
}
