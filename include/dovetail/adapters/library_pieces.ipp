/// @file
/// What `library_pieces.hpp` declares.
#pragma once

#include "dovetail/adapters/library_pieces.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/improver/concepts.hpp"
#include "dovetail/improver/point_numbering.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/mesh/validity.hpp"

#include <algorithm>
#include <cstddef>
#include <queue>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail::improvement::detail {

inline void require_tetrahedra(const simplicial_mesh<3>& mesh, const side_table<3>& sides,
                               const frozen_entities<3>& frozen) {
  if (!mesh.tags.empty() && mesh.tags.size() != mesh.elements.size())
    throw mesh_error("the mesh has " + std::to_string(mesh.elements.size()) + " elements but " +
                     std::to_string(mesh.tags.size()) + " tags");
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto v = sorted_vertices(mesh.elements[e]);
    if (std::adjacent_find(v.begin(), v.end()) != v.end())
      throw mesh_error("element " + std::to_string(e) + " uses a point twice");
  }
  if (!sides.further_elements.empty())
    throw mesh_error("more than two elements meet at side " +
                     std::to_string(sides.further_elements.front().first) + ", of element " +
                     std::to_string(sides.further_elements.front().second));
  for (const auto& side : frozen.sides) {
    const auto key = sorted_vertices(side);
    const auto found =
        std::lower_bound(sides.vertices.begin(), sides.vertices.end(), key,
                         [](const simplex<2>& a, const simplex<2>& b) { return sorted_vertices(a) < b; });
    if (found == sides.vertices.end() || sorted_vertices(*found) != key)
      throw mesh_error("frozen side (" + std::to_string(key[0]) + ", " + std::to_string(key[1]) + ", " +
                       std::to_string(key[2]) + ") is not a side of the mesh");
  }
}

