/// @file
/// What `mesh_subdomains.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesher/any_mesher.hpp"
#include "dovetail/mesher/fallbacks.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/meshing/piece_receipt.hpp"
#include "dovetail/meshing/piece_work.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/entity_store.hpp"
#include "dovetail/parallel/map_tasks.hpp"
#include "dovetail/remesh/surface_deviation.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// What is kept in place of a piece that was given up.
struct released_piece {
  piece_summary summary;
  piece_note note;

  using fields = field_list<&released_piece::summary, &released_piece::note>;
};

/// Finished pieces by the numbers of the present decomposition.
template <int D>
class piece_shelf {
public:
  piece_shelf(std::size_t count, std::shared_ptr<entity_store> store,
              std::function<std::vector<local_id>(local_id)> skeleton_points)
      : store_(std::move(store)), keys_(count), skeleton_points_(std::move(skeleton_points)) {}

  entity_store& store() const { return *store_; }
  const std::vector<content_key>& keys() const { return keys_; }
  void place(local_id subdomain, content_key key) { keys_[static_cast<std::size_t>(subdomain)] = key; }
  simplicial_piece<D> load(local_id subdomain) const {
    auto piece =
        store_->template value<finished_piece<D>>(keys_.at(static_cast<std::size_t>(subdomain))).piece;
    piece.subdomain = subdomain;
    piece.skeleton_points = skeleton_points_(subdomain);
    return piece;
  }

  /// Gives up a piece, in a worker. In D = 2 finished pieces are compared with each other, so that a resumed
  /// run needs them all and no note is kept.
  void release(local_id subdomain, const piece_note& note) const {
    const content_key key = keys_.at(static_cast<std::size_t>(subdomain));
    if (D == 3 && !note.files.empty())
      store_->keep_value(key_of_note(key),
                         released_piece{store_->template value<finished_piece<D>>(key).summary, note});
    store_->release(key);
  }
  std::optional<piece_note> released(local_id subdomain) const {
    auto found = find_released(keys_.at(static_cast<std::size_t>(subdomain)));
    return found ? std::optional(std::move(found->note)) : std::nullopt;
  }
  /// A piece that was given up and is in the files of the note.
  std::optional<released_piece> find_released(content_key key) const {
    auto found = store_->template find_value<released_piece>(key_of_note(key));
    const auto is_there = [](const piece_note::file& file) {
      std::error_code missing;
      return std::filesystem::file_size(file.path, missing) == file.bytes && !missing;
    };
    if (found && !std::all_of(found->note.files.begin(), found->note.files.end(), is_there))
      found.reset();
    return found;
  }

private:
  static content_key key_of_note(content_key key) { return key_maker(key)(std::int64_t{1}).key(); }

  std::shared_ptr<entity_store> store_;
  std::vector<content_key> keys_;
  std::function<std::vector<local_id>(local_id)> skeleton_points_;
};

/// The rounds of `mesh_subdomains`.
template <int D>
class subdomain_rounds {
public:
  subdomain_rounds(std::size_t count, const piece_source<D>& source, const any_mesher<D>& mesh_it,
                   const any_improver<D>& improve, const refined_sizing& size, const any_executor& run_tasks,
                   const meshing_options& options)
      : source_(source), improve_(improve), size_(size), run_tasks_(run_tasks), options_(options),
        ladder_(ladder_of(mesh_it)),
        shelf_(std::make_shared<piece_shelf<D>>(
            count, options.store ? options.store : std::make_shared<entity_store>(),
            options.skeleton_points ? options.skeleton_points
                                    : [source](local_id s) { return source(s).skeleton_points; })) {
    result_.pieces.resize(count);
    pending_.resize(count);
    for (std::size_t s = 0; s < count; ++s)
      pending_[s].subdomain = static_cast<local_id>(s);
  }

