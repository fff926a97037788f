/// @file
/// Moves inner vertices within the surface towards well-shaped stars; for the states of
/// surface_operations.hpp.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/surface_operations.hpp"

namespace dovetail::detail {

/// Gauss-Seidel smoothing in index order. A vertex is visited again only while it or a neighbour moves.
template <class State>
class smoother {
public:
  explicit smoother(State& state) : s_(state) {}

  /// One pass over the vertices that are awake; returns how many moved noticeably.
  std::size_t pass() {
    awake_.resize(s_.point.size(), 1);
    next_.assign(s_.point.size(), 0);
    std::size_t moved = 0;
    for (local_id v = s_.frozen; v < static_cast<local_id>(s_.point.size()); ++v) {
      if (!awake_[v] || s_.table.corner_of[v] == no_id)
        continue;
      if (!improve(v))
        continue;
      ++moved;
      next_[v] = 1;
      for (const auto& [a, b] : link_)
        next_[a] = 1;
    }
    awake_.swap(next_);
    return moved;
  }
  void wake_all() { awake_.assign(s_.point.size(), 1); }

  /// Moves v towards the middle of its star when that raises the sum of the qualities there and does not make
  /// the worst of them worse.
  bool relax(local_id v) {
    collect_link(s_, v, link_);
    const vec3 step = wanted_point(v) - s_.point[v];
    star now = measure(v);
    return try_step(v, step, strict_rule{}, now) || try_step(v, 0.4 * step, strict_rule{}, now);
  }

  /// Moves v to where the worst triangle of its star is best, by a shrinking pattern search; stops at
  /// `enough`.
  bool maximise_worst(local_id v, double enough = 1) {
    collect_link(s_, v, link_);
    bool any = false;
    star now = measure(v);
    double reach = 0.3 * link_radius(v);
    for (int round = 0; round < 6; ++round) {
      const vec3 n = s_.normal[v];
      const vec3 x = s_.tangent(v), y = cross(n, x);
      bool better = false;
      for (int k = 0; k < 6 && !better; ++k) {
        const double angle = std::numbers::pi / 3 * (k + 0.5 * (round % 2));
        better = try_step(v, reach * (std::cos(angle) * x + std::sin(angle) * y), worst_rule{}, now);
      }
      any = any || better;
      if (!better)
        reach *= 0.5;
      else if (enough < 1 && now.least >= enough)
        break;
    }
    return any;
  }

private:
  struct star {
    double least = 1;
    double sum = 0;
  };
  /// Accepts a move that improves the sum without making a bad star worse.
  struct balanced_rule {
    bool operator()(const star& before, const star& after) const {
      constexpr double good_enough = 0.36;
      if (before.least < good_enough && after.least < before.least)
        return before.least < 0 ? false : after.least >= good_enough;
      if (after.least < good_enough)
        return after.least > before.least + 1e-4 ||
               (after.least >= before.least && after.sum > before.sum + 1e-4);
      return before.least < good_enough || after.sum > before.sum + 1e-3;
    }
  };
  struct strict_rule {
    bool operator()(const star& before, const star& after) const {
      return after.least >= before.least && after.sum > before.sum + 1e-3;
    }
  };
  struct worst_rule {
    bool operator()(const star& before, const star& after) const { return after.least > before.least + 1e-4; }
  };

  bool improve(local_id v) {
    collect_link(s_, v, link_);
    const vec3 step = wanted_point(v) - s_.point[v];
    if (norm_squared(step) < 1e-4 * s_.size[v] * s_.size[v])
      return false;
    star now = measure(v);
    return try_step(v, step, balanced_rule{}, now) || try_step(v, 0.4 * step, balanced_rule{}, now);
  }

  /// The mean of the apexes that would make each triangle of the star equilateral.
  vec3 wanted_point(local_id v) const {
    constexpr double height = 0.8660254037844386;
    const vec3 n = s_.normal[v];
    vec3 sum{};
    for (const auto& [a, b] : link_) {
      const vec3 pa = s_.point[a], pb = s_.point[b];
      sum += midpoint(pa, pb) + height * cross(n, pb - pa);
    }
    return sum / static_cast<double>(link_.size());
  }

  double link_radius(local_id v) const {
    double sum = 0;
    for (const auto& [a, b] : link_)
      sum += s_.length(v, a);
    return sum / static_cast<double>(link_.size());
  }

  /// `now` is what the star measures.
  template <class Rule>
  bool try_step(local_id v, vec3 step, Rule accepts, star& now) {
    const auto to = s_.displaced(v, step, span_of(link_));
    if (!to)
      return false;
    const auto old = s_.location_of(v);
    s_.place(v, *to);
    if (const star after = measure(v); accepts(now, after)) {
      now = after;
      return true;
    }
    s_.place(v, old);
    return false;
  }

  star measure(local_id v) const {
    star result;
    for (const auto& [a, b] : link_) {
      const double q = s_.quality(v, a, b);
      result.least = std::min(result.least, q);
      result.sum += q;
    }
    return result;
  }

  State& s_;
  std::vector<std::uint8_t> awake_, next_;
  std::vector<std::array<local_id, 2>> link_;
};

} // namespace dovetail::detail
