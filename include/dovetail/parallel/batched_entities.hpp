/// @file
/// Small entities, of a millisecond or less, that are made many in a task and lie in the entity store
/// together.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/content_key.hpp"
#include "dovetail/core/encoding.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/entity_store.hpp"
#include "dovetail/parallel/map_tasks.hpp"

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

/// An entity that could not be made.
struct entity_failure {
  std::size_t entity = 0; ///< its number in the call
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

/// Values of one type by their keys. Consecutive ones that are missing make a batch, which is one task and
/// one blob of the store; its key is that of its members, so a resumed run, where the same ones are missing,
/// finds it again. Here are only keys: 40 bytes per entity, and the blobs where the store has no disk.
template <encodable Entity>
class batched_entities {
public:
  /// Makes the entities of the given numbers; runs in a task.
  using maker = std::function<std::vector<Entity>(const std::vector<std::size_t>& entities)>;

  explicit batched_entities(std::shared_ptr<entity_store> store) : store_(std::move(store)) {}

  /// How many were made so far, and not found.
  std::size_t made() const { return made_; }

  /// Makes those that are not there, in batches of at least `batch_cost`, the costliest first. The members of
  /// a batch that fails are made again one by one; those that fail alone are returned, by growing number, and
  /// the others are kept. An `io_error` of the store, a `sizing_error` and a `usage_error`, which no other
  /// attempt mends, are thrown.
  std::vector<entity_failure> make_missing(std::span<const content_key> keys, std::span<const double> costs,
                                           double batch_cost, const maker& make, const any_executor& run,
                                           run_options options) {
    std::vector<entity_failure> failures;
    std::vector<batch> alone;
    const auto fail = [&](const batch& failed, std::string reason) {
      if (failed.members.size() == 1)
        failures.push_back({failed.members.front(), std::move(reason)});
      else
        for (const std::size_t i : failed.members)
          alone.push_back(batch_of(keys, costs, {i}));
    };
    make_all(missing(keys, costs, batch_cost), keys, make, run, options, fail);
    make_all(std::exchange(alone, {}), keys, make, run, options, fail);
    stable_sort_all(failures, [](const auto& a, const auto& b) { return a.entity < b.entity; });
    return failures;
  }

  /// Calls `use(i, entity)` for each key in turn. A blob is read once, and held from its first entity in
  /// `keys` to its last. Throws `io_error` when one is missing or damaged.
  template <class Use>
  void for_each(std::span<const content_key> keys, const Use& use) const {
    struct open_batch {
      std::size_t uses = 0;
      std::vector<Entity> members;
    };
    std::unordered_map<content_key, open_batch, content_key_hash> open;
    for (const content_key key : keys)
      ++open[places_.at(key).batch].uses;
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const place at = places_.at(keys[i]);
      open_batch& held = open[at.batch];
      if (held.members.empty())
        held.members = store_->value<std::vector<Entity>>(at.batch);
      use(i, std::as_const(held.members[at.member]));
      if (--held.uses == 0)
        open.erase(at.batch);
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

  static batch batch_of(std::span<const content_key> keys, std::span<const double> costs,
                        std::vector<std::size_t> members) {
    batch result{.members = std::move(members)};
    key_maker make;
    for (const std::size_t i : result.members) {
      make(static_cast<std::int64_t>(keys[i].value));
      result.cost += costs[i];
    }
    result.key = make.key();
    return result;
  }

  std::vector<batch> missing(std::span<const content_key> keys, std::span<const double> costs,
                             double batch_cost) const {
    std::vector<batch> batches;
    std::vector<std::size_t> members;
    double cost = 0;
    const auto close = [&] {
      if (!members.empty())
        batches.push_back(batch_of(keys, costs, std::exchange(members, {})));
      cost = 0;
    };
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (places_.contains(keys[i]))
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
  template <class Fail>
  void make_all(const std::vector<batch>& batches, std::span<const content_key> keys, const maker& make,
                const any_executor& run, run_options options, const Fail& fail) {
    options.order.resize(batches.size());
    std::iota(options.order.begin(), options.order.end(), std::size_t{0});
    stable_sort_all(options.order,
                    [&](std::size_t a, std::size_t b) { return batches[a].cost > batches[b].cost; });
    auto results = map_tasks(
        run, batches.size(), [&](std::size_t b) { return make_batch(batches[b], make); }, options);
    std::vector<content_key> kept;
    for (std::size_t b = 0; b < batches.size(); ++b) {
      const std::vector<std::size_t>& members = batches[b].members;
      if (!results[b].value) {
        fail(batches[b], std::move(results[b].failure));
        continue;
      }
      made_ += results[b].value->is_new ? members.size() : 0;
      kept.push_back(store_->take(std::move(results[b].value->kept)));
      for (std::size_t i = 0; i < members.size(); ++i)
        places_[keys[members[i]]] = {batches[b].key, i};
    }
    store_->exchange(run.network(), kept);
  }

  /// In a worker, which puts it into the store itself where it can.
  detail::made_batch make_batch(const batch& wanted, const maker& make) const {
    if (store_->is_shared() && store_->find(wanted.key))
      return {false, {wanted.key, {}}};
    return {true, store_->keep_in_task(wanted.key, encoded(make(wanted.members)))};
  }

  std::shared_ptr<entity_store> store_;
  std::unordered_map<content_key, place, content_key_hash> places_;
  std::size_t made_ = 0;
};

} // namespace dovetail
