/// @file
/// The geometry model that a task may query.
#pragma once

#include "dovetail/geometry/concepts.hpp"
#include "dovetail/parallel/concepts.hpp"

#include <optional>

namespace dovetail {

/// Made at the start of a task: the model itself, or a copy of the task's own where tasks run in threads and
/// threads may not share the model. The model must outlive it.
template <geometry_model Geometry>
class task_model {
public:
  template <executor Executor>
  task_model(const Geometry& model, const Executor& run) : shared_(&model) {
    if (runs_in_threads(run) && !model.thread_safe())
      own_.emplace(model);
  }
  /// The model to query; valid as long as this.
  const Geometry& get() const { return own_ ? *own_ : *shared_; }

private:
  const Geometry* shared_;
  std::optional<Geometry> own_;
};

} // namespace dovetail
