/// @file
/// Models whose surfaces cross where they touch, or nearly do: they are read again, with such faces joined.
#pragma once

#include "model_source.hpp"
#include "options.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/geometry/error_of_faces.hpp"

#include <cstddef>

namespace dovetail::app {

/// Whether surfaces of the model cross.
inline bool is_crossing(const blames_faces& problem) {
  return dynamic_cast<const intersection_error*>(&problem) != nullptr;
}

/// How a model is read: as it was drawn; where surfaces then cross, with faces joined by growing lengths; and
/// where they still do, as it was drawn, which its details may be to blame for.
class touching_faces {
public:
  touching_faces(const model_options& given, int dimension);
  touching_faces(const touching_faces&) = delete; // others refer to its options
  touching_faces& operator=(const touching_faces&) = delete;

  /// How the model is to be read now.
  const model_options& options() const { return options_; }

  /// What `prepare()` makes of the model, read as `options` say.
  template <class Prepare>
  model_source prepared(const Prepare& prepare) {
    return retried(prepare, [] {});
  }

  /// Calls what meshes a source made by `prepare()`; the source is made again where its surfaces cross.
  template <class Prepare, class F>
  auto meshed(model_source& source, const Prepare& prepare, const F& mesh_it) {
    return retried(mesh_it, [&] { source = prepared(prepare); });
  }

private:
  template <class F, class Before>
  auto retried(const F& attempt, const Before& before_the_next) {
    while (true) {
      try {
        return attempt();
      } catch (const blames_faces& problem) {
        if (!is_crossing(problem) || !next())
          throw;
      }
      before_the_next();
    }
  }

  /// Goes on to another way to read it; false when there is none.
  bool next();

  model_options options_;
  int dimension_;
  std::size_t tried_ = 0; ///< lengths
};

} // namespace dovetail::app
