/// @file
/// The native improver on triangles: how fast, how good.
///
/// Usage: improver_surface [CELLS_PER_SIDE] [REPEATS]
///
/// Inputs: a jittered plane grid, the same bent into a wave (discrete host) and rolled into a cylinder (a
/// host given by functions). Prints per preset the median of processor times, without statistics.
#include "dovetail/improver/native.hpp"
#include "dovetail/mesh/quality.hpp"
#include "support/jittered_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <utility>
#include <vector>

namespace {

using namespace dovetail;

struct test_input {
  const char* name;
  simplicial_mesh<2> mesh;
  surface_host host;
};

std::vector<test_input> make_inputs(int n) {
  std::vector<test_input> inputs;
  inputs.push_back({"plane", dovetail_test::jittered_squares(n, 0.3, 1, 0), {}});
  inputs.push_back({"wave, discrete", dovetail_test::jittered_squares(n, 0.3, 1, 0.1), {}});
  test_input rolled{"cylinder", dovetail_test::jittered_squares(n, 0.3, 1, 0), {}};
  for (vec3& p : rolled.mesh.points)
    p = {std::cos(3 * p.x), std::sin(3 * p.x), 3 * p.y};
  rolled.host.project = [](local_id, vec3 p, vec2) {
    const vec3 outwards = normalized({p.x, p.y, 0});
    return host_point{{outwards.x, outwards.y, p.z}, outwards, {}};
  };
  inputs.push_back(std::move(rolled));
  return inputs;
}

void print_row(const char* preset, const quality_statistics& quality, double seconds) {
  std::printf("  %-8s %9lld %8.3f %10.1f %9.1f %7.2f", preset, static_cast<long long>(quality.elements),
              quality.min_dihedral_deg, quality.per_million_under(30), quality.per_million_under(15),
              quality.mean_min_dihedral_deg());
  if (seconds > 0)
    std::printf(" %8.3f %12.0f", seconds, static_cast<double>(quality.elements) / seconds);
  std::printf("\n");
}

} // namespace

int main(int argc, char** argv) {
  const int n = argc > 1 ? std::atoi(argv[1]) : 500;
  const int repeats = argc > 2 ? std::atoi(argv[2]) : 3;
  if (n < 2 || repeats < 1) {
    std::fprintf(stderr, "usage: improver_surface [CELLS_PER_SIDE] [REPEATS]\n");
    return 2;
  }
  for (const test_input& input : make_inputs(n)) {
    std::printf("%s\n  %-8s %9s %8s %10s %9s %7s %8s %12s\n", input.name, "", "triangles", "min deg",
                "<30 per M", "<15 per M", "mean", "seconds", "per second");
    print_row("before", measure_quality(input.mesh), 0);
    for (const auto& [name, preset] :
         {std::pair{"fast", improvement::native::fast()}, std::pair{"fine", improvement::native::fine()},
          std::pair{"finest", improvement::native::finest()}}) {
      improvement::native improver = preset;
      improver.statistics = false;
      std::vector<double> seconds;
      simplicial_mesh<2> mesh;
      for (int k = 0; k < repeats; ++k) {
        mesh = input.mesh;
        const std::clock_t start = std::clock();
        improver(mesh, {}, {}, input.host);
        seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
      }
      std::nth_element(seconds.begin(), seconds.begin() + repeats / 2, seconds.end());
      print_row(name, measure_quality(mesh), seconds[repeats / 2]);
    }
  }
  return 0;
}
