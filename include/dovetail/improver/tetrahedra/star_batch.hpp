/// @file
/// The star of one vertex as structure of arrays: all its elements are measured at once, in vector
/// instructions, for a trial position of the vertex.
#pragma once

#include "dovetail/core/vector.hpp"
#include "dovetail/improver/shape_measure.hpp"
#include "dovetail/improver/tetrahedra/tet_walks.hpp"

#include <array>

namespace dovetail::improvement {

/// The sides opposite the vertex, in single precision relative to a centre and a length near the star's own:
/// values are good to about 1e-5 unless the star is nearly degenerate.
template <shape_measure Measure>
class star_batch {
public:
  static constexpr int lanes = 16;          ///< the batch is padded to a multiple of this
  static constexpr int capacity = max_star; ///< sides that there is room for
  static_assert(capacity % lanes == 0);
  using values = std::array<float, static_cast<std::size_t>(capacity)>; ///< one value for each side

  /// Begins a star around a centre, of that length.
  void start(vec3 center, double length) {
    center_ = center;
    scale_ = 1 / length;
    size_ = 0;
  }
  /// Adds the element (vertex, a, b, c); positive when (a-p) x (b-p) . (c-p) > 0.
  bool add(vec3 a, vec3 b, vec3 c) {
    if (size_ == capacity)
      return false;
    put(0, a);
    put(3, b);
    put(6, c);
    ++size_;
    return true;
  }
  /// Fills the batch up with copies of its first element; call after the last `add`.
  void finish() {
    padded_ = (size_ + lanes - 1) / lanes * lanes;
    for (int i = size_; i < padded_; ++i)
      for (auto& coordinate : sides_)
        coordinate[i] = coordinate[0];
  }
  int size() const { return size_; }

  /// A position of the mesh in the batch's own units, and back.
  triple<float> to_local(vec3 p) const {
    const vec3 d = scale_ * (p - center_);
    return {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
  }
  /// A position in the star as a point of the mesh.
  vec3 to_global(triple<float> p) const { return center_ + vec3{p.x, p.y, p.z} / scale_; }

  /// The value of every element with the vertex at `p` (local units); returns the smallest.
  float measure(triple<float> p, values& out) const {
    const auto& s = sides_;
    for (int i = 0; i < padded_; ++i) {
      const int k = i;
      out[k] = Measure::template of_apex<float>({s[0][k] - p.x, s[1][k] - p.y, s[2][k] - p.z},
                                                {s[3][k] - p.x, s[4][k] - p.y, s[5][k] - p.z},
                                                {s[6][k] - p.x, s[7][k] - p.y, s[8][k] - p.z});
    }
    return least_of(out, padded_, 2);
  }
  /// The least of the first `count` values, a multiple of `lanes`, and `bound`.
  static float least_of(const values& of, int count, float bound) {
    std::array<float, lanes> least;
    least.fill(bound);
    for (int i = 0; i < count; i += lanes)
      for (int l = 0; l < lanes; ++l)
        least[l] = detail::smaller(of[i + l], least[l]);
    for (const float value : least)
      bound = detail::smaller(value, bound);
    return bound;
  }
  int padded_size() const { return padded_; } ///< sides, rounded up to whole vectors

private:
  void put(int row, vec3 p) {
    const auto local = to_local(p);
    sides_[row][size_] = local.x;
    sides_[row + 1][size_] = local.y;
    sides_[row + 2][size_] = local.z;
  }

  alignas(64) std::array<values, 9> sides_;
  vec3 center_;
  double scale_ = 1;
  int size_ = 0, padded_ = 0;
};

} // namespace dovetail::improvement
