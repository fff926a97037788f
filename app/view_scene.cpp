#include "view_scene.hpp"

#include "mesh_files.hpp"

#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

namespace dovetail::app {
namespace {

using tag_names = std::vector<std::pair<local_id, std::string>>;

template <class T>
std::size_t index(T i) {
  return static_cast<std::size_t>(i);
}

/// Tags as labels, in the order of the tags; of one without a name "word tag".
view_labels labels_of(std::span<const local_id> tags, const tag_names& names, const std::string& word) {
  std::map<local_id, local_id> known;
  for (const local_id tag : tags)
    known.emplace(tag, 0);
  view_labels labels;
  for (auto& [tag, label] : known) {
    label = static_cast<local_id>(labels.names.size());
    const auto named =
        std::find_if(names.begin(), names.end(), [t = tag](const auto& n) { return n.first == t; });
    labels.names.push_back(named == names.end() ? word + " " + std::to_string(tag) : named->second);
  }
  labels.of.reserve(tags.size());
  for (const local_id tag : tags)
    labels.of.push_back(known.find(tag)->second);
  return labels;
}

/// The triangles of a file, to be found by their vertices.
class tagged_triangles {
public:
  tagged_triangles(std::span<const simplex<2>> triangles, std::span<const local_id> tags) {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      known_.emplace_back(sorted(triangles[t]), t < tags.size() ? tags[t] : 0);
    std::sort(known_.begin(), known_.end());
  }
  std::optional<local_id> tag_of(const simplex<2>& triangle) const {
    const auto found = std::lower_bound(known_.begin(), known_.end(),
                                        std::pair(sorted(triangle), std::numeric_limits<local_id>::min()));
    if (found == known_.end() || found->first != sorted(triangle))
      return std::nullopt;
    return found->second;
  }

private:
  static simplex<2> sorted(simplex<2> triangle) {
    std::sort(triangle.begin(), triangle.end());
    return triangle;
  }
  std::vector<std::pair<simplex<2>, local_id>> known_;
};

/// Finds the groups of triangles one by one: tags of the file have their names, other sides get new ones.
class group_finder {
public:
  group_finder(view_scene& scene, const io::loaded_mesh& loaded)
      : scene_(scene), by_vertices_(loaded.triangles, loaded.triangle_tags),
        tags_(labels_of(loaded.triangle_tags, loaded.triangle_names, "group")),
        has_triangles_(!loaded.triangles.empty()) {
    for (std::size_t t = 0; t < loaded.triangle_tags.size(); ++t)
      label_of_tag_.emplace(loaded.triangle_tags[t], tags_.of[t]);
  }
  std::optional<local_id> of_file(const simplex<2>& side) const {
    return has_triangles_ ? by_vertices_.tag_of(side) : std::nullopt;
  }
  /// The label of a side.
  local_id label(std::optional<local_id> tag, bool outer, local_id element) {
    if (tag)
      return label_named(tags_.names[index(label_of_tag_.at(*tag))]);
    if (!outer)
      return label_named("between pieces");
    if (has_triangles_ || scene_.materials.names.size() < 2)
      return label_named(has_triangles_ ? "without a group" : "surface");
    return label_named("surface of " + scene_.materials.names[index(scene_.materials.of[index(element)])]);
  }

  /// Puts the labels into the order of the tags, with the others after them.
  void sort_labels() {
    std::vector<std::string> names = tags_.names;
    names.insert(names.end(), scene_.groups.names.begin(), scene_.groups.names.end());
    std::vector<local_id> label(scene_.groups.names.size(), no_id);
    std::vector<std::string> sorted;
    for (const std::string& name : names)
      if (const auto at = labels_.find(name); at != labels_.end() && label[index(at->second)] == no_id) {
        label[index(at->second)] = static_cast<local_id>(sorted.size());
        sorted.push_back(name);
      }
    for (local_id& of : scene_.groups.of)
      of = label[index(of)];
    scene_.groups.names = std::move(sorted);
  }

private:
  local_id label_named(const std::string& name) {
    const auto [at, is_new] = labels_.emplace(name, static_cast<local_id>(scene_.groups.names.size()));
    if (is_new)
      scene_.groups.names.push_back(name);
    return at->second;
  }

