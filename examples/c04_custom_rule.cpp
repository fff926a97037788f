/// A simplification rule of one's own, used by the whole pipeline.
/// Usage: c04_custom_rule FILE
#include "dovetail/models/occt_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <tuple>

// part rule
/// No interface comes near a point, as far as subdomains stay in balance: what happens there is computed by
/// one worker. Elsewhere two interfaces include no angle under 30 degrees.
struct away_from {
  dovetail::vec3 point;
  double radius = 1;

  /// A side is the better an interface the farther it is from the point.
  template <int D>
  dovetail::side_judgement operator()(const dovetail::simplicial_mesh<D>& mesh,
                                      const dovetail::side_table<D>& sides) const {
    dovetail::side_judgement judged{.wanted_quality = radius, .wanted_angle_deg = 30};
    for (const auto& vertices : sides.vertices) {
      double nearest = radius;
      for (const auto v : vertices)
        nearest = std::min(nearest, distance(mesh.points[v], point));
      judged.quality.push_back(nearest);
    }
    return judged;
  }
  /// Of a small dihedral's two sides the nearer one goes; of equals the one whose removal makes less.
  bool prefer_removal(const dovetail::dihedral_side& a, const dovetail::dihedral_side& b) const {
    return std::tuple(a.quality, a.weight, a.side) < std::tuple(b.quality, b.weight, b.side);
  }
  /// What is decided on the surface stays there.
  std::optional<dovetail::ridge_decision> propagate(const dovetail::side_below&) const { return {}; }
  /// The weight of a side that balance forbids to remove, in the graph that is partitioned.
  double penalty(const dovetail::deficit& missed) const { return 1 + 200 * (1 - missed.fraction()); }
};
// end

int main(int argc, char** argv) try {
  using namespace dovetail;
  const auto model = read_occt_model(argc > 1 ? argv[1] : "").model;
  const auto box = model.bounds();
  // part use
  const auto plain = parameters<>{}.with_options({.subdomains = 8});
  const auto given = plain.with_simplifier(away_from{box.center(), 0.2 * box.diagonal()});
  const auto result = generate<3>(model, uniform_size(box.diagonal() / 25), given);
  // end
  std::printf("%lld tetrahedra in %zu subdomains\n", static_cast<long long>(result.quality.elements),
              result.mesh.counts.size());
  return result.failures.empty() ? 0 : 1;
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
