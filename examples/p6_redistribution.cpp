/// Section 4 of the paper: many pieces, meshed in parallel, are repartitioned along clean interfaces for a
/// few ranks, and improved there with what bounds them fixed. Usage: p6_redistribution [MODEL.brep|step|stl
/// [SIZE]]
#include "dovetail/distributed/by_elements.hpp"
#include "dovetail/distributed/improve_pieces.hpp"
#include "dovetail/files/write_vtu.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "dovetail/solver/gather.hpp"
#include "paper_model.hpp"

#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace dovetail;

/// Writes a mesh by a number for each of its pieces.
template <int D>
void write(const distributed_simplicial_mesh<D>& mesh, const std::vector<local_id>& number_of_piece,
           const std::string& file) {
  auto whole = io::gather(mesh);
  for (std::size_t e = 0; e < whole.mesh.elements.size(); ++e)
    whole.mesh.tags[e] = number_of_piece[whole.subdomains[e]];
  io::write_vtu(whole.mesh, file);
}

template <int D>
void show(int argc, char** argv) {
  const any_geometry model = paper::model<D>(argc, argv);
  const uniform_size size(paper::size<D>(argc, argv, model));
  // part mesh
  constexpr int subdomains = 16,
                ranks = 4; // more subdomains than workers: what is heavy is balanced by the others
  auto policies = parameters<>{}.with_executor(parallel::threads{}).with_options({.subdomains = subdomains});
  const auto result = [&] {
    if constexpr (D == 3)
      return generate<D>(model, size, policies.with_improver(improvement::none{})); // improved below
    else
      return generate<D>(model, size, policies);
  }();
  std::printf("D = %d: %zu pieces, %lld elements\n", D, result.mesh.counts.size(),
              static_cast<long long>(result.quality.elements));
  // end

  // part redistribute
  const auto given = redistribution_by::elements{.super_elements = 500}(result.mesh, ranks);
  const report& account = given.summary;
  std::printf("  %.0f super-elements to %d ranks; interface sides: %.0f before, %.0f now\n",
              account.get("super_elements"), ranks, account.get("seams_before"),
              account.get("interface_sides"));
  // end
  std::vector<local_id> pieces;
  for (std::size_t p = 0; p < result.mesh.counts.size(); ++p)
    pieces.push_back(static_cast<local_id>(p));
  const std::string name = "p6_" + std::to_string(D) + "d_";
  write(result.mesh, pieces, name + "pieces.vtu");
  write(*given.mesh, given.rank_of_piece, name + "ranks.vtu");

  // part improve
  if constexpr (D == 3) {
    const auto improved = improve_pieces(*given.mesh, improvement::native{}, size, parallel::threads{});
    std::printf("  interfaces: smallest face angle %.0f, dihedral %.0f degrees\n",
                account.get("min_face_angle_deg"), account.get("min_dihedral_deg"));
    std::printf("  elements with a dihedral angle under 24 degrees: %lld, after the improvement %lld\n",
                static_cast<long long>(result.quality.min_dihedrals.below(24)),
                static_cast<long long>(improved.quality.min_dihedrals.below(24)));
  }
  // end
}

} // namespace

int main(int argc, char** argv) try {
  show<2>(argc, argv);
  show<3>(argc, argv);
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
