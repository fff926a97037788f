/// @file
/// Tasks over pieces whose results are kept in an entity store: by the task itself where it can, else by the
/// process that started it.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/content_key.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/progress.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/entity_store.hpp"
#include "dovetail/parallel/final_errors.hpp"

#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

struct kept_tasks {
  const any_executor& run_tasks;
  entity_store& store;
  progress on_progress = {};

  /// Runs `task(i)` for each size, the largest first, and then `take(i, reader of what it gave)` in turn.
  /// Throws `mesh_error` that names stage and task when one fails, the `io_error`, `sizing_error` and
  /// `usage_error` of a task, and `cancelled`.
  template <class Task, class Take>
  void run(const char* stage, const std::vector<global_id>& sizes, const Task& task, const Take& take) const {
    run_options options;
    options.order.resize(sizes.size());
    std::iota(options.order.begin(), options.order.end(), std::size_t{0});
    stable_sort_all(options.order, [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
    options.on_progress = on_progress;
    options.stage = stage;
    auto outcomes = run_tasks.run(
        sizes.size(), [&](std::size_t i) { return detail::with_final_errors([&] { return task(i); }); },
        options);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      if (!outcomes[i].ok)
        throw mesh_error(std::string(stage) + ", number " + std::to_string(i) + ": " + outcomes[i].failure);
      const byte_buffer said = detail::without_final_errors(std::move(outcomes[i].result));
      byte_reader from(said);
      take(i, from);
    }
  }
  /// In a task: keeps bytes under their key, or adds them to its reply.
  void keep(content_key key, const byte_buffer& bytes, byte_writer& reply) const {
    reply.value(key);
    if (store.is_shared())
      store.keep(key, bytes);
    else
      reply.array(bytes);
  }
  /// In a task: says that the store, a shared one, has the entity already.
  void keep_found(content_key key, byte_writer& reply) const { reply.value(key); }
  /// After a run: gives each rank what others have kept, where their spools are not the same.
  void exchange(std::span<const content_key> keys) const { store.exchange(run_tasks.network(), keys); }
  /// What `keep` or `keep_found` has said.
  content_key take_kept(byte_reader& from) const {
    const auto key = from.value<content_key>();
    if (!store.is_shared())
      store.keep(key, from.array<std::byte>());
    return key;
  }
};

} // namespace dovetail
