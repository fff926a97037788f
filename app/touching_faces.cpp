#include "touching_faces.hpp"

#include "dovetail/core/error.hpp"

#include <array>
#include <optional>

namespace dovetail::app {

touching_faces::touching_faces(const model_options& given, int dimension)
    : options_(given), dimension_(dimension), may_join_(!given.join && may_be_read_again(given.input)) {
  options_.crossing_is_told = may_join_;
}

bool touching_faces::next() {
  // Shares of the diagonal within which faces are joined; nothing: the model as it was drawn.
  constexpr std::array<std::optional<double>, 6> shares{0.0, std::nullopt, 1e-5, 2e-5, 5e-5, 1e-4};
  while (may_join_ && tried_ < shares.size()) {
    const std::optional<double> share = shares[tried_++];
    options_.crossing_is_told = share && *share > 0;
    options_.joined_for_crossing = share.has_value();
    options_.join = share;
    if (!share && !options_.keep_all)
      return true;
    if (!share)
      continue;
    if (*share > 0) {
      if (diagonal_ == 0)
        diagonal_ = load_geometry(options_.input, options_.unit, dimension_).bounds().diagonal();
      *options_.join *= diagonal_;
    }
    if (has_faces_to_join(options_, dimension_))
      return true;
  }
  return false;
}

} // namespace dovetail::app
