/// @file
/// What `mesh_subdomains.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesher/any_mesher.hpp"
#include "dovetail/mesher/fallbacks.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/meshing/piece_work.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/spool.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// Finished pieces, in the spool or in memory.
template <int D>
class piece_shelf {
public:
  piece_shelf(std::size_t count, const meshing_options& options)
      : in_memory_(options.store ? 0 : count), store_(options.store), prefix_(options.store_prefix) {}

  /// Worker side: what is left to send back after storing. Empty `found` means that nothing is stored yet.
  std::optional<byte_buffer> find(local_id subdomain) const {
    return store_ ? store_->read(name_of(subdomain)) : std::nullopt;
  }
  byte_buffer store(local_id subdomain, byte_buffer finished) const {
    if (!store_)
      return finished;
    store_->write(name_of(subdomain), finished);
    return receipt(finished);
  }
  /// In place of a piece that is in the spool, only its summary travels to the parent.
  static byte_buffer receipt(const byte_buffer& finished) {
    byte_writer bytes;
    encode(bytes, summary_of(finished));
    return bytes.take();
  }

  /// Parent side: takes what a worker sent.
  void keep(local_id subdomain, byte_buffer sent) {
    if (!store_)
      in_memory_[static_cast<std::size_t>(subdomain)] = std::move(sent);
  }
  simplicial_piece<D> load(local_id subdomain) const {
    if (!store_)
      return piece_of<D>(in_memory_.at(static_cast<std::size_t>(subdomain)));
    const auto finished = store_->read(name_of(subdomain));
    if (!finished)
      throw io_error(store_->path_of(name_of(subdomain)).string() +
                     " is missing or damaged; resume the run to make it again");
    return piece_of<D>(*finished);
  }

private:
  std::string name_of(local_id subdomain) const { return prefix_ + piece_name(subdomain); }

  std::vector<byte_buffer> in_memory_;
  std::optional<spool> store_;
  std::string prefix_;
};

/// Errors that no other rung can mend travel beside the result, and are thrown again by the parent.
enum class reply_kind : std::uint8_t { finished, cannot_store, bad_size };

/// The rounds of `mesh_subdomains`.
template <int D>
class subdomain_rounds {
public:
  subdomain_rounds(std::size_t count, const piece_source<D>& source, const any_mesher<D>& mesh_it,
                   const any_improver<D>& improve, const any_sizing& size, const any_executor& run_tasks,
                   const meshing_options& options)
      : source_(source), improve_(improve), size_(size), run_tasks_(run_tasks), options_(options),
        ladder_(ladder_of(mesh_it)), shelf_(std::make_shared<piece_shelf<D>>(count, options)) {
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
    result_.summary.seconds = clock.seconds();
    result_.load = [shelf = shelf_](local_id subdomain) { return shelf->load(subdomain); };
    return std::move(result_);
  }

private:
  /// After the mesher's ladder, the mesher as it is, without improvement: better a raw piece than none.
  std::size_t rung_count() const { return ladder_.size() + (improve_ ? 1 : 0); }
  byte_buffer attempt(local_id subdomain, std::size_t rung) const {
    const piece_input<D> input = source_(subdomain);
    if (rung < ladder_.size())
      return make_piece<D>(subdomain, input, ladder_[rung], &improve_, size_, rung);
    return make_piece<D>(subdomain, input, ladder_[0], nullptr, size_, rung);
  }

