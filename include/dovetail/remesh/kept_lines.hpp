/// @file
/// Whether triangles keep the lines that they were given.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// How often directed edges between points of lines are listed, and how often triangles pass them. Sorts
/// both; a question takes logarithmic time.
class line_passages {
public:
  using directed_edge = std::array<local_id, 2>; ///< its start and its end

  line_passages(std::vector<directed_edge> listed, std::vector<directed_edge> passed)
      : listed_(std::move(listed)), passed_(std::move(passed)) {
    sort_all(listed_);
    sort_all(passed_);
  }

  /// Edges that triangles pass more often than a surface does: as often as listed where a line is, else once.
  /// In growing order, each direction by itself.
  std::vector<directed_edge> repeated() const {
    std::vector<directed_edge> found;
    for (std::size_t i = 0; i < passed_.size(); ++i)
      if ((i == 0 || passed_[i] != passed_[i - 1]) && times(passed_, passed_[i]) > allowed(passed_[i]))
        found.push_back(passed_[i]);
    return found;
  }

  /// Throws `mesher_error` unless every listed edge is passed by exactly one triangle in the direction in
  /// which it is listed, and by none in the other one unless it is listed in both.
  void check() const {
    std::size_t lost = 0;
    for (const directed_edge& edge : listed_) {
      const directed_edge back{edge[1], edge[0]};
      if (times(passed_, edge) > times(listed_, edge) || times(passed_, back) > times(listed_, back))
        throw mesher_error(
            "the elements overlap each other or the outside at the edge between boundary points " +
            std::to_string(edge[0]) + " and " + std::to_string(edge[1]));
      lost += times(passed_, edge) == 0 ? 1 : 0;
    }
    if (lost > 0)
      throw mesher_error(std::to_string(lost) + " of " + std::to_string(listed_.size()) +
                         " boundary edges are lost");
  }

private:
  static std::ptrdiff_t times(const std::vector<directed_edge>& edges, const directed_edge& edge) {
    const auto [first, last] = std::equal_range(edges.begin(), edges.end(), edge);
    return last - first;
  }
  std::ptrdiff_t allowed(const directed_edge& edge) const {
    const auto here = times(listed_, edge);
    return here > 0 || times(listed_, {edge[1], edge[0]}) > 0 ? here : 1;
  }

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
