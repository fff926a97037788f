/// @file
/// Progress and cancellation, passed down by value; a default-constructed one does nothing.
#pragma once

#include "dovetail/core/error.hpp"

#include <cstddef>
#include <functional>
#include <string_view>

namespace dovetail {

/// Callbacks of a long-running call. Both may be empty. They are called from the calling thread only.
struct progress {
  /// Stage name, units done, units in total (0 when unknown).
  std::function<void(std::string_view stage, std::size_t done, std::size_t total)> update = {};
  /// Returns true when the caller wants to stop; the library then throws `cancelled`.
  std::function<bool()> stop_requested = {};

  /// Tells that `done` of `total` parts of a stage are done; throws `cancelled` if asked to stop.
  void operator()(std::string_view stage, std::size_t done, std::size_t total) const {
    if (update)
      update(stage, done, total);
    stop_if_requested();
  }
  /// Throws `cancelled` if asked to stop.
  void stop_if_requested() const {
    if (stop_requested && stop_requested())
      throw cancelled();
  }
  /// The same without the updates, for the parts of a stage.
  progress only_stopping() const { return {.update = {}, .stop_requested = stop_requested}; }
};

} // namespace dovetail
