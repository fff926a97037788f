/// @file
/// Any redistributor behind one type.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/distributed/concepts.hpp"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Holds any redistributor by value; one converts to it. A call costs one indirect call and a look at the
/// result. Throws `partition_error` that names the redistributor for a result that no solver can use.
template <int D>
class any_redistributor {
public:
  template <class R>
    requires(!std::same_as<R, any_redistributor> && redistributor<R, D>)
  any_redistributor(R policy, std::string name = {}) // NOLINT: converts, as std::function does
      : name_(std::move(name)), call_(std::move(policy)) {}

  /// The name it was given, for reports; may be empty.
  const std::string& name() const { return name_; }
  redistribution<D> operator()(const distributed_simplicial_mesh<D>& mesh, int ranks) const {
    redistribution<D> result = call_policy<partition_error>(
        [&] { return named_policy("redistributor", name_); }, [&] { return call_(mesh, ranks); });
    check(result.rank_of_piece, result.divided(mesh).counts.size(), ranks);
    return result;
  }

private:
  void check(const std::vector<local_id>& rank, std::size_t pieces, int ranks) const {
    const auto refuse = [&](const std::string& why) {
      throw partition_error(named_policy("redistributor", name_) + " " + why);
    };
    if (rank.size() != pieces)
      refuse("gave " + std::to_string(rank.size()) + " pieces to ranks, the mesh has " +
             std::to_string(pieces));
    std::vector<bool> has_piece(static_cast<std::size_t>(ranks), false);
    for (const local_id q : rank) {
      if (q < 0 || q >= ranks)
        refuse("gave a piece to rank " + std::to_string(q) + " of " + std::to_string(ranks));
      has_piece[q] = true;
    }
    if (const auto at = std::find(has_piece.begin(), has_piece.end(), false);
        at != has_piece.end() && pieces >= has_piece.size())
      refuse("left rank " + std::to_string(at - has_piece.begin()) + " of " + std::to_string(ranks) +
             " without a piece");
  }

  std::string name_;
  std::function<redistribution<D>(const distributed_simplicial_mesh<D>&, int)> call_;
};
static_assert(redistributor<any_redistributor<2>, 2> && redistributor<any_redistributor<3>, 3>);

} // namespace dovetail
