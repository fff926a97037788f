/// @file
/// The geometry model that a task may query.
#pragma once

#include "dovetail/geometry/concepts.hpp"
#include "dovetail/parallel/run_task.hpp"

#include <optional>

namespace dovetail {

/// Made at the start of a task: the model itself, or a copy of the task's own where tasks run in threads and
/// threads may not share the model. The model must outlive it.
template <geometry_model G>
class task_model {
public:
  template <class E>
  task_model(const G& model, const E& run) : shared_(&model) {
    if (runs_in_threads(run) && !model.thread_safe())
      own_.emplace(model);
  }
  const G& get() const { return own_ ? *own_ : *shared_; }

private:
  const G* shared_;
  std::optional<G> own_;
};

} // namespace dovetail
