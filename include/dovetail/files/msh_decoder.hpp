/// @file
/// The numbers in an MSH file, as text or raw bytes, and the nodes that its numbers name.
#pragma once

#include "dovetail/core/input_file.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/files/msh_encoder.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"
#include "dovetail/mesh/quadratic_element.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::io::detail {

/// Numbers of the body of an MSH file, as text or as raw bytes.
class msh_decoder {
public:
  explicit msh_decoder(file_cursor& at) : at_(at) {}

  bool binary = false;
  bool swapped = false;

  std::int32_t integer() { return binary ? at_.raw<std::int32_t>(swapped) : at_.number<std::int32_t>(); }
  std::uint64_t count() { return binary ? at_.raw<std::uint64_t>(swapped) : at_.number<std::uint64_t>(); }
  double real() { return binary ? at_.raw<double>(swapped) : at_.number<double>(); }
  vec3 point() {
    vec3 p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = real();
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      at_.fail("a node has a coordinate that is not finite");
    return p;
  }
  /// A count of things that take at least so many bytes each in a binary file, or as many digits in text.
  std::size_t count_of(std::size_t bytes_each) { return at_.plausible(count(), binary ? bytes_each : 2); }
  file_cursor& at() { return at_; }

private:
  file_cursor& at_;
};

/// The number of nodes of the element types that are read or passed over; 0 for others.
inline std::size_t msh_node_count(int type, element_order elements) {
  const bool quadratic = elements == element_order::any;
  switch (static_cast<msh_type>(type)) {
  case msh_type::point:
    return 1;
  case msh_type::line:
    return 2;
  case msh_type::triangle:
    return 3;
  case msh_type::tetrahedron:
    return 4;
  case msh_type::quadratic_line:
    return quadratic ? quadratic_nodes<1> : 0;
  case msh_type::quadratic_triangle:
    return quadratic ? quadratic_nodes<2> : 0;
  case msh_type::quadratic_tetrahedron:
    return quadratic ? quadratic_nodes<3> : 0;
  default:
    return 0;
  }
}

/// Finds nodes by their numbers in the file, which may be any.
class node_lookup {
public:
  /// Fails at the cursor's place when a number occurs twice. O(n log n).
  node_lookup(const std::vector<std::uint64_t>& numbers, const file_cursor& at) : at_(at) {
    if (numbers.size() > static_cast<std::size_t>(std::numeric_limits<local_id>::max()))
      at_.fail("the mesh is too large to be read at once");
    known_.reserve(numbers.size());
    for (const auto number : numbers)
      known_.emplace_back(number, static_cast<local_id>(known_.size()));
    std::sort(known_.begin(), known_.end());
    for (std::size_t i = 1; i < known_.size(); ++i)
      if (known_[i].first == known_[i - 1].first)
        at_.fail("the node number " + std::to_string(known_[i].first) + " occurs twice");
    dense_ = !known_.empty() && known_.back().first - known_.front().first == known_.size() - 1;
  }
  /// O(1) when the numbers have no gaps, else O(log n).
  local_id index(std::uint64_t number) const {
    auto at = known_.end();
    if (dense_ && number - known_.front().first < known_.size())
      at = known_.begin() + static_cast<std::ptrdiff_t>(number - known_.front().first);
    else if (!dense_)
      at = std::lower_bound(known_.begin(), known_.end(), std::pair(number, local_id{0}));
    if (at == known_.end() || at->first != number)
      at_.fail("an element refers to node " + std::to_string(number) + ", which does not exist");
    return at->second;
  }

private:
  const file_cursor& at_;
  std::vector<std::pair<std::uint64_t, local_id>> known_;
  bool dense_ = false;
};

} // namespace dovetail::io::detail
