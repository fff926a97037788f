/// @file
/// Where a run keeps what its tasks have made.
#pragma once

#include "dovetail/parallel/entity_store.hpp"
#include "dovetail/parallel/executor_services.hpp"
#include "dovetail/parallel/kept.hpp"

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

namespace dovetail {

/// The results of one run by kinds: on a disk, where a later run finds them, or in the memory of the process
/// that started its workers.
class run_results {
public:
  explicit run_results(std::shared_ptr<const blob_place> disk = {}) : disk_(std::move(disk)) {}

  /// Whether a later run finds them.
  bool outlast_it() const { return disk_ != nullptr; }
  /// Those of a kind, the same for each caller. Not while others ask in other threads.
  std::shared_ptr<entity_store> of(const std::string& kind) {
    auto& store = stores_[kind];
    if (!store)
      store = std::make_shared<entity_store>(disk_, kind);
    return store;
  }

private:
  std::shared_ptr<const blob_place> disk_;
  std::map<std::string, std::shared_ptr<entity_store>> stores_;
};

/// Where a run keeps results of a kind; a place of their own in memory where it keeps none.
/// \param run makes them
/// \param kind what the results are called
template <executor Executor>
std::shared_ptr<entity_store> store_of(const Executor& run, const std::string& kind) {
  const auto results = results_of(run);
  return results ? results->of(kind) : std::make_shared<entity_store>(nullptr, kind);
}

/// The same where a later run finds them; null where none does.
/// \param run makes them
/// \param kind what the results are called
template <executor Executor>
std::shared_ptr<entity_store> lasting_store_of(const Executor& run, const std::string& kind) {
  const auto results = results_of(run);
  return results && results->outlast_it() ? results->of(kind) : nullptr;
}

/// Removes results of a kind from the disk of a run. In memory they stay as long as the executor: others may
/// have them too. Throws what the disk does.
/// \param run made them
/// \param kind what the results are called
/// \param results that nobody asks for any more
template <executor Executor, class Result>
void forget(const Executor& run, const std::string& kind, const std::set<kept<Result>>& results) {
  const auto store = lasting_store_of(run, kind);
  if (store && (leads(run) || !store->is_common()))
    for (const kept<Result>& result : results)
      store->release(result.key());
}

} // namespace dovetail