  meshed_pieces<D> run() {
    const stopwatch clock;
    for (std::size_t rung = 0; rung < rung_count() && !pending_.empty(); ++rung)
      run_round(rung);
    report_failures();
    summarize();
    result_.keys = shelf_->keys();
    shelf_->store().exchange(run_tasks_.network(), result_.keys);
    result_.summary.seconds = clock.seconds();
    result_.load = [shelf = shelf_](local_id subdomain) { return shelf->load(subdomain); };
    if (shelf_->store().is_common()) {
      result_.release = [shelf = shelf_](local_id s, const piece_note& note) { shelf->release(s, note); };
      result_.released = [shelf = shelf_](local_id s) { return shelf->released(s); };
    }
    return std::move(result_);
  }

private:
  /// After the mesher's ladder, the mesher as it is, without improvement: better a raw piece than none.
  std::size_t rung_count() const { return ladder_.size() + (improve_ ? 1 : 0); }
  box3 place(const piece_input<D>& input) const { return size_.is_refined() ? place_of(input) : box3{}; }

  finished_piece<D> attempt(const piece_failure& piece, const piece_input<D>& input, std::size_t rung) const {
    const bool climbs = rung < ladder_.size();
    return make_piece<D>(piece.subdomain, input, ladder_[climbs ? rung : 0], climbs ? &improve_ : nullptr,
                         faster_in(size_.near(place(input)), box_around(input.boundary.boundary.points)),
                         piece.reasons, piece.timed_out);
  }

  void run_round(std::size_t rung) {
    run_options round;
    round.order = largest_first();
    round.on_progress = options_.on_progress;
    round.stage = rung == 0 ? "meshing" : "meshing again";
    auto results = map_tasks(
        run_tasks_, pending_.size(), [&](std::size_t k) { return receipt_of(pending_[k], rung); }, round);
    std::vector<piece_failure> failed;
    for (std::size_t k = 0; k < results.size(); ++k)
      if (!accept(pending_[k], results[k]))
        failed.push_back(std::move(pending_[k]));
    if (rung == 0)
      result_.summary.set("retried", static_cast<double>(failed.size()));
    pending_ = std::move(failed);
  }

  /// The pending subdomains with the largest cost first; ties by number.
  std::vector<std::size_t> largest_first() const {
    std::vector<std::size_t> order(pending_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto cost = [&](std::size_t k) {
      return options_.predicted_cost[static_cast<std::size_t>(pending_[k].subdomain)];
    };
    if (!options_.predicted_cost.empty())
      stable_sort_all(order, [&](std::size_t a, std::size_t b) { return cost(a) > cost(b); });
    return order;
  }

  /// Runs in the worker: makes the piece, unless the store has it.
  piece_receipt receipt_of(const piece_failure& piece, std::size_t rung) const {
    const piece_input<D> input = source_(piece.subdomain);
    const content_key key = key_of(input, size_.key_near(place(input)));
    piece_receipt receipt{.piece = {key, {}}};
    if (auto summary = find_summary(key)) {
      receipt.reused = true;
      receipt.summary = *std::move(summary);
    } else {
      auto finished = attempt(piece, input, rung);
      receipt.piece = shelf_->store().keep_in_task(key, encoded(finished));
      receipt.summary = std::move(finished.summary);
    }
    receipt.summary.summary = brief(receipt.summary.summary);
    return receipt;
  }

  /// That of a piece which the store has, or had until it was given up.
  std::optional<piece_summary> find_summary(content_key key) const {
    if (auto kept = shelf_->store().template find_value<finished_piece<D>>(key))
      return std::move(kept->summary);
    if (auto released = shelf_->store().is_common() ? shelf_->find_released(key) : std::nullopt)
      return std::move(released->summary);
    return std::nullopt;
  }

  /// Takes one result; false when the subdomain failed.
  bool accept(piece_failure& piece, task_result<piece_receipt>& result) {
    report& summary = result_.summary;
    summary.set("peak_rss_bytes",
                std::max(summary.get("peak_rss_bytes"), static_cast<double>(result.peak_rss_bytes)));
    if (!result.value) {
      piece.reasons.push_back(result.failure);
      piece.timed_out = piece.timed_out || result.timed_out;
      return false;
    }
    piece_receipt receipt = *std::move(result.value);
    summary.add("reused", receipt.reused ? 1 : 0);
    receipt.summary.summary.name = piece_name(piece.subdomain);
    shelf_->place(piece.subdomain, shelf_->store().take(std::move(receipt.piece)));
    result_.pieces[static_cast<std::size_t>(piece.subdomain)] = std::move(receipt.summary);
    return true;
  }

  void report_failures() {
    result_.failures = std::move(pending_);
    if constexpr (D == 3)
      if (options_.on_failure && run_tasks_.leads())
        for (piece_failure& failure : result_.failures)
          options_.on_failure(failure, source_(failure.subdomain).boundary.boundary);
  }

  void summarize() {
    report& summary = result_.summary;
    summary.name = "meshing";
    summary.set("failed", static_cast<double>(result_.failures.size()));
    global_id first_element = 0;
    report deviation;
    for (const piece_summary& piece : result_.pieces) {
      result_.quality.merge(piece.quality, first_element);
      first_element += piece.counts.elements;
      summary.add("elements", static_cast<double>(piece.counts.elements));
      summary.add("inner_points", static_cast<double>(piece.counts.inner_points));
      summary.add("stops_by_clock", stops_by_clock(piece.summary));
      collect_warnings(piece.summary, piece.summary.name);
      for (const report& part : piece.summary.children) {
        summary.add(part.name + "_seconds", part.seconds);
        collect_warnings(part, piece.summary.name);
        for (const report& child : part.children)
          if (child.name == "deviation")
            merge_deviations(deviation, child);
      }
    }
    warn_of_deviations(summary, deviation);
    if (!deviation.children.empty())
      summary.children.push_back(std::move(deviation));
  }

  void collect_warnings(const report& from, const std::string& piece) {
    for (const std::string& warning : from.warnings)
      result_.summary.warnings.push_back(piece + ": " + warning);
  }

  const piece_source<D>& source_;
  const any_improver<D>& improve_;
  const refined_sizing& size_;
  const any_executor& run_tasks_;
  const meshing_options& options_;
  std::vector<any_mesher<D>> ladder_;
  std::shared_ptr<piece_shelf<D>> shelf_;
  std::vector<piece_failure> pending_;
  meshed_pieces<D> result_;
};

} // namespace detail

