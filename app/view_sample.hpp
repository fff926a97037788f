/// @file
/// Of many elements, which come one after the other, the worst ones and evenly spread ones.
#pragma once

#include "view_scene.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace dovetail::app {

/// An element without its mesh.
struct lone_element {
  std::array<global_id, 4> ids; ///< of its points
  std::array<vec3, 4> corners;
  local_id piece;    ///< its tag, in the file
  local_id material; ///< likewise
  float angle;
  std::uint64_t number = 0; ///< in the order in which they came
};

/// The order of elements from the worst on, each of which has its place.
inline bool is_worse(const lone_element& a, const lone_element& b) {
  return std::tie(a.angle, a.number) < std::tie(b.angle, b.number);
}

/// Memory: three times as many elements as are wanted.
class element_sample {
public:
  explicit element_sample(std::size_t most) : most_(most) {}

  /// One more element, which `make` makes if it is kept.
  template <class Make>
  void add(float angle, const Make& make) {
    const std::uint64_t number = seen_++;
    if (most_ == 0)
      return;
    if (number % step_ == 0)
      add_to_spread(numbered(make(), number));
    if (worst_.size() < view_part::worst_of(most_)) {
      worst_.push_back(numbered(make(), number));
      std::push_heap(worst_.begin(), worst_.end(), is_worse);
    } else if (angle < worst_.front().angle) {
      std::pop_heap(worst_.begin(), worst_.end(), is_worse);
      worst_.back() = numbered(make(), number);
      std::push_heap(worst_.begin(), worst_.end(), is_worse);
    }
  }

  std::uint64_t seen() const { return seen_; }                        ///< how many there were
  std::size_t held() const { return worst_.size() + spread_.size(); } ///< how many are in memory

  /// As many as there is room for, but not more than the sample was made for: all; or half of them the worst
  /// ones, the worst first, then spread ones of the others in their order. The sample is empty then.
  std::vector<lone_element> take(std::size_t room) {
    std::vector<lone_element> kept;
    room = std::min(room, most_);
    if (seen_ <= room) {
      kept.swap(spread_);
    } else {
      kept.swap(worst_);
      std::sort(kept.begin(), kept.end(), is_worse);
      kept.resize(std::min(kept.size(), view_part::worst_of(room)));
      // What is as bad as the worst ones is among them.
      if (!kept.empty())
        std::erase_if(spread_, [last = kept.back()](const lone_element& e) { return !is_worse(last, e); });
      add_spread<lone_element>(kept, spread_, room - kept.size());
    }
    *this = element_sample(0);
    return kept;
  }

private:
  static lone_element numbered(lone_element element, std::uint64_t number) {
    element.number = number;
    return element;
  }
  /// Every n-th; of these every second is left once they are twice as many as are wanted.
  void add_to_spread(const lone_element& element) {
    spread_.push_back(element);
    if (spread_.size() <= 2 * most_)
      return;
    step_ *= 2;
    std::erase_if(spread_, [this](const lone_element& e) { return e.number % step_ != 0; });
  }

  std::size_t most_;
  std::uint64_t seen_ = 0;
  std::uint64_t step_ = 1;
  std::vector<lone_element> worst_;  ///< a heap with the best of them on top
  std::vector<lone_element> spread_; ///< in their order
};

} // namespace dovetail::app
