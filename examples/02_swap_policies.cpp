/// The same model with other partitioners, improvers and executors: one token of a row changes, nothing else.
/// Usage: 02_swap_policies FILE [SUBDOMAINS (default 6)]    (STEP, IGES or BREP)
#include "dovetail/adapters/metis.hpp"
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/dovetail.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/partition/inertial.hpp"

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) try {
  using namespace dovetail;
  if (argc < 2) {
    std::puts("usage: 02_swap_policies FILE [SUBDOMAINS]");
    return 2;
  }
  const auto model = read_occt_model(argv[1]).model;
  const uniform_size size(model.bounds().diagonal() / 25);
  generate_options options;
  options.subdomains = argc > 2 ? std::atoi(argv[2]) : 6;
  const auto defaults = parameters<>{}.with_options(options).with_mesher(mesher::tetgen{});

  std::printf("%-24s%10s%12s%12s%10s\n", "", "elements", "interfaces", "smallest", "seconds");
  const auto row = [&](const char* changed, const auto& policies) {
    const stopwatch clock;
    const auto result = generate<3>(model, size, policies);
    std::printf("%-24s%10lld%11.1f°%11.1f°%10.1f\n", changed, static_cast<long long>(result.quality.elements),
                result.coarse_angles.min_dihedral_deg(), result.quality.min_dihedral_deg, clock.seconds());
  };
  row("greedy, native, serial", defaults);
  row("metis", defaults.with_partitioner(partition::metis{}));
  row("inertial", defaults.with_partitioner(partition::inertial{}));
  row("native fast", defaults.with_improver(improvement::native::fast()));
  row("processes", defaults.with_executor(parallel::processes{}));
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
