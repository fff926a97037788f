/// @file
/// Finds the two half sides that belong together while a cavity is filled: a small hash table of sides.
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/improver/tetrahedra/tet_adjacency.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

namespace dovetail::improvement {

/// What lies beyond a side of a cavity: the half side against it (`no_id` on the boundary of the mesh).
struct cavity_side {
  half_side outer; ///< across the side; `no_id` on the boundary of the mesh
  bool is_fixed;   ///< whether the side must stay
};

/// Open addressing with linear probing; entries of earlier cavities are told apart by a stamp, so starting a
/// new cavity costs nothing. Each side is offered once and taken at most once.
class cavity_matcher {
public:
  /// Forgets all sides and makes room for `sides` of them.
  void start(std::size_t sides) {
    const std::size_t wanted = std::bit_ceil(2 * sides);
    if (wanted > table_.size() || ++stamp_ == 0) {
      table_.assign(wanted > table_.size() ? wanted : table_.size(), {});
      stamp_ = 1;
    }
  }
  /// Puts in a side, by its sorted vertices.
  void offer(const std::array<local_id, 3>& key, cavity_side side) {
    std::size_t i = slot_of(key);
    while (table_[i].stamp == stamp_)
      i = (i + 1) & (table_.size() - 1);
    table_[i] = {key, side, stamp_};
  }
  /// The side offered under this key, if there is one.
  std::optional<cavity_side> take(const std::array<local_id, 3>& key) const {
    for (std::size_t i = slot_of(key); table_[i].stamp == stamp_; i = (i + 1) & (table_.size() - 1))
      if (const auto& known = table_[i].key; known[0] == key[0] && known[1] == key[1] && known[2] == key[2])
        return table_[i].side;
    return std::nullopt;
  }

private:
  struct entry {
    std::array<local_id, 3> key{};
    cavity_side side{};
    std::uint32_t stamp = 0;
  };

  std::size_t slot_of(const std::array<local_id, 3>& key) const {
    const auto mixed = static_cast<std::uint64_t>(key[0]) * 0x9e3779b97f4a7c15ULL ^
                       static_cast<std::uint64_t>(key[1]) * 0xc2b2ae3d27d4eb4fULL ^
                       static_cast<std::uint64_t>(key[2]) * 0x165667b19e3779f9ULL;
    return static_cast<std::size_t>(mixed >> 40) & (table_.size() - 1);
  }
  std::vector<entry> table_;
  std::uint32_t stamp_ = 0;
};

} // namespace dovetail::improvement
