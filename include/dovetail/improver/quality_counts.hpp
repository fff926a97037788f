/// @file
/// Counts of poor elements, of those that the fixed boundary limits and of the rest.
#pragma once

#include "dovetail/core/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

namespace dovetail::improvement {

/// Counts of the poor elements of a mesh.
struct quality_counts {
  /// Counts of one class.
  struct of_class {
    /// All of the class, those that are inverted, and those whose smallest dihedral angle is below the two
    /// limits; the latter count inverted ones too.
    std::size_t elements = 0, inverted = 0, bad = 0, low = 0;
    double min_angle = 180, max_angle = 0; ///< of dihedrals, degrees; of elements that are not inverted
  };
  of_class limited, free; ///< elements that the fixed boundary limits, and the others

  /// Sets counters of a report, named by `when` and the class.
  void write_to(report& to, const std::string& when) const;
};

/// Makes `quality_counts` from the cosines of the elements' extreme angles.
class quality_counter {
public:
  /// Elements with an angle under these, in degrees, are low and bad.
  quality_counter(double low_angle, double bad_angle)
      : cos_low_(cosine(low_angle)), cos_bad_(cosine(bad_angle)) {}

  /// Counts an inverted element.
  void add_inverted(bool is_limited) {
    auto& counted = class_of(is_limited);
    ++counted.elements;
    ++counted.inverted;
    ++counted.bad;
    ++counted.low;
  }
  /// `of_smallest` is the cosine of the element's smallest angle, `of_largest` that of its largest.
  void add(bool is_limited, double of_smallest, double of_largest) {
    auto& counted = class_of(is_limited);
    ++counted.elements;
    counted.bad += of_smallest > cos_bad_;
    counted.low += of_smallest > cos_low_;
    extremes& extreme = is_limited ? of_limited_ : of_free_;
    extreme.of_smallest = std::max(extreme.of_smallest, of_smallest);
    extreme.of_largest = std::min(extreme.of_largest, of_largest);
  }
  /// The counts so far.
  quality_counts result() const;

private:
  struct extremes {
    double of_smallest = -1, of_largest = 1; ///< cosines
  };
  static double cosine(double degrees) { return std::cos(degrees * std::numbers::pi / 180); }
  static double degrees(double cosine) {
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
  }
  quality_counts::of_class& class_of(bool is_limited) { return is_limited ? counts_.limited : counts_.free; }
  static void set_angles(quality_counts::of_class& counted, const extremes& extreme);

  double cos_low_, cos_bad_;
  quality_counts counts_;
  extremes of_limited_, of_free_;
};

} // namespace dovetail::improvement

#ifndef DOVETAIL_COMPILED
#include "dovetail/improver/quality_counts.ipp"
#endif
