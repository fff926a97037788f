/// @file
/// Small entities, of a millisecond or less, that are made many in a task and lie in the entity store
/// together.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/content_key.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/entity_store.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dovetail {

/// An entity that could not be made.
struct entity_failure {
  std::size_t entity = 0; ///< its number in the call
  std::string reason;
};

/// Entities by their keys. Consecutive ones that are missing make a batch, which is one task and one blob of
/// the store; its key is that of its members, so a resumed run, where the same ones are missing, finds it
/// again. Here are only keys: 40 bytes per entity, and the blobs where the store has no disk.
class batched_entities {
public:
  /// Makes the entities of the given numbers; runs in a task.
  using maker = std::function<std::vector<byte_buffer>(const std::vector<std::size_t>& entities)>;

  explicit batched_entities(std::shared_ptr<entity_store> store) : store_(std::move(store)) {}

  /// How many were made so far, and not found.
  std::size_t made() const { return made_; }

  /// Makes those that are not there, in batches of at least `batch_cost`, the costliest first. The members of
  /// a batch that fails are made again one by one, to find out which they are; these are returned, and of
  /// such a batch none is kept. An `io_error` of the store and a `sizing_error`, which no other attempt
  /// mends, are thrown.
  std::vector<entity_failure> make_missing(std::span<const content_key> keys, std::span<const double> costs,
                                           double batch_cost, const maker& make, const any_executor& run,
                                           run_options options) {
    std::vector<entity_failure> failures;
    const std::vector<batch> batches = missing(keys, costs, batch_cost);
    options.order.resize(batches.size());
    std::iota(options.order.begin(), options.order.end(), std::size_t{0});
    std::stable_sort(options.order.begin(), options.order.end(),
                     [&](std::size_t a, std::size_t b) { return batches[a].cost > batches[b].cost; });
    auto outcomes = run.run(
        batches.size(), [&](std::size_t b) { return make_batch(batches[b], make); }, options);
    for (std::size_t b = 0; b < batches.size(); ++b) {
      const std::vector<std::size_t>& members = batches[b].members;
      if (!outcomes[b].ok) {
        append(failures, failures_among(members, outcomes[b].failure, make, run, options));
        continue;
      }
      accept(batches[b], std::move(outcomes[b].result));
      for (std::size_t i = 0; i < members.size(); ++i)
        places_[keys[members[i]]] = {batches[b].key, i};
    }
    return failures;
  }

  /// Calls `use(i, bytes)` for each key in turn. A blob is read once, and held from its first entity in
  /// `keys` to its last. Throws `io_error` when one is missing or damaged.
  template <class Use>
  void for_each(std::span<const content_key> keys, const Use& use) const {
    struct open_batch {
      std::size_t uses = 0;
      std::vector<byte_buffer> members;
    };
    std::map<content_key, open_batch> open;
    for (const content_key key : keys)
      ++open[places_.at(key).batch].uses;
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const place at = places_.at(keys[i]);
      open_batch& held = open[at.batch];
      if (held.members.empty())
        held.members = members_of(store_->get(at.batch));
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

  std::vector<batch> missing(std::span<const content_key> keys, std::span<const double> costs,
                             double batch_cost) const {
    std::vector<batch> batches;
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (places_.contains(keys[i]))
        continue;
      if (batches.empty() || batches.back().cost >= batch_cost)
        batches.emplace_back();
      batches.back().members.push_back(i);
      batches.back().cost += costs[i];
    }
    for (batch& each : batches) {
      key_maker make;
      for (const std::size_t i : each.members)
        make(static_cast<std::int64_t>(keys[i].value));
      each.key = make.key();
    }
    return batches;
  }

  /// How the reply of a worker ends; before it is the blob, unless the worker has put that into the store
  /// itself, or an error's text.
  enum class reply_kind : std::uint8_t { found, made, cannot_store, bad_size };

  /// In a worker.
  byte_buffer make_batch(const batch& wanted, const maker& make) const {
    try {
      if (store_->is_shared() && store_->find(wanted.key))
        return tagged({}, reply_kind::found);
      byte_writer bytes;
      for (const byte_buffer& member : make(wanted.members))
        bytes.array(member);
      if (!store_->is_shared())
        return tagged(bytes.take(), reply_kind::made);
      store_->keep(wanted.key, bytes.take());
      return tagged({}, reply_kind::made);
    } catch (const io_error& problem) {
      return tagged(as_bytes(problem.what()), reply_kind::cannot_store);
    } catch (const sizing_error& problem) {
      return tagged(as_bytes(problem.what()), reply_kind::bad_size);
    }
  }

  static byte_buffer tagged(byte_buffer bytes, reply_kind kind) {
    bytes.push_back(static_cast<std::byte>(kind));
    return bytes;
  }
  static byte_buffer as_bytes(std::string_view text) {
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    return {first, first + text.size()};
  }

  void accept(const batch& finished, byte_buffer reply) {
    const auto kind = static_cast<reply_kind>(reply.back());
    reply.pop_back();
    const std::string text(reinterpret_cast<const char*>(reply.data()),
                           kind == reply_kind::made ? 0 : reply.size());
    if (kind == reply_kind::cannot_store)
      throw io_error(text);
    if (kind == reply_kind::bad_size)
      throw sizing_error(text);
    if (kind == reply_kind::made)
      made_ += finished.members.size();
    if (!store_->is_shared())
      store_->keep(finished.key, std::move(reply));
  }

  static std::vector<byte_buffer> members_of(const byte_buffer& bytes) {
    std::vector<byte_buffer> members;
    for (byte_reader in(bytes); !in.at_end();)
      members.push_back(in.array<std::byte>());
    return members;
  }

  /// The first of them, for the reason of all `together`, when each by itself can be made.
  static std::vector<entity_failure> failures_among(const std::vector<std::size_t>& members,
                                                    const std::string& together, const maker& make,
                                                    const any_executor& run, run_options options) {
    options.order.clear();
    const auto alone = run.run(
        members.size(),
        [&](std::size_t i) {
          make({members[i]});
          return byte_buffer{};
        },
        options);
    std::vector<entity_failure> failures;
    for (std::size_t i = 0; i < alone.size(); ++i)
      if (!alone[i].ok)
        failures.push_back({members[i], alone[i].failure});
    if (failures.empty())
      failures.push_back({members.front(), together});
    return failures;
  }

  std::shared_ptr<entity_store> store_;
  std::map<content_key, place> places_;
  std::size_t made_ = 0;
};

} // namespace dovetail
