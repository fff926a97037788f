/// @file
/// The same size everywhere.
#pragma once

#include "dovetail/sizing/bounds.hpp"

namespace dovetail {

/// One size for all space. Throws `sizing_error` for a size that is not positive and finite.
class uniform_size {
public:
  explicit uniform_size(double size) : size_(sizing::checked_size(size, "the uniform size")) {}

  double operator()(vec3) const { return size_; }
  double smallest_size_in(const box3&) const { return size_; }

private:
  double size_;
};

} // namespace dovetail
