// Redistribution by elements: what its steps cost, and what the interfaces are like before and after.
//
//   redistribution [MODEL] [ELEMENTS] [SUBDOMAINS] [RANKS]
//
// MODEL is the name of a built-in model (orbiter), meshed by TetGen and the own improver at about ELEMENTS
// (500000) elements in SUBDOMAINS (80) pieces, which go to RANKS (4). Seconds are processor time of one core.
#include "many_pieces.hpp"

#include "dovetail/adapters/metis.hpp"
#include "dovetail/distributed/by_elements.hpp"
#include "dovetail/distributed/by_pieces.hpp"
#include "dovetail/distributed/piece_supers.hpp"
#include "dovetail/improver/native.hpp"

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

using namespace dovetail;

namespace {

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void print_steps(const distributed_mesh& mesh, const redistribution_by::elements& how) {
  const io::sides_by_subdomain<3> sides(mesh);
  double loading = 0, simplifying = 0, elements = 0;
  for (local_id p = 0; p < static_cast<local_id>(mesh.counts.size()); ++p) {
    const double start = processor_seconds();
    const auto piece = io::load_checked(mesh, p);
    const double loaded = processor_seconds();
    simplify_piece<3>(piece, mesh.skeleton, sides[p], how.simplify_by, how.super_elements);
    loading += loaded - start;
    simplifying += processor_seconds() - loaded;
    elements += static_cast<double>(piece.mesh.elements.size());
  }
  std::printf("Simplification of %.0f elements: %.2f s, %.0f elements/s; loading them %.2f s.\n\n", elements,
              simplifying, elements / simplifying, loading);
}

void print_row(const char* name, const report& summary, double seconds) {
  std::printf("| %s | %.3f | %.0f | %.0f | %.0f | ", name, summary.get("imbalance"),
              summary.get("sides_between_ranks"), summary.get("disconnected_ranks"),
              summary.get("most_neighbours"));
  if (summary.get("avoidable_angles", -1) >= 0) // they are measured by elements alone
    std::printf("%.1f | %.1f | %.0f", summary.get("min_face_angle_deg"), summary.get("min_dihedral_deg"),
                summary.get("avoidable_angles"));
  else
    std::printf("| |");
  std::printf(" | %.2f |\n", seconds);
}

} // namespace

int main(int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "orbiter";
  const double wanted = argc > 2 ? std::atof(argv[2]) : 5e5;
  const int subdomains = argc > 3 ? std::atoi(argv[3]) : 80;
  const int ranks = argc > 4 ? std::atoi(argv[4]) : 4;
  const auto given_mesh = mesh_in_pieces({name, wanted, subdomains}, improvement::native{});
  const distributed_mesh& mesh = given_mesh.made.mesh;
  const redistribution_by::elements by_elements{.partitioner = partition::metis{}};
  print_steps(mesh, by_elements);
  std::printf(
      "| | imbalance | sides between ranks | disconnected ranks | most neighbours | least face angle | "
      "least dihedral | avoidable small angles | seconds |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  double start = processor_seconds();
  const auto whole = redistribution_by::pieces{.partitioner = partition::metis{}}(mesh, ranks);
  print_row("by pieces", whole.summary, processor_seconds() - start);
  start = processor_seconds();
  const auto given = by_elements(mesh, ranks);
  print_row("by elements", given.summary, processor_seconds() - start);
  std::printf("\nOf %.0f sides of interfaces %.0f are left, and there are %.0f in all; small angles: %.0f.\n",
              given.summary.get("seams_before"), given.summary.get("seams_after"),
              given.summary.get("interface_sides"), given.summary.get("small_angles"));
  for (const report& step : given.summary.children)
    std::printf("%s: %.2f s\n", step.name.c_str(), step.seconds);
}
