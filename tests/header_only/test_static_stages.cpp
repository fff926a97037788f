// The stages are bound to the model, the executor and the field that they are called with, and what holds any
// of these is one like others: it gives the same mesh.
#include "dovetail/background/coarse_surface.hpp"
#include "dovetail/background/coarse_volume.hpp"
#include "dovetail/background/tubes.hpp"
#include "dovetail/decomposition/decompose.hpp"
#include "dovetail/decomposition/extract_skeleton.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/intersection/suppression.hpp"
#include "dovetail/mesher/native.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/meshing/subdomain_surface.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/remesh/patch_remesher.hpp"
#include "dovetail/simplification/paper.hpp"
#include "dovetail/simplification/simplify_coupled.hpp"
#include "dovetail/skeleton/line_skeleton.hpp"
#include "dovetail/skeleton/remesh_lines.hpp"
#include "dovetail/skeleton/remesh_skeleton.hpp"
#include "dovetail/skeleton/segment_matching.hpp"

namespace {

template <class T>
concept is_defined = requires {
  sizeof(T);
};

} // namespace

namespace dovetail {

class any_executor;
class any_geometry;
static_assert(!is_defined<any_executor> && !is_defined<any_geometry>, "the stages do without them");

} // namespace dovetail

#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/models/implicit/shapes.hpp"
#include "dovetail/models/implicit_model.hpp"
#include "dovetail/parallel/any_executor.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <utility>
#include <vector>

using namespace dovetail;

namespace {

/// Two shapes that meet in a curve.
implicit_model body() {
  return {implicit::intersection(implicit::sphere{}, implicit::torus{}, 0.2),
          {{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}},
          {.resolution = 32}};
}

/// What the stages have made of a model.
struct made {
  surface_mesh surface;
  std::vector<std::int64_t> chord_facts; ///< of D = 2
  fine_skeleton skeleton;
  std::size_t matched = 0, crossings = 0;
  byte_buffer pieces;
};

template <geometry_model Geometry, sizing_field Size, sizing_field Coarse, executor Executor>
made by_stages(const Geometry& model, const Size& size, const Coarse& coarse, const Executor& run) {
  made result;
  const remesh::patch_remesher mesh_patch{};
  const mesher::native mesh_volume{};
  const improvement::native improve{};
  CHECK(background::sizes_at_tubes(model, size).empty());
  result.surface = background::coarse_surface(model, coarse, {}, run, mesh_patch).surface;
  const background_mesh background{
      result.surface,
      background::coarse_volume(result.surface, model.topology(), coarse, mesh_volume, improve, run).mesh};
  const auto& [surface, volume] = background;
  const auto sides = build_sides(volume);
  std::vector<simplex<1>> on_curves;
  for (const auto& edge : surface.curve_edges)
    on_curves.push_back(edge.vertices);
  const auto simplified = simplify_coupled({surface.mesh, {.fixed_sides = on_curves}}, {volume, sides, {}},
                                           simplifier::paper{}, {.subdomains = 3});
  const auto parts = decompose<3>(volume, sides, simplified.volume.super_of_element, simplified.volume.graph,
                                  volume.tags, partition::greedy{}, 3);
  coarse_skeleton skeleton = extract_skeleton(background, sides, parts.part_of_element);

  const refined_sizing sizes(size);
  memo<fine_line> made_lines(run, "skeleton");
  region_memo made_patches{{run, "patch"}};
  matched_faces made_segments;
  const auto number = [&] {
    return number_lines(skeleton, remesh_lines(model, skeleton.lines, volume.points, sizes, run, made_lines),
                        volume.points, surface.vertex_hosts);
  };
  numbered_lines lines = number();
  const skeleton_to_remesh of{model, surface, volume.points, skeleton, lines, sizes, parts.material_of_part};
  auto patches = mesh_patches(of, mesh_patch, run, made_patches);
  constexpr double wanted_deg = 40;
  result.matched = match_segments(model, volume.points, skeleton, {lines.lines, lines.names},
                                  faces_with_small_angles(patches, skeleton, made_patches, wanted_deg), sizes,
                                  wanted_deg, mesh_patch, run, made_segments);
  lines = number();
  result.skeleton = remesh_skeleton(of, mesh_patch, run, made_patches).fine;
  const std::vector<bool> planar(result.skeleton.sides.size(), false);
  result.crossings = plan_suppression(result.skeleton, planar, run).crossings;

  const auto sorted = sort_by_subdomain(result.skeleton, static_cast<std::size_t>(parts.parts));
  const auto source = [&](local_id s) {
    auto cut = boundary_of_subdomain(result.skeleton, sorted, s);
    return piece_input<3>{{std::move(cut.boundary), parts.material_of_part[s]},
                          std::move(cut.skeleton_points)};
  };
  const auto meshed =
      mesh_subdomains<3>(static_cast<std::size_t>(parts.parts), source, mesh_volume, improve, sizes, run);
  CHECK(meshed.failures.empty());
  byte_writer bytes;
  for (local_id s = 0; s < parts.parts; ++s)
    encode(bytes, meshed.load(s));
  result.pieces = bytes.take();

  const std::vector<local_id> one_part(surface.mesh.elements.size(), 0);
  const coarse_skeleton of_surface = extract_skeleton(surface, own_subdomains(one_part));
  const auto surface_lines =
      number_lines(of_surface, remesh_lines(model, of_surface.lines, volume.points, sizes, run, made_lines),
                   volume.points, surface.vertex_hosts);
  const auto edges = skeleton_of_lines(surface, build_sides(surface.mesh), one_part, surface_lines);
  result.chord_facts = chord_rule(model, of_surface, edges, surface_lines, surface)
                           .facts(std::vector<local_id>{0}, edges.sides.front());
  return result;
}

} // namespace

TEST_CASE("stages bound statically, and by what holds any model, executor and field, make the same") {
  const auto size = [](vec3 p) { return 0.16 + 0.02 * p.x; };
  const auto coarse = [](vec3 p) { return 0.48 + 0.06 * p.x; };
  const made bound = by_stages(body(), size, coarse, parallel::serial{});
  const made erased = by_stages(any_geometry(body()), any_sizing(size), any_sizing(coarse),
                                any_executor(parallel::serial{}, "serial"));
  REQUIRE(bound.skeleton.sides.size() > 500);
  CHECK(bound.matched > 0);
  CHECK(bound.surface.mesh.points == erased.surface.mesh.points);
  CHECK(bound.surface.mesh.elements == erased.surface.mesh.elements);
  CHECK(bound.chord_facts == erased.chord_facts);
  CHECK(bound.skeleton.points == erased.skeleton.points);
  CHECK(bound.skeleton.sides == erased.skeleton.sides);
  CHECK(bound.matched == erased.matched);
  CHECK(bound.crossings == erased.crossings);
  CHECK(bound.pieces == erased.pieces);
}
