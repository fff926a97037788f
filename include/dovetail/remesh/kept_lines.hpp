/// @file
/// Whether triangles keep the lines that they were given.
#pragma once

#include "dovetail/mesh/simplex.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace dovetail {

/// How often directed edges between points of lines are listed, and how often triangles pass them. Sorts
/// both; a question takes logarithmic time.
class line_passages {
public:
  using directed_edge = std::array<local_id, 2>; ///< its start and its end

  line_passages(std::vector<directed_edge> listed, std::vector<directed_edge> passed);

  /// Edges that triangles pass more often than a surface does: as often as listed where a line is, else once.
  /// In growing order, each direction by itself.
  std::vector<directed_edge> repeated() const;

  /// Throws `mesher_error` unless every listed edge is passed by exactly one triangle in the direction in
  /// which it is listed, and by none in the other one unless it is listed in both.
  void check() const;

private:
  static std::ptrdiff_t times(const std::vector<directed_edge>& edges, const directed_edge& edge);
  std::ptrdiff_t allowed(const directed_edge& edge) const;

  std::vector<directed_edge> listed_, passed_;
};

/// Calls `visit` for every side, directed, whose ends both come before `points`.
template <class Visit>
void for_each_edge_before(local_id points, std::span<const simplex<2>> triangles, const Visit& visit) {
  for (const simplex<2>& t : triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (const std::array<local_id, 2> edge{t[k], t[(k + 1) % 3]}; edge[0] < points && edge[1] < points)
        visit(edge);
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/remesh/kept_lines.ipp"
#endif
