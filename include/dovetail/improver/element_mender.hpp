/// @file
/// All that can be tried for one poor element.
#pragma once

#include "dovetail/improver/edge_removal.hpp"
#include "dovetail/improver/face_removal.hpp"
#include "dovetail/improver/operation_log.hpp"
#include "dovetail/improver/shell_transformation.hpp"
#include "dovetail/improver/vertex_insertion.hpp"
#include "dovetail/improver/vertex_smoothing.hpp"

#include <utility>

namespace dovetail::improvement {

struct mender_limits {
  float target = 0.17F; ///< elements with a smaller value are poor
  insertion_limits insertion = {};
  apex_search_limits search = {};
  size_band band = {};
};

/// The operations with their working memory: nothing is allocated per try.
template <shape_measure Measure>
class element_mender {
public:
  element_mender(tet_complex& mesh, const mender_limits& limits) : mesh_(mesh) { set_limits(limits); }
  element_mender(const element_mender&) = delete; // points into itself
  element_mender& operator=(const element_mender&) = delete;

  void set_limits(const mender_limits& limits) {
    limits_ = limits;
    limits_.search.enough = limits_.target;
    limits_.insertion.search = limits_.search;
    limits_.insertion.band = limits_.band;
  }
  bool is_poor(local_id e) const { return mesh_.value(e) < limits_.target; }
  const operation_log& log() const { return log_; }

  /// Tries to replace element `e` or to move its vertices; false when nothing helps.
  bool mend(local_id e) {
    bool helped = flip(e);
    if (is_poor(e))
      helped = smooth(e) || helped;
    return helped;
  }
  /// Also removes edges by way of their neighbours, and inserts and removes vertices.
  bool mend_hard(local_id e) {
    bool helped = mend(e);
    if (is_poor(e))
      helped = transform(e) || contract(e) || insert(e) || helped;
    return helped;
  }

private:
  /// Executes the best removal of an edge or side of `e`.
  bool flip(local_id e) {
    best_->clear();
    best_->worst = -2;
    for (int edge = 0; edge < 6 && best_->worst < limits_.target; ++edge)
      if (collect_shell(mesh_, e, edge, shell_))
        log_.record(operation::edge_removal, [&] {
          const float bar = worst_value(mesh_, shell_.elements.view());
          return edges_.find(mesh_, shell_, bar, *trial_) && keep_better();
        });
    for (int side = 0; side < 4 && best_->worst < limits_.target; ++side)
      log_.record(operation::face_removal,
                  [&] { return faces_.find(mesh_, e, side, *trial_) && keep_better(); });
    if (best_->fresh.size == 0)
      return false;
    execute(mesh_, *best_);
    return true;
  }
  bool keep_better() {
    if (!(trial_->worst > best_->worst) || !is_sound(mesh_, *trial_) || !limits_.band.admits(mesh_, *trial_))
      return false;
    std::swap(best_, trial_);
    return true;
  }

  bool smooth(local_id e) {
    const auto corners = mesh_.vertices(e);
    bool helped = false;
    for (const local_id v : corners)
      if (mesh_.is_free(v) && is_poor(e))
        helped = log_.record(operation::smoothing, [&] {
          return smoothing_.improve(mesh_, v, limits_.search, limits_.band);
        }) || helped;
    return helped;
  }

  bool transform(local_id e) {
    for (int edge = 0; edge < 6; ++edge)
      if (log_.record(operation::shell_transformation,
                      [&] { return transformation_.improve(mesh_, e, edge, limits_.band); }))
        return true;
    return false;
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

  /// In the middle of `e`, or of one of its edges.
  bool insert(local_id e) {
    const auto corners = mesh_.vertices(e);
    vec3 center = 0.25 * (mesh_.point(corners[0]) + mesh_.point(corners[1]) + mesh_.point(corners[2]) +
                          mesh_.point(corners[3]));
    if (log_.record(operation::insertion, [&] {
          return insertion_.improve(mesh_, {&e, 1}, center, limits_.insertion);
        }))
      return true;
    for (int edge = 0; edge < 6; ++edge)
      if (collect_shell(mesh_, e, edge, shell_) && log_.record(operation::insertion, [&] {
            return insertion_.improve(mesh_, shell_.elements.view(),
                                      midpoint(mesh_.point(shell_.a), mesh_.point(shell_.b)),
                                      limits_.insertion);
          }))
        return true;
    return false;
  }

  tet_complex& mesh_;
  mender_limits limits_;
  operation_log log_;
  edge_shell shell_;
  std::array<local_change, 2> changes_;
  local_change *best_ = &changes_[0], *trial_ = &changes_[1];
  edge_removal<Measure> edges_;
  face_removal<Measure> faces_;
  vertex_smoothing<Measure> smoothing_;
  shell_transformation<Measure> transformation_;
  vertex_insertion<Measure> insertion_;
  edge_contraction<Measure> contraction_;
};

} // namespace dovetail::improvement
