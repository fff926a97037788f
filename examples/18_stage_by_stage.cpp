/// The stages of the method one by one, without the pipeline: a torus given by a function, sizes by another,
/// all tasks in this process. Each stage is bound to these at compile time, and nothing is needed but a
/// compiler.
#include "dovetail/background/coarse_surface.hpp"
#include "dovetail/background/coarse_volume.hpp"
#include "dovetail/decomposition/decompose.hpp"
#include "dovetail/decomposition/extract_skeleton.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/intersection/suppression.hpp"
#include "dovetail/mesher/native.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/meshing/subdomain_surface.hpp"
#include "dovetail/models/implicit_model.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/remesh/patch_remesher.hpp"
#include "dovetail/simplification/paper.hpp"
#include "dovetail/simplification/simplify_coupled.hpp"
#include "dovetail/skeleton/remesh_lines.hpp"
#include "dovetail/skeleton/remesh_skeleton.hpp"

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <vector>

int main() try {
  using namespace dovetail;
  const auto torus = [](vec3 p) { return std::hypot(std::hypot(p.x, p.y) - 1, p.z) - 0.4; };
  const implicit_model model(torus, {{-1.6, -1.6, -0.6}, {1.6, 1.6, 0.6}});
  const auto size = [](vec3 p) { return 0.08 + 0.04 * std::abs(p.x); };
  const auto coarse_size = [&](vec3 p) { return 3 * size(p); };
  const parallel::serial run;
  constexpr int subdomains = 8;

  // part stages
  // 3.2: the background mesh, a surface and what is in it
  const auto surface =
      background::coarse_surface(model, coarse_size, {}, run, remesh::patch_remesher{}).surface;
  const auto volume = background::coarse_volume(surface, model.topology(), coarse_size, mesher::native{},
                                                improvement::native{}, run)
                          .mesh;
  const background_mesh background{surface, volume};

  // 3.3: super-elements, between which interfaces may be
  const auto sides = build_sides(volume);
  std::vector<simplex<1>> on_curves;
  for (const auto& edge : surface.curve_edges)
    on_curves.push_back(edge.vertices);
  const auto simplified = simplify_coupled({surface.mesh, {.fixed_sides = on_curves}}, {volume, sides},
                                           simplifier::paper{}, {.subdomains = subdomains});

  // 3.4: their graph is partitioned; the boundaries of the subdomains are the skeleton
  const auto& graph = simplified.volume.graph;
  const auto cut = decompose<3>(volume, sides, simplified.volume.super_of_element, graph, volume.tags,
                                partition::greedy{}, subdomains);
  const auto skeleton = extract_skeleton(background, sides, cut.part_of_element);

  // 3.5: its lines are remeshed, then its faces between them
  const refined_sizing fine_size(size); // becomes smaller near crossings, if there are some
  memo<fine_line> lines_made;
  region_memo regions_made;
  const auto points = background.points();
  const auto lines =
      number_lines(skeleton, remesh_lines(model, skeleton.lines, points, fine_size, run, lines_made), points,
                   surface.vertex_hosts);
  const skeleton_to_remesh with_lines{
      model, surface, points, skeleton, lines, fine_size, cut.material_of_part};
  const auto remeshed = remesh_skeleton(with_lines, remesh::patch_remesher{}, run, regions_made);

  // 3.6: which subdomains would have to be merged, as their faces cross
  const std::vector<bool> is_planar(remeshed.fine.sides.size(), false);
  const auto suppression = plan_suppression(remeshed.fine, is_planar, run);

  // 4: each subdomain is meshed by itself
  const auto count = static_cast<std::size_t>(cut.parts);
  const auto triangles = sort_by_subdomain(remeshed.fine, count);
  const auto boundary_of = [&](local_id s) {
    const auto own = boundary_of_subdomain(remeshed.fine, triangles, s);
    const int material = cut.material_of_part[static_cast<std::size_t>(s)];
    return piece_input<3>{{own.boundary, material}, own.skeleton_points};
  };
  const auto pieces =
      mesh_subdomains<3>(count, boundary_of, mesher::native{}, improvement::native{}, fine_size, run);
  // end

  std::printf("background:   %zu triangles, %zu tetrahedra\n", surface.mesh.elements.size(),
              volume.elements.size());
  std::printf("simplified:   %d super-elements\n", static_cast<int>(simplified.volume.super_count));
  std::printf("skeleton:     %d subdomains, %zu lines, %zu interface faces\n", static_cast<int>(cut.parts),
              skeleton.lines.size(), skeleton.faces.size());
  std::printf("remeshed:     %zu triangles, %zu pairs of them cross\n", remeshed.fine.sides.size(),
              suppression.crossings);
  std::printf("meshed:       %lld tetrahedra, none under %.1f degrees\n",
              static_cast<long long>(pieces.quality.elements), pieces.quality.min_dihedral_deg);
  return remeshed.patches.failures.empty() && pieces.failures.empty() && suppression.crossings == 0 ? 0 : 1;
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
