/// @file
/// The best position of the apex of a star: non-smooth maximisation of the worst value.
///
/// Each iteration linearises all values at the present position (forward differences), finds the direction
/// that maximises the worst linear model within a trust radius (a few Frank-Wolfe steps on the weights of the
/// gradients, as in proximal bundle methods), and tries it. Cf. L. Freitag, C. Ollivier-Gooch, "Tetrahedral
/// mesh improvement using swapping and smoothing", for the objective.
#pragma once

#include "dovetail/improver/tetrahedra/star_batch.hpp"

#include <algorithm>
#include <cmath>

namespace dovetail::improvement {

/// How long the search goes on.
struct apex_search_limits {
  int iterations = 6;   ///< linearisations at most
  float enough = 2;     ///< stop when the worst value is above this
  float radius = 0.25F; ///< first trust radius, in units of the star's length

  bool operator==(const apex_search_limits&) const = default;
};

/// Searches the best position of a vertex by its star.
template <shape_measure Measure>
class apex_search {
public:
  using batch = star_batch<Measure>; ///< the star, ready to be measured

  /// Moves `p` (local units) uphill; returns the worst value reached. O(iterations x star).
  float climb(const batch& star, triple<float>& p, const apex_search_limits& limits) {
    float worst = star.measure(p, values_);
    float radius = limits.radius;
    for (int iteration = 0; iteration < limits.iterations && worst < limits.enough; ++iteration) {
      linearise(star, p);
      bool moved = false;
      for (int attempt = 0; attempt < 3 && !moved; ++attempt, radius *= 0.4F) {
        const triple<float> step = best_step(star.padded_size(), radius);
        const triple<float> q{p.x + step.x, p.y + step.y, p.z + step.z};
        const float reached = star.measure(q, trial_);
        if (!(reached > worst + 1e-4F))
          continue;
        moved = true;
        const bool slow = reached - worst < 0.05F * worst;
        p = q;
        worst = reached;
        std::swap(values_, trial_);
        if (slow && iteration > 1)
          return worst;
        radius *= 4;
      }
      if (!moved)
        break;
    }
    return worst;
  }

private:
  using values = typename batch::values;

  void linearise(const batch& star, triple<float> p) {
    constexpr float h = 1e-3F;
    for (int axis = 0; axis < 3; ++axis) {
      const triple<float> q{p.x + (axis == 0 ? h : 0), p.y + (axis == 1 ? h : 0), p.z + (axis == 2 ? h : 0)};
      auto& slope = gradients_[axis];
      star.measure(q, slope);
      for (int i = 0; i < star.padded_size(); ++i)
        slope[i] = (slope[i] - values_[i]) / h;
    }
  }

  /// Approximately the step of length <= radius that maximises min_i (value_i + gradient_i . step).
  triple<float> best_step(int n, float radius) const {
    triple<float> mix{0, 0, 0}; // the convex combination of gradients; the step goes along it
    triple<float> step{0, 0, 0}, best_step{0, 0, 0};
    float best = -3e38F;
    for (int round = 0; round < 8; ++round) {
      const auto [least, at] = lowest_prediction(n, step);
      if (least > best) {
        best = least;
        best_step = step;
      }
      const float weight = 2.0F / static_cast<float>(round + 2);
      const triple<float> g{gradients_[0][at], gradients_[1][at], gradients_[2][at]};
      mix = {mix.x + weight * (g.x - mix.x), mix.y + weight * (g.y - mix.y), mix.z + weight * (g.z - mix.z)};
      const float length = std::sqrt(dot(mix, mix));
      if (!(length > 1e-12F))
        break;
      const float s = radius / length;
      step = {s * mix.x, s * mix.y, s * mix.z};
    }
    return best_step;
  }

  struct prediction {
    float value;
    int at;
  };
  /// The first of the lowest. Two passes, of which the compiler makes vector instructions.
  prediction lowest_prediction(int n, triple<float> step) const {
    alignas(64) values predicted;
    for (int i = 0; i < n; ++i) {
      const int k = i;
      predicted[k] =
          values_[k] + gradients_[0][k] * step.x + gradients_[1][k] * step.y + gradients_[2][k] * step.z;
    }
    const float least = batch::least_of(predicted, n, 3e38F);
    const float* const found = std::find(predicted.data(), predicted.data() + n, least);
    return {least, found == predicted.data() + n ? 0 : static_cast<int>(found - predicted.data())};
  }

  alignas(64) values values_, trial_;
  alignas(64) std::array<values, 3> gradients_;
};

} // namespace dovetail::improvement
