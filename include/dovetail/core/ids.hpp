/// @file
/// Entity numbers. Local ids (within one mesh held in memory) have 32 bits, global ids 64.
#pragma once

#include <cstdint>

namespace dovetail {

/// Index of an entity inside one mesh; non-negative.
using local_id = std::int32_t;

/// Index of an entity in the whole, possibly distributed, mesh; non-negative.
using global_id = std::int64_t;

/// "No such entity", for example the neighbour across a boundary side.
inline constexpr local_id no_id = -1;

} // namespace dovetail
