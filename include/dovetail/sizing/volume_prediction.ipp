/// @file
/// What `volume_prediction.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/sizing/prediction.hpp"
#include "dovetail/sizing/volume_prediction.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace dovetail::sizing {

DOVETAIL_INLINE double mark_volume_cells(const std::vector<volume_cell>& cells, double allowed,
                                         std::vector<char>& marked) {
  struct variance_view {
    double error;
  };
  std::vector<variance_view> variances;
  variances.reserve(cells.size());
  for (const volume_cell& c : cells)
    variances.push_back({c.variance});
  std::vector<char> for_variance;
  const double bias = mark_largest_errors(cells, 0.25 * allowed, marked);
  const double variance = mark_largest_errors(variances, 0.0625 * allowed * allowed, for_variance);
  for (std::size_t i = 0; i < marked.size(); ++i)
    marked[i] = marked[i] != 0 || for_variance[i] != 0 ? 1 : 0;
  return bias + 2 * std::sqrt(variance);
}

DOVETAIL_INLINE double total_integral(const std::vector<volume_cell>& cells, double enclosed_volume) {
  double whole = 0;
  double cut = 0;
  double whole_volume = 0;
  double cut_volume = 0;
  for (const volume_cell& c : cells) {
    (c.triangles.empty() ? whole : cut) += c.integral;
    (c.triangles.empty() ? whole_volume : cut_volume) += c.volume_inside;
  }
  const double factor = cut_volume > 0 ? (enclosed_volume - whole_volume) / cut_volume : 1.0;
  return whole + (factor > 0.5 && factor < 2 ? factor : 1.0) * cut;
}

} // namespace dovetail::sizing