  void run_round(std::size_t rung) {
    run_options round;
    round.order = largest_first();
    round.limit_seconds = options_.limit_seconds;
    round.on_progress = options_.on_progress;
    round.stage = rung == 0 ? "meshing" : "meshing again";
    auto outcomes = run_tasks_.run(
        pending_.size(), [&](std::size_t k) { return reply(pending_[k].subdomain, rung); }, round);
    std::vector<piece_failure> failed;
    for (std::size_t k = 0; k < outcomes.size(); ++k)
      if (!accept(pending_[k], outcomes[k]))
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

  /// Runs in the worker.
  byte_buffer reply(local_id subdomain, std::size_t rung) const {
    try {
      if (const auto finished = shelf_->find(subdomain))
        return tagged(reply_kind::finished, piece_shelf<D>::receipt(*finished));
      return tagged(reply_kind::finished, shelf_->store(subdomain, attempt(subdomain, rung)));
    } catch (const io_error& e) {
      return tagged(reply_kind::cannot_store, as_bytes(e.what()));
    } catch (const sizing_error& e) {
      return tagged(reply_kind::bad_size, as_bytes(e.what()));
    }
  }

  /// The kind goes last, so that neither end moves the bytes of a piece.
  static byte_buffer tagged(reply_kind kind, byte_buffer bytes) {
    bytes.push_back(static_cast<std::byte>(kind));
    return bytes;
  }
  static byte_buffer as_bytes(const std::string& text) {
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    return {first, first + text.size()};
  }

  /// Takes one outcome; false when the subdomain failed.
  bool accept(piece_failure& piece, task_outcome& outcome) {
    report& summary = result_.summary;
    summary.set("peak_rss_bytes",
                std::max(summary.get("peak_rss_bytes"), static_cast<double>(outcome.peak_rss_bytes)));
    if (!outcome.ok) {
      piece.reasons.push_back(outcome.failure);
      piece.timed_out = piece.timed_out || outcome.timed_out;
      return false;
    }
    const auto kind = static_cast<reply_kind>(outcome.result.back());
    outcome.result.pop_back();
    const auto text = [&] {
      return std::string(reinterpret_cast<const char*>(outcome.result.data()), outcome.result.size());
    };
    if (kind == reply_kind::cannot_store)
      throw io_error(text());
    if (kind == reply_kind::bad_size)
      throw sizing_error(text());
    result_.pieces[static_cast<std::size_t>(piece.subdomain)] = summary_of(outcome.result);
    shelf_->keep(piece.subdomain, std::move(outcome.result));
    if (piece.timed_out)
      summary.warnings.push_back(
          "subdomain " + std::to_string(piece.subdomain) +
          " reached the wall-clock limit before it was meshed in another way; the mesh "
          "may differ on another machine");
    return true;
  }

  void report_failures() {
    result_.failures = std::move(pending_);
    if constexpr (D == 3)
      if (options_.on_failure)
        for (piece_failure& failure : result_.failures)
          options_.on_failure(failure, source_(failure.subdomain).boundary.boundary);
  }

  void summarize() {
    report& summary = result_.summary;
    summary.name = "meshing";
    summary.set("failed", static_cast<double>(result_.failures.size()));
    global_id first_element = 0;
    for (const piece_summary& piece : result_.pieces) {
      result_.quality.merge(piece.quality, first_element);
      first_element += piece.counts.elements;
      summary.add("elements", static_cast<double>(piece.counts.elements));
      summary.add("inner_points", static_cast<double>(piece.counts.inner_points));
      collect_warnings(piece.summary, piece.summary.name);
      for (const report& part : piece.summary.children) {
        summary.add(part.name + "_seconds", part.seconds);
        collect_warnings(part, piece.summary.name);
      }
    }
  }

  void collect_warnings(const report& from, const std::string& piece) {
    for (const std::string& warning : from.warnings)
      result_.summary.warnings.push_back(piece + ": " + warning);
  }

  const piece_source<D>& source_;
  const any_improver<D>& improve_;
  const any_sizing& size_;
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
  if (!mesh_it.actual_traits().thread_safe)
    throw usage_error("this mesher" + why);
  if (!improve.actual_traits().thread_safe)
    throw usage_error("this improver" + why);
}

template <int D>
meshed_pieces<D> mesh_subdomains(std::size_t count, const std::type_identity_t<piece_source<D>>& source,
                                 const std::type_identity_t<any_mesher<D>>& mesh_it,
                                 const std::type_identity_t<any_improver<D>>& improve, const any_sizing& size,
                                 const any_executor& run_tasks, const meshing_options& options) {
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
                                             const any_sizing& size, const any_executor& run_tasks,
                                             const meshing_options& options);
template meshed_pieces<3> mesh_subdomains<3>(std::size_t count, const piece_source<3>& source,
                                             const any_mesher<3>& mesh_it, const any_improver<3>& improve,
                                             const any_sizing& size, const any_executor& run_tasks,
                                             const meshing_options& options);
#endif

} // namespace dovetail
