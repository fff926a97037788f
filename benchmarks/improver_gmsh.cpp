/// @file
/// Gmsh's own optimiser on raw meshes. Usage: improver_gmsh THRESHOLD[,THRESHOLD...] REPEATS MESH.raw...
/// Its seconds include handing the mesh over to Gmsh in a child process and back.
#include "dovetail/adapters/gmsh_improver.hpp"
#include "improver_runs.hpp"

#include <sstream>

int main(int argc, char** argv) try {
  if (argc < 4 || std::atoi(argv[2]) < 1) {
    std::cerr << "usage: improver_gmsh THRESHOLD[,THRESHOLD...] REPEATS MESH.raw...\n";
    return 2;
  }
  std::stringstream thresholds(argv[1]);
  for (std::string threshold; std::getline(thresholds, threshold, ',');)
    for (int i = 3; i < argc; ++i)
      improver_runs::run("Gmsh " + threshold,
                         dovetail::improvement::gmsh{.threshold = std::atof(threshold.c_str())},
                         std::atoi(argv[2]), argv[i]);
  return 0;
} catch (const dovetail::error& problem) {
  std::cerr << problem.what() << '\n';
  return 1;
}
