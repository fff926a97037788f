/// @file
/// What `sources.hpp` declares.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/candidate_octree.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/sizing/bounds.hpp"
#include "dovetail/sizing/sources.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE source_field::source_field(double ambient, std::vector<grid_source> sources,
                                           double largest_slope)
    : ambient_(sizing::checked_size(ambient, "the ambient size")), log_ambient_(std::log(ambient)),
      largest_slope_(largest_slope), sources_(std::move(sources)) {
  if (!(largest_slope > 0))
    throw sizing_error("the largest slope of a source field is " + number_text(largest_slope) +
                       "; give a positive number");
  std::vector<box3> boxes;
  boxes.reserve(sources_.size());
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    check(sources_[i], i);
    laws_.push_back(prepared(sources_[i]));
    laws_.back().reached = inflated(core_box(sources_[i]), laws_.back().reach);
    boxes.push_back(laws_.back().reached);
  }
  tree_ = box_tree(boxes);
  nodes_ = tree_.reduce<node_bound>([&](local_id i) { return bound_of(static_cast<std::size_t>(i)); },
                                    [](const node_bound& a, const node_bound& b) { return joined(a, b); });
  locate();
}

DOVETAIL_INLINE double source_field::operator()(vec3 p) const {
  minimum found{log_ambient_};
  std::size_t tried = 0;
  for (const local_id i : located_.candidates(p)) {
    if (laws_[i].log_least >= found.log_size) // so are those after it
      break;
    if (++tried > most_tried) {
      search(p, found);
      break;
    }
    take(i, p, found);
  }
  if (found.source == no_id)
    return ambient_;
  // Inside the inner radius of a source of one spacing, that spacing to the last bit, not exp(log(.)).
  const law& of_winner = laws_[found.source];
  if (found.log_size == of_winner.log_least)
    return of_winner.least;
  return std::exp(found.log_size);
}

DOVETAIL_INLINE double source_field::smallest_size_in(const box3& box) const {
  const vec3 center = box.center();
  const double radius = 0.5 * box.diagonal();
  const double least = tree_.least(
      log_ambient_,
      [&](std::size_t node) {
        return tree_.box(node).overlaps(box) ? least_from(nodes_[node], center, radius) : infinite;
      },
      [&](local_id i) { return log_size(i, center, radius); });
  return least < log_ambient_ ? std::exp(least) * (1 - 1e-12) : ambient_;
}

DOVETAIL_INLINE source_field source_field::within(const box3& box) const {
  std::vector<local_id> counting;
  tree_.for_each([&](const box3& reached, std::size_t) { return reached.overlaps(box); },
                 [&](local_id i) {
                   if (laws_[i].reached.overlaps(box))
                     counting.push_back(i);
                 });
  remove_outdone(box, counting);
  sort_all(counting);
  std::vector<grid_source> sources;
  for (const local_id i : counting)
    sources.push_back(sources_[i]);
  return {ambient_, std::move(sources), largest_slope_};
}

DOVETAIL_INLINE double source_field::feature_size(vec3 p) const {
  const double least = tree_.least(
      infinite,
      [&](std::size_t node) {
        if (!contains(tree_.box(node), p))
          return infinite;
        const double away = std::sqrt(distance_squared(nodes_[node].cores, p));
        return (1 - 1e-9) * std::max(nodes_[node].least_inner, away);
      },
      [&](local_id id) {
        const auto i = static_cast<std::size_t>(id);
        const auto [away, at] = nearest(i, p);
        return away < reach_at(sources_[i], at) ? std::max(mixed(sources_[i].inner_radius, at), away)
                                                : infinite;
      });
  return 0.5 * least;
}

DOVETAIL_INLINE source_field::node_bound source_field::bound_of(std::size_t i) const {
  const grid_source& s = sources_[i];
  node_bound result{core_box(s), laws_[i].log_least, s.inner_radius[0], s.inner_radius[0]};
  double widest = s.spacing[0], band = 0;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(s.dimension); ++k) {
    result.least_inner = std::min(result.least_inner, s.inner_radius[k]);
    result.most_inner = std::max(result.most_inner, s.inner_radius[k]);
    widest = std::max(widest, s.spacing[k]);
    band = std::max(band, s.outer_radius[k] - s.inner_radius[k]);
  }
  result.rate = std::max(0.0, growth_rate(s, 0, band, std::log(widest)));
  result.constant = laws_[i].constant;
  return result;
}

DOVETAIL_INLINE source_field::node_bound source_field::joined(const node_bound& a, const node_bound& b) {
  return {united(a.cores, b.cores),
          std::min(a.log_least, b.log_least),
          std::min(a.least_inner, b.least_inner),
          std::max(a.most_inner, b.most_inner),
          std::min(a.rate, b.rate),
          a.constant && b.constant};
}

