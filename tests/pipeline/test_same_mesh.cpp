// Meshes of policies that are dovetail's own. Each is printed as a line, "mesh of ...", with the number of
// its elements and its hash, so that programs of other compilers and flags can be compared:
// tests/sanitized/check_same_mesh.sh does it with two, benchmarks/same_mesh with more.
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/mesher/native.hpp"
#include "dovetail/models/discrete_model.hpp"
#include "dovetail/models/implicit/shapes.hpp"
#include "dovetail/models/implicit_model.hpp"
#include "dovetail/models/plane/svg_path.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/partition/all.hpp"
#include "dovetail/partition/any_partitioner.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/sources.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

using namespace dovetail;

namespace {

/// A ring of a round cross-section, with `n` corners around and `m` in each section.
discrete_model ring_of_triangles(int n, int m) {
  std::vector<vec3> points;
  std::vector<simplex<2>> triangles;
  const auto corner = [&](int i, int j) { return static_cast<local_id>(i % n * m + j % m); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const double u = 2 * std::numbers::pi * i / n;
      const double v = 2 * std::numbers::pi * j / m;
      const double r = 2 + 0.7 * std::cos(v);
      points.push_back({r * std::cos(u), r * std::sin(u), 0.7 * std::sin(v)});
      triangles.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
      triangles.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
  return discrete_model(points, triangles);
}

template <int D, class Model, class Size, class Parameters>
void print_mesh_of(const char* name, const Model& model, const Size& size, const Parameters& policies) {
  generate_options options;
  options.subdomains = 4;
  const auto made =
      generate<D>(model, size, policies.with_improver(improvement::native::fine()).with_options(options));
  REQUIRE(made.failures.empty());
  CHECK(made.mesh.counts.size() > 2);
  std::printf("mesh of %s: %lld elements, %016llx\n", name, static_cast<long long>(made.quality.elements),
              static_cast<unsigned long long>(io::mesh_hash(made.mesh)));
}

} // namespace

TEST_CASE("meshes to be compared with those of other compilers: tetrahedra") {
  const auto by = [](any_partitioner partitioner) { return parameters<>{}.with_partitioner(partitioner); };
  const implicit_model body(implicit::intersection(implicit::sphere{}, implicit::torus{}, 0.2),
                            {{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}}, {.resolution = 32});
  print_mesh_of<3>("a body of formulas", body, uniform_size(0.2), by(partition::inertial{}));
  const source_field sources(0.5, {point_source({2, 0, 0}, 0.3, 2, 0.2)});
  print_mesh_of<3>("a ring with a source", ring_of_triangles(32, 12), sources, by(partition::greedy{}));
}

TEST_CASE("meshes to be compared with those of other compilers: triangles") {
  const plane_domain plate(drawing_from_svg_path("M0 0 H30 V20 H0 Z M8 10 a4 4 0 1 0 8 0 a4 4 0 1 0 -8 0 Z"));
  print_mesh_of<2>("a plate with a round hole", plate, uniform_size(1), parameters<>{});
  print_mesh_of<2>("the surface of a ring", ring_of_triangles(32, 12), uniform_size(0.3), parameters<>{});
}
