/// @file
/// How many tries that come to nothing the costly operations may make: work is bounded by what it gains.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace dovetail::improvement {

/// What to expect of an element: `narrow` are those at a limiting part of the fixed surface and those with
/// fixed vertices only that are not bad. Thin parts consist of nothing else, and most of them are beyond
/// help. All others are `open`; `count` is the number of kinds.
enum class prospect : std::size_t { open, narrow, count };

/// For one prospect.
struct effort_limits {
  double share;       ///< tries that may come to nothing, as a share of the elements of the mesh
  std::size_t least;  ///< and at least so many
  std::size_t reward; ///< further tries for each one that paid
};
/// The credit of each kind of element.
struct effort_plan {
  effort_limits open{.share = 0.05, .least = 100, .reward = 8};   ///< of elements that may come to something
  effort_limits narrow{.share = 0.002, .least = 30, .reward = 2}; ///< of elements that hardly will
};

/// Credit per prospect: every try costs one, one that pays brings the reward. While more than one try in
/// `reward` pays it goes on; where fewer do, the credit ends.
class effort {
public:
  effort(const effort_plan& plan, std::size_t elements)
      : accounts_{start(plan.open, elements), start(plan.narrow, elements)} {}

  /// Whether there is credit for another try.
  bool allows(prospect kind) const { return account_of(kind).credit > 0; }
  /// Charges a try, and rewards one that paid.
  void record(prospect kind, bool paid) {
    auto& charged = accounts_[static_cast<std::size_t>(kind)];
    charged.credit += (paid ? charged.reward : 0) - 1;
  }

private:
  struct account {
    std::size_t credit, reward;
  };
  static account start(const effort_limits& limits, std::size_t elements) {
    const auto share = static_cast<std::size_t>(limits.share * static_cast<double>(elements));
    return {std::max(limits.least, share), limits.reward};
  }
  const account& account_of(prospect kind) const { return accounts_[static_cast<std::size_t>(kind)]; }

  std::array<account, static_cast<std::size_t>(prospect::count)> accounts_;
};

} // namespace dovetail::improvement
