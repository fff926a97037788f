/// @file
/// What `repair.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/graph/disjoint_sets.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/unused_points.hpp"
#include "dovetail/models/discrete/crossings.hpp"
#include "dovetail/models/discrete/nesting.hpp"
#include "dovetail/models/discrete/orientation.hpp"
#include "dovetail/models/discrete/repair.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

namespace discrete {

/// Works on one soup, step by step; `name` is how messages call it.
class soup_repair {
public:
  soup_repair(const triangle_soup& soup, std::string name, const repair_options& options)
      : name_(std::move(name)), options_(options) {
    check_soup(soup, name_);
    result_.mesh.points = soup.points;
    result_.mesh.elements = soup.triangles;
    take_groups(soup);
    result_.repairs.name = "repair";
    box3 box;
    for (const vec3& p : soup.points)
      box.include(p);
    diagonal_ = box.diagonal();
  }

  /// All steps. Throws `geometry_error` when no surface can be made.
  oriented_surfaces run() {
    merge_points(0);
    drop_degenerate();
    if (!is_closed()) {
      merge_points(options_.merge_tolerance * diagonal_);
      drop_degenerate();
    }
    check_edges();
    flip_caps(1e-3 * options_.merge_tolerance * diagonal_);
    const std::vector<simplex<2>> listed = triangles();
    shells_ = oriented(result_.mesh, name_);
    nest();
    count_turned(listed);
    result_.repairs.set(counts_);
    require_no_crossing(result_.mesh, name_, sliver_height(), result_.repairs);
    return std::move(result_);
  }

private:
  void take_groups(const triangle_soup& soup) {
    result_.groups = soup.groups;
    result_.groups.resize(soup.triangles.size(), no_id);
    result_.group_names = soup.group_names;
    result_.group_numbers.resize(soup.group_names.size());
    std::iota(result_.group_numbers.begin(), result_.group_numbers.end(), local_id{0});
    if (soup.group_names.empty())
      name_groups_by_numbers(result_);
  }

