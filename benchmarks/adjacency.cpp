/// Seconds to build sides, neighbours and ridges of a large mesh of tetrahedra.
/// Usage: adjacency [cells per axis (default 118: 10 million tetrahedra)] [shuffled]
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/core/report.hpp"
#include "support/jittered_meshes.hpp"

#include <cstdio>
#include <cstdlib>
#include <string_view>

int main(int argc, char** argv) {
  const int cells = argc > 1 ? std::atoi(argv[1]) : 118;
  auto mesh = dovetail_test::jittered_cubes(cells);
  if (argc > 2 && std::string_view(argv[2]) == "shuffled")
    mesh = dovetail_test::shuffled(mesh, 1);
  const auto millions = static_cast<double>(mesh.elements.size()) * 1e-6;

  const dovetail::stopwatch sides_time;
  const auto sides = dovetail::build_sides(mesh);
  std::printf("%.2f M tetrahedra\nsides      %.2f s (%zu)\n", millions, sides_time.seconds(), sides.size());
  const dovetail::stopwatch neighbours_time;
  const auto neighbours = dovetail::element_neighbours(sides);
  std::printf("neighbours %.2f s (%zu)\n", neighbours_time.seconds(), neighbours.size());
  const dovetail::stopwatch ridges_time;
  const auto ridges = dovetail::build_ridges(mesh, sides);
  std::printf("ridges     %.2f s (%zu)\n", ridges_time.seconds(), ridges.size());
}
