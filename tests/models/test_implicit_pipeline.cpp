#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/models/implicit/shapes.hpp"
#include "dovetail/models/implicit_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace dovetail;

namespace {

/// Meshes a body in 4 subdomains and returns the volume of its mesh.
template <class F>
double meshed_volume(const F& body, double half_box, double size, int resolution) {
  const implicit_model model(body, {{-half_box, -half_box, -half_box}, {half_box, half_box, half_box}},
                             {.resolution = resolution});
  generate_options options;
  options.subdomains = 4;
  const auto result = generate<3>(model, uniform_size(size),
                                  parameters<>{}.with_mesher(mesher::tetgen{}).with_options(options));
  REQUIRE(result.failures.empty());
  CHECK(io::check_distributed(result.mesh).valid());
  const fine_skeleton& skeleton = result.mesh.skeleton;
  for (std::size_t v = 0; v < skeleton.points.size(); ++v)
    if (skeleton.point_hosts[v].dimension <= 2)
      CHECK(std::abs(body(skeleton.points[v])) < 1e-9);
  double volume = 0;
  for (std::size_t p = 0; p < result.mesh.counts.size(); ++p) {
    const mesh_piece piece = result.mesh.load(static_cast<local_id>(p));
    const auto at = [&](local_id v) { return piece.mesh.points[v]; };
    for (const auto& [a, b, c, d] : piece.mesh.elements)
      volume += signed_volume(at(a), at(b), at(c), at(d));
  }
  return volume;
}

} // namespace

TEST_CASE("a ball from a formula to a mesh in pieces") {
  CHECK(meshed_volume(implicit::sphere{}, 1.3, 0.15, 32) ==
        doctest::Approx(4.0 / 3 * std::numbers::pi).epsilon(0.02));
}

TEST_CASE("a torus from a formula") {
  CHECK(meshed_volume(implicit::torus{.large_radius = 1, .small_radius = 0.4}, 1.6, 0.15, 32) ==
        doctest::Approx(2 * std::numbers::pi * std::numbers::pi * 0.16).epsilon(0.03));
}

TEST_CASE("metaballs from a formula") {
  const implicit::metaballs balls{{{{-0.5, 0, 0}, 0.5}, {{0.5, 0.1, 0}, 0.5}, {{0, 0.6, 0.2}, 0.4}}};
  CHECK(meshed_volume(balls, 2, 0.18, 32) > 3 * 0.27); // more than the balls alone
}

TEST_CASE("a gyroid in a rounded box") {
  const auto body =
      implicit::intersection(implicit::gyroid{.period = 1.6, .thickness = 0.4},
                             implicit::rounded_box{.half_widths = {0.7, 0.7, 0.7}, .rounding = 0.2}, 0.15);
  const double volume = meshed_volume(body, 0.8, 0.12, 32);
  CHECK(volume > 0.3);
  CHECK(volume < 1.4 * 1.4 * 1.4);
}
