/// Section 3.4 of the paper: the simplified background mesh, partitioned, and written by part.
/// Usage: p3_partition [MODEL.brep|step|stl [SIZE]]
#include "dovetail/files/write_vtu.hpp"
#include "dovetail/partition/recursive_coordinate.hpp"
#include "dovetail/pipeline/background.hpp"
#include "dovetail/pipeline/divide.hpp"
#include "dovetail/pipeline/parameters.hpp"
#include "dovetail/simplification/none.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "paper_model.hpp"

#include <cstdio>
#include <string>

namespace {

using namespace dovetail;

// part print
/// `divide` is the simplification of section 3.3 and then `decompose`: the partition, and its repairs.
template <int D>
divided_background<D> divided(const char* how, const background_result<D>& background, const auto& policies) {
  auto result = divide<D>(background.mesh, background.size, background.plan.subdomains, policies);
  std::printf("  %s: %d parts, imbalance %.2f, cut %.0f, smallest interface dihedral %.0f degrees, %zu "
              "angles under %s\n",
              how, static_cast<int>(result.pieces.parts), result.partition.get("imbalance"),
              result.partition.get("cut"), result.angles.min_dihedral_deg(), result.angles.violations.size(),
              D == 2 ? "50" : "30");
  return result;
}
// end

template <int D>
void show(int argc, char** argv) {
  const any_geometry model = paper::model<D>(argc, argv);
  const auto policies = parameters<>{}.with_options({.subdomains = 8, .coarse_scale = 3});
  const uniform_size size(paper::size<D>(argc, argv, model));
  // part partition
  const auto background = make_background<D>(model, size, policies);
  std::printf("D = %d: %zu elements\n", D, background.mesh.elements().elements.size());
  divided<D>("as it is, greedy", background, policies.with_simplifier(simplifier::none{}));
  divided<D>("simplified, by coordinates", background,
             policies.with_partitioner(partition::recursive_coordinate{}));
  const auto by_default = divided<D>("simplified, greedy", background, policies);

  simplicial_mesh<D> coloured = background.mesh.elements();
  coloured.tags = by_default.pieces.part_of_element;
  io::write_vtu(coloured, "p3_" + std::to_string(D) + "d.vtu");
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