/// The library's points in another order: fixed ones first, found by their exact coordinates. False when one
/// is missing.
inline bool restore_fixed_points(const library_piece& piece, simplicial_mesh<3>& made) {
  const auto less = [](vec3 a, vec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
  const auto fixed_point = [&](local_id v) { return piece.mesh.points[v]; };
  std::vector<local_id> sorted(piece.fixed_points);
  for (std::size_t v = 0; v < sorted.size(); ++v)
    sorted[v] = static_cast<local_id>(v);
  std::sort(sorted.begin(), sorted.end(),
            [&](local_id a, local_id b) { return less(fixed_point(a), fixed_point(b)); });
  std::vector<bool> is_used(made.points.size(), false);
  for (const auto& element : made.elements)
    for (const local_id v : element)
      is_used[v] = true;
  std::vector<vec3> points(piece.mesh.points.begin(),
                           piece.mesh.points.begin() + static_cast<std::ptrdiff_t>(piece.fixed_points));
  std::vector<local_id> number(made.points.size(), no_id);
  std::size_t found_count = 0;
  for (std::size_t v = 0; v < made.points.size(); ++v) {
    if (!is_used[v])
      continue;
    const auto found = std::lower_bound(sorted.begin(), sorted.end(), made.points[v],
                                        [&](local_id a, vec3 p) { return less(fixed_point(a), p); });
    if (found != sorted.end() && fixed_point(*found) == made.points[v]) {
      number[v] = *found;
      ++found_count;
    } else {
      number[v] = static_cast<local_id>(points.size());
      points.push_back(made.points[v]);
    }
  }
  if (found_count != piece.fixed_points)
    return false;
  made.points = std::move(points);
  for (auto& element : made.elements)
    for (local_id& v : element)
      v = number[v];
  return true;
}

/// Puts a new point at the centroid of element `e`, which becomes four.
inline void cut_at_centroid(simplicial_mesh<3>& mesh, std::size_t e) {
  const simplex<3> whole = mesh.elements[e];
  vec3 sum;
  for (const local_id v : whole)
    sum += mesh.points[v];
  const auto centroid = static_cast<local_id>(mesh.points.size());
  mesh.points.push_back(sum / 4);
  mesh.elements[e][0] = centroid;
  for (std::size_t k = 1; k < whole.size(); ++k) {
    mesh.elements.push_back(whole);
    mesh.elements.back()[k] = centroid;
  }
}

DOVETAIL_INLINE void add_centroids(simplicial_mesh<3>& mesh, std::size_t count) {
  if (mesh.points.size() >= count)
    return;
  std::priority_queue<std::pair<double, std::size_t>> best; // the least angle, and the element
  const auto add = [&](std::size_t e) {
    best.emplace(
        std::ranges::min(dihedral_angles(corners(std::span<const vec3>(mesh.points), mesh.elements[e]))), e);
  };
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    add(e);
  while (mesh.points.size() < count && !best.empty()) {
    const std::size_t e = best.top().second, first_new = mesh.elements.size();
    best.pop();
    cut_at_centroid(mesh, e);
    add(e);
    for (std::size_t part = first_new; part < mesh.elements.size(); ++part)
      add(part);
  }
}

inline std::vector<simplex<2>> sorted_boundary(const simplicial_mesh<3>& mesh) {
  std::vector<simplex<2>> result;
  const side_table<3> sides = build_sides(mesh);
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (sides.is_boundary(static_cast<local_id>(s)))
      result.push_back(sorted_vertices(sides.vertices[s]));
  return result;
}

DOVETAIL_INLINE std::string fault_of(const library_piece& piece, simplicial_mesh<3>& made,
                                     const std::vector<simplex<2>>& frozen_sides) {
  if (!restore_fixed_points(piece, made))
    return "it lost a fixed point";
  add_centroids(made, piece.needed_points);
  if (const validity found = check_validity(made); !found.valid())
    return "it is not valid: " + found.text();
  if (sorted_boundary(made) != sorted_boundary(piece.mesh))
    return "it changed the boundary";
  if (!frozen_sides.empty()) {
    std::vector<simplex<2>> sides = build_sides(made).vertices;
    for (auto& side : sides)
      side = sorted_vertices(side);
    for (const auto& side : frozen_sides)
      if (!std::binary_search(sides.begin(), sides.end(), side))
        return "it lost a frozen side";
  }
  const double before = measure_quality(piece.mesh).min_dihedral_deg,
               after = measure_quality(made).min_dihedral_deg;
  if (after < before - 1e-9)
    return "its worst angle is " + number_text(after) + " degrees instead of " + number_text(before);
  return {};
}

DOVETAIL_INLINE double mean_edge_length(const simplicial_mesh<3>& mesh) {
  double sum = 0;
  for (const auto& element : mesh.elements)
    for (const auto& edge : numbering::ridges<3>)
      sum += distance(mesh.points[element[edge[0]]], mesh.points[element[edge[1]]]);
  return mesh.elements.empty() ? 0 : sum / (6 * static_cast<double>(mesh.elements.size()));
}

DOVETAIL_INLINE piece_cutter::piece_cutter(const simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen)
    : mesh_(mesh), frozen_(frozen), is_fixed_(mesh.points.size(), true), new_id_(mesh.points.size(), no_id) {
  const side_table<3> sides = build_sides(mesh);
  require_tetrahedra(mesh, sides, frozen);
  for (const auto& element : mesh.elements)
    for (const local_id v : element)
      is_fixed_[v] = v < frozen.points;
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (const auto [e, f] = sides.elements[s]; f == no_id || tag(e) != tag(f))
      fix(sides.vertices[s]);
  for (const auto& side : frozen.sides)
    fix(side);
  for (std::size_t v = 0; v < is_fixed_.size(); ++v)
    if (is_fixed_[v])
      last_fixed_ = v;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    elements_of_[tag(e)].push_back(static_cast<local_id>(e));
}

DOVETAIL_INLINE library_piece piece_cutter::cut(const std::vector<local_id>& elements) {
  library_piece piece;
  std::vector<local_id> used;
  for (const local_id e : elements)
    for (const local_id v : mesh_.elements[e])
      if (new_id_[v] == no_id) {
        new_id_[v] = 0;
        used.push_back(v);
      }
  std::sort(used.begin(), used.end(),
            [this](local_id a, local_id b) { return is_fixed_[a] != is_fixed_[b] ? is_fixed_[a] : a < b; });
  for (std::size_t k = 0; k < used.size(); ++k) {
    new_id_[used[k]] = static_cast<local_id>(k);
    piece.mesh.points.push_back(mesh_.points[used[k]]);
    if (is_fixed_[used[k]])
      piece.point_in_whole.push_back(used[k]);
  }
  piece.fixed_points = piece.point_in_whole.size();
  piece.needed_points = piece.fixed_points;
  for (const local_id v : used)
    if (!is_fixed_[v] && static_cast<std::size_t>(v) < last_fixed_)
      ++piece.needed_points;
  for (const local_id e : elements) {
    simplex<3> element = mesh_.elements[e];
    for (local_id& v : element)
      v = new_id_[v];
    piece.mesh.elements.push_back(element);
  }
  frozen_sides_.clear();
  for (simplex<2> side : frozen_.sides) {
    for (local_id& v : side)
      v = new_id_[v];
    side = sorted_vertices(side);
    if (side[0] != no_id)
      frozen_sides_.push_back(side);
  }
  for (const local_id v : used)
    new_id_[v] = no_id;
  const side_table<3> sides = build_sides(piece.mesh);
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (sides.is_boundary(static_cast<local_id>(s)))
      piece.boundary.push_back(sides.vertices[s]);
  return piece;
}

DOVETAIL_INLINE void piece_cutter::add(local_id tag, const library_piece& piece,
                                       const simplicial_mesh<3>& made) {
  const auto first = static_cast<local_id>(free_points_.size());
  free_points_.insert(free_points_.end(),
                      made.points.begin() + static_cast<std::ptrdiff_t>(piece.fixed_points),
                      made.points.end());
  for (simplex<3> element : made.elements) {
    // Free points are negative until they get numbers: -1 - index.
    for (local_id& v : element)
      v = static_cast<std::size_t>(v) < piece.fixed_points
              ? piece.point_in_whole[v]
              : -1 - (first + v - static_cast<local_id>(piece.fixed_points));
    elements_.push_back(element);
    tags_.push_back(tag);
  }
}

DOVETAIL_INLINE simplicial_mesh<3> piece_cutter::result() {
  const point_numbering numbers(is_fixed_, free_points_.size());
  simplicial_mesh<3> whole{mesh_.points, std::move(elements_), {}};
  whole.points.resize(numbers.size);
  for (std::size_t k = 0; k < free_points_.size(); ++k)
    whole.points[numbers.of_free[k]] = free_points_[k];
  for (auto& element : whole.elements)
    for (local_id& v : element)
      if (v < 0)
        v = numbers.of_free[-1 - v];
  if (!mesh_.tags.empty())
    whole.tags = std::move(tags_);
  return whole;
}

DOVETAIL_INLINE void report_quality(report& to, const std::string& when, const quality_statistics& quality) {
  to.set("elements " + when, static_cast<double>(quality.elements));
  to.set(when + " bad", static_cast<double>(quality.min_dihedrals.below(12)));
  to.set(when + " low", static_cast<double>(quality.min_dihedrals.below(24)));
  to.set(when + " min angle", quality.min_dihedral_deg);
}

} // namespace dovetail::improvement::detail
