/// @file
/// What `tet_improver.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/improver/tetrahedra/tet_improver.hpp"

#include <string>
#include <vector>

namespace dovetail::improvement::detail {

DOVETAIL_INLINE std::size_t count_tangled(const tet_complex& complex) {
  std::size_t count = 0;
  for (local_id e = 0; e < complex.element_slots(); ++e)
    count += complex.is_alive(e) && !is_positive(complex, e);
  return count;
}

DOVETAIL_INLINE bool has_distinct_sides(const tet_complex& complex) {
  std::vector<simplex<3>> alive;
  for (local_id e = 0; e < complex.element_slots(); ++e)
    if (complex.is_alive(e))
      alive.push_back(complex.vertices(e));
  try {
    match_sides(span_of(alive), static_cast<std::size_t>(complex.vertex_slots()));
  } catch (const mesh_error&) {
    return false;
  }
  return true;
}

DOVETAIL_INLINE void report_tangled(const tet_complex& complex, std::size_t before, report& result) {
  const std::size_t left = count_tangled(complex);
  result.set("inverted before", static_cast<double>(before));
  result.set("inverted after", static_cast<double>(left));
  if (left > 0)
    result.warnings.push_back(std::to_string(left) + " elements are still flat or inverted");
}

} // namespace dovetail::improvement::detail
