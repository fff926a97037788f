#include "touching_faces.hpp"

#include "dovetail/core/error.hpp"

#include <array>
#include <optional>

namespace dovetail::app {

touching_faces::touching_faces(const model_options& given, int dimension)
    : options_(given), dimension_(dimension) {
  options_.join_where_crossing = !given.join && !given.input.empty();
}

bool touching_faces::next() {
  constexpr std::array shares_of_diagonal{0.0, 1e-5, 2e-5, 5e-5, 1e-4};
  if (!options_.join_where_crossing)
    return false;
  const double diagonal = load_geometry(options_.input, options_.unit, dimension_).bounds().diagonal();
  while (tried_ < shares_of_diagonal.size()) {
    options_.join = shares_of_diagonal[tried_++] * diagonal;
    try {
      if (has_faces_to_join(options_, dimension_))
        return true;
    } catch (const geometry_error&) { // what is joined so is none
    }
  }
  options_.join = std::nullopt;
  options_.join_where_crossing = false;
  return true;
}

} // namespace dovetail::app