  std::vector<vec3>& points() { return result_.mesh.points; }
  std::vector<simplex<2>>& triangles() { return result_.mesh.elements; }
  vec3 point(local_id v) { return points()[v]; }
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
    drop_unused_points(result_.mesh);
    counts_.merged_points += n - points().size();
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
        ++counts_.degenerate;
      } else if (i > 0 && keyed[i - 1].first == v) {
        dropped[keyed[i].second] = 1;
        ++counts_.duplicates;
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
        counts_.degenerate += 2;
        ++i;
      }
    drop(dropped);
  }

  void drop(const std::vector<char>& dropped) {
    if (dropped.empty())
      throw geometry_error(name_ + ": there are no triangles; give a closed surface");
    std::size_t kept = 0;
    for (std::size_t t = 0; t < triangles().size(); ++t)
      if (!dropped[t]) {
        triangles()[kept] = triangles()[t];
        result_.groups[kept++] = result_.groups[t];
      }
    triangles().resize(kept);
    result_.groups.resize(kept);
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

  /// At an edge are two triangles, or one where sheets are allowed.
  void check_edges() {
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
    if (open == 0)
      return;
    const std::string what = "the surface is open: " + std::to_string(open) +
                             " edges have one triangle only, one of them near " + where_open;
    if (!options_.allow_sheets)
      throw geometry_error(name_ + ": " + what + "; close the hole, or mesh it with triangles (dimension 2)");
    result_.repairs.warnings.push_back(name_ + ": " + what + "; they stay its boundary");
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
        if (across == no_id || touched[across] || !flip(t, longest, across))
          continue;
        touched[t] = touched[across] = 1;
        ++flips;
      }
      counts_.flipped_caps += flips;
      if (flips == 0)
        return;
    }
  }

  /// Exchanges the edge opposite corner `i` of triangle t for the other diagonal; false when that is an edge
  /// already.
  bool flip(std::size_t t, std::size_t i, local_id across) {
    auto& first = triangles()[t];
    auto& second = triangles()[across];
    const local_id apex = first[i];
    const local_id from = first[(i + 1) % 3];
    const local_id to = first[(i + 2) % 3];
    std::size_t j = 0;
    while (second[j] == from || second[j] == to)
      ++j;
    const local_id other = second[j];
    if (other == apex || result_.groups[t] != result_.groups[across] ||
        distance(point(apex), point(other)) == 0)
      return false;
    const bool turned = second[(j + 1) % 3] == from; // the neighbour is oriented the other way
    first = {apex, from, other};
    second = {apex, other, to};
    if (turned)
      std::swap(second[1], second[2]);
    return true;
  }

  /// Finds which closed shells lie in which, and turns each so that its normals point out of its solid.
  void nest() {
    std::vector<simplicial_mesh<2>> closed;
    std::vector<local_id> number; // per shell: among the closed ones
    for (auto& shell : shell_meshes(result_.mesh, shells_.shell_of, shells_.count())) {
      const bool sheet = shells_.is_sheet[number.size()];
      number.push_back(sheet ? no_id : static_cast<local_id>(closed.size()));
      if (!sheet)
        closed.push_back(std::move(shell));
    }
    const shell_nesting nesting = nested(closed);
    result_.solids = nesting.solids;
    result_.solid_of.assign(triangles().size(), no_id);
    for (std::size_t t = 0; t < triangles().size(); ++t) {
      const local_id shell = number[shells_.shell_of[t]];
      if (shell == no_id)
        continue;
      if (nesting.is_inside_out[shell])
        std::swap(triangles()[t][1], triangles()[t][2]);
      result_.solid_of[t] = nesting.solid_of[shell];
    }
    counts_.shells = closed.size();
    counts_.sheets = shells_.is_sheet.size() - closed.size();
    counts_.solids = nesting.solids;
    counts_.voids = nesting.voids;
  }

  /// Those that are the other way round than before.
  void count_turned(const std::vector<simplex<2>>& listed) {
    std::size_t turned = 0;
    for (std::size_t t = 0; t < listed.size(); ++t) {
      const auto first = std::find(triangles()[t].begin(), triangles()[t].end(), listed[t][0]);
      const auto next = first + 1 == triangles()[t].end() ? triangles()[t].begin() : first + 1;
      turned += *next == listed[t][1] ? 0 : 1;
    }
    counts_.turned = turned;
  }

  bool is_sliver(std::size_t t) {
    const auto [a, b, c] = corners(t);
    const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
    return norm(cross(b - a, c - a)) < sliver_height() * longest;
  }
  double sliver_height() const { return 1e-5 * diagonal_; }

  std::string name_;
  repair_options options_;
  oriented_surfaces result_;
  repair_counts counts_;
  double diagonal_ = 0;
  oriented_shells shells_;
};

} // namespace discrete

DOVETAIL_INLINE oriented_surfaces repaired(const triangle_soup& soup, const std::string& name,
                                           const repair_options& options) {
  return discrete::soup_repair(soup, name, options).run();
}

DOVETAIL_INLINE oriented_surfaces repaired_file(const triangle_soup& soup, const std::string& name,
                                                const repair_options& options) {
  oriented_surfaces made = repaired(soup, name, options);
  const auto counts = made.repairs.as<repair_counts>();
  const auto note = [&](std::size_t count, const char* one, const char* more) {
    if (count > 0)
      made.repairs.warnings.push_back(name + ": " + std::to_string(count) + (count == 1 ? one : more));
  };
  note(counts.duplicates, " triangle is a copy of another one and was left out",
       " triangles are copies of others and were left out");
  note(counts.turned, " triangle was listed the wrong way round and turned",
       " triangles were listed the wrong way round and turned");
  return made;
}

} // namespace dovetail
