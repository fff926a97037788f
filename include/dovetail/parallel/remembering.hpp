/// @file
/// Executors that keep what stages make through them, or do not.
#pragma once

#include "dovetail/parallel/concepts.hpp"
#include "dovetail/parallel/run_results.hpp"
#include "dovetail/parallel/wraps.hpp"

#include <concepts>
#include <memory>
#include <utility>

namespace dovetail::parallel {

/// A model of `executor`: another one, and what stages have made through it. What a stage asks for again,
/// with the same inputs, is found: in memory, or on a disk, also by a later run (`checkpointed`). Copies
/// share it. Model, sizes, policies and options must be the same for all that is made through it.
template <executor E>
class remembering : public wraps<remembering<E>, E> {
public:
  // Of nothing that converts to an executor, as this does itself.
  template <std::same_as<E> Given>
  explicit remembering(Given run, std::shared_ptr<const blob_place> disk = {})
      : wraps<remembering<E>, E>(std::move(run)), results_(std::make_shared<run_results>(std::move(disk))) {}

  /// What was made so far.
  std::shared_ptr<run_results> results() const { return results_; }

private:
  std::shared_ptr<run_results> results_;
};
template <executor E>
remembering(E) -> remembering<E>;
template <executor E>
remembering(E, std::shared_ptr<const blob_place>) -> remembering<E>;

/// A model of `executor`: another one, which keeps nothing of what is made through this one.
template <executor E>
class forgetting : public wraps<forgetting<E>, E> {
public:
  // As above.
  template <std::same_as<E> Given>
  explicit forgetting(Given run) : wraps<forgetting<E>, E>(std::move(run)) {}

  /// None.
  std::shared_ptr<run_results> results() const { return nullptr; }
};
template <executor E>
forgetting(E) -> forgetting<E>;

/// An executor as `forgetting` it; of the same type where that can hold it, so that what is called with it is
/// not compiled a second time.
/// \param run an executor
template <executor E>
auto forgetful(const E& run) {
  if constexpr (std::constructible_from<E, forgetting<E>>)
    return E(forgetting<E>(run));
  else
    return forgetting<E>(run);
}

} // namespace dovetail::parallel
