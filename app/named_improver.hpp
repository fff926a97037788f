/// @file
/// An improver by name, for elements of either dimension.
#pragma once

#include "dovetail/improver/any_improver.hpp"

#include <string>
#include <utility>

namespace dovetail::app {

/// One policy as improver of tetrahedra and, where it is one, of triangles.
class named_improver {
public:
  template <improver<3> I>
  named_improver(I policy, const std::string& name) : of_tetrahedra_(policy, name) {
    if constexpr (improver<I, 2>)
      of_triangles_ = {std::move(policy), name};
  }

  const std::string& name() const { return of_tetrahedra_.name(); }
  const any_improver<3>& of_tetrahedra() const { return of_tetrahedra_; }
  /// Holds nothing when the policy does not take triangles.
  const any_improver<2>& of_triangles() const { return of_triangles_; }

private:
  any_improver<3> of_tetrahedra_;
  any_improver<2> of_triangles_;
};

} // namespace dovetail::app
