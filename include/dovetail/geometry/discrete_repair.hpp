/// @file
/// From a triangle soup to closed, consistently oriented surfaces that bound solids.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/geometry/discrete_nesting.hpp"
#include "dovetail/geometry/discrete_soup.hpp"
#include "dovetail/graph/disjoint_sets.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/triangle_intersection.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

/// Closed surfaces: every edge has two triangles that pass it in opposite directions, and every triangle's
/// normal points out of its solid's material.
struct closed_surfaces {
  simplicial_mesh<2> mesh;
  std::vector<local_id> patches; ///< per triangle, as in the soup
  std::vector<std::string> patch_names;
  std::vector<local_id> solid_of; ///< per triangle: the solid behind it
  local_id solids = 0;
  report repairs; ///< counters: merged_points, degenerate, duplicates, turned, shells, solids, voids
};

namespace discrete {

inline std::string place(vec3 p) {
  return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) + ")";
}

/// Works on one soup, step by step; `name` is how messages call it.
class soup_repair {
public:
  soup_repair(const triangle_soup& soup, std::string name) : name_(std::move(name)) {
    result_.mesh.points = soup.points;
    result_.mesh.elements = soup.triangles;
    result_.patches = soup.patches.size() == soup.triangles.size()
                          ? soup.patches
                          : std::vector<local_id>(soup.triangles.size(), no_id);
    result_.patch_names = soup.patch_names;
    result_.repairs.name = "repair";
    box3 box;
    for (const vec3& p : soup.points)
      box.include(p);
    diagonal_ = box.diagonal();
  }

  closed_surfaces run(double merge_tolerance) {
    merge_points(0);
    drop_degenerate();
    if (!is_closed()) {
      merge_points(merge_tolerance * diagonal_);
      drop_degenerate();
    }
    require_closed();
    flip_caps(1e-3 * merge_tolerance * diagonal_);
    orient();
    nest();
    require_no_crossing();
    return std::move(result_);
  }

private:
  std::vector<vec3>& points() { return result_.mesh.points; }
  std::vector<simplex<2>>& triangles() { return result_.mesh.elements; }
  vec3 point(local_id v) { return points()[static_cast<std::size_t>(v)]; }
  std::array<vec3, 3> corners(std::size_t t) {
    const auto& v = triangles()[t];
    return {point(v[0]), point(v[1]), point(v[2])};
  }

  /// Joins points within the tolerance (0: equal ones) to the one with the smallest index, and drops unused
  /// points.
  void merge_points(double tolerance) {
    const std::size_t n = points().size();
    std::vector<local_id> order(n);
    std::iota(order.begin(), order.end(), local_id{0});
    std::sort(order.begin(), order.end(), [&](local_id a, local_id b) {
      const vec3 p = point(a);
      const vec3 q = point(b);
      return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
    });
    disjoint_sets sets(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n && point(order[j]).x <= point(order[i]).x + tolerance; ++j) {
        if (tolerance == 0 && !(point(order[j]) == point(order[i])))
          break; // equal points are neighbours in this order
        if (distance(point(order[i]), point(order[j])) <= tolerance)
          sets.unite(order[i], order[j]);
      }
    for (auto& t : triangles())
      for (local_id& v : t)
        v = sets.find(v);
    drop_unused_points();
  }

  void drop_unused_points() {
    std::vector<local_id> renamed(points().size(), no_id);
    for (const auto& t : triangles())
      for (const local_id v : t)
        renamed[static_cast<std::size_t>(v)] = 0;
    std::vector<vec3> kept;
    for (std::size_t i = 0; i < renamed.size(); ++i)
      if (renamed[i] != no_id) {
        renamed[i] = static_cast<local_id>(kept.size());
        kept.push_back(points()[i]);
      }
    for (auto& t : triangles())
      for (local_id& v : t)
        v = renamed[static_cast<std::size_t>(v)];
    result_.repairs.add("merged_points", static_cast<double>(points().size() - kept.size()));
    points().swap(kept);
  }

