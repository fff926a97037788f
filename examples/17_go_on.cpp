/// A run that goes on where another one has left off: what was made lies in a folder.
/// Usage: 17_go_on [FOLDER (default go_on_spool)]
#include "dovetail/models/implicit/shapes.hpp"
#include "dovetail/models/implicit_model.hpp"
#include "dovetail/parallel/checkpointed.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <cstdio>
#include <filesystem>
#include <string>

int main(int argc, char** argv) try {
  using namespace dovetail;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "go_on_spool";
  const implicit_model model(implicit::sphere{}, {{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}});
  // part checkpoint
  const int subdomains = 6;
  const double size = 0.15;
  const run_identity identity{{"model", "sphere"}, // all that the mesh depends on
                              {"size", std::to_string(size)},
                              {"subdomains", std::to_string(subdomains)}};
  const auto disk =
      spool::is_started(folder) ? spool::resume(folder, identity) : spool::start(folder, identity);
  const auto policies = parameters<>{}
                            .with_executor(parallel::checkpointed(parallel::threads{}, disk))
                            .with_options({.subdomains = subdomains});
  const auto result = generate<3>(model, uniform_size(size), policies);
  const auto found = result.summary.find("meshing").as<meshing_counts>().reused;
  // end
  std::printf("%lld tetrahedra in %zu pieces, of which %zu had been made before\n",
              static_cast<long long>(result.quality.elements), result.mesh.counts.size(), found);
  return result.failures.empty() ? 0 : 1;
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
