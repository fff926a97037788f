/// @file
/// A closed triangulation of a level set: marching tetrahedra on a grid, evened out on the surface.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/models/discrete/soup.hpp"
#include "dovetail/models/implicit/function.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace dovetail {

/// Triangulates the zero set of a function inside a box. The grid's cells are cubes, each cut into the six
/// tetrahedra around its diagonal, which fit across cells; so the surface is closed and every edge has two
/// triangles whatever the values are. Throws `geometry_error` when the surface does not exist, leaves the
/// box, or a value is not finite.
class level_set_triangulation {
public:
  level_set_triangulation(const level_set& surface, const box3& bounds, int cells_along_longest_side)
      : surface_(surface), lower_(bounds.lower) {
    const vec3 extent = bounds.upper - bounds.lower;
    width_ = std::max({extent.x, extent.y, extent.z}) / cells_along_longest_side;
    for (int k = 0; k < 3; ++k)
      cells_[k] = std::max(1, static_cast<int>(std::ceil(extent[k] / width_ - 1e-9)));
  }

  double cell_width() const { return width_; } ///< of a cell of the grid

  /// The closed triangulation.
  triangle_soup run() {
    evaluate();
    for (int k = 0; k < cells_[2]; ++k)
      for (int j = 0; j < cells_[1]; ++j)
        for (int i = 0; i < cells_[0]; ++i)
          march_cell({i, j, k});
    even_out();
    soup_.groups.assign(soup_.triangles.size(), no_id);
    return std::move(soup_);
  }

private:
  using node = std::array<int, 3>;
  static constexpr int smoothing_rounds = 6;

  std::int64_t number(const node& n) const {
    return (static_cast<std::int64_t>(n[2]) * (cells_[1] + 1) + n[1]) * (cells_[0] + 1) + n[0];
  }
  vec3 point(const node& n) const {
    return lower_ +
           width_ * vec3{static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])};
  }
  double value(const node& n) const { return values_[number(n)]; }
  bool is_on_border(const node& n) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (n[k] == 0 || n[k] == cells_[k])
        return true;
    return false;
  }
  static std::string text(vec3 p) { return place_text(p); }

  void evaluate() {
    values_.resize(static_cast<std::size_t>(number({cells_[0], cells_[1], cells_[2]})) + 1);
    bool any_inside = false;
    for (int k = 0; k <= cells_[2]; ++k)
      for (int j = 0; j <= cells_[1]; ++j)
        for (int i = 0; i <= cells_[0]; ++i) {
          const node n{i, j, k};
          const double v = surface_.value(point(n));
          if (!std::isfinite(v))
            throw geometry_error("the implicit function is not finite at " + text(point(n)) +
                                 "; give one that is finite in the whole box");
          if (v < 0 && is_on_border(n))
            throw geometry_error("the implicit body reaches the border of its box at " + text(point(n)) +
                                 "; give a larger box, or intersect the body with one");
          any_inside = any_inside || v < 0;
          values_[number(n)] = v;
        }
    if (!any_inside)
      throw geometry_error("the implicit function is negative at no point of a grid of cells of width " +
                           number_text(width_) +
                           "; the body is where it is negative, so turn its sign, move the box or raise the "
                           "resolution");
  }

  void march_cell(const node& corner) {
    constexpr std::array<std::array<std::size_t, 3>, 6> orders{
        {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    for (const auto& order : orders) {
      std::array<node, 4> tetrahedron{corner, corner, corner, corner};
      for (std::size_t step = 0; step < 3; ++step)
        for (std::size_t later = step + 1; later < 4; ++later)
          ++tetrahedron[later][order[step]];
      march_tetrahedron(tetrahedron);
    }
  }

  void march_tetrahedron(const std::array<node, 4>& nodes) {
    std::array<node, 4> in{};
    std::array<node, 4> out{};
    std::size_t ins = 0;
    std::size_t outs = 0;
    for (const node& n : nodes)
      if (value(n) < 0)
        in[ins++] = n;
      else
        out[outs++] = n;
    if (ins == 1)
      add_triangle({vertex(in[0], out[0]), vertex(in[0], out[1]), vertex(in[0], out[2])}, in[0], out[0]);
    if (ins == 3)
      add_triangle({vertex(in[0], out[0]), vertex(in[1], out[0]), vertex(in[2], out[0])}, in[0], out[0]);
    if (ins == 2) {
      const simplex<2> first{vertex(in[0], out[0]), vertex(in[0], out[1]), vertex(in[1], out[1])};
      add_triangle(first, in[0], out[0]);
      add_triangle({first[0], first[2], vertex(in[1], out[0])}, in[0], out[0]);
    }
  }

  /// Appends a triangle whose normal points from the inside to the outside.
  void add_triangle(simplex<2> t, const node& inside, const node& outside) {
    const auto at = [&](std::size_t i) { return soup_.points[t[i]]; };
    if (dot(cross(at(1) - at(0), at(2) - at(0)), point(outside) - point(inside)) < 0)
      std::swap(t[1], t[2]);
    soup_.triangles.push_back(t);
  }

  /// The surface vertex on the edge between two nodes; kept off the nodes so that no two vertices coincide.
  local_id vertex(const node& inside, const node& outside) {
    const std::int64_t a = number(inside);
    const std::int64_t b = number(outside);
    const auto key = static_cast<std::uint64_t>(std::min(a, b)) * values_.size() +
                     static_cast<std::uint64_t>(std::max(a, b));
    const auto [entry, is_new] = vertex_of_.try_emplace(key, static_cast<local_id>(soup_.points.size()));
    if (is_new) {
      const double from = value(inside);
      const double s = std::clamp(from / (from - value(outside)), 0.1, 0.9);
      soup_.points.push_back(point(inside) + s * (point(outside) - point(inside)));
    }
    return entry->second;
  }

  /// Moves every vertex towards the mean of its neighbours, then onto the surface: marching makes thin
  /// triangles where the surface passes near a node.
  void even_out() {
    for (int round = 0; round < smoothing_rounds; ++round) {
      const auto& points = soup_.points;
      std::vector<vec3> sums(points.size());
      std::vector<double> counts(points.size(), 0);
      for (const auto& t : soup_.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
          sums[t[k]] += points[t[(k + 1) % 3]];
          counts[t[k]] += 1;
        }
      std::vector<vec3> moved(points.size());
      for (std::size_t v = 0; v < points.size(); ++v) {
        moved[v] = on_surface(midpoint(points[v], sums[v] / counts[v]), points[v]);
      }
      soup_.points = std::move(moved);
    }
  }

  vec3 on_surface(vec3 aim, vec3 before) const {
    for (const vec3 from : {aim, before})
      if (const auto p = surface_.project(from, 0.5 * width_))
        return *p;
    return before;
  }

  const level_set& surface_;
  vec3 lower_;
  double width_ = 0;
  std::array<int, 3> cells_{};
  std::vector<double> values_;
  std::unordered_map<std::uint64_t, local_id> vertex_of_; ///< of the edge between two nodes
  triangle_soup soup_;
};

} // namespace dovetail