template <int D>
void require_policies(const any_mesher<D>& mesh_it, const any_improver<D>& improve,
                      const any_executor& run_tasks) {
  const std::string why = " must not run in several threads of one process; use worker processes";
  if (!mesh_it)
    throw usage_error("no mesher was chosen: parameters<>{}.with_mesher(...)");
  if (!runs_in_threads(run_tasks))
    return;
  for (const any_mesher<D>& rung : ladder_of(mesh_it))
    if (!rung.actual_traits().thread_safe)
      throw usage_error(named_policy("mesher", rung.name()) + why);
  if (!improve.actual_traits().thread_safe)
    throw usage_error(named_policy("improver", improve.name()) + why);
}

template <int D>
meshed_pieces<D> mesh_subdomains(std::size_t count, const std::type_identity_t<piece_source<D>>& source,
                                 const std::type_identity_t<any_mesher<D>>& mesh_it,
                                 const std::type_identity_t<any_improver<D>>& improve,
                                 const refined_sizing& size, const any_executor& run_tasks,
                                 const meshing_options& options) {
  require_policies(mesh_it, improve, run_tasks);
  if (!options.predicted_cost.empty() && options.predicted_cost.size() != count)
    throw usage_error("meshing_options::predicted_cost must have one value per subdomain");
  return detail::subdomain_rounds<D>(count, source, mesh_it, improve, size, run_tasks, options).run();
}

#ifdef DOVETAIL_COMPILED
template void require_policies<2>(const any_mesher<2>& mesh_it, const any_improver<2>& improve,
                                  const any_executor& run_tasks);
template void require_policies<3>(const any_mesher<3>& mesh_it, const any_improver<3>& improve,
                                  const any_executor& run_tasks);
template meshed_pieces<2> mesh_subdomains<2>(std::size_t count, const piece_source<2>& source,
                                             const any_mesher<2>& mesh_it, const any_improver<2>& improve,
                                             const refined_sizing& size, const any_executor& run_tasks,
                                             const meshing_options& options);
template meshed_pieces<3> mesh_subdomains<3>(std::size_t count, const piece_source<3>& source,
                                             const any_mesher<3>& mesh_it, const any_improver<3>& improve,
                                             const refined_sizing& size, const any_executor& run_tasks,
                                             const meshing_options& options);
#endif

} // namespace dovetail
