/// The pipeline stage by stage, for a question: how small an angle may two interfaces include, at which
/// threshold of the simplification, with the background mesh as it comes from the mesher and improved? Usage:
/// 08_thresholds FILE [SIZE [SUBDOMAINS]]
#include "dovetail/adapters/metis.hpp"
#include "dovetail/dovetail.hpp"
#include "dovetail/models/occt_model.hpp"

#include <cstdio>
#include <cstdlib>

namespace {

using namespace dovetail;

struct found_angles {
  double dihedral_deg;  ///< the smallest between two interfaces, or an interface and the surface
  std::size_t under_30; ///< angles of interfaces, and dihedrals beside them, under 30 degrees
  double refused_sides; ///< that should have gone, but for the weight of their super-element
};

// for the readme
found_angles decompose_at(double threshold_deg, const background_result<3>& background, int subdomains) {
  const auto& [surface, volume] = background.mesh; // paper, section 3.2
  const auto sides = build_sides(volume);
  const auto weights = predict_elements<3>(volume, background.size).per_element;
  std::vector<simplex<1>> on_curves;
  for (const auto& edge : surface.curve_edges)
    on_curves.push_back(edge.vertices);

  const auto simplified = simplify_coupled( // 3.3
      {surface.mesh, {.fixed_sides = on_curves}}, {volume, sides, {.element_weights = weights}},
      simplifier::paper{.volume_dihedral_deg = threshold_deg},
      {.subdomains = static_cast<double>(subdomains)});
  const auto& kept = simplified.volume;
  const auto pieces = decompose<3>(volume, sides, kept.super_of_element, kept.graph, volume.tags, // 3.4
                                   partition::metis{}, subdomains);

  const auto angles = measure_interface_angles<3>({volume, sides, kept.side_states, pieces.part_of_element},
                                                  {.face_deg = 30, .dihedral_deg = 30});
  return {angles.min_dihedral_deg(), angles.violations.size(), kept.summary.get("refused_sides")};
}
// end

} // namespace

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::puts("usage: 08_thresholds FILE [SIZE [SUBDOMAINS]]");
    return 2;
  }
  const auto model = read_occt_model(argv[1]).model;
  const uniform_size size(argc > 2 ? std::atof(argv[2]) : model.bounds().diagonal() / 25);
  const auto policies = parameters<>{};
  const int subdomains = argc > 3 ? std::atoi(argv[3]) : 16;
  const auto improved = make_background<3>(model, size, policies);
  const auto raw = make_background<3>(model, size, policies.with_background_improver(improvement::none{}));
  std::puts("smallest dihedral, angles under 30 degrees, sides refused");
  std::puts("threshold      background as it comes      improved");
  for (const double threshold : {0.0, 10.0, 20.0, 30.0, 40.0}) {
    std::printf("%9.0f", threshold);
    for (const auto* background : {&raw, &improved}) {
      const auto found = decompose_at(threshold, *background, subdomains);
      std::printf("     %6.1f %6zu %6.0f", found.dihedral_deg, found.under_30, found.refused_sides);
    }
    std::puts("");
  }
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
