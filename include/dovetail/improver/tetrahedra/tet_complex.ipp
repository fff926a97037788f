/// @file
/// What `tet_complex.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/improver/tetrahedra/tet_adjacency.hpp"
#include "dovetail/improver/tetrahedra/tet_complex.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::improvement {

DOVETAIL_INLINE tet_complex::tet_complex(std::vector<vec3> points, std::vector<simplex<3>> elements,
                                         std::vector<local_id> tags, std::vector<local_id> numbers)
    : points_(std::move(points)), elements_(std::move(elements)), tags_(std::move(tags)),
      numbers_(std::move(numbers)), given_vertices_(static_cast<local_id>(points_.size())),
      across_(match_sides(span_of(elements_), points_.size(), numbers_)), values_(elements_.size(), 0.0F),
      fixed_sides_(elements_.size(), 0), element_marks_(elements_.size(), 0), changed_at_(points_.size(), 0),
      element_at_(points_.size(), no_id), kinds_(points_.size(), vertex_kind::unused),
      alive_(elements_.size()) {
  for (local_id e = 0; e < element_slots(); ++e)
    for (const local_id v : elements_[e]) {
      element_at_[v] = e;
      kinds_[v] = vertex_kind::free;
    }
}

DOVETAIL_INLINE void tet_complex::finish_kinds() {
  local_id free = 0, kept = 0, end = 0; // kept numbers are all below `end`
  for (local_id v = 0; v < given_vertices_; ++v) {
    if (is_free(v)) {
      ++free;
      continue;
    }
    ++kept;
    end = std::max(end, given_number(v) + 1);
  }
  releasable_ = free - (end - kept);
}

DOVETAIL_INLINE local_id tet_complex::add_vertex(vec3 p, float size) {
  if (!free_vertices_.empty()) {
    const local_id v = free_vertices_.back();
    free_vertices_.pop_back();
    ++releasable_;
    points_[v] = p;
    kinds_[v] = vertex_kind::free;
    if (!sizes_.empty())
      sizes_[v] = size;
    return v;
  }
  points_.push_back(p);
  element_at_.push_back(no_id);
  changed_at_.push_back(now_);
  kinds_.push_back(vertex_kind::free);
  if (!sizes_.empty())
    sizes_.push_back(size);
  ++releasable_;
  return vertex_slots() - 1;
}

DOVETAIL_INLINE void tet_complex::replace(std::span<const local_id> old, std::span<const simplex<3>> fresh,
                                          std::span<const float> values, std::span<local_id> ids) {
  start_change();
  clear_marks();
  for (const local_id e : old)
    mark(e);
  matcher_.start(4 * (old.size() + fresh.size()));
  for (const local_id e : old)
    for (int side = 0; side < 4; ++side) {
      const half_side outer = across(e, side);
      if (outer == no_id || !is_marked(element_of(outer)))
        matcher_.offer(sorted_side(vertices(e), side), {outer, is_fixed(e, side)});
    }
  const local_id tag_of_cavity = tag(old[0]);
  for (std::size_t i = 0; i < fresh.size(); ++i)
    ids[i] = i < old.size() ? old[i] : new_element();
  for (std::size_t i = old.size(); i-- > fresh.size();)
    kill(old[i]);
  alive_ = alive_ + fresh.size() - old.size();
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    const local_id e = ids[i];
    elements_[e] = fresh[i];
    set_value(e, values[i]);
    fixed_sides_[e] = 0;
    if (has_tags())
      tags_[e] = tag_of_cavity;
    for (const local_id v : fresh[i]) {
      element_at_[v] = e;
      touch(v);
    }
    for (int side = 0; side < 4; ++side) {
      const auto key = sorted_side(fresh[i], side);
      if (const auto match = matcher_.take(key))
        join(e, side, *match);
      else
        matcher_.offer(key, {half_side_of(e, side), false});
    }
  }
}

DOVETAIL_INLINE bool tet_complex::is_consistent() const {
  for (local_id e = 0; e < element_slots(); ++e)
    for (int side = 0; is_alive(e) && side < 4; ++side) {
      const half_side other = across(e, side);
      if (other == no_id ? !is_fixed(e, side)
                         : !is_alive(element_of(other)) || element_of(other) == e ||
                               across(element_of(other), side_of(other)) != half_side_of(e, side) ||
                               sorted_side(vertices(element_of(other)), side_of(other)) !=
                                   sorted_side(vertices(e), side) ||
                               is_fixed(element_of(other), side_of(other)) != is_fixed(e, side))
        return false;
    }
  for (local_id v = 0; v < vertex_slots(); ++v)
    if (kind(v) == vertex_kind::free || kind(v) == vertex_kind::fixed) {
      const local_id e = element_at(v);
      if (e == no_id || !is_alive(e) || vertex(e, corner_of(e, v)) != v)
        return false;
    }
  return true;
}

DOVETAIL_INLINE local_id tet_complex::new_element() {
  if (!dead_elements_.empty()) {
    const local_id e = dead_elements_.back();
    dead_elements_.pop_back();
    return e;
  }
  elements_.push_back({});
  across_.push_back({});
  values_.push_back(gone);
  fixed_sides_.push_back(0);
  element_marks_.push_back(0);
  if (has_tags())
    tags_.push_back(0);
  return element_slots() - 1;
}

} // namespace dovetail::improvement
