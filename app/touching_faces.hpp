/// @file
/// Models whose surfaces cross where they touch, or nearly do: they are read again, with such faces joined.
#pragma once

#include "model_source.hpp"
#include "options.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/geometry/error_of_faces.hpp"

#include <cstddef>
#include <exception>
#include <utility>

namespace dovetail::app {

/// Whether it is that surfaces of the model cross.
inline bool is_crossing(const blames_faces& problem) {
  return dynamic_cast<const intersection_error*>(&problem) != nullptr;
}

/// How a CAD model is read: as it was drawn; where its surfaces cross, with faces joined that touch; where
/// they still do, or none touch, as it was drawn, since details left out may be to blame; and at last with
/// faces joined by growing lengths.
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
    return retried(mesh_it, [&] {
      model_source again = prepared(prepare);
      if (again.file != source.file)
        throw geometry_error(options_.input + ": the file was changed while it was meshed; run again");
      source = std::move(again);
    });
  }

private:
  template <class F, class Before>
  auto retried(const F& attempt, const Before& before_the_next) {
    while (true) {
      try {
        return attempt();
      } catch (const cancelled&) {
        throw;
      } catch (const communication_error&) {
        throw;
      } catch (const error& problem) {
        const auto* blames = dynamic_cast<const blames_faces*>(&problem);
        if (!first_problem_ && !(blames && is_crossing(*blames)))
          throw;
        if (!first_problem_)
          first_problem_ = std::current_exception();
        if (!next())
          std::rethrow_exception(first_problem_); // its faces have the numbers of the file
      }
      before_the_next();
    }
  }

  /// Goes on to another way to read it; false when there is none.
  bool next();

  model_options options_;
  int dimension_;
  bool may_join_;
  std::size_t tried_ = 0; ///< ways
  double diagonal_ = 0;   ///< of the model, once it is needed
  std::exception_ptr first_problem_;
};

} // namespace dovetail::app
