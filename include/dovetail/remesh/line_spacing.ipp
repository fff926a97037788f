/// @file
/// What `line_spacing.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/remesh/line_spacing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace dovetail::remesh {

DOVETAIL_INLINE double line_spacing::rounded(double segments) const {
  if (!even_when_few || segments > 4.5)
    return std::round(segments);
  return segments < 1.2 ? 1 : segments < 3.2 ? 2 : 4;
}

DOVETAIL_INLINE std::vector<double> line_spacing::positions(const std::vector<leaf>& leaves, double first,
                                                            double last) const {
  double total = 0;
  for (const leaf& l : leaves)
    total += l.segments;
  const auto count = static_cast<std::size_t>(
      given_segments > 0 ? given_segments
                         : std::max(static_cast<double>(minimum_segments), std::min(rounded(total), 1e8)));
  std::vector<double> t{first};
  t.reserve(count + 1);
  double before = 0;
  std::size_t next = 1;
  for (const leaf& l : leaves) {
    while (next < count) {
      const double even = static_cast<double>(next) / static_cast<double>(count);
      const double wanted =
          total * static_cast<double>(next) / static_cast<double>(count) + total * bias * even * (1 - even);
      if (wanted > before + l.segments)
        break;
      const double part = l.segments > 0 ? (wanted - before) / l.segments : 0.5;
      t.push_back(l.t0 + part * (l.t1 - l.t0));
      ++next;
    }
    before += l.segments;
  }
  while (t.size() < count) // rounding of the last sum, or a line of length zero
    t.push_back(t.back() + (last - t.back()) / static_cast<double>(count - t.size() + 1));
  t.push_back(last);
  return t;
}

} // namespace dovetail::remesh
