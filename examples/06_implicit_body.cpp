/// A body given by a formula, meshed: no file needed.
/// Usage: 06_implicit_body [SIZE (default 0.08)]
#include "dovetail/models/implicit/shapes.hpp"
#include "dovetail/models/implicit_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) try {
  using namespace dovetail;
  // part model
  // Any callable will do: the body is where it is negative. Here three waves in a ball.
  const auto waves = [](vec3 p) { return 0.2 * std::sin(5 * p.x) * std::cos(5 * p.y) + 0.4 * p.z; };
  const implicit_model model(implicit::intersection(implicit::sphere{}, waves, 0.4),
                             {{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}}, {.resolution = 72});
  // end
  // part generate
  const uniform_size size(argc > 1 ? std::atof(argv[1]) : 0.08);
  generate_options options;
  options.subdomains = 6;
  const auto result = generate<3>(model, size, parameters<>{}.with_options(options));
  // end
  std::printf("%zu faces, %zu subdomains, %lld tetrahedra, smallest dihedral angle %.1f degrees\n",
              model.topology().faces.size(), result.mesh.counts.size(),
              static_cast<long long>(result.quality.elements), result.quality.min_dihedral_deg);
  return result.failures.empty() ? 0 : 1;
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
