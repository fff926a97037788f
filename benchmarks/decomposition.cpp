/// Seconds of processor time per step from a coarse mesh to subdomains: adjacency, simplification, partition,
/// repair. The mesh is a jittered lattice in a ball-like box, graded towards its centre, as is the sizing.
/// Usage: decomposition [elements (default 3000000)] [parts (default 256)] [partitioners (default metis
/// greedy; metis:4 tries four partitions, metis:groups partitions in groups)]
#include "dovetail/adapters/metis.hpp"
#include "dovetail/decomposition/decompose.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/partition/in_groups.hpp"
#include "dovetail/simplification/paper.hpp"
#include "dovetail/simplification/simplify.hpp"
#include "support/jittered_meshes.hpp"
#include "timed_partitioner.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace dovetail;

/// About as many tetrahedra as asked for, smaller towards the centre: the element size grows with the square
/// root of the distance.
simplicial_mesh<3> graded_mesh(double elements) {
  auto mesh =
      dovetail_test::jittered_cubes(std::max(2, static_cast<int>(std::lround(std::cbrt(elements / 6)))));
  for (vec3& p : mesh.points) {
    p = p - vec3{0.5, 0.5, 0.5};
    p = std::sqrt(norm(p)) * p;
  }
  return mesh;
}

/// Final elements per coarse element, for a size that grows linearly with the distance from the centre.
std::vector<double> predicted_elements(const simplicial_mesh<3>& mesh) {
  std::vector<double> weights;
  for (const auto& t : mesh.elements) {
    const auto at = [&](std::size_t k) { return mesh.points[t[k]]; };
    const double size = 0.002 + 0.02 * norm((at(0) + at(1) + at(2) + at(3)) / 4);
    weights.push_back(signed_volume(at(0), at(1), at(2), at(3)) / (0.12 * size * size * size));
  }
  return weights;
}

void print(const char* step, double elements, double seconds) {
  std::printf("  %-16s %8.2f s  %11.0f elements/s\n", step, seconds, elements / seconds);
  std::fflush(stdout);
}

struct coarse_mesh {
  simplicial_mesh<3> mesh;
  side_table<3> sides;
  simplification simplified;
  double simplification_seconds = 0;
};

template <graph_partitioner P>
void measure(const char* name, const P& policy, const coarse_mesh& coarse, int parts) {
  const auto n = static_cast<double>(coarse.mesh.elements.size());
  double partition_seconds = 0;
  const dovetail_benchmark::processor_clock clock;
  const auto pieces =
      decompose<3>(coarse.mesh, coarse.sides, coarse.simplified.super_of_element, coarse.simplified.graph, {},
                   dovetail_benchmark::timed<P>{policy, &partition_seconds}, parts);
  print(name, n, partition_seconds);
  const double seconds = clock.seconds();
  print("repair", n, seconds - partition_seconds);
  print("all steps", n, coarse.simplification_seconds + seconds);
  for (const char* key :
       {"imbalance", "cut_of_partitioner", "cut", "joined_strays", "repaired_super_elements",
        "refined_super_elements", "non_manifold_edges", "non_manifold_points"})
    std::printf("    %-24s %.10g\n", key, pieces.summary.get(key));
}

} // namespace

int main(int argc, char** argv) {
  const double elements = argc > 1 ? std::atof(argv[1]) : 3e6;
  const int parts = argc > 2 ? std::atoi(argv[2]) : 256;
  std::vector<std::string> partitioners(argv + std::min(argc, 3), argv + argc);
  if (partitioners.empty())
    partitioners = {"metis", "greedy"};
  coarse_mesh coarse;
  coarse.mesh = graded_mesh(elements);
  const auto n = static_cast<double>(coarse.mesh.elements.size());
  std::printf("%.0f elements, %d parts\n", n, parts);
  const dovetail_benchmark::processor_clock adjacency_clock;
  coarse.sides = build_sides(coarse.mesh);
  print("adjacency", n, adjacency_clock.seconds());
  const auto weights = predicted_elements(coarse.mesh);
  const contraction_bound bound{.subdomains = static_cast<double>(parts)};
  const dovetail_benchmark::processor_clock simplification_clock;
  coarse.simplified =
      simplify<3>(coarse.mesh, mesh_duals<3>(coarse.mesh, coarse.sides, {.element_weights = weights}),
                  simplifier::paper{}, bound);
  coarse.simplification_seconds = simplification_clock.seconds();
  print("simplification", n, coarse.simplification_seconds);
  std::printf("    super-elements           %d\n", coarse.simplified.super_count);
  for (const std::string& name : partitioners)
    if (name == "metis")
      measure("metis", partition::metis{}, coarse, parts);
    else if (name == "metis:4")
      measure("metis:4", partition::metis{.trials = 4}, coarse, parts);
    else if (name == "metis:groups")
      measure("metis:groups", partition::in_groups{partition::metis{}}, coarse, parts);
    else
      measure("greedy", partition::greedy{}, coarse, parts);
}
