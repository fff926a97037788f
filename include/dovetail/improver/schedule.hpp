/// @file
/// In which order the operations are tried: passes over the poor elements, cheap operations first.
#pragma once

#include "dovetail/improver/edge_removal.hpp"
#include "dovetail/improver/face_removal.hpp"
#include "dovetail/improver/operation_log.hpp"
#include "dovetail/improver/vertex_insertion.hpp"
#include "dovetail/improver/vertex_smoothing.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail::improvement {

struct schedule_limits {
  float target = 0.17F;     ///< elements with a smaller value are worked on
  int passes = 8;           ///< sweeps over the poor elements
  double least_gain = 0.02; ///< two sweeps in a row that mend a smaller part of what is lacking are the last
  int hard_passes = 8;      ///< sweeps in which vertices are inserted and removed as well
  double hard_share = 0.1;  ///< such a sweep tries this part of the elements, the worst, and at least 200
  insertion_limits insertion = {};
  apex_search_limits search = {};
  size_band band = {};
};

template <shape_measure Measure>
class schedule {
public:
  schedule(tet_complex& mesh, const schedule_limits& limits) : mesh_(mesh), limits_(limits) {}

  /// Changes the limits of later runs.
  void set_limits(const schedule_limits& limits) { limits_ = limits; }
  void run() {
    const auto all = static_cast<std::size_t>(mesh_.element_slots());
    const auto few =
        std::max<std::size_t>(200, static_cast<std::size_t>(limits_.hard_share * static_cast<double>(all)));
    sweep_until_settled(limits_.passes, all, [this](local_id e) { return mend(e); });
    sweep_until_settled(limits_.hard_passes, few, [this](local_id e) { return mend_hard(e); });
  }
  const operation_log& log() const { return log_; }
  int passes() const { return passes_; }

private:
  bool is_poor(local_id e) const { return mesh_.value(e) < limits_.target; }
  /// Nothing helped element `e`, and nothing around it has changed since.
  bool is_settled(local_id e) const {
    if (static_cast<std::size_t>(e) >= failed_at_.size())
      return false;
    const std::uint32_t failed = failed_at_[static_cast<std::size_t>(e)];
    const auto& v = mesh_.vertices(e);
    return failed >= std::max({mesh_.changed_at(v[0]), mesh_.changed_at(v[1]), mesh_.changed_at(v[2]),
                               mesh_.changed_at(v[3]), std::uint32_t{1}});
  }
  void settle(local_id e) {
    if (static_cast<std::size_t>(e) >= failed_at_.size())
      failed_at_.resize(static_cast<std::size_t>(mesh_.element_slots()), 0);
    failed_at_[static_cast<std::size_t>(e)] = mesh_.now();
  }
  /// Lists the poor elements; the result is the sum of what they lack.
  double collect_poor() {
    double deficit = 0;
    poor_.clear();
    const auto values = mesh_.values();
    for (std::size_t e = 0; e < values.size(); ++e)
      if (values[e] < limits_.target) {
        poor_.push_back(static_cast<local_id>(e));
        deficit += static_cast<double>(limits_.target - values[e]);
      }
    return deficit;
  }
  /// Thin parts have nothing but poor elements, most of them beyond help: trying all would take minutes.
  void keep_worst(std::size_t at_most) {
    if (poor_.size() <= at_most)
      return;
    const auto worse = [&](local_id a, local_id b) {
      return mesh_.value(a) != mesh_.value(b) ? mesh_.value(a) < mesh_.value(b) : a < b;
    };
    const auto last = poor_.begin() + static_cast<std::ptrdiff_t>(at_most);
    std::nth_element(poor_.begin(), last, poor_.end(), worse);
    poor_.erase(last, poor_.end());
    std::sort(poor_.begin(), poor_.end());
  }
  /// Sweeps over the poor elements until two sweeps in a row did not pay.
  template <class Mend>
  void sweep_until_settled(int passes, std::size_t at_most, const Mend& mend_one) {
    failed_at_.clear();
    double deficit = collect_poor();
    for (int pass = 0, idle = 0; pass < passes && idle < 2 && !poor_.empty(); ++pass) {
      keep_worst(at_most);
      for (const local_id e : poor_)
        if (is_poor(e) && !is_settled(e) && !mend_one(e))
          settle(e);
      ++passes_;
      const double before = std::exchange(deficit, collect_poor());
      idle = before - deficit < limits_.least_gain * before ? idle + 1 : 0;
    }
  }

