/// @file
/// A sizing field that is refined at places, round by round, such that what is made elsewhere stays.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/bytes.hpp"
#include "dovetail/sizing/size_balls.hpp"

#include <concepts>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// A field, and balls that were added to it. Each entity (line, patch, piece) gets the field with the balls
/// in reach of the box that it lies in, and is a function of these: what a refinement does not reach stays as
/// it is. A ball reaches to where, grown, it asks for what the field does at its center.
class refined_sizing {
public:
  template <class H>
    requires(!std::same_as<H, refined_sizing> && sizing_field<H>)
  refined_sizing(H plain) : plain_(keep_bounds(std::move(plain))) {} // NOLINT: converts

  /// Whether there are balls: else all of it is the same everywhere, and no box need be known.
  bool is_refined() const { return !balls_.empty(); }
  /// Adds the balls that ask for less than the field at their centers. O(n log n) in all balls.
  void refine(std::span<const size_ball> more);

  /// All that a run adds to the plain field, for another process that has that one: the balls.
  void encode(byte_writer& to) const { to.array(balls_); }
  /// The same field. Throws `input_error` when the data end early.
  static refined_sizing decode(any_sizing plain, byte_reader& from) {
    refined_sizing field(std::move(plain));
    field.refine(from.array<size_ball>());
    return field;
  }

  /// The field for an entity.
  any_sizing near(const box3& entity) const { return within_bounds(plain_, balls_near(entity), growth); }
  /// The field with all balls: for what looks at many places, and is made again whenever one is added.
  any_sizing everywhere() const { return within_bounds(plain_, balls_, growth); }
  /// What tells the field near an entity from the plain one: the balls in reach, in the order in which they
  /// were added. O(log n + balls near).
  std::vector<size_ball> balls_near(const box3& entity) const;

private:
  static constexpr double growth = 0.3;

  any_sizing plain_;
  std::vector<size_ball> balls_; ///< in the order in which they were added
  std::vector<double> reaches_;  ///< per ball
  box_tree tree_;                ///< of the boxes that they reach
};

/// The box around points of an entity.
box3 box_around(std::span<const vec3> points);
/// The same with room for what bulges out between the points of a line or of the boundary of a surface.
inline box3 roomy_box_around(std::span<const vec3> points) {
  const box3 box = box_around(points);
  return inflated(box, 0.5 * box.diagonal());
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/sizing/refined_sizing.ipp"
#endif
