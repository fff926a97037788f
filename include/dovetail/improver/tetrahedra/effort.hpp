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
/// The credit of each kind of element, and an end to all.
struct effort_plan {
  effort_limits open{.share = 0.05, .least = 100, .reward = 8};   ///< of elements that may come to something
  effort_limits narrow{.share = 0.002, .least = 30, .reward = 2}; ///< of elements that hardly will
  /// Tries in all, as a share of the elements: where a third of a mesh is poor, as in thin walls, there is
  /// always a little to gain. Meshes without them need a fiftieth.
  double most = 0.05;
  std::size_t least_of_most = 1000; ///< and at least so many
};

/// Credit per prospect: every try costs one, one that pays brings the reward. While more than one try in
/// `reward` pays it goes on; where fewer do, the credit ends.
class effort {
public:
  effort(const effort_plan& plan, std::size_t elements)
      : accounts_{start(plan.open, elements), start(plan.narrow, elements)},
        tries_left_(at_least(plan.least_of_most, plan.most, elements)) {}

  /// Whether there is credit for another try.
  bool allows(prospect kind) const { return tries_left_ > 0 && account_of(kind).credit > 0; }
  /// Charges a try, and rewards one that paid.
  void record(prospect kind, bool paid) {
    --tries_left_;
    auto& charged = accounts_[static_cast<std::size_t>(kind)];
    charged.credit += (paid ? charged.reward : 0) - 1;
  }

private:
  struct account {
    std::size_t credit, reward;
  };
  static std::size_t at_least(std::size_t least, double share, std::size_t elements) {
    return std::max(least, static_cast<std::size_t>(share * static_cast<double>(elements)));
  }
  static account start(const effort_limits& limits, std::size_t elements) {
    return {at_least(limits.least, limits.share, elements), limits.reward};
  }
  const account& account_of(prospect kind) const { return accounts_[static_cast<std::size_t>(kind)]; }

  std::array<account, static_cast<std::size_t>(prospect::count)> accounts_;
  std::size_t tries_left_;
};

} // namespace dovetail::improvement
