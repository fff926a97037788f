/// @file
/// A field of limited growth that is costly to evaluate, precomputed on an octree.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/sizing/erased.hpp"
#include "dovetail/sizing/octree_values.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>

namespace dovetail {

/// How exactly a field is tabulated.
struct table_options {
  double relative_error = 0.10;           ///< at the centre of every leaf
  std::size_t largest_leaves = 4'000'000; ///< stop refining there; `error_bound()` tells what was reached
};

/// A field by trilinear interpolation between the corners of an octree: for fields whose growth is limited
/// and that are asked often. Inside the domain evaluated in O(depth) without calling the field, outside it by
/// the field itself. Leaves are at most `width_per_size` times as wide as the smallest size in them, so no
/// value is off by more than 0.87 x growth x width; at the centres, where interpolation is worst but for
/// kinks of the field, it is off by at most the relative error. Built with about three evaluations per leaf;
/// copies share it. Throws `sizing_error` for options out of range and an empty domain.
class tabulated_size {
public:
  template <bounded_below_sizing_field H>
  tabulated_size(const H& field, const box3& domain, const table_options& options = {})
      : held_(std::make_shared<const table>(field, domain, options)) {}

  double operator()(vec3 p) const { return held_->value(p); }
  double smallest_size_in(const box3& box) const { return held_->smallest_in(box); }
  double feature_size(vec3 p) const { return held_->field().feature_size(p); }

  /// What was precomputed.
  const erased_sizing& field() const { return held_->field(); }
  /// The largest relative error found at the centre of a leaf.
  double error_bound() const { return held_->error(); }
  std::size_t leaf_count() const { return held_->leaf_count(); } ///< leaves of the octree

private:
  static constexpr double width_per_size = 2;

  class table : public sizing::octree_values {
  public:
    table(erased_sizing field, const box3& domain, const table_options& options);

    double value(vec3 p) const { return contains(domain_, p) ? interpolated(tree_.locate(p), p) : field_(p); }
    double smallest_in(const box3& box) const;
    const erased_sizing& field() const { return field_; }
    double error() const { return error_; }

  private:
    static box3 cube_of(const box3& domain) {
      if (domain.empty() || !(domain.diagonal() > 0))
        throw sizing_error("the domain of precomputed sizes is empty; give the model's box");
      return cube_around(domain);
    }

    /// Splits level by level. Leaves beside the domain stay as they are.
    void fill(const table_options& options);

    std::uint32_t corner_at(const octree::key& at);

    erased_sizing field_;
    box3 domain_;
    double error_ = 0;
    std::unordered_map<std::uint64_t, std::uint32_t> id_of_; ///< while building, by the place of a corner
  };

  std::shared_ptr<const table> held_;
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/sizing/tabulated.ipp"
#endif
