/// TetGen alone, next to the pipeline: fills the boundary of a mesh that `dovetail mesh` wrote, in one piece
/// and at the same size, and prints a JSON line. Usage: tetgen_alone MESH (VTU, PVTU or MSH) SIZE
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/files/read_mesh.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include <malloc.h>

namespace {

using namespace dovetail;

/// The sides that have one element only, on points of their own, outwards. (Solids that touch become one.)
mesher_input<3> boundary_of(const simplicial_mesh<3>& mesh) {
  mesher_input<3> input;
  const auto sides = build_sides(mesh);
  std::vector<local_id> place(mesh.points.size(), no_id);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (!sides.is_boundary(static_cast<local_id>(s)))
      continue;
    simplex<2> triangle = sides.vertices[s];
    for (auto& vertex : triangle) {
      auto& own = place[vertex];
      if (own == no_id) {
        own = static_cast<local_id>(input.boundary.points.size());
        input.boundary.points.push_back(mesh.points[vertex]);
      }
      vertex = own;
    }
    input.boundary.elements.push_back(triangle);
  }
  return input;
}

/// From here on the peak is that of the mesher, not of the reader (Linux).
void forget_peak_memory() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

double peak_gigabytes() {
  std::ifstream status("/proc/self/status");
  for (std::string key; status >> key;)
    if (key == "VmHWM:") {
      double kilobytes = 0;
      status >> kilobytes;
      return kilobytes / (1 << 20);
    }
  return 0;
}

} // namespace

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::puts("usage: tetgen_alone MESH SIZE");
    return 2;
  }
  const auto input = boundary_of(io::read_mesh(argv[1]).mesh);
  forget_peak_memory();
  const stopwatch clock;
  const auto result = mesher::tetgen{}(input, any_sizing(uniform_size(std::atof(argv[2]))));
  const double seconds = clock.seconds();
  std::printf("{\"boundary_triangles\": %zu, \"elements\": %zu, \"seconds\": %.3f, \"peak_gib\": %.3f}\n",
              input.boundary.elements.size(), result.mesh.elements.size(), seconds, peak_gigabytes());
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