  /// Tries to replace element `e` or to move its vertices; false when nothing helps.
  bool mend(local_id e) {
    bool helped = flip(e);
    if (is_poor(e))
      helped = smooth(e) || helped;
    return helped;
  }

  /// Also inserts and removes vertices.
  bool mend_hard(local_id e) {
    bool helped = mend(e);
    if (is_poor(e))
      helped = contract(e) || insert(e) || helped;
    return helped;
  }
  bool contract(local_id e) {
    const auto corners = mesh_.vertices(e);
    for (const local_id from : corners)
      for (const local_id to : corners)
        if (from != to && mesh_.is_free(from) && log_.record(operation::contraction, [&] {
              return contraction_.improve(mesh_, from, to, limits_.band);
            }))
          return true;
    return false;
  }
  bool insert(local_id e) {
    insertion_limits limits = limits_.insertion;
    limits.search = limits_.search;
    limits.band = limits_.band;
    limits.search.enough = limits_.target;
    const auto corners = mesh_.vertices(e);
    vec3 center = 0.25 * (mesh_.point(corners[0]) + mesh_.point(corners[1]) + mesh_.point(corners[2]) +
                          mesh_.point(corners[3]));
    if (log_.record(operation::insertion, [&] { return insertion_.improve(mesh_, {&e, 1}, center, limits); }))
      return true;
    for (int edge = 0; edge < 6; ++edge)
      if (collect_shell(mesh_, e, edge, shell_) && log_.record(operation::insertion, [&] {
            return insertion_.improve(mesh_, shell_.elements.view(),
                                      midpoint(mesh_.point(shell_.a), mesh_.point(shell_.b)), limits);
          }))
        return true;
    return false;
  }

  /// Executes the best removal of an edge or side of `e`.
  bool flip(local_id e) {
    best_.clear();
    best_.worst = -2;
    for (int edge = 0; edge < 6 && best_.worst < limits_.target; ++edge)
      if (collect_shell(mesh_, e, edge, shell_))
        log_.record(operation::edge_removal, [&] {
          const float bar = worst_value(mesh_, shell_.elements.view());
          return edges_.find(mesh_, shell_, bar, trial_) && keep_better();
        });
    for (int side = 0; side < 4 && best_.worst < limits_.target; ++side)
      log_.record(operation::face_removal,
                  [&] { return faces_.find(mesh_, e, side, trial_) && keep_better(); });
    if (best_.fresh.size == 0)
      return false;
    execute(best_);
    return true;
  }
  bool keep_better() {
    if (!(trial_.worst > best_.worst) || !is_sound(mesh_, trial_) || !limits_.band.admits(mesh_, trial_))
      return false;
    std::swap(best_, trial_);
    return true;
  }
  void execute(const local_change& change) {
    std::array<local_id, static_cast<std::size_t>(max_cavity)> ids;
    mesh_.replace(change.old.view(), change.fresh.view(), change.values.view(),
                  {ids.data(), static_cast<std::size_t>(change.fresh.size)});
  }

  bool smooth(local_id e) {
    const auto corners = mesh_.vertices(e);
    auto search = limits_.search;
    search.enough = limits_.target;
    bool helped = false;
    for (const local_id v : corners)
      if (mesh_.is_free(v) && is_poor(e))
        helped = log_.record(operation::smoothing, [&] {
          return smoothing_.improve(mesh_, v, search, limits_.band);
        }) || helped;
    return helped;
  }

  tet_complex& mesh_;
  schedule_limits limits_;
  operation_log log_;
  int passes_ = 0;
  edge_shell shell_;
  local_change best_, trial_;
  edge_removal<Measure> edges_;
  face_removal<Measure> faces_;
  vertex_smoothing<Measure> smoothing_;
  vertex_insertion<Measure> insertion_;
  edge_contraction<Measure> contraction_;
  std::vector<local_id> poor_;
  std::vector<std::uint32_t> failed_at_; ///< per element; 0: never
};

} // namespace dovetail::improvement
