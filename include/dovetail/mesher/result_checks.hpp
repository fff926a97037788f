/// @file
/// What the result of every mesher and improver must satisfy in both dimensions: entries that exist, the
/// given points bit for bit, and elements that fit together inside the given boundary and nowhere else.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/mesh/chain_sum.hpp"
#include "dovetail/mesh/simplex.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace dovetail::detail {

/// Points that elements refer to exist, and tags are one per element or none. Whatever else looks at a
/// foreign mesh relies on it.
template <int D>
void check_entries(const simplicial_mesh<D>& mesh) {
  if (!mesh.tags.empty() && mesh.tags.size() != mesh.elements.size())
    throw mesher_error(std::to_string(mesh.tags.size()) + " tags for " +
                       std::to_string(mesh.elements.size()) + " elements");
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (const local_id v : mesh.elements[e])
      if (v < 0 || static_cast<std::size_t>(v) >= mesh.points.size())
        throw mesher_error("element " + std::to_string(e) + " refers to point " + std::to_string(v) +
                           ", which does not exist");
}

void check_points_kept(const std::vector<vec3>& given, const std::vector<vec3>& got);

/// The points after the `given` ones are each in an element: what nobody has is in no mesh and has no number.
template <int D>
void check_points_used(std::size_t given, const simplicial_mesh<D>& mesh) {
  std::vector<bool> used(mesh.points.size(), false);
  for (const auto& element : mesh.elements)
    for (const local_id v : element)
      used[v] = true;
  for (std::size_t v = given; v < used.size(); ++v)
    if (!used[v])
      throw mesher_error("point " + std::to_string(v) + " is in no element");
}

/// Whether every side inside is passed by its elements as often in one direction as in the other, and one of
/// the boundary once more as it is listed: none of them is missing, doubled or turned over. With positive
/// elements it follows that they fill the boundary once.
template <int D>
bool fit_together(const simplicial_mesh<D - 1>& boundary, const simplicial_mesh<D>& mesh) {
  chain_sum expected, found;
  for (const simplex<D - 1>& side : boundary.elements)
    expected.add(side);
  for (const simplex<D>& element : mesh.elements)
    found.add_sides_of(element);
  return found == expected;
}

[[noreturn]] inline void throw_no_fit() {
  throw mesher_error("the elements do not fit together inside the boundary: some are lost, doubled or turned "
                     "over");
}

} // namespace dovetail::detail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesher/result_checks.ipp"
#endif
