/// @file
/// The splitting of the triangles of charted surfaces along contour lines.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/models/discrete/charted_surface.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace dovetail::discrete {

/// Signed values at the corners of a triangle; the contour is where they are zero.
using corner_values = std::array<double, 3>;

/// One use of `split_along_contours`.
class contour_splitter {
public:
  contour_splitter(charted_surface& surface, std::vector<std::optional<corner_values>>& values)
      : s_(surface), values_(values) {}

  /// Splits the triangles.
  void run() {
    const auto splits = collect_splits();
    const auto split_on = [&](local_id a, local_id b) -> const edge_split* {
      const std::array<local_id, 2> ends{std::min(a, b), std::max(a, b)};
      const auto found = std::lower_bound(splits.begin(), splits.end(), ends,
                                          [](const edge_split& e, const auto& key) { return e.ends < key; });
      return found != splits.end() && found->ends == ends ? &*found : nullptr;
    };
    const std::size_t count = triangles().size();
    for (std::size_t t = 0; t < count; ++t) {
      const auto v = triangles()[t];
      std::array<const edge_split*, 3> on{}; // the edge from corner i to the next
      int split_edges = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        on[i] = split_on(v[i], v[(i + 1) % 3]);
        split_edges += on[i] ? 1 : 0;
      }
      if (split_edges > 0)
        split_triangle(t, on, split_edges);
    }
  }

private:
  struct edge_split {
    std::array<local_id, 2> ends; ///< sorted
    double s;                     ///< from ends[0] to ends[1]
    local_id vertex = no_id;
  };

  /// Every edge that a contour crosses gets one new vertex, whichever chart asked for it first.
  std::vector<edge_split> collect_splits() {
    std::vector<edge_split> splits;
    for (std::size_t t = 0; t < triangles().size(); ++t)
      if (values_[t])
        for (std::size_t i = 0; i < 3; ++i) {
          local_id from = triangles()[t][i];
          local_id to = triangles()[t][(i + 1) % 3];
          double a = (*values_[t])[i];
          double b = (*values_[t])[(i + 1) % 3];
          if (a * b >= 0)
            continue;
          if (from > to) {
            std::swap(from, to);
            std::swap(a, b);
          }
          splits.push_back({{from, to}, a / (a - b)});
        }
    std::stable_sort(splits.begin(), splits.end(),
                     [](const edge_split& a, const edge_split& b) { return a.ends < b.ends; });
    splits.erase(std::unique(splits.begin(), splits.end(),
                             [](const edge_split& a, const edge_split& b) { return a.ends == b.ends; }),
                 splits.end());
    for (edge_split& split : splits) {
      split.vertex = static_cast<local_id>(s_.mesh.points.size());
      const vec3 a = point(split.ends[0]);
      s_.mesh.points.push_back(a + split.s * (point(split.ends[1]) - a));
    }
    return splits;
  }

  /// Replaces a triangle by two, three or four; its corner values go along, new ones are zero where the sign
  /// changes.
  void split_triangle(std::size_t t, const std::array<const edge_split*, 3>& on, int split_edges) {
    const simplex<2> v = triangles()[t];
    const std::optional<corner_values> g = values_[t];
    std::array<local_id, 3> m{};
    corner_values at_m{};
    for (std::size_t i = 0; i < 3; ++i)
      if (on[i]) {
        m[i] = on[i]->vertex;
        if (g && (*g)[i] * (*g)[(i + 1) % 3] > 0)
          at_m[i] = 0.5 * ((*g)[i] + (*g)[(i + 1) % 3]);
      }
    struct corner {
      local_id v;
      double g;
    };
    const auto old_corner = [&](std::size_t i) { return corner{v[i % 3], g ? (*g)[i % 3] : 0}; };
    const auto new_corner = [&](std::size_t i) { return corner{m[i % 3], at_m[i % 3]}; };
    bool first = true;
    const auto put = [&](corner a, corner b, corner c) {
      const std::optional<corner_values> values =
          g ? std::optional(corner_values{a.g, b.g, c.g}) : std::nullopt;
      if (first) {
        triangles()[t] = {a.v, b.v, c.v};
        values_[t] = values;
      } else {
        triangles().push_back({a.v, b.v, c.v});
        values_.push_back(values);
        for (auto* tags : s_.of_triangles()) {
          const local_id tag = (*tags)[t];
          tags->push_back(tag);
        }
      }
      first = false;
    };
    if (split_edges == 3) {
      for (std::size_t i = 0; i < 3; ++i)
        put(old_corner(i), new_corner(i), new_corner(i + 2));
      put(new_corner(0), new_corner(1), new_corner(2));
      return;
    }
    std::size_t i = 0;
    if (split_edges == 1) {
      while (!on[i])
        ++i;
      put(old_corner(i), new_corner(i), old_corner(i + 2));
      put(new_corner(i), old_corner(i + 1), old_corner(i + 2));
      return;
    }
    while (on[(i + 1) % 3]) // edges i and i + 2 are split, they meet at corner i
      ++i;
    put(old_corner(i), new_corner(i), new_corner(i + 2));
    const corner a = new_corner(i);
    const corner b = old_corner(i + 1);
    const corner c = old_corner(i + 2);
    const corner d = new_corner(i + 2);
    if (distance(point(a.v), point(c.v)) <= distance(point(b.v), point(d.v))) {
      put(a, b, c);
      put(a, c, d);
    } else {
      put(a, b, d);
      put(b, c, d);
    }
  }

  std::vector<simplex<2>>& triangles() { return s_.mesh.elements; }
  vec3 point(local_id v) const { return s_.mesh.points[v]; }

  charted_surface& s_;
  std::vector<std::optional<corner_values>>& values_;
};

/// Splits every edge on which values change sign, once for all triangles beside it, so that the contour runs
/// along edges. Triangles without values are split along. New corners on the contour have the value zero.
/// O(n log n).
inline void split_along_contours(charted_surface& surface,
                                 std::vector<std::optional<corner_values>>& values) {
  contour_splitter(surface, values).run();
}

} // namespace dovetail::discrete