DOVETAIL_INLINE double source_field::least_from(const node_bound& node, vec3 p, double closer) const {
  const double away = std::sqrt(distance_squared(node.cores, p)) - closer - node.most_inner;
  if (!(away > 0) || !(node.rate > 0) || (closer > 0 && !node.constant))
    return node.log_least;
  return std::max(node.log_least, log_grown(node.log_least, node.rate, away) - rounding);
}

DOVETAIL_INLINE void source_field::take(local_id i, vec3 p, minimum& found) const {
  const law& l = laws_[i];
  if (!contains(l.reached, p))
    return;
  const double candidate = log_size(i, p, 0.0);
  const auto is_before = [&](local_id j) {
    return std::pair(l.log_least, i) < std::pair(laws_[j].log_least, j);
  };
  if (candidate < found.log_size ||
      (candidate == found.log_size && found.source != no_id && is_before(found.source)))
    found = {candidate, i};
}

DOVETAIL_INLINE void source_field::search(vec3 p, minimum& found) const {
  tree_.least(
      found.log_size,
      [&](std::size_t node) {
        if (!contains(tree_.box(node), p))
          return infinite;
        return least_from(nodes_[node], p, 0) - rounding; // what asks for the same is tried too
      },
      [&](local_id i) {
        take(i, p, found);
        return found.log_size;
      });
}

DOVETAIL_INLINE void source_field::locate() {
  std::vector<local_id> order(sources_.size());
  std::iota(order.begin(), order.end(), local_id{0});
  stable_sort_all(order, [&](local_id a, local_id b) { return laws_[a].log_least < laws_[b].log_least; });
  located_ = candidate_octree(
      tree_.bounds(), order,
      [&](local_id id, const box3& box) {
        const auto i = static_cast<std::size_t>(id);
        return laws_[i].reached.overlaps(box) &&
               nearest(i, box.center()).distance <= laws_[i].reach + 0.5001 * box.diagonal();
      },
      [&](const box3& box, std::vector<local_id>& items) { remove_outdone(box, items); });
}

DOVETAIL_INLINE void source_field::remove_outdone(const box3& box, std::vector<local_id>& items) const {
  const vec3 center = box.center();
  const double radius = 0.5001 * box.diagonal();
  double most = log_ambient_; // the size is at most this
  for (const local_id i : items)
    if (laws_[i].constant)
      most = std::min(most, log_size(i, center, -radius));
  std::erase_if(items, [&](local_id i) { return log_size(i, center, radius) > most + rounding; });
}

DOVETAIL_INLINE box3 source_field::core_box(const grid_source& s) {
  box3 box;
  for (int k = 0; k <= s.dimension; ++k)
    box.include(s.corners[k]);
  return box;
}

DOVETAIL_INLINE source_field::law source_field::prepared(const grid_source& s) const {
  law result;
  result.least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k <= static_cast<std::size_t>(s.dimension); ++k) {
    weights corner{};
    corner[k] = 1;
    result.least = std::min(result.least, s.spacing[k]);
    result.reach = std::max(result.reach, reach_at(s, corner));
    result.constant = result.constant && s.spacing[k] == s.spacing[0] &&
                      s.inner_radius[k] == s.inner_radius[0] && s.outer_radius[k] == s.outer_radius[0];
  }
  if (!result.constant && (s.growth == source_growth::doubling || std::isfinite(largest_slope_))) {
    // The reach is not monotone between corners: bound it by the widest radii and the smallest spacing.
    double inner = 0;
    double band = 0;
    for (std::size_t k = 0; k <= static_cast<std::size_t>(s.dimension); ++k) {
      inner = std::max(inner, s.inner_radius[k]);
      band = std::max(band, s.outer_radius[k] - s.inner_radius[k]);
    }
    const double log_least = std::log(result.least);
    const double slowest = growth_rate(s, 0, band, log_least);
    const double limited = std::isfinite(largest_slope_) ? ambient_ / largest_slope_ : 0.0;
    result.reach = std::max(result.reach, inner + width_of_growth(log_least, slowest) + limited);
  }
  result.log_least = std::log(result.least);
  result.rate = growth_rate(s, s.inner_radius[0], s.outer_radius[0], result.log_least);
  if (!result.constant) {
    result.inner_slope = slope_along(s, s.inner_radius);
    result.outer_slope = slope_along(s, s.outer_radius);
    result.spacing_slope = slope_along(s, s.spacing);
  }
  return result;
}

DOVETAIL_INLINE double source_field::slope_along(const grid_source& s, const weights& values) {
  const vec3 ab = s.corners[1] - s.corners[0];
  const vec3 ac = s.corners[2] - s.corners[0];
  const double b = values[1] - values[0];
  const double c = values[2] - values[0];
  if (s.dimension == 1)
    return b == 0 ? 0 : std::abs(b) / norm(ab);
  const vec3 n = cross(ab, ac);
  const vec3 gradient = b * cross(ac, n) + c * cross(n, ab);
  return b == 0 && c == 0 ? 0 : norm(gradient) / norm_squared(n);
}

