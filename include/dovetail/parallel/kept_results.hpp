/// @file
/// Large results of tasks, each made once: a worker keeps what it has made where it can be found again, under
/// the name of what it is a function of, and gives back a summary.
#pragma once

#include "dovetail/core/content_key.hpp"
#include "dovetail/core/encoding.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/parallel/entity_store.hpp"
#include "dovetail/parallel/executor_services.hpp"
#include "dovetail/parallel/kept.hpp"
#include "dovetail/parallel/map_tasks.hpp"
#include "dovetail/parallel/run_results.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace dovetail {

/// The results 0 .. count-1 of a batch of tasks, made in one or several calls. The member `summary` of a
/// result is what is known of it without loading it. What a run before has kept, or this one under another
/// number, is not made again. A result may be given up and a `Note` left in its place, which says where it is
/// now and `is_whole()` as long as it is there.
template <encodable Result, encodable Note>
class kept_results {
public:
  /// What is known of a result without loading it.
  using summary_type = std::remove_cvref_t<decltype(std::declval<Result&>().summary)>;

  /// What a task says of the result that it has made.
  struct receipt {
    kept_value kept = {};      ///< where it is
    summary_type summary = {}; ///< what is known of it
    bool is_reused = false;    ///< it was there

    using fields = field_list<&receipt::kept, &receipt::summary, &receipt::is_reused>;
  };

  /// That many, kept where `run` keeps its results, which are called `kind` there.
  template <executor Executor>
  kept_results(std::size_t count, const Executor& run, const std::string& kind)
      : store_(store_of(run, kind)), results_(count) {}

  /// Makes result `number(k)` for each k below `count` in a task of `run`, unless it is there: `input(k)` is
  /// what it is a function of, `name(in)` tells that from others, `make(k, in)` makes it. Returns what
  /// `map_tasks` does: per k a receipt, with `brief(summary)` for a summary, or why there is none.
  template <executor Executor, class Number, class Input, class Name, class Make, class Brief>
  std::vector<task_result<receipt>> make(std::size_t count, const Executor& run, const Number& number,
                                         const Input& input, const Name& name, const Make& make_result,
                                         const Brief& brief, const run_options& options) {
    auto receipts = map_tasks(
        run, count,
        [&](std::size_t k) {
          const auto in = input(k);
          const kept<Result> wanted = name(in);
          receipt made = make_once(wanted.key(), [&] { return make_result(k, in); });
          made.summary = brief(std::move(made.summary));
          return made;
        },
        options);
    std::vector<content_key> there;
    for (std::size_t k = 0; k < count; ++k)
      if (auto& made = receipts[k].value) {
        there.push_back(store_->take(std::exchange(made->kept, {})));
        results_[number(k)] = kept<Result>(there.back());
      }
    store_->exchange(network_of(run), there);
    return receipts;
  }

  /// Throws `io_error` when it is missing or damaged.
  Result load(std::size_t i) const { return store_->template value<Result>(results_.at(i).key()); }
  /// Their names; none where one could not be made.
  const std::vector<kept<Result>>& all() const { return results_; }

  /// Whether results can be given up: all ranks have what one has kept.
  bool can_release() const { return store_->is_common(); }
  /// Gives up a result, in a worker; with `note` in its place unless there is none.
  void release(std::size_t i, const std::optional<Note>& note) const {
    const content_key key = results_.at(i).key();
    if (note)
      store_->keep_value(key_of_note(key), released_result{load(i).summary, *note});
    store_->release(key);
  }
  /// The note of a result that was given up.
  std::optional<Note> released(std::size_t i) const {
    auto found = find_released(results_.at(i).key());
    return found ? std::optional(std::move(found->note)) : std::nullopt;
  }

private:
  struct released_result {
    summary_type summary = {};
    Note note = {};

    using fields = field_list<&released_result::summary, &released_result::note>;
  };

  /// In a task.
  template <class Make>
  receipt make_once(content_key key, const Make& make_result) const {
    if (auto summary = find_summary(key))
      return {{key, {}}, *std::move(summary), true};
    Result made = make_result();
    auto kept = store_->keep_in_task(key, encoded(made));
    return {std::move(kept), std::move(made.summary), false};
  }

  /// That of a result which is there, or was until it was given up.
  std::optional<summary_type> find_summary(content_key key) const {
    if (auto whole = store_->template find_value<Result>(key))
      return std::move(whole->summary);
    if (auto released = can_release() ? find_released(key) : std::nullopt)
      return std::move(released->summary);
    return std::nullopt;
  }
  std::optional<released_result> find_released(content_key key) const {
    auto found = store_->template find_value<released_result>(key_of_note(key));
    if (found && !found->note.is_whole())
      found.reset();
    return found;
  }
  static content_key key_of_note(content_key key) { return key_maker(key)(std::int64_t{1}).key(); }

  std::shared_ptr<entity_store> store_;
  std::vector<kept<Result>> results_;
};

} // namespace dovetail
