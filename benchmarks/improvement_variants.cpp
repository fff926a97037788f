// When to improve, and what to do about interfaces: the pieces as they were meshed, what the ranks have after
// redistribution by elements, both, or that with the elements at the ranks' interfaces once more, as the
// paper's two baselines do (docs/baselines.md); beside all of it at once. Low-quality elements have a
// dihedral angle under 24 degrees, bad ones under 12. Prints Markdown tables; seconds are of one core.
//
//   improvement_variants [MODEL] [ELEMENTS] [SUBDOMAINS] [RANKS]
//
// as in `redistribution`.
#include "many_pieces.hpp"

#include "dovetail/distributed/by_elements.hpp"
#include "dovetail/distributed/improve_pieces.hpp"
#include "dovetail/experiments/baselines/ito_improvement.hpp"
#include "dovetail/experiments/baselines/loehner_improvement.hpp"
#include "dovetail/improver/any_improver.hpp"
#include "dovetail/improver/native.hpp"

#include <cstdio>
#include <cstdlib>
#include <string>

using namespace dovetail;

namespace {

void print_row(const char* name, double improved, double seconds, const quality_statistics& quality) {
  std::printf("| %s | %.0f | %.1f | %.1f | %.1f | %.2f |\n", name, improved, seconds,
              quality.per_million_under(24), quality.per_million_under(12), quality.min_dihedral_deg);
  std::fflush(stdout);
}

/// The rows of the paper's table 10; 0 where an improver has no such step.
void print_steps(const char* name, double redistribution, const report& made) {
  const auto seconds = [&](const char* step) { return made.find(step).seconds; };
  const report& moved = made.find(std::string(name) == "Ito" ? "collection" : "redistribution");
  std::printf("| %s | %.2f | %.2f | %.2f | %.2f | %.2f | %.0f | %.2f |\n", name, redistribution,
              seconds("first pass"), moved.seconds, seconds("second pass"), seconds("writing back"),
              moved.get("elements"), moved.get("largest_over_mean"));
}

} // namespace

int main(int argc, char** argv) {
  const wanted_mesh wanted{argc > 1 ? argv[1] : "orbiter", argc > 2 ? std::atof(argv[2]) : 5e5,
                           argc > 3 ? std::atoi(argv[3]) : 80};
  const int ranks = argc > 4 ? std::atoi(argv[4]) : 4;
  const improvement::native improver;
  const redistribution_by::elements by_elements{.partitioner = partition::metis{}};
  const auto improve = [&](const distributed_mesh& mesh, const any_sizing& size,
                           const improving_strategy& strategy) {
    return strategy(mesh, improver, size, parallel::serial{}, {});
  };
  std::printf("| improved | elements improved | seconds | low per million | bad per million | least angle |\n"
              "|---|--:|--:|--:|--:|--:|\n");
  const auto in_pieces = mesh_in_pieces(wanted, improver);
  const report& meshing = in_pieces.made.summary.find("meshing");
  const double elements = meshing.get("elements"), seconds = meshing.get("improver_seconds");
  print_row("in pieces", elements, seconds, in_pieces.made.quality);
  const auto print_second = [&](const char* name, const distributed_mesh& mesh,
                                const improving_strategy& strategy) {
    const auto second = improve(mesh, in_pieces.size, strategy);
    print_row(name, elements + second.summary.get("elements"),
              seconds + second.summary.get("improver_seconds"), second.quality);
  };
  print_second("in pieces, then again with a band around their interfaces", in_pieces.made.mesh,
               baselines::ito_improvement{});
  print_second("in pieces, then what ranks have", *by_elements(in_pieces.made.mesh, ranks).mesh,
               improve_pieces);
  const auto raw = mesh_in_pieces(wanted, any_improver<3>{});
  const auto of_ranks = by_elements(raw.made.mesh, ranks);
  const auto print = [&](const char* name, const improved_pieces& after) {
    print_row(name, after.summary.get("elements"), after.summary.get("improver_seconds"), after.quality);
  };
  print("what ranks have", improve(*of_ranks.mesh, raw.size, improve_pieces));
  const auto ito = improve(*of_ranks.mesh, raw.size, baselines::ito_improvement{});
  print("what ranks have, then layers at interfaces in one mesh (Ito)", ito);
  const auto loehner = improve(*of_ranks.mesh, raw.size, baselines::loehner_improvement{});
  print("what ranks have, then with layers of the next ranks (Loehner)", loehner);
  print("all at once", improve(*by_elements(raw.made.mesh, 1).mesh, raw.size, improve_pieces));

  std::printf("\n| improver | repartitioning | first pass | collection or redistribution | second pass | "
              "writing back | elements moved | largest piece over mean |\n"
              "|---|--:|--:|--:|--:|--:|--:|--:|\n");
  print_steps("Ito", of_ranks.summary.seconds, ito.summary);
  print_steps("Loehner", of_ranks.summary.seconds, loehner.summary);
}
