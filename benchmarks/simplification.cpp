/// Coarse elements per second of the simplification alone (adjacency given), D = 3 and D = 2.
/// Usage: simplification [cells per axis (default 40: 384,000 tetrahedra)]
#include "dovetail/simplification/paper.hpp"
#include "dovetail/simplification/simplify.hpp"
#include "support/jittered_meshes.hpp"

#include <cstdio>
#include <cstdlib>

namespace {

template <int D>
void measure(const dovetail::simplicial_mesh<D>& mesh) {
  const auto sides = dovetail::build_sides(mesh);
  const auto result = dovetail::simplify(mesh, dovetail::mesh_duals<D>(mesh, sides),
                                         dovetail::simplifier::paper{}, {.subdomains = 32});
  const auto n = static_cast<double>(mesh.elements.size());
  std::printf("D = %d: %.0f elements -> %d super-elements, %.3f s, %.0f elements/s\n", D, n,
              result.super_count, result.summary.seconds, n / result.summary.seconds);
  for (const auto& [key, value] : result.summary.counters)
    std::printf("  %-24s %.6g\n", key.c_str(), value);
}

} // namespace

int main(int argc, char** argv) {
  const int cells = argc > 1 ? std::atoi(argv[1]) : 40;
  measure(dovetail_test::jittered_cubes(cells));
  measure(dovetail_test::jittered_squares(10 * cells));
}
