/// Section 3.2 of the paper: the background mesh, from the sizes scaled up by several factors.
/// Usage: p1_background [MODEL.brep|step|stl [SIZE]]
#include "dovetail/files/write_vtu.hpp"
#include "dovetail/pipeline/background.hpp"
#include "dovetail/pipeline/parameters.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "paper_model.hpp"

#include <cstdio>
#include <string>

namespace {

using namespace dovetail;

template <int D>
void show(int argc, char** argv) {
  // part scales
  const any_geometry model = paper::model<D>(argc, argv);
  const uniform_size size(paper::size<D>(argc, argv, model));
  for (const double scale : {2.0, 3.0, 4.0}) {
    const auto policies = parameters<>{}.with_options({.subdomains = 8, .coarse_scale = scale});
    const background_result<D> background = make_background<D>(model, size, policies);
    const surface_mesh& surface = background.mesh.surface;
    const simplicial_mesh<D>& elements =
        background.mesh.elements(); // of the surface (D = 2) or the volume (D = 3)
    std::printf("D = %d, sizes times %.0f: %zu surface triangles on %zu faces, %zu elements; %.0f wanted\n",
                D, scale, surface.mesh.elements.size(), model.topology().faces.size(),
                elements.elements.size(), background.plan.predicted_elements);
    if (scale == 3)
      io::write_vtu(elements, "p1_" + std::to_string(D) + "d.vtu");
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
