/// @file
/// The best of what several kinds of change propose for an element.
#pragma once

#include "dovetail/improver/tetrahedra/operation_limits.hpp"

#include <array>
#include <cstddef>
#include <utility>

namespace dovetail::improvement {

/// An operation made of changes that are proposed before one of them is carried out. Each of `Proposals` has
///
/// - `name`: a text for reports, constexpr static
/// - `p.propose(mesh, e, offer)`: calls `offer(find)` for one place after another as long as
/// `offer.is_open()`; `find(change)` fills in a local_change and returns whether it beats what it replaces
template <class... Proposals>
class best_change : Proposals... {
public:
  static constexpr std::array names{Proposals::name...}; ///< of the kinds of change, for reports
  static constexpr turn when = turn::always;             ///< it is tried in all sweeps

  best_change() = default;
  best_change(const best_change&) = delete; // points into itself
  best_change& operator=(const best_change&) = delete;

  /// Executes the best sound change, if there is one.
  bool mend(tet_complex& mesh, local_id e, const operation_limits<3>& limits, const recorded_tries& tries) {
    best_->clear();
    best_->worst = -2;
    std::size_t name = 0;
    (Proposals::propose(mesh, e, offers{*this, mesh, limits, tries, name++}), ...);
    if (best_->fresh.size == 0)
      return false;
    execute(mesh, *best_);
    return true;
  }

private:
  struct offers {
    best_change& own;
    const tet_complex& mesh;
    const operation_limits<3>& limits;
    const recorded_tries& tries;
    std::size_t name;

    /// Nothing good enough was offered yet.
    bool is_open() const { return own.best_->worst < limits.target; }
    template <class Find>
    void operator()(const Find& find) const {
      tries([&] { return find(*own.trial_) && own.keep_better(mesh, limits.band); }, name);
    }
  };
  bool keep_better(const tet_complex& mesh, const size_band& band) {
    if (!(trial_->worst > best_->worst) || !is_sound(mesh, *trial_) || !band.admits(mesh, *trial_))
      return false;
    std::swap(best_, trial_);
    return true;
  }

  std::array<local_change, 2> changes_;
  local_change *best_ = &changes_[0], *trial_ = &changes_[1];
};

} // namespace dovetail::improvement