DOVETAIL_INLINE double source_field::reach_at(const grid_source& s, const weights& at) const {
  const double inner = mixed(s.inner_radius, at);
  const double log_spacing = std::log(mixed(s.spacing, at));
  return inner + width_of_growth(log_spacing, growth_rate(s, inner, mixed(s.outer_radius, at), log_spacing));
}

DOVETAIL_INLINE source_field::nearest_point source_field::nearest(std::size_t i, vec3 p) const {
  const grid_source& s = sources_[i];
  weights at{1, 0, 0};
  if (s.dimension == 1) {
    const auto w = nearest_on_segment(s.corners[0], s.corners[1], p);
    at = {w[0], w[1], 0};
  } else if (s.dimension == 2) {
    at = nearest_on_triangle(s.corners[0], s.corners[1], s.corners[2], p);
  }
  const vec3 foot = at[0] * s.corners[0] + at[1] * s.corners[1] + at[2] * s.corners[2];
  return {distance(foot, p), at};
}

DOVETAIL_INLINE double source_field::log_size(local_id id, vec3 p, double closer) const {
  const auto i = static_cast<std::size_t>(id);
  const grid_source& s = sources_[i];
  const law& l = laws_[i];
  const auto [away, at] = nearest(i, p);
  const double r = std::max(0.0, away - closer);
  if (r >= l.reach)
    return log_ambient_;
  double inner = s.inner_radius[0];
  double outer = s.outer_radius[0];
  double log_spacing = l.log_least;
  if (!l.constant) {
    // Points within `closer` of p see feet within `closer` of p's foot: projection onto a convex set does
    // not expand.
    inner = mixed(s.inner_radius, at) + moved(l.inner_slope, closer);
    outer = mixed(s.outer_radius, at) + moved(l.outer_slope, closer);
    log_spacing = std::log(std::max(l.least, mixed(s.spacing, at) - moved(l.spacing_slope, closer)));
  }
  if (r <= inner)
    return log_spacing;
  if (!std::isfinite(inner) || !std::isfinite(outer))
    return log_spacing;
  const double rate = l.constant ? l.rate : growth_rate(s, inner, outer, log_spacing);
  return std::min(log_ambient_, log_grown(log_spacing, rate, r - inner));
}

DOVETAIL_INLINE double source_field::log_grown(double log_spacing, double rate, double r) const {
  const double exponential = log_spacing + rate * r;
  if (largest_slope_ == std::numeric_limits<double>::infinity())
    return exponential;
  const double bend = std::max(std::log(largest_slope_ / rate), log_spacing); // -inf for an infinite rate
  if (exponential <= bend)
    return exponential;
  const double r_bend = bend > log_spacing ? (bend - log_spacing) / rate : 0.0;
  return std::log(std::exp(bend) + largest_slope_ * (r - r_bend));
}

DOVETAIL_INLINE double source_field::width_of_growth(double log_spacing, double rate) const {
  if (log_spacing >= log_ambient_)
    return 0;
  const double free_width = (log_ambient_ - log_spacing) / rate;
  if (largest_slope_ == std::numeric_limits<double>::infinity())
    return free_width;
  const double bend = std::max(std::log(largest_slope_ / rate), log_spacing);
  if (bend >= log_ambient_)
    return free_width;
  const double r_bend = bend > log_spacing ? (bend - log_spacing) / rate : 0.0;
  return r_bend + (ambient_ - std::exp(bend)) / largest_slope_;
}

DOVETAIL_INLINE void source_field::check(const grid_source& s, std::size_t index) {
  const std::string who =
      "source " + std::to_string(index) + (s.name.empty() ? std::string() : " (" + s.name + ")");
  if (s.dimension < 0 || s.dimension > 2)
    throw sizing_error(who + " has dimension " + std::to_string(s.dimension) +
                       "; give 0 (point), 1 (line) or 2 (triangle)");
  for (std::size_t k = 0; k <= static_cast<std::size_t>(s.dimension); ++k) {
    sizing::checked_point(s.corners[k], "corner " + std::to_string(k) + " of " + who);
    sizing::checked_size(s.spacing[k], "the spacing of " + who);
    sizing::checked_length(s.inner_radius[k], "the inner radius of " + who);
    sizing::checked_size(s.outer_radius[k], "the outer radius of " + who);
    if (s.outer_radius[k] < s.inner_radius[k])
      throw sizing_error("the outer radius of " + who + " is smaller than its inner radius; exchange them");
  }
}

} // namespace dovetail
