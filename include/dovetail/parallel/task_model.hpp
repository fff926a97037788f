/// @file
/// The geometry model that a task may query.
#pragma once

#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/parallel/concepts.hpp"

#include <optional>

namespace dovetail {

/// Made at the start of a task: the model itself, or a copy of the task's own where tasks run in threads and
/// threads may not share the model. The model must outlive it.
class task_model {
public:
  template <executor Executor>
  task_model(const any_geometry& model, const Executor& run) : shared_(&model) {
    if (runs_in_threads(run) && !model.thread_safe())
      own_.emplace(model);
  }
  /// The model to query; valid as long as this.
  const any_geometry& get() const { return own_ ? *own_ : *shared_; }

private:
  const any_geometry* shared_;
  std::optional<any_geometry> own_;
};

} // namespace dovetail
