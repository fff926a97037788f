/// Section 3.3 of the paper: a background mesh simplified on its dual graphs, and written by super-element.
/// Usage: p2_simplification [MODEL.brep|step|stl [SIZE]]
#include "dovetail/files/write_vtu.hpp"
#include "dovetail/pipeline/background.hpp"
#include "dovetail/pipeline/parameters.hpp"
#include "dovetail/simplification/paper.hpp"
#include "dovetail/simplification/shape_only.hpp"
#include "dovetail/simplification/simplify_coupled.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "paper_model.hpp"

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace dovetail;

// part simplify
/// The rule's thresholds are the paper's. In D = 3 the surface goes first: what is removed of it takes the
/// faces at it along.
template <int D>
simplification simplified(const simplicial_background<D>& coarse, const mesh_duals<D>& duals,
                          const auto& rule, const contraction_bound& bound) {
  std::vector<simplex<1>> on_curves; // feature lines stay
  for (const auto& edge : coarse.surface.curve_edges)
    on_curves.push_back(edge.vertices);
  const mesh_duals<2> surface(coarse.surface.mesh, {.fixed_sides = on_curves});
  if constexpr (D == 2)
    return simplify<2>(coarse.surface.mesh, surface, rule, bound);
  else
    return simplify_coupled(surface, duals, rule, bound).volume;
}
// end

template <int D>
void show(int argc, char** argv) {
  const any_geometry model = paper::model<D>(argc, argv);
  const auto policies = parameters<>{}.with_options({.subdomains = 8, .coarse_scale = 3});
  const auto coarse =
      make_background<D>(model, uniform_size(paper::size<D>(argc, argv, model)), policies).mesh;

  // part graphs
  const simplicial_mesh<D>& mesh = coarse.elements();
  const mesh_duals<D> duals(mesh); // every element weighs 1, as in the paper
  std::printf("D = %d: EDG of %zu elements, SDG of %zu sides and %zu dihedrals\n", D,
              duals.elements().element_count(), duals.dihedrals().side_count(),
              duals.dihedrals().angles().size());
  const contraction_bound bound{.subdomains = 8};
  const auto by_shape = simplified<D>(coarse, duals, simplifier::shape_only{}, bound);
  const auto result = simplified<D>(coarse, duals, simplifier::paper{}, bound);
  std::printf("  removed: %.0f sides, %.0f of them by shape alone; refused: %.0f; fixed: %.0f\n",
              result.summary.get("removed_sides"), by_shape.summary.get("removed_sides"),
              result.summary.get("refused_sides"), result.summary.get("fixed_sides"));
  // end

  // part supers
  const auto supers = static_cast<std::size_t>(result.super_count);
  std::vector<std::size_t> members(supers, 0);
  for (const local_id super : result.super_of_element)
    ++members[super];
  const auto merged = supers - static_cast<std::size_t>(std::count(members.begin(), members.end(), 1u));
  std::printf("  simplified EDG: %zu nodes, of which %zu are super-elements, the largest of %zu elements\n",
              supers, merged, *std::max_element(members.begin(), members.end()));

  simplicial_mesh<D> coloured = mesh;
  coloured.tags = result.super_of_element;
  io::write_vtu(coloured, "p2_" + std::to_string(D) + "d.vtu");
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
