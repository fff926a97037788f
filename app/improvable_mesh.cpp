#include "improvable_mesh.hpp"

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesh/unused_points.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace dovetail::app {
namespace {

/// Numbers that a file can give points: none twice, none negative.
bool are_numbers(std::vector<global_id> ids) {
  std::sort(ids.begin(), ids.end());
  return ids.empty() || (ids.front() >= 0 && std::adjacent_find(ids.begin(), ids.end()) == ids.end());
}

/// Appends the least numbers that are not there until there are `count`.
void fill_up(std::vector<global_id>& ids, std::size_t count) {
  std::vector<global_id> taken = ids;
  std::sort(taken.begin(), taken.end());
  auto next_taken = taken.begin();
  for (global_id next = 0; ids.size() < count; ++next) {
    while (next_taken != taken.end() && *next_taken < next)
      ++next_taken;
    if (next_taken == taken.end() || *next_taken != next)
      ids.push_back(next);
  }
}

} // namespace

template <int D>
improvable_mesh<D>::improvable_mesh(io::loaded_mesh from) : rest_(std::move(from)) {
  if (!are_numbers(rest_.node_ids))
    rest_.node_ids.clear();
  if constexpr (D == 3) {
    mesh = std::move(rest_.mesh);
    join_subdomains();
  } else {
    mesh = {std::move(rest_.mesh.points), std::move(rest_.triangles), std::move(rest_.triangle_tags)};
    rest_.triangles.clear();
  }
  freeze_interfaces();
}

/// Elements keep their tags: so they keep their subdomains too when these are part of it.
template <int D>
void improvable_mesh<D>::join_subdomains() {
  if (rest_.subdomains.empty())
    return;
  std::vector<std::array<local_id, 2>> of_element(mesh.elements.size());
  for (std::size_t e = 0; e < of_element.size(); ++e)
    of_element[e] = {mesh.tags.empty() ? 0 : mesh.tags[e], rest_.subdomains[e]};
  material_and_subdomain_ = of_element;
  sort_unique(material_and_subdomain_);
  mesh.tags.resize(mesh.elements.size());
  for (std::size_t e = 0; e < of_element.size(); ++e)
    mesh.tags[e] = static_cast<local_id>(
        std::lower_bound(material_and_subdomain_.begin(), material_and_subdomain_.end(), of_element[e]) -
        material_and_subdomain_.begin());
}

template <int D>
void improvable_mesh<D>::freeze_interfaces() {
  const auto tag = [&](local_id element) { return mesh.tags.empty() ? 0 : mesh.tags[element]; };
  std::vector<simplex<D - 1>> kept; // triangles of the file
  if constexpr (D == 3) {
    for (const simplex<2>& triangle : rest_.triangles)
      kept.push_back(sorted_vertices(triangle));
    sort_unique(kept);
  }
  std::vector<bool> stays(mesh.points.size(), false);
  const auto stay = [&](const auto& vertices) {
    for (const local_id v : vertices)
      stays[v] = true;
  };
  for (const simplex<2>& triangle : rest_.triangles)
    stay(triangle);
  const side_table<D> sides = build_sides(mesh);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto [first, second] = sides.elements[s];
    const bool is_interface = second != no_id && tag(first) != tag(second);
    if (is_interface || std::binary_search(kept.begin(), kept.end(), sorted_vertices(sides.vertices[s])))
      frozen.sides.push_back(sides.vertices[s]);
    if (is_interface || second == no_id)
      stay(sides.vertices[s]);
  }
  if (!rest_.triangles.empty() || !rest_.node_ids.empty())
    bring_forward(std::move(stays));
}

template <int D>
void improvable_mesh<D>::bring_forward(std::vector<bool> stays) {
  std::vector<local_id> order;
  for (const bool first : {true, false}) {
    for (std::size_t v = 0; v < stays.size(); ++v)
      if (stays[v] == first)
        order.push_back(static_cast<local_id>(v));
    if (first)
      frozen.points = static_cast<local_id>(order.size());
  }
  std::vector<local_id> place(order.size());
  std::vector<vec3> points;
  std::vector<global_id> ids;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto v = static_cast<std::size_t>(order[k]);
    place[v] = static_cast<local_id>(k);
    points.push_back(mesh.points[v]);
    if (!rest_.node_ids.empty() && stays[v])
      ids.push_back(rest_.node_ids[v]);
  }
  mesh.points = std::move(points);
  rest_.node_ids = std::move(ids);
  const auto renumber = [&](auto& simplices) {
    for (auto& vertices : simplices)
      for (local_id& v : vertices)
        v = place[v];
  };
  renumber(mesh.elements);
  renumber(rest_.triangles);
  renumber(frozen.sides);
}

template <int D>
io::loaded_mesh improvable_mesh<D>::put_back() && {
  io::loaded_mesh whole = std::move(rest_);
  whole.point_scalars.clear();
  // An improver leaves gaps where it has removed points before others that it may not renumber.
  drop_unused_points(mesh, static_cast<std::size_t>(frozen.points));
  if (!whole.node_ids.empty())
    fill_up(whole.node_ids, mesh.points.size());
  if constexpr (D == 3) {
    if (!material_and_subdomain_.empty()) {
      whole.subdomains.resize(mesh.elements.size());
      for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        const auto& [material, subdomain] = material_and_subdomain_[mesh.tags[e]];
        mesh.tags[e] = material;
        whole.subdomains[e] = subdomain;
      }
    }
    whole.mesh = std::move(mesh);
  } else {
    whole.mesh.points = std::move(mesh.points);
    whole.triangles = std::move(mesh.elements);
    whole.triangle_tags = std::move(mesh.tags);
  }
  return whole;
}

template class improvable_mesh<2>;
template class improvable_mesh<3>;

std::string left_out(const io::loaded_mesh& mesh) {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  const auto& ids = mesh.node_ids;
  const auto [least, most] = std::minmax_element(ids.begin(), ids.end());
  if (!are_numbers(ids))
    add("the numbers of points, which are negative or not unique");
  else if (!ids.empty() &&
           *most - *least >= static_cast<global_id>(ids.size())) // with gaps: they mean something
    add("the numbers of inner points, which are others now");
  for (const auto& array : mesh.point_scalars)
    add("the values '" + array.name + "' of points, which have moved");
  for (const auto& what : mesh.passed_over)
    add(what);
  return text;
}

} // namespace dovetail::app
