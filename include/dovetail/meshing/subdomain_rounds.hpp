/// @file
/// The rounds of attempts at subdomains: what `mesh_subdomains` does, whoever makes a piece.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/meshing/brief_summary.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/meshing/piece_work.hpp"
#include "dovetail/parallel/executor_services.hpp"
#include "dovetail/parallel/kept_results.hpp"
#include "dovetail/remesh/surface_deviation.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

template <int D>
using kept_pieces = kept_results<finished_piece<D>, piece_note>;

/// The rounds of `mesh_subdomains`.
template <int D, executor Executor>
class subdomain_rounds {
public:
  subdomain_rounds(std::size_t count, const piece_source<D>& source, const piece_attempts<D>& attempts,
                   const refined_sizing& size, const Executor& run_tasks, const meshing_options& options)
      : source_(source), attempts_(attempts), size_(size), run_tasks_(run_tasks), options_(options),
        skeleton_points_(options.skeleton_points
                             ? options.skeleton_points
                             : [source](local_id s) { return source(s).skeleton_points; }),
        pieces_(std::make_shared<kept_pieces<D>>(count, run_tasks, name_of_pieces)) {
    result_.pieces.resize(count);
    std::vector<local_id> wanted = options.wanted;
    if (wanted.empty()) {
      wanted.resize(count);
      std::iota(wanted.begin(), wanted.end(), local_id{0});
    }
    pending_.resize(wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k)
      pending_[k].subdomain = wanted[k];
  }

  meshed_pieces<D> run() {
    const stopwatch clock;
    for (std::size_t attempt = 0; attempt < attempts_.count && !pending_.empty(); ++attempt)
      run_round(attempt);
    report_failures();
    summarize();
    result_.finished = pieces_->all();
    result_.summary.seconds = clock.seconds();
    serve_pieces();
    return std::move(result_);
  }

private:
  /// Finished pieces by the numbers of the present decomposition, as long as the result lasts. In D = 2
  /// finished pieces are compared with each other, so that a resumed run needs them all and no note is kept.
  void serve_pieces() {
    result_.load = [pieces = pieces_, points = skeleton_points_](local_id s) {
      auto piece = pieces->load(static_cast<std::size_t>(s)).piece;
      piece.subdomain = s;
      piece.skeleton_points = points(s);
      return piece;
    };
    if (!pieces_->can_release())
      return;
    result_.release = [pieces = pieces_](local_id s, const piece_note& note) {
      const bool leaves_note = D == 3 && !note.files.empty();
      pieces->release(static_cast<std::size_t>(s), leaves_note ? std::optional(note) : std::nullopt);
    };
    result_.released = [pieces = pieces_](local_id s) {
      return pieces->released(static_cast<std::size_t>(s));
    };
  }

  box3 place(const piece_input<D>& input) const { return size_.is_refined() ? place_of(input) : box3{}; }

  finished_piece<D> piece_by(const piece_failure& piece, const piece_input<D>& input,
                             std::size_t attempt) const {
    return attempts_.make(attempt, piece, input,
                          faster_in(size_.near(place(input)), box_around(input.boundary.boundary.points)));
  }

  void run_round(std::size_t attempt) {
    run_options round;
    round.order = largest_first();
    round.on_progress = options_.on_progress;
    round.stage = attempt == 0 ? "meshing" : "meshing again";
    auto results = pieces_->make(
        pending_.size(), run_tasks_, [&](std::size_t k) { return pending_[k].subdomain; },
        [&](std::size_t k) { return source_(pending_[k].subdomain); },
        [&](const piece_input<D>& input) { return kept_piece(input, size_.balls_near(place(input))); },
        [&](std::size_t k, const piece_input<D>& input) { return piece_by(pending_[k], input, attempt); },
        brief_summary, round);
    std::vector<piece_failure> failed;
    for (std::size_t k = 0; k < results.size(); ++k)
      if (!accept(pending_[k], results[k]))
        failed.push_back(std::move(pending_[k]));
    if (attempt == 0)
      counts_.retried = failed.size();
    pending_ = std::move(failed);
  }

