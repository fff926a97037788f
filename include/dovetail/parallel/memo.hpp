/// @file
/// Small results, of a millisecond or less, that are made many in a task and kept together.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/content_key.hpp"
#include "dovetail/core/encoding.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/parallel/entity_store.hpp"
#include "dovetail/parallel/executor_services.hpp"
#include "dovetail/parallel/kept.hpp"
#include "dovetail/parallel/map_tasks.hpp"
#include "dovetail/parallel/run_results.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace dovetail {

/// A result that could not be made.
struct memo_failure {
  std::size_t number = 0; ///< in the call
  std::string reason;     ///< what its maker threw
};

namespace detail {

/// What a worker says of a batch.
struct made_batch {
  bool is_new = false; ///< and was not found
  kept_value kept;

  using fields = field_list<&made_batch::is_new, &made_batch::kept>;
};

} // namespace detail

/// Results of one type, each made once, if a call names it once. Consecutive ones that are missing make a
/// batch, which is one task and is kept as a whole under the names of its members, so a resumed run, where
/// the same ones are missing, finds it again. Here are only names: 40 bytes per result, and the batches where
/// the run has no disk.
template <encodable Result>
class memo {
public:
  /// Makes the results of the given numbers; runs in a task.
  using maker = std::function<std::vector<Result>(const std::vector<std::size_t>& numbers)>;

  /// In memory, as long as this.
  memo() : store_(std::make_shared<entity_store>(nullptr, "result")) {}
  /// Where an executor keeps its results, which are called `kind` there.
  template <executor Executor>
  memo(const Executor& run, const std::string& kind) : store_(store_of(run, kind)) {}

  /// How many were made so far, and not found.
  std::size_t made() const { return made_; }

  /// Makes those that are not there, in batches of at least `batch_cost`, the costliest first. The members of
  /// a batch that fails are made again one by one; those that fail alone are returned, by growing number, and
  /// the others are kept. An `io_error`, a `sizing_error` and a `usage_error`, which no other attempt mends,
  /// are thrown.
  template <executor Executor>
  std::vector<memo_failure> make_missing(std::span<const kept<Result>> results, std::span<const double> costs,
                                         double batch_cost, const maker& make, const Executor& run,
                                         run_options options) {
    std::vector<memo_failure> failures;
    std::vector<batch> alone;
    const auto fail = [&](const batch& failed, std::string reason) {
      if (failed.members.size() == 1)
        failures.push_back({failed.members.front(), std::move(reason)});
      else
        for (const std::size_t i : failed.members)
          alone.push_back(batch_of(results, costs, {i}));
    };
    make_all(missing(results, costs, batch_cost), results, make, run, options, fail);
    make_all(std::exchange(alone, {}), results, make, run, options, fail);
    stable_sort_all(failures, [](const auto& a, const auto& b) { return a.number < b.number; });
    return failures;
  }

  /// Calls `use(i, result)` for each in turn. A batch is read once, and held from its first result in
  /// `results` to its last. Throws `io_error` when one is missing or damaged.
  template <class Use>
  void for_each(std::span<const kept<Result>> results, const Use& use) const {
    struct open_batch {
      content_key key = {};
      std::size_t uses = 0;
      std::vector<Result> members = {};
    };
    struct open_place {
      open_batch* batch;
      std::size_t member;
    };
    std::unordered_map<content_key, open_batch, content_key_hash> open;
    std::vector<open_place> places;
    places.reserve(results.size());
    for (const kept<Result>& result : results) {
      const place at = places_.at(result);
      const bool is_next = !places.empty() && places.back().batch->key == at.batch; // as most are
      open_batch& held = is_next ? *places.back().batch : open[at.batch];
      held.key = at.batch;
      ++held.uses;
      places.push_back({&held, at.member});
    }
    for (std::size_t i = 0; i < results.size(); ++i) {
      open_batch& held = *places[i].batch;
      if (held.members.empty())
        held.members = store_->value<std::vector<Result>>(held.key);
      use(i, std::as_const(held.members[places[i].member]));
      if (--held.uses == 0)
        held.members = {};
    }
  }

private:
  struct batch {
    content_key key = {};
    std::vector<std::size_t> members = {}; ///< their numbers in the call
    double cost = 0;
  };
  struct place {
    content_key batch;
    std::size_t member;
  };

  static batch batch_of(std::span<const kept<Result>> results, std::span<const double> costs,
                        std::vector<std::size_t> members) {
    batch made{.members = std::move(members)};
    key_maker make;
    for (const std::size_t i : made.members) {
      make(static_cast<std::int64_t>(results[i].key().value));
      made.cost += costs[i];
    }
    made.key = make.key();
    return made;
  }

  std::vector<batch> missing(std::span<const kept<Result>> results, std::span<const double> costs,
                             double batch_cost) const {
    std::vector<batch> batches;
    std::vector<std::size_t> members;
    double cost = 0;
    const auto close = [&] {
      if (!members.empty())
        batches.push_back(batch_of(results, costs, std::exchange(members, {})));
      cost = 0;
    };
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (places_.contains(results[i]))
        continue;
      members.push_back(i);
      cost += costs[i];
      if (cost >= batch_cost)
        close();
    }
    close();
    return batches;
  }

  /// Keeps the batches that can be made, and calls `fail(batch, reason)` for each other one.
  template <executor Executor, class Fail>
  void make_all(const std::vector<batch>& batches, std::span<const kept<Result>> results, const maker& make,
                const Executor& run, run_options options, const Fail& fail) {
    options.order.resize(batches.size());
    std::iota(options.order.begin(), options.order.end(), std::size_t{0});
    stable_sort_all(options.order,
                    [&](std::size_t a, std::size_t b) { return batches[a].cost > batches[b].cost; });
    auto said = map_tasks(
        run, batches.size(), [&](std::size_t b) { return make_batch(batches[b], make); }, options);
    std::vector<content_key> there;
    for (std::size_t b = 0; b < batches.size(); ++b) {
      const std::vector<std::size_t>& members = batches[b].members;
      if (!said[b].value) {
        fail(batches[b], std::move(said[b].failure));
        continue;
      }
      made_ += said[b].value->is_new ? members.size() : 0;
      there.push_back(store_->take(std::move(said[b].value->kept)));
      for (std::size_t i = 0; i < members.size(); ++i)
        places_[results[members[i]]] = {batches[b].key, i};
    }
    store_->exchange(network_of(run), there);
  }

  /// In a worker, which puts it into the store itself where it can.
  detail::made_batch make_batch(const batch& wanted, const maker& make) const {
    if (store_->find(wanted.key))
      return {false, {wanted.key, {}}};
    return {true, store_->keep_in_task(wanted.key, encoded(make(wanted.members)))};
  }

  std::shared_ptr<entity_store> store_;
  std::unordered_map<kept<Result>, place, kept_hash> places_;
  std::size_t made_ = 0;
};

} // namespace dovetail
