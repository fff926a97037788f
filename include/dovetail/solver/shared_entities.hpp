/// @file
/// Do ranks that have an edge or a side in common all say so?
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/core/sequence.hpp"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail::io::detail {

/// Edges (N = 2) or sides (N = 3) at the ends of the ranks' elements, and among how many ranks each is shared
/// as the ranks say.
template <std::size_t N>
class shared_entities {
public:
  struct entity {
    std::array<global_id, N> ids; ///< ascending
    local_id rank;                ///< that has it
    local_id sharers;             ///< 1: it says that no other rank has it
  };
  /// An entity that several ranks have, of which one does not say so.
  struct unlisted {
    local_id rank = no_id; ///< which does not list it
    local_id other = no_id;
    std::array<global_id, N> ids{};
  };

  /// A rank adds each of its own once.
  void add(const entity& one) { all_.push_back(one); }

  /// The first that is not listed, or one without ranks. n log n.
  unlisted find_unlisted() {
    sort_all(all_, [](const entity& a, const entity& b) {
      return std::pair(a.ids, a.rank) < std::pair(b.ids, b.rank);
    });
    for (std::size_t i = 0, end; i < all_.size(); i = end) {
      for (end = i + 1; end < all_.size() && all_[end].ids == all_[i].ids;)
        ++end;
      for (std::size_t k = i; k < end; ++k)
        if (static_cast<std::size_t>(all_[k].sharers) != end - i)
          return {all_[k].rank, all_[k == i && end > i + 1 ? i + 1 : i].rank, all_[i].ids};
    }
    return {};
  }

private:
  std::vector<entity> all_;
};

} // namespace dovetail::io::detail
