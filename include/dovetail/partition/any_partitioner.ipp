/// @file
/// What `any_partitioner.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/partition/any_partitioner.hpp"
#include "dovetail/partition/checked_partition.hpp"

#include <vector>

namespace dovetail {

DOVETAIL_INLINE std::vector<local_id> any_partitioner::operator()(const csr_graph& graph, int parts) const {
  return checked_partition(call_, graph, parts, name_);
}

} // namespace dovetail
