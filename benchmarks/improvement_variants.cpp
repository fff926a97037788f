// When to improve: the pieces as they were meshed, what the ranks have after redistribution by elements, or
// both; beside all of it at once. Interfaces stay in each. Low-quality elements have a dihedral angle under
// 24 degrees, bad ones under 12. Prints a Markdown table; seconds are those of the improver, of one core.
//
//   improvement_variants [MODEL] [ELEMENTS] [SUBDOMAINS] [RANKS]
//
// as in `redistribution`.
#include "many_pieces.hpp"

#include "dovetail/improver/native.hpp"
#include "dovetail/pipeline/by_elements.hpp"
#include "dovetail/pipeline/improve_pieces.hpp"

#include <cstdio>
#include <cstdlib>
#include <string>

using namespace dovetail;

namespace {

void print_row(const char* name, double improved, double seconds, const quality_statistics& quality) {
  std::printf("| %s | %.0f | %.1f | %.1f | %.1f | %.2f |\n", name, improved, seconds,
              quality.per_million_under(24), quality.per_million_under(12), quality.min_wedge_deg);
  std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
  const wanted_mesh wanted{argc > 1 ? argv[1] : "orbiter", argc > 2 ? std::atof(argv[2]) : 5e5,
                           argc > 3 ? std::atoi(argv[3]) : 80};
  const int ranks = argc > 4 ? std::atoi(argv[4]) : 4;
  const improvement::native improver;
  const redistribution_by::elements by_elements{.partitioner = partition::metis{}};
  const auto improve = [&](const many_pieces& from, int of_ranks) {
    return improve_pieces(*by_elements(from.made.mesh, of_ranks).mesh, improver, from.size,
                          parallel::serial{});
  };
  std::printf("| improved | elements improved | seconds | low per million | bad per million | least angle |\n"
              "|---|--:|--:|--:|--:|--:|\n");
  const auto in_pieces = mesh_in_pieces(wanted, improver);
  const report& meshing = in_pieces.made.summary.find("meshing");
  const double elements = meshing.get("elements"), seconds = meshing.get("improver_seconds");
  print_row("in pieces", elements, seconds, in_pieces.made.quality);
  const auto both = improve(in_pieces, ranks);
  print_row("in pieces, then what ranks have", elements + both.summary.get("elements"),
            seconds + both.summary.get("improver_seconds"), both.quality);
  const auto raw = mesh_in_pieces(wanted, any_improver<3>{});
  for (const int of_ranks : {ranks, 1}) {
    const auto after = improve(raw, of_ranks);
    print_row(of_ranks == 1 ? "all at once" : "what ranks have", after.summary.get("elements"),
              after.summary.get("improver_seconds"), after.quality);
  }
}
