// Meshes of policies that are dovetail's own, one line each: what was meshed, how, the number of elements and
// the mesh's hash. `benchmarks/same_mesh` compiles it in several ways and compares the lines.
#include "dovetail/improver/native.hpp"
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

#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>
#include <vector>

namespace {

using namespace dovetail;

/// A ring of a round cross-section, whose corners are computed with sines: they are the same only as far as
/// these are.
discrete_model ring(int n, int m) {
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

template <int D, class Model, class Size>
int show(const char* name, const Model& model, const Size& size, any_partitioner partitioner) {
  generate_options options;
  options.subdomains = 5;
  const auto policies = parameters<>{}
                            .with_partitioner(std::move(partitioner))
                            .with_improver(improvement::native::fine())
                            .with_options(options);
  const auto made = generate<D>(model, size, policies);
  std::printf("%s: %lld elements, %016llx\n", name, static_cast<long long>(made.quality.elements),
              static_cast<unsigned long long>(io::mesh_hash(made.mesh)));
  return made.failures.empty() && made.mesh.counts.size() > 2 ? 0 : 1;
}

} // namespace

int main() try {
  int failed = 0;
  const auto waves = [](vec3 p) { return 0.2 * std::sin(5 * p.x) * std::cos(5 * p.y) + 0.4 * p.z; };
  const implicit_model body(implicit::intersection(implicit::sphere{}, waves, 0.4),
                            {{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}}, {.resolution = 72});
  failed += show<3>("body of a formula, greedy", body, uniform_size(0.15), partition::greedy{});
  const source_field sources(0.4, {point_source({2, 0, 0}, 0.3, 2, 0.15)});
  failed += show<3>("ring of triangles, sources, inertial", ring(48, 16), sources, partition::inertial{});
  const plane_domain plate(drawing_from_svg_path("M0 0 H30 V20 H0 Z M8 10 a4 4 0 1 0 8 0 a4 4 0 1 0 -8 0 Z"));
  failed +=
      show<2>("plate with a round hole, curve", plate, uniform_size(0.5), partition::space_filling_curve{});
  failed += show<2>("surface of the ring, coordinates", ring(48, 16), uniform_size(0.2),
                    partition::recursive_coordinate{});
  return failed;
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
