/// Section 3.5 of the paper: what bounds the subdomains, before and after it is remeshed to the sizes wanted.
/// Usage: p4_skeleton [MODEL.brep|step|stl [SIZE]]
#include "dovetail/files/write_vtu.hpp"
#include "dovetail/pipeline/background.hpp"
#include "dovetail/pipeline/divide.hpp"
#include "dovetail/pipeline/realize.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "paper_model.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <vector>

namespace {

using namespace dovetail;

// part boundaries
/// The boundary of every subdomain: a triangle between two of them is there for each.
struct boundaries {
  simplicial_mesh<2> mesh; ///< tags: subdomains

  void add(const simplex<2>& triangle, const std::array<local_id, 2>& subdomains) {
    for (const local_id subdomain : subdomains)
      if (subdomain != no_id) {
        mesh.elements.push_back(triangle);
        mesh.tags.push_back(subdomain);
      }
  }
};

void write_boundaries(const simplicial_background<3>& coarse, const realized<3>& made) {
  boundaries before{{coarse.points(), {}, {}}},
      after{{{made.fine.points.begin(), made.fine.points.end()}, {}, {}}};
  for (const skeleton_region& region : made.coarse.regions)
    for (const local_id t : region.triangles)
      before.add(coarse.surface.mesh.elements[t], region.subdomains);
  for (const skeleton_face& face : made.coarse.faces)
    before.add(face.vertices, face.subdomains);
  for (std::size_t s = 0; s < made.fine.sides.size(); ++s)
    after.add(made.fine.sides[s], made.fine.subdomains[s]);
  io::write_vtu(before.mesh, "p4_before.vtu");
  io::write_vtu(after.mesh, "p4_after.vtu");
}
// end

template <int D>
void show(int argc, char** argv) {
  const any_geometry model = paper::model<D>(argc, argv);
  const auto policies = parameters<>{}.with_options({.subdomains = 8, .coarse_scale = 3});
  const auto background =
      make_background<D>(model, uniform_size(paper::size<D>(argc, argv, model)), policies);
  const auto divided = divide<D>(background.mesh, background.size, 8, policies);
  // part realize
  skeleton_memo made_so_far;
  const realized<D> made =
      realize<D>(model, background.mesh, divided, divided.pieces.part_of_element,
                 static_cast<std::size_t>(divided.pieces.parts), background.size, made_so_far, policies);
  const auto lines_on = [&](int dimension) {
    return std::count_if(made.coarse.lines.begin(), made.coarse.lines.end(),
                         [&](const skeleton_line& line) { return line.on.dimension == dimension; });
  };
  const auto& faces = made.coarse.faces;
  const auto curved =
      std::count_if(faces.begin(), faces.end(), [](const auto& face) { return face.is_curved; });
  std::printf("D = %d: lines: %td on CAD curves, %td on CAD faces, %td inside; %zu regions;"
              " interface faces: %td curved, %td planar\n",
              D, lines_on(1), lines_on(2), lines_on(3), made.coarse.regions.size(), curved,
              std::ssize(faces) - curved);
  std::printf("  remeshed: %zu points, %zu sides\n", made.fine.points.size(), made.fine.sides.size());
  // end
  if constexpr (D == 3)
    write_boundaries(background.mesh, made);
}

} // namespace

int main(int argc, char** argv) try {
  show<2>(argc, argv);
  show<3>(argc, argv);
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
