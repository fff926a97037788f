/// @file
/// What `oriented_surfaces.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/models/discrete/oriented_surfaces.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace dovetail::discrete {

DOVETAIL_INLINE void name_groups_by_numbers(oriented_surfaces& surfaces) {
  auto& numbers = surfaces.group_numbers;
  numbers = surfaces.groups;
  sort_unique(numbers);
  std::erase(numbers, no_id);
  for (const local_id number : numbers)
    surfaces.group_names.push_back(std::to_string(number));
  for (local_id& group : surfaces.groups)
    if (group != no_id)
      group =
          static_cast<local_id>(std::lower_bound(numbers.begin(), numbers.end(), group) - numbers.begin());
}

} // namespace dovetail::discrete
