/// @file
/// Tasks over pieces, each of which makes a value that is kept in an entity store, by the task itself where
/// it can, else by the process that started it.
#pragma once

#include "dovetail/core/content_key.hpp"
#include "dovetail/core/encoding.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/progress.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/entity_store.hpp"
#include "dovetail/parallel/map_tasks.hpp"

#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Runs tasks whose values are kept.
struct kept_tasks {
  const any_executor& run_tasks; ///< what runs them
  entity_store& store;           ///< where the values are kept
  progress on_progress = {};     ///< told how the tasks come along

  /// Runs `task(i)` for each size, the largest first, and then `take(i, what it gave)` in turn. Throws
  /// `mesh_error` that names stage and task when one fails, what `map_tasks` throws, and `cancelled`.
  template <class Task, class Take>
  void run(const char* stage, const std::vector<global_id>& sizes, const Task& task, const Take& take) const {
    run_options options;
    options.order.resize(sizes.size());
    std::iota(options.order.begin(), options.order.end(), std::size_t{0});
    stable_sort_all(options.order, [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
    options.on_progress = on_progress;
    options.stage = stage;
    auto results = map_tasks(run_tasks, sizes.size(), task, options);
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (!results[i].value)
        throw mesh_error(std::string(stage) + ", number " + std::to_string(i) + ": " + results[i].failure);
      take(i, *std::move(results[i].value));
    }
  }
  /// In a task: keeps a value under a key.
  template <encodable T>
  kept_value keep(content_key key, const T& value) const {
    return store.keep_in_task(key, encoded(value));
  }
  /// The same under a key of its own content; `make` has what tells it from equal ones of other tasks.
  template <encodable T>
  kept_value keep_by_content(key_maker make, const T& value) const {
    byte_buffer bytes = encoded(value);
    const content_key key = make(bytes).key();
    return store.keep_in_task(key, std::move(bytes));
  }
  /// After a run: gives each rank what others have kept, where their spools are not the same.
  void exchange(std::span<const content_key> keys) const { store.exchange(network_of(run_tasks), keys); }
};

} // namespace dovetail
