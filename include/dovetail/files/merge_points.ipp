/// @file
/// What `merge_points.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/files/merge_points.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail::io {

DOVETAIL_INLINE void complete_point_data(loaded_mesh& mesh) {
  if (mesh.node_ids.size() != mesh.mesh.points.size())
    mesh.node_ids.clear();
  if (mesh.subdomains.size() != mesh.mesh.elements.size())
    mesh.subdomains.clear();
  if (mesh.triangle_subdomains.size() != mesh.triangles.size())
    mesh.triangle_subdomains.clear();
  for (auto& array : mesh.point_scalars)
    array.values.resize(mesh.mesh.points.size(), std::numeric_limits<double>::quiet_NaN());
}

DOVETAIL_INLINE void append_part(loaded_mesh& mesh, loaded_mesh part) {
  const auto first = static_cast<local_id>(mesh.mesh.points.size());
  if (part.mesh.points.size() >
      static_cast<std::size_t>(std::numeric_limits<local_id>::max()) - mesh.mesh.points.size())
    throw input_error("the mesh is too large to be read at once");
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  const auto append_simplices = [&](auto& to, auto& from) {
    for (auto& vertices : from)
      for (local_id& v : vertices)
        v += first;
    append(to, from);
  };
  append_simplices(mesh.mesh.elements, part.mesh.elements);
  append_simplices(mesh.triangles, part.triangles);
  append_simplices(mesh.middles, part.middles);
  append_simplices(mesh.triangle_middles, part.triangle_middles);
  append(mesh.mesh.tags, part.mesh.tags);
  append(mesh.triangle_tags, part.triangle_tags);
  append(mesh.subdomains, part.subdomains);
  append(mesh.triangle_subdomains, part.triangle_subdomains);
  append(mesh.node_ids, part.node_ids);
  for (const point_array& theirs : part.point_scalars) {
    if (mesh.scalars(theirs.name) == nullptr)
      mesh.point_scalars.push_back({theirs.name, {}});
    for (point_array& array : mesh.point_scalars)
      if (array.name == theirs.name) {
        array.values.resize(static_cast<std::size_t>(first), std::numeric_limits<double>::quiet_NaN());
        append(array.values, theirs.values);
      }
  }
  append(mesh.mesh.points, part.mesh.points);
  for (const std::string& what : part.passed_over)
    mesh.pass_over(what);
  if (mesh.material_names.empty())
    mesh.material_names = std::move(part.material_names);
  if (mesh.triangle_names.empty())
    mesh.triangle_names = std::move(part.triangle_names);
}

namespace detail {

/// The first of all points that are the same as each point, and all points in an order in which equal ones
/// follow each other: by global id, or by coordinates where there are no ids.
struct equal_points {
  std::vector<local_id> first;
  std::vector<local_id> order;
};

/// Throws `input_error` when points with the same global id are at different places.
inline equal_points find_equal_points(const std::vector<vec3>& points, const std::vector<global_id>& ids) {
  const bool numbered = ids.size() == points.size();
  const auto at = [&](local_id v) { return points[v]; };
  const auto id = [&](local_id v) { return ids[v]; };
  const auto key = [&](local_id v) { return std::tuple(at(v).x, at(v).y, at(v).z); };
  const auto same = [&](local_id a, local_id b) { return numbered ? id(a) == id(b) : at(a) == at(b); };
  equal_points result{std::vector<local_id>(points.size()), std::vector<local_id>(points.size())};
  auto& order = result.order;
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](local_id a, local_id b) {
    return same(a, b) ? a < b : numbered ? id(a) < id(b) : key(a) < key(b);
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool repeated = i > 0 && same(order[i - 1], order[i]);
    auto& first = result.first[order[i]];
    first = repeated ? result.first[order[i - 1]] : order[i];
    if (repeated && at(first) != at(order[i]))
      throw input_error("two points have the global number " + std::to_string(id(first)) +
                        " but not the same coordinates");
  }
  return result;
}

} // namespace detail

DOVETAIL_INLINE bool repeats_points(const loaded_mesh& mesh) {
  const auto& ids = mesh.node_ids;
  if (std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<>()) == ids.end())
    return false;
  std::vector<local_id> order(ids.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](local_id a, local_id b) { return ids[a] == ids[b] ? a < b : ids[a] < ids[b]; });
  bool repeated = false;
  for (std::size_t i = 1; i < order.size(); ++i)
    if (ids[order[i]] == ids[order[i - 1]]) {
      repeated = true;
      if (mesh.mesh.points[order[i]] != mesh.mesh.points[order[i - 1]])
        return false;
    }
  return repeated;
}

DOVETAIL_INLINE void merge_points(loaded_mesh& mesh) {
  const auto equal = detail::find_equal_points(mesh.mesh.points, mesh.node_ids);
  std::vector<local_id> kept;
  for (const auto v : equal.order)
    if (equal.first[v] == v)
      kept.push_back(v);
  if (mesh.node_ids.empty())
    std::sort(kept.begin(), kept.end());
  std::vector<local_id> place(mesh.mesh.points.size(), no_id);
  for (std::size_t i = 0; i < kept.size(); ++i)
    place[kept[i]] = static_cast<local_id>(i);
  const auto renumber = [&](auto& simplices) {
    for (auto& simplex : simplices)
      for (auto& v : simplex)
        v = place[equal.first[v]];
  };
  renumber(mesh.mesh.elements);
  renumber(mesh.triangles);
  renumber(mesh.middles);
  renumber(mesh.triangle_middles);
  mesh.mesh.points = detail::chosen(mesh.mesh.points, kept);
  if (!mesh.node_ids.empty())
    mesh.node_ids = detail::chosen(mesh.node_ids, kept);
  for (auto& array : mesh.point_scalars)
    array.values = detail::chosen(array.values, kept);
  for (auto& field : mesh.point_fields) {
    const auto size = static_cast<std::size_t>(field.components);
    std::vector<double> values;
    for (const auto v : kept)
      values.insert(values.end(), &field.values[v * size], &field.values[v * size] + size);
    field.values = std::move(values);
  }
}

} // namespace dovetail::io
