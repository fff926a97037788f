#include "view_scene.hpp"

#include "mesh_files.hpp"
#include "view_labels.hpp"
#include "view_sides.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/files/second_order_nodes.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/element_angles.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

namespace dovetail::app {
namespace {

/// The sides to be seen of tetrahedra.
void add_sides(view_scene& scene, const io::loaded_mesh& loaded) {
  const seen_sides sides = find_seen_sides(loaded, scene.pieces.of, scene.materials.of);
  tag_labels tags;
  for (const local_id tag : loaded.triangle_tags)
    tags.note(tag);
  tags.finish(loaded.triangle_names, "group");
  group_labels groups(scene, std::move(tags), !loaded.triangles.empty());
  for (const auto* some : {&sides.outer, &sides.inner})
    for (const seen_side& side : *some) {
      scene.triangles.push_back(side.vertices);
      scene.element_of.push_back(side.element);
      groups.add(side.tag, some == &sides.outer, side.element);
    }
  scene.outer = sides.outer.size();
  groups.sort();
}

template <int D>
void measure(view_scene& scene, const std::vector<simplex<D>>& elements) {
  std::vector<bool> used(scene.points.size());
  scene.count = elements.size();
  scene.angles.reserve(elements.size());
  for (const auto& element : elements) {
    scene.angles.push_back(least_angle_of(corners(span_of(scene.points), element)));
    scene.least_angle = std::min(scene.least_angle, scene.angles.back());
    for (const local_id v : element)
      used[v] = true;
  }
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v]) {
      scene.box.include(scene.points[v]);
      ++scene.vertices;
    }
}

/// By area; of a piece without triangles or area, or a single one, the middle of all.
void find_centres(view_scene& scene) {
  std::vector<double> areas(scene.pieces.names.size());
  scene.centres.resize(areas.size());
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const auto p = corners(span_of(scene.points), scene.triangles[t]);
    const double area = norm(cross(p[1] - p[0], p[2] - p[0]));
    const std::size_t piece = static_cast<std::size_t>(scene.piece_of_triangle(t));
    scene.centres[piece] += area / 3 * (p[0] + p[1] + p[2]);
    areas[piece] += area;
  }
  for (std::size_t k = 0; k < areas.size(); ++k)
    scene.centres[k] = areas[k] > 0 && areas.size() > 1 ? scene.centres[k] / areas[k] : scene.box.center();
}

/// Whether the surface turns at an edge by more than 35 degrees.
bool turns(const view_scene& scene, local_id a, local_id b) {
  const auto normal = [&](local_id t) {
    const auto p = corners(span_of(scene.points), scene.triangles[t]);
    return normalized(cross(p[1] - p[0], p[2] - p[0]));
  };
  return dot(normal(a), normal(b)) < std::cos(35 / degrees_per_radian);
}

void find_outline(view_scene& scene) {
  const auto outer = std::span(scene.triangles).first(scene.outer);
  const side_table<2> edges = build_sides<2>(outer, scene.points.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto& [a, b] = edges.elements[e];
    const bool ends = b == no_id || edges.is_non_manifold(static_cast<local_id>(e));
    if (!ends && scene.groups.of[a] == scene.groups.of[b] && !turns(scene, a, b))
      continue;
    const local_id piece = scene.piece_of_triangle(static_cast<std::size_t>(a));
    scene.outline.push_back({edges.vertices[e], piece});
    if (b != no_id && scene.piece_of_triangle(static_cast<std::size_t>(b)) != piece)
      scene.outline.push_back({edges.vertices[e], scene.piece_of_triangle(static_cast<std::size_t>(b))});
  }
}

view_scene scene_of_tetrahedra(io::loaded_mesh loaded) {
  view_scene scene;
  const std::size_t count = loaded.mesh.elements.size();
  // Of a large mesh nothing is kept in memory for longer than it is needed.
  loaded.point_scalars = {};
  loaded.node_ids = {};
  loaded.mesh.tags.resize(count, 0);
  scene.materials = labels_of(std::exchange(loaded.mesh.tags, {}), loaded.material_names, "material");
  scene.pieces = loaded.subdomains.size() == count
                     ? labels_of(std::exchange(loaded.subdomains, {}), {}, "piece")
                     : scene.materials;
  add_sides(scene, loaded);
  scene.points = std::move(loaded.mesh.points);
  scene.tetrahedra = std::move(loaded.mesh.elements);
  measure<3>(scene, scene.tetrahedra);
  return scene;
}

