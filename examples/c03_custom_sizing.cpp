/// Sizing fields of one's own: a struct, a lambda, and what the library makes of them.
/// Usage: c03_custom_sizing FILE
#include "dovetail/models/occt_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/compose.hpp"

#include <cmath>
#include <cstdio>

// part field
/// Fine in a plane, coarser away from it: a shear layer, a weld, a crack.
struct layer {
  dovetail::vec3 on, normal; ///< a point of the plane, its unit normal
  double finest = 1;         ///< the size in the plane
  double growth = 0.3;       ///< of the size per distance from the plane

  double operator()(dovetail::vec3 p) const { return finest + growth * std::abs(dot(p - on, normal)); }
};
static_assert(dovetail::sizing_field<layer>);
// end

int main(int argc, char** argv) try {
  using namespace dovetail;
  const auto model = read_occt_model(argc > 1 ? argv[1] : "").model;
  // part use
  const box3 box = model.bounds();
  const double coarse = box.diagonal() / 20;
  const layer weld{.on = box.center(), .normal = {1, 0, 0}, .finest = coarse / 6};
  const auto fine_corner = [&](vec3 p) { return coarse / 4 + 0.4 * norm(p - box.lower); };

  const auto size = minimum_of(weld, fine_corner, [=](vec3) { return coarse; });
  const auto result = generate<3>(model, size, parameters<>{});
  // end

  const mesh_piece piece = result.mesh.load(0);
  std::printf("%lld tetrahedra; %.3g is asked for at the centre, %.3g at the lower corner\n",
              static_cast<long long>(result.quality.elements), size(box.center()), size(box.lower));
  std::printf("the first subdomain has %zu points\n", piece.mesh.points.size());
  return result.failures.empty() ? 0 : 1;
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