  view_scene& scene_;
  tagged_triangles by_vertices_;
  view_labels tags_;
  std::map<local_id, local_id> label_of_tag_;
  std::map<std::string, local_id> labels_;
  bool has_triangles_;
};

/// The sides to be seen of tetrahedra.
void add_sides(view_scene& scene, const io::loaded_mesh& loaded) {
  const simplicial_mesh<3>& mesh = loaded.mesh;
  const side_table<3> sides = build_sides(mesh);
  group_finder groups(scene, loaded);
  const auto region = [&](local_id e) {
    return std::pair(scene.pieces.of[index(e)], scene.materials.of[index(e)]);
  };
  const auto add = [&](std::size_t side, local_id element, std::optional<local_id> tag, bool outer) {
    scene.triangles.push_back(side_of_element(mesh, sides, static_cast<local_id>(side), element));
    scene.element_of.push_back(element);
    scene.groups.of.push_back(groups.label(tag, outer, element));
  };
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (sides.is_boundary(static_cast<local_id>(s)))
      add(s, sides.elements[s][0], groups.of_file(sides.vertices[s]), true);
  scene.outer = scene.triangles.size();
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (sides.is_boundary(static_cast<local_id>(s)))
      continue;
    const auto tag = groups.of_file(sides.vertices[s]);
    const auto& [first, second] = sides.elements[s];
    if (tag || sides.is_non_manifold(static_cast<local_id>(s)) || region(first) != region(second))
      for (const local_id element : sides.all_elements(static_cast<local_id>(s)))
        add(s, element, tag, false);
  }
  groups.sort_labels();
}

template <int D>
void measure(view_scene& scene, const std::vector<simplex<D>>& elements) {
  std::vector<bool> used(scene.points.size());
  scene.angles.reserve(elements.size());
  for (const auto& element : elements) {
    scene.angles.push_back(
        static_cast<float>(extreme_dihedral_angles(corners(span_of(scene.points), element))[0]));
    for (const local_id v : element)
      used[index(v)] = true;
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
    const std::size_t piece = index(scene.piece_of_triangle(t));
    scene.centres[piece] += area / 3 * (p[0] + p[1] + p[2]);
    areas[piece] += area;
  }
  for (std::size_t k = 0; k < areas.size(); ++k)
    scene.centres[k] = areas[k] > 0 && areas.size() > 1 ? scene.centres[k] / areas[k] : scene.box.center();
}

/// Whether the surface turns at an edge by more than 35 degrees.
bool turns(const view_scene& scene, local_id a, local_id b) {
  const auto normal = [&](local_id t) {
    const auto p = corners(span_of(scene.points), scene.triangles[index(t)]);
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
    if (!ends && scene.groups.of[index(a)] == scene.groups.of[index(b)] && !turns(scene, a, b))
      continue;
    const local_id piece = scene.piece_of_triangle(index(a));
    scene.outline.push_back({edges.vertices[e], piece});
    if (b != no_id && scene.piece_of_triangle(index(b)) != piece)
      scene.outline.push_back({edges.vertices[e], scene.piece_of_triangle(index(b))});
  }
}

view_scene scene_of_tetrahedra(io::loaded_mesh loaded) {
  view_scene scene;
  const std::size_t count = loaded.mesh.elements.size();
  loaded.mesh.tags.resize(count, 0);
  scene.materials = labels_of(loaded.mesh.tags, loaded.material_names, "material");
  scene.pieces =
      loaded.subdomains.size() == count ? labels_of(loaded.subdomains, {}, "piece") : scene.materials;
  add_sides(scene, loaded);
  scene.points = std::move(loaded.mesh.points);
  scene.tetrahedra = std::move(loaded.mesh.elements);
  measure<3>(scene, scene.tetrahedra);
  find_outline(scene);
  return scene;
}

view_scene scene_of_triangles(io::loaded_mesh loaded) {
  view_scene scene;
  scene.dimension = 2;
  const tag_names names = std::move(loaded.triangle_names);
  simplicial_mesh<2> mesh = take_triangles(std::move(loaded));
  mesh.tags.resize(mesh.elements.size(), 0);
  scene.groups = scene.pieces = scene.materials = labels_of(mesh.tags, names, "group");
  scene.points = std::move(mesh.points);
  scene.triangles = std::move(mesh.elements);
  scene.outer = scene.triangles.size();
  scene.element_of.resize(scene.outer);
  std::iota(scene.element_of.begin(), scene.element_of.end(), 0);
  find_outline(scene); // which refuses vertices that there are not
  measure<2>(scene, scene.triangles);
  return scene;
}

/// Adds `count` of some indices, evenly spread, or all.
void add_spread(std::vector<local_id>& to, std::span<const local_id> from, std::size_t count) {
  count = std::min(count, from.size());
  for (std::size_t k = 0; k < count; ++k)
    to.push_back(from[static_cast<std::size_t>(static_cast<double>(k) * static_cast<double>(from.size()) /
                                               static_cast<double>(count))]);
}

std::vector<local_id> elements_that_fit(const view_scene& scene, std::size_t room) {
  std::vector<local_id> all(scene.tetrahedra.size());
  std::iota(all.begin(), all.end(), 0);
  if (all.size() <= room)
    return all;
  const auto worst_end = all.begin() + static_cast<std::ptrdiff_t>((room + 1) / 2);
  std::partial_sort(all.begin(), worst_end, all.end(), [&](local_id a, local_id b) {
    return std::pair(scene.angles[index(a)], a) < std::pair(scene.angles[index(b)], b);
  });
  std::sort(worst_end, all.end());
  std::vector<local_id> kept(all.begin(), worst_end);
  add_spread(kept, std::span(worst_end, all.end()), room - kept.size());
  return kept;
}

} // namespace

float view_scene::least_angle() const {
  return angles.empty() ? 180 : *std::min_element(angles.begin(), angles.end());
}

view_scene scene_of(io::loaded_mesh loaded) {
  view_scene scene = is_of_triangles(loaded) ? scene_of_triangles(std::move(loaded))
                                             : scene_of_tetrahedra(std::move(loaded));
  find_centres(scene);
  return scene;
}

view_part part_that_fits(const view_scene& scene, std::int64_t most) {
  std::vector<local_id> all(scene.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  view_part part;
  const auto room = [&] { return static_cast<std::size_t>(most) - part.triangles.size(); };
  add_spread(part.triangles, std::span(all).first(scene.outer), room());
  add_spread(part.triangles, std::span(all).subspan(scene.outer), room());
  part.elements = elements_that_fit(scene, room() / 4);
  return part;
}

std::string text_of_left_out(const view_scene& scene, const view_part& part) {
  std::string text;
  const auto add = [&](std::size_t here, std::size_t all, const std::string& what) {
    if (here < all)
      text += (text.empty() ? "" : ", ") + std::to_string(here) + " of " + std::to_string(all) + what;
  };
  add(part.triangles.size(), scene.triangles.size(), " triangles of the surface and between pieces");
  add(part.elements.size(), scene.tetrahedra.size(), " elements inside, half of them the worst");
  return text.empty() ? text : "only " + text;
}

} // namespace dovetail::app