view_scene scene_of_triangles(io::loaded_mesh loaded) {
  view_scene scene;
  scene.dimension = 2;
  const tag_names names = std::move(loaded.triangle_names);
  const std::vector<local_id> subdomains = std::move(loaded.triangle_subdomains);
  simplicial_mesh<2> mesh = take_triangles(std::move(loaded));
  mesh.tags.resize(mesh.elements.size(), 0);
  scene.groups = scene.materials = labels_of(mesh.tags, names, "group");
  scene.pieces =
      subdomains.size() == mesh.elements.size() ? labels_of(subdomains, {}, "piece") : scene.groups;
  scene.points = std::move(mesh.points);
  scene.triangles = std::move(mesh.elements);
  scene.outer = scene.triangles.size();
  scene.element_of.resize(scene.outer);
  std::iota(scene.element_of.begin(), scene.element_of.end(), 0);
  for (std::size_t t = 0; t < scene.triangles.size(); ++t)
    for (const local_id v : scene.triangles[t])
      if (v < 0 || static_cast<std::size_t>(v) >= scene.points.size())
        throw mesh_error("triangle " + std::to_string(t) + " refers to point " + std::to_string(v) +
                         ", but the mesh has " + std::to_string(scene.points.size()) + " points");
  measure<2>(scene, scene.triangles);
  return scene;
}

std::vector<local_id> elements_that_fit(const view_scene& scene, std::size_t room) {
  std::vector<local_id> all(scene.tetrahedra.size());
  std::iota(all.begin(), all.end(), 0);
  if (all.size() <= room)
    return all;
  const auto worst_end = all.begin() + static_cast<std::ptrdiff_t>(view_part::worst_of(room));
  std::partial_sort(all.begin(), worst_end, all.end(), [&](local_id a, local_id b) {
    return std::pair(scene.angles[a], a) < std::pair(scene.angles[b], b);
  });
  std::sort(worst_end, all.end());
  std::vector<local_id> kept(all.begin(), worst_end);
  add_spread<local_id>(kept, std::span(worst_end, all.end()), room - kept.size());
  return kept;
}

} // namespace

view_scene scene_of(io::loaded_mesh loaded) {
  const bool second_order = io::detail::has_middles(loaded);
  if (second_order)
    loaded = io::corners_of(loaded);
  view_scene scene = is_of_triangles(loaded) ? scene_of_triangles(std::move(loaded))
                                             : scene_of_tetrahedra(std::move(loaded));
  scene.second_order = second_order;
  finish_scene(scene);
  return scene;
}

void finish_scene(view_scene& scene) {
  find_outline(scene);
  find_centres(scene);
}

view_room::view_room(std::size_t all_outer, std::size_t all_inner, std::size_t all_elements,
                     std::int64_t most) {
  const auto all = static_cast<std::size_t>(most);
  outer = std::min(all, all_outer);
  const std::size_t left = all - outer;
  elements = std::min(all_elements, left / 16);
  inner = std::min(all_inner, left - 4 * elements);
  elements = std::min(all_elements, (left - inner) / 4);
}

view_part part_that_fits(const view_scene& scene, std::int64_t most) {
  const view_room room(scene.outer, scene.triangles.size() - scene.outer,
                       scene.dimension == 3 ? scene.count : 0, most);
  std::vector<local_id> all(scene.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  view_part part;
  add_spread<local_id>(part.triangles, std::span(all).first(scene.outer), room.outer);
  add_spread<local_id>(part.triangles, std::span(all).subspan(scene.outer), room.inner);
  part.elements = elements_that_fit(scene, room.elements);
  return part;
}

std::string text_of_left_out(const view_scene& scene, const view_part& part) {
  std::string text;
  const auto add = [&](std::size_t here, std::size_t all, const std::string& what) {
    if (here < all)
      text += (text.empty() ? "" : ", ") + (here == 0 ? "none" : "only " + std::to_string(here)) + " of " +
              std::to_string(all) + what;
  };
  add(part.triangles.size(), scene.triangles.size(), " triangles of the surface and between pieces");
  if (scene.dimension == 3)
    add(part.elements.size(), scene.count,
        part.elements.empty() ? " elements inside" : " elements inside, half of them the worst");
  return text;
}

std::optional<float> complete_under(const view_scene& scene, const view_part& part) {
  if (scene.dimension != 3 || part.elements.size() == scene.count)
    return std::nullopt;
  const std::size_t worst = view_part::worst_of(part.elements.size());
  return worst == 0 ? scene.least_angle : scene.angles[part.elements[worst - 1]];
}

} // namespace dovetail::app
