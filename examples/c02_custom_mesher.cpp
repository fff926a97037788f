/// A mesher of one's own, used by the whole pipeline.
/// Usage: c02_custom_mesher FILE
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/mesher/wraps.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

// part mesher
/// Meshes each subdomain by TetGen with elements that grow towards the subdomain's centre. Its boundary stays
/// as it is, so that neighbours fit. All else is as in TetGen: traits, the form for the background mesh.
struct coarse_core : dovetail::mesher::wraps<coarse_core, dovetail::mesher::tetgen> {
  double growth = 2; ///< the size at the centre over the size asked for

  dovetail::mesher_result<3> operator()(const dovetail::mesher_input<3>& input,
                                        const dovetail::any_sizing& size) const {
    dovetail::box3 box;
    for (const dovetail::vec3& p : input.boundary.points)
      box.include(p);
    const double radius = 0.5 * box.diagonal();
    const auto coarser_inside = [&](dovetail::vec3 p) {
      const double depth = 1 - std::min(1.0, norm(p - box.center()) / radius); // 1 at the centre
      return size(p) * (1 + (growth - 1) * depth);
    };
    return wrapped(input, coarser_inside);
  }

  /// What is tried next where this fails: plain TetGen.
  std::vector<coarse_core> fallbacks() const {
    coarse_core plain = *this;
    plain.growth = 1;
    return {plain};
  }
};
static_assert(dovetail::boundary_keeping_mesher<coarse_core, 3>);
// end

int main(int argc, char** argv) try {
  using namespace dovetail;
  const auto model = read_occt_model(argc > 1 ? argv[1] : "").model;
  const uniform_size size(model.bounds().diagonal() / 25);
  const auto plain = generate<3>(model, size, parameters<>{}.with_mesher(mesher::tetgen{}));
  // part use
  coarse_core coarse;
  coarse.growth = 3;
  const auto grown = generate<3>(model, size, parameters<>{}.with_mesher(coarse));
  // end
  std::printf("%lld tetrahedra of one size, %lld with a coarse core in each of %zu subdomains\n",
              static_cast<long long>(plain.quality.elements), static_cast<long long>(grown.quality.elements),
              grown.mesh.counts.size());
  return grown.failures.empty() ? 0 : 1;
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
