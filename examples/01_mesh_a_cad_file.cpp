/// From a CAD file to a conforming tetrahedral mesh.
/// Usage: 01_mesh_a_cad_file FILE FOLDER [SIZE]    (STEP, IGES or BREP; SIZE is the wanted edge length)
#include "dovetail/adapters/metis.hpp"
#include "dovetail/dovetail.hpp"
#include "dovetail/models/occt_model.hpp"

#include <cstdio>
#include <cstdlib>

namespace {

void mesh_file(const char* file, const char* folder, double edge_length) {
  // for the readme
  using namespace dovetail;
  const auto model = read_occt_model(file).model;
  const uniform_size size(edge_length > 0 ? edge_length : model.bounds().diagonal() / 25);
  const auto policies = parameters<>{}
                            .with_partitioner(partition::metis{})
                            .with_improver(improvement::native::fine())
                            .with_executor(parallel::threads{});
  const auto result = generate<3>(model, size, policies);
  for (const auto& failure : result.failures)
    throw mesher_error("subdomain " + std::to_string(failure.subdomain) + ": " +
                       joined_reasons(failure.reasons));
  io::vtu_writer{}(result.mesh, folder);
  // end
  std::printf("%lld tetrahedra in %zu subdomains, smallest dihedral angle %.1f degrees\n",
              static_cast<long long>(result.quality.elements), result.mesh.counts.size(),
              result.quality.min_dihedral_deg);
}

} // namespace

int main(int argc, char** argv) try {
  if (argc < 3) {
    std::puts("usage: 01_mesh_a_cad_file FILE FOLDER [SIZE]");
    return 2;
  }
  mesh_file(argv[1], argv[2], argc > 3 ? std::atof(argv[3]) : 0);
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
