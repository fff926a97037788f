/// @file
/// Do triangles lie beside each other like those of a map? A quick proof that no two of a set cross.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace dovetail {

/// Proves for sets of triangles of one mesh that no two of a set cross: seen along some direction all show
/// their front, and the edges that only one triangle of the set has make one closed polygon without crossings
/// (Volino and Magnenat-Thalmann's criterion, 1994). Then the set covers every point of the polygon's inside
/// once. Rounding is on the safe side: `true` is proven, `false` says nothing. Keeps scratch memory between
/// calls; not for several threads at once.
class single_sheet {
public:
  single_sheet(std::span<const vec3> points, std::span<const simplex<2>> triangles)
      : points_(points), triangles_(triangles) {}

  /// O(n) expected, but for the polygon, whose b edges are swept in O(b log b) when they are short.
  bool operator()(std::span<const local_id> set) {
    return faces_one_way(set) && make_view(set) && find_outline(set) && is_one_loop() && is_simple();
  }

private:
  struct edge_slot {
    local_id low = no_id, high = no_id; ///< of its ends
    std::int8_t state = 0;              ///< 1 or -1: passed once, from `low` or to it; 2: in both directions
  };
  struct segment {
    vec2 a, b;
    std::array<local_id, 2> ends;
    double left, right;
  };

  vec3 at(local_id v) const { return points_[v]; }
  const simplex<2>& triangle(local_id t) const { return triangles_[t]; }
  vec3 normal_of(const simplex<2>& t) const { return cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0])); }

  /// Sums the normals; stops at the first that is turned by a right angle from the first of all.
  bool faces_one_way(std::span<const local_id> set) {
    const vec3 first = normal_of(triangle(set.front()));
    direction_ = {};
    for (const local_id t : set) {
      const vec3 normal = normal_of(triangle(t));
      if (!(dot(normal, first) > 0))
        return false;
      direction_ += normal;
    }
    return norm(direction_) > 0;
  }

  /// A frame seen along the direction; all triangles must show their front there, rounding or not.
  bool make_view(std::span<const local_id> set) {
    direction_ = normalized(direction_);
    const vec3 other = std::abs(direction_.x) < 0.6 ? vec3{1, 0, 0} : vec3{0, 1, 0};
    right_ = normalized(cross(other, direction_));
    up_ = cross(direction_, right_);
    origin_ = at(triangle(set.front())[0]);
    double largest = 0;
    for (const local_id t : set)
      for (const local_id v : triangle(t))
        for (int axis = 0; axis < 3; ++axis)
          largest = std::max(largest, std::abs(at(v)[axis]));
    rounding_ = 64 * std::numeric_limits<double>::epsilon() * largest;
    return std::all_of(set.begin(), set.end(), [&](local_id t) {
      const simplex<2>& v = triangle(t);
      const vec3 first = at(v[1]) - at(v[0]), second = at(v[2]) - at(v[0]);
      return dot(cross(first, second), direction_) > rounding_ * (norm(first) + norm(second));
    });
  }

  /// The edges of one triangle of the set; false when an edge is passed twice in one direction.
  bool find_outline(std::span<const local_id> set) {
    std::size_t slots = 16;
    while (slots < 4 * set.size())
      slots *= 2;
    table_.assign(slots, {});
    for (const local_id t : set)
      for (std::size_t k = 0; k < 3; ++k)
        if (!pass(triangle(t)[k], triangle(t)[(k + 1) % 3]))
          return false;
    outline_.clear();
    for (const edge_slot& edge : table_)
      if (edge.state == 1)
        outline_.push_back({edge.low, edge.high});
      else if (edge.state == -1)
        outline_.push_back({edge.high, edge.low});
    sort_all(outline_); // the order in the table is a matter of numbers only, but a sorted one is searched
    return !outline_.empty();
  }

  bool pass(local_id from, local_id to) {
    const local_id low = std::min(from, to), high = std::max(from, to);
    const auto state = static_cast<std::int8_t>(from == low ? 1 : -1);
    const std::uint64_t key =
        static_cast<std::uint64_t>(static_cast<std::uint32_t>(low)) << 32 | static_cast<std::uint32_t>(high);
    const std::size_t mask = table_.size() - 1;
    for (auto slot = static_cast<std::size_t>((key * 0x9e3779b97f4a7c15U) >> 32) & mask;;
         slot = (slot + 1) & mask) {
      edge_slot& edge = table_[slot];
      if (edge.state == 0) {
        edge = {low, high, state};
        return true;
      }
      if (edge.low == low && edge.high == high) {
        const bool back = edge.state == -state;
        edge.state = 2;
        return back;
      }
    }
  }

  /// Puts the outline's edges in the order in which they follow each other. Where two leave a point, one is
  /// never reached.
  bool is_one_loop() {
    loop_.clear();
    std::array<local_id, 2> edge = outline_.front();
    do {
      loop_.push_back(edge);
      const auto next =
          std::lower_bound(outline_.begin(), outline_.end(),
                           std::array<local_id, 2>{edge[1], std::numeric_limits<local_id>::min()});
      if (next == outline_.end() || (*next)[0] != edge[1])
        return false;
      edge = *next;
    } while (edge != outline_.front() && loop_.size() <= outline_.size());
    return loop_.size() == outline_.size();
  }

  vec2 seen(local_id v) const {
    const vec3 p = at(v) - origin_;
    return {dot(p, right_), dot(p, up_)};
  }

  bool is_simple() {
    segments_.clear();
    for (const auto& edge : loop_) {
      const vec2 a = seen(edge[0]), b = seen(edge[1]);
      segments_.push_back({a, b, edge, std::min(a.x, b.x), std::max(a.x, b.x)});
    }
    sort_all(segments_, [](const segment& s, const segment& t) { return s.left < t.left; });
    for (std::size_t i = 0; i < segments_.size(); ++i)
      for (std::size_t j = i + 1; j < segments_.size() && segments_[j].left <= segments_[i].right + rounding_;
           ++j)
        if (!are_apart(segments_[i], segments_[j]))
          return false;
    return true;
  }

  /// Of two that follow each other nothing is asked: where one goes back over the other, the next after it
  /// begins or ends on that one as well.
  bool are_apart(const segment& s, const segment& t) const {
    if (s.ends[1] == t.ends[0] || t.ends[1] == s.ends[0])
      return true;
    if (std::min(s.a.y, s.b.y) > std::max(t.a.y, t.b.y) + rounding_ ||
        std::min(t.a.y, t.b.y) > std::max(s.a.y, s.b.y) + rounding_)
      return true;
    return beside(s, t) || beside(t, s);
  }

  /// Both ends of t are on one side of the line of s.
  bool beside(const segment& s, const segment& t) const {
    const vec2 along = s.b - s.a, first = t.a - s.a, second = t.b - s.a;
    const double margin = rounding_ * (norm(along) + norm(first) + norm(second));
    const double of_first = cross(along, first), of_second = cross(along, second);
    return (of_first > margin && of_second > margin) || (of_first < -margin && of_second < -margin);
  }

  std::span<const vec3> points_;
  std::span<const simplex<2>> triangles_;
  vec3 direction_{}, right_{}, up_{}, origin_{};
  double rounding_ = 0;
  std::vector<edge_slot> table_;
  std::vector<std::array<local_id, 2>> outline_, loop_;
  std::vector<segment> segments_;
};

} // namespace dovetail