  /// Drops triangles with equal corners and the second copy of a triangle listed twice in one orientation.
  void drop_degenerate() {
    std::vector<std::pair<simplex<2>, std::size_t>> keyed;
    for (std::size_t t = 0; t < triangles().size(); ++t) {
      auto v = triangles()[t];
      std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end()); // keeps the orientation
      keyed.emplace_back(v, t);
    }
    std::sort(keyed.begin(), keyed.end());
    std::vector<char> dropped(triangles().size(), 0);
    for (std::size_t i = 0; i < keyed.size(); ++i) {
      const auto& v = keyed[i].first;
      if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
        dropped[keyed[i].second] = 1;
        result_.repairs.add("degenerate", 1);
      } else if (i > 0 && keyed[i - 1].first == v) {
        dropped[keyed[i].second] = 1;
        result_.repairs.add("duplicates", 1);
      }
    }
    drop(dropped);
    cancel_thin_folds();
  }

  /// A thin triangle and its reverse, left of a strip that rounding closed, go together: they would make
  /// their edges crowded.
  void cancel_thin_folds() {
    std::vector<std::pair<simplex<2>, std::size_t>> keyed;
    for (std::size_t t = 0; t < triangles().size(); ++t)
      if (is_sliver(t)) {
        auto v = triangles()[t];
        std::sort(v.begin(), v.end());
        keyed.emplace_back(v, t);
      }
    std::sort(keyed.begin(), keyed.end());
    std::vector<char> dropped(triangles().size(), 0);
    for (std::size_t i = 0; i + 1 < keyed.size(); ++i)
      if (keyed[i].first == keyed[i + 1].first) {
        dropped[keyed[i].second] = dropped[keyed[i + 1].second] = 1;
        result_.repairs.add("degenerate", 2);
        ++i;
      }
    drop(dropped);
  }

  void drop(const std::vector<char>& dropped) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < triangles().size(); ++t)
      if (!dropped[t]) {
        triangles()[kept] = triangles()[t];
        result_.patches[kept++] = result_.patches[t];
      }
    triangles().resize(kept);
    result_.patches.resize(kept);
    if (kept == 0)
      throw geometry_error(name_ + ": all triangles are degenerate; give a closed surface");
  }

  bool is_closed() {
    const auto sides = build_sides<2>(result_.mesh);
    for (std::size_t s = 0; s < sides.size(); ++s)
      if (!sides.is_interior(static_cast<local_id>(s)))
        return false;
    return true;
  }

  void require_closed() {
    const auto sides = build_sides<2>(result_.mesh);
    std::size_t open = 0;
    std::size_t crowded = 0;
    std::string where_open;
    std::string where_crowded;
    for (std::size_t s = 0; s < sides.size(); ++s) {
      const auto side = static_cast<local_id>(s);
      const auto where = [&] {
        return place(midpoint(point(sides.vertices[s][0]), point(sides.vertices[s][1])));
      };
      if (sides.is_boundary(side) && open++ == 0)
        where_open = where();
      if (sides.is_non_manifold(side) && crowded++ == 0)
        where_crowded = where();
    }
    if (crowded > 0)
      throw geometry_error(name_ + ": the surface is not manifold: more than two triangles meet at " +
                           std::to_string(crowded) + " edges, one near " + where_crowded +
                           "; give each solid its own closed surface");
    if (open > 0)
      throw geometry_error(name_ + ": the surface is open: " + std::to_string(open) +
                           " edges have one triangle only, one of them near " + where_open +
                           "; close the hole");
  }

  /// A triangle whose corner lies on its opposite edge has no normal: the edge is flipped with the triangle
  /// across.
  void flip_caps(double flat) {
    for (int round = 0; round < 10; ++round) {
      const auto sides = build_sides<2>(result_.mesh);
      std::vector<char> touched(triangles().size(), 0);
      std::size_t flips = 0;
      for (std::size_t t = 0; t < triangles().size(); ++t) {
        const auto [a, b, c] = corners(t);
        const std::array<double, 3> lengths{distance(b, c), distance(c, a), distance(a, b)};
        const auto longest =
            static_cast<std::size_t>(std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
        if (touched[t] || norm(cross(b - a, c - a)) > flat * lengths[longest])
          continue;
        const local_id across = sides.across(sides.of_element[t][longest], static_cast<local_id>(t));
        if (across == no_id || touched[static_cast<std::size_t>(across)] || !flip(t, longest, across))
          continue;
        touched[t] = touched[static_cast<std::size_t>(across)] = 1;
        ++flips;
      }
      result_.repairs.add("flipped_caps", static_cast<double>(flips));
      if (flips == 0)
        return;
    }
  }

  /// Exchanges the edge opposite corner `i` of triangle t for the other diagonal; false when that is an edge
  /// already.
  bool flip(std::size_t t, std::size_t i, local_id across) {
    auto& first = triangles()[t];
    auto& second = triangles()[static_cast<std::size_t>(across)];
    const local_id apex = first[i];
    const local_id from = first[(i + 1) % 3];
    const local_id to = first[(i + 2) % 3];
    std::size_t j = 0;
    while (second[j] == from || second[j] == to)
      ++j;
    const local_id other = second[j];
    if (other == apex || result_.patches[t] != result_.patches[static_cast<std::size_t>(across)] ||
        distance(point(apex), point(other)) == 0)
      return false;
    const bool turned = second[(j + 1) % 3] == from; // the neighbour is oriented the other way
    first = {apex, from, other};
    second = {apex, other, to};
    if (turned)
      std::swap(second[1], second[2]);
    return true;
  }

  /// Makes the orientation consistent within each shell.
  void orient() {
    const auto sides = build_sides<2>(result_.mesh);
    const std::size_t n = triangles().size();
    shell_of_.assign(n, no_id);
    shells_ = 0;
    double turned = 0;
    std::vector<std::size_t> pending;
    for (std::size_t seed = 0; seed < n; ++seed) {
      if (shell_of_[seed] != no_id)
        continue;
      shell_of_[seed] = shells_;
      pending.assign(1, seed);
      while (!pending.empty()) {
        const std::size_t t = pending.back();
        pending.pop_back();
        for (std::size_t i = 0; i < 3; ++i) {
          const auto next = static_cast<std::size_t>(
              sides.across(sides.of_element[t][side_of(sides, t, i)], static_cast<local_id>(t)));
          const bool agrees = passes(next, triangles()[t][(i + 2) % 3], triangles()[t][(i + 1) % 3]);
          if (shell_of_[next] == no_id) {
            if (!agrees) {
              std::swap(triangles()[next][1], triangles()[next][2]);
              ++turned;
            }
            shell_of_[next] = shells_;
            pending.push_back(next);
          } else if (!agrees) {
            throw geometry_error(name_ + ": the surface has one side only (as a Moebius strip) near " +
                                 place(point(triangles()[t][i])) + "; it encloses no volume");
          }
        }
      }
      ++shells_;
    }
    result_.repairs.set("turned", turned);
  }

  /// The local side in `sides` of the edge opposite the present corner i of t (turning a triangle renumbers
  /// its corners).
  std::size_t side_of(const side_table<2>& sides, std::size_t t, std::size_t i) {
    const local_id v = triangles()[t][i];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& ends = sides.vertices[static_cast<std::size_t>(sides.of_element[t][k])];
      if (ends[0] != v && ends[1] != v)
        return k;
    }
    return i;
  }

  bool passes(std::size_t t, local_id from, local_id to) {
    const auto& v = triangles()[t];
    return (v[0] == from && v[1] == to) || (v[1] == from && v[2] == to) || (v[2] == from && v[0] == to);
  }

  /// Finds which shells lie in which, and turns each so that its normals point out of its solid.
  void nest() {
    const shell_nesting nesting = nested(shell_meshes(result_.mesh, shell_of_, shells_));
    result_.solids = nesting.solids;
    result_.solid_of.resize(triangles().size());
    for (std::size_t t = 0; t < triangles().size(); ++t) {
      const auto shell = static_cast<std::size_t>(shell_of_[t]);
      if (nesting.is_inside_out[shell]) {
        std::swap(triangles()[t][1], triangles()[t][2]);
        result_.repairs.add("turned", 1);
      }
      result_.solid_of[t] = nesting.solid_of[shell];
    }
    result_.repairs.set("shells", shells_);
    result_.repairs.set("solids", nesting.solids);
    result_.repairs.set("voids", nesting.voids);
  }

  /// Crossings of slivers, which the rounding of a file can fold over their neighbours, are only warned of.
  void require_no_crossing() {
    std::vector<box3> boxes;
    for (std::size_t t = 0; t < triangles().size(); ++t) {
      box3 box;
      for (const vec3& p : corners(t))
        box.include(p);
      boxes.push_back(box);
    }
    const box_tree tree(boxes);
    std::size_t slivers = 0;
    std::vector<std::pair<std::size_t, std::size_t>> crossing;
    for (std::size_t t = 0; t < triangles().size(); ++t)
      tree.for_each([&](const box3& box, std::size_t) { return box.overlaps(boxes[t]); },
                    [&](local_id id) {
                      const auto other = static_cast<std::size_t>(id);
                      if (other <= t || !boxes[other].overlaps(boxes[t]) ||
                          !triangles_cross(points(), triangles()[t], triangles()[other]))
                        return;
                      if (is_sliver(t) || is_sliver(other))
                        ++slivers;
                      else
                        crossing.emplace_back(t, other);
                    });
    if (slivers > 0)
      result_.repairs.warnings.push_back(name_ + ": " + std::to_string(slivers) +
                                         " slivers overlap their neighbours by rounding");
    if (crossing.empty())
      return;
    const auto first = *std::min_element(crossing.begin(), crossing.end());
    const auto [a, b, c] = corners(first.first);
    throw geometry_error(name_ + ": the surface crosses itself: " + std::to_string(crossing.size()) +
                         " pairs of triangles, one near " + place((a + b + c) / 3) + "; repair it");
  }
  bool is_sliver(std::size_t t) {
    const auto [a, b, c] = corners(t);
    const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
    return norm(cross(b - a, c - a)) < 1e-5 * diagonal_ * longest;
  }

  std::string name_;
  closed_surfaces result_;
  double diagonal_ = 0;
  std::vector<local_id> shell_of_;
  local_id shells_ = 0;
};

} // namespace discrete

/// Merges points, drops degenerate and repeated triangles, orients, and finds solids and voids. Points are
/// merged when equal, and, where the surface is then still open, within `merge_tolerance` times the diagonal
/// of its box. About O(n log n) for few shells. Throws `geometry_error` naming `name` and the place when the
/// surface is open, not manifold, one-sided or crosses itself.
inline closed_surfaces repaired(const triangle_soup& soup, const std::string& name = "the surface",
                                double merge_tolerance = 1e-6) {
  return discrete::soup_repair(soup, name).run(merge_tolerance);
}

} // namespace dovetail