  /// The pending subdomains with the largest cost first; ties by number.
  std::vector<std::size_t> largest_first() const {
    std::vector<std::size_t> order(pending_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto cost = [&](std::size_t k) { return options_.predicted_cost[pending_[k].subdomain]; };
    if (!options_.predicted_cost.empty())
      stable_sort_all(order, [&](std::size_t a, std::size_t b) { return cost(a) > cost(b); });
    return order;
  }

  /// Takes one result; false when the subdomain failed.
  bool accept(piece_failure& piece, task_result<typename kept_pieces<D>::receipt>& result) {
    counts_.peak_rss_bytes = std::max(counts_.peak_rss_bytes, result.peak_rss_bytes);
    if (!result.value) {
      piece.reasons.push_back(result.failure);
      piece.timed_out = piece.timed_out || result.timed_out;
      return false;
    }
    counts_.reused += result.value->is_reused ? 1 : 0;
    piece_summary& made = result_.pieces[piece.subdomain];
    made = std::move(result.value->summary);
    made.summary.name = piece_name(piece.subdomain);
    return true;
  }

  void report_failures() {
    result_.failures = std::move(pending_);
    if constexpr (D == 3)
      for (piece_failure& failure : result_.failures)
        failure = once(run_tasks_, [&] {
          piece_failure recorded = failure;
          if (options_.on_failure)
            options_.on_failure(recorded, source_(failure.subdomain).boundary.boundary);
          return recorded;
        });
  }

  void summarize() {
    report& summary = result_.summary;
    summary.name = "meshing";
    counts_.failed = result_.failures.size();
    global_id first_element = 0;
    report deviation;
    for (const piece_summary& piece : result_.pieces) {
      result_.quality.merge(piece.quality.all, first_element);
      first_element += piece.counts.elements;
      counts_.elements += piece.counts.elements;
      counts_.inner_points += piece.counts.inner_points;
      counts_.stops_by_clock += stops_by_clock(piece.summary);
      collect_warnings(piece.summary, piece.summary.name);
      for (const report& part : piece.summary.children) {
        (part.name == "mesher" ? counts_.mesher_seconds : counts_.improver_seconds) += part.seconds;
        collect_warnings(part, piece.summary.name);
        for (const report& child : part.children)
          if (child.name == "deviation")
            merge_deviations(deviation, child);
      }
    }
    summary.set(counts_);
    warn_of_deviations(summary, deviation);
    if (!deviation.children.empty())
      summary.children.push_back(std::move(deviation));
  }

  void collect_warnings(const report& from, const std::string& piece) {
    for (const std::string& warning : from.warnings)
      result_.summary.warnings.push_back(piece + ": " + warning);
  }

  const piece_source<D>& source_;
  const piece_attempts<D>& attempts_;
  const refined_sizing& size_;
  const Executor& run_tasks_;
  const meshing_options& options_;
  std::function<std::vector<local_id>(local_id)> skeleton_points_;
  std::shared_ptr<kept_pieces<D>> pieces_;
  std::vector<piece_failure> pending_;
  meshing_counts counts_;
  meshed_pieces<D> result_;
};

template <int D, executor Executor>
meshed_pieces<D> mesh_in_rounds(std::size_t count, const piece_source<D>& source,
                                const piece_attempts<D>& attempts, const refined_sizing& size,
                                const Executor& run_tasks, const meshing_options& options) {
  if (!options.predicted_cost.empty() && options.predicted_cost.size() != count)
    throw usage_error("meshing_options::predicted_cost must have one value per subdomain");
  std::vector<local_id> wanted = options.wanted;
  sort_all(wanted);
  if (!wanted.empty() && (wanted.front() < 0 || static_cast<std::size_t>(wanted.back()) >= count ||
                          std::adjacent_find(wanted.begin(), wanted.end()) != wanted.end()))
    throw usage_error("meshing_options::wanted must list subdomains that there are, each once");
  return subdomain_rounds<D, Executor>(count, source, attempts, size, run_tasks, options).run();
}

} // namespace detail

} // namespace dovetail
