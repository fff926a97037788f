#include "surface_file.hpp"

#include "mesh_files.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/files/merge_points.hpp"
#include "dovetail/files/read_mesh.hpp"
#include "dovetail/files/zlib.hpp"
#include "dovetail/mesh/unused_points.hpp"
#include "dovetail/models/discrete/read.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace dovetail::app {
namespace {

io::loaded_mesh triangles_of_soup(triangle_soup soup) {
  io::loaded_mesh mesh;
  mesh.mesh.points = std::move(soup.points);
  mesh.triangles = std::move(soup.triangles);
  mesh.triangle_tags = std::move(soup.groups);
  for (std::size_t k = 0; k < soup.group_names.size(); ++k)
    mesh.triangle_names.emplace_back(static_cast<local_id>(k), soup.group_names[k]);
  return mesh;
}

/// Triangles of no group get one of their own, the first that is free.
void complete_tags(std::vector<local_id>& tags, std::size_t triangles) {
  tags.resize(triangles, no_id);
  const local_id free = tags.empty() ? 0 : std::max(no_id, *std::max_element(tags.begin(), tags.end())) + 1;
  for (local_id& tag : tags)
    tag = tag < 0 ? free : tag;
}

/// Returns how many triangles have lost their extent.
std::size_t drop_collapsed(simplicial_mesh<2>& surface) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < surface.elements.size(); ++t) {
    const auto& [a, b, c] = surface.elements[t];
    if (a == b || b == c || c == a)
      continue;
    surface.elements[kept] = surface.elements[t];
    surface.tags[kept++] = surface.tags[t];
  }
  const std::size_t dropped = surface.elements.size() - kept;
  surface.elements.resize(kept);
  surface.tags.resize(kept);
  return dropped;
}

} // namespace

surface_file read_surface_file(const std::filesystem::path& file) {
  const bool is_soup = !triangle_format_of(file).empty();
  io::loaded_mesh loaded =
      is_soup ? triangles_of_soup(read_triangles(file)) : io::read_mesh(file, io::zlib_expand);
  if (loaded.triangles.empty())
    throw input_error(file.string() +
                      ": there is no triangle in this file; give a closed surface of triangles");
  surface_file read;
  if (!loaded.mesh.elements.empty())
    read.warnings.push_back(file.string() + ": only its triangles are used, not its " +
                            std::to_string(loaded.mesh.elements.size()) + " tetrahedra");
  const std::size_t points_before = loaded.mesh.points.size();
  loaded.mesh.elements.clear();
  loaded.node_ids.clear(); // points are told apart by their places alone
  loaded.point_scalars.clear();
  io::merge_points(loaded);
  if (!is_soup && loaded.mesh.points.size() < points_before)
    read.warnings.push_back(file.string() + ": " + std::to_string(points_before - loaded.mesh.points.size()) +
                            " points are at the place of another one and became one with it");
  read.names = std::move(loaded.triangle_names);
  read.surface = take_triangles(std::move(loaded));
  complete_tags(read.surface.tags, read.surface.elements.size());
  if (const std::size_t dropped = drop_collapsed(read.surface); dropped > 0)
    read.warnings.push_back(file.string() + ": " + std::to_string(dropped) +
                            " triangles with two corners at one place are left out");
  drop_unused_points(read.surface);
  return read;
}

} // namespace dovetail::app
