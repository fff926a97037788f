/// @file
/// What the stage "intersection" counts.
#pragma once

#include "dovetail/core/fields.hpp"
#include "dovetail/core/ids.hpp"

#include <cstddef>

namespace dovetail {

/// What was found and done about crossings and failures.
struct intersection_counts {
  std::size_t crossings = 0;         ///< pairs of triangles
  std::size_t rounds = 0;            ///< of looking for them
  int refinements = 0;               ///< of places where something crossed
  local_id merges = 0;               ///< of subdomains whose boundaries cross
  local_id merged_after_failure = 0; ///< since no attempt could mesh them
  local_id largest_merged = 1;       ///< subdomains in one

  using fields = field_list<&intersection_counts::crossings, &intersection_counts::rounds,
                            &intersection_counts::refinements, &intersection_counts::merges,
                            &intersection_counts::merged_after_failure, &intersection_counts::largest_merged>;
};

} // namespace dovetail
