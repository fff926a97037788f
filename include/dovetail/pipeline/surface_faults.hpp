/// @file
/// What is wrong with a surface of triangles, counted and named by the places.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <cstddef>
#include <string>

namespace dovetail::detail {

/// Counts faults of one kind and keeps the words for the first ones.
class surface_faults {
public:
  template <class Text>
  void add(const Text& text) {
    if (count_++ < most_named)
      named_ += (named_.empty() ? "" : "; ") + text();
  }
  /// Throws when there are any. The remedy comes first, since the list may be long.
  void check(const std::string& one, const std::string& several, const std::string& remedy) const {
    if (count_ > 0)
      throw geometry_error((count_ == 1 ? one : std::to_string(count_) + " " + several) + "; " + remedy +
                           ": " + named_ + (count_ > most_named ? "; ..." : ""));
  }

private:
  static constexpr std::size_t most_named = 3;
  std::size_t count_ = 0;
  std::string named_;
};

inline std::string triangle_text(const simplicial_mesh<2>& surface, std::size_t t) {
  vec3 middle;
  for (const local_id v : surface.elements[t])
    middle = middle + surface.points[v] / 3.0;
  return std::to_string(t) + " at " + place_text(middle);
}

} // namespace dovetail::detail
