/// @file
/// The mesh as the improver sees it: elements with neighbours, cached measures and vertex stars, changed by
/// replacing one small set of elements by another that fills the same cavity.
#pragma once

#include "dovetail/core/vector.hpp"
#include "dovetail/improver/tetrahedra/cavity_matcher.hpp"
#include "dovetail/improver/tetrahedra/tet_adjacency.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::improvement {

/// What may happen to a vertex.
enum class vertex_kind : std::uint8_t {
  free,    ///< may be moved and removed
  fixed,   ///< on a fixed side, or frozen by the caller
  removed, ///< was removed: its number may be taken by a new vertex
  unused   ///< in no element from the start; left alone
};

/// Flat arrays, 32-bit ids. A *fixed* side is never removed: it has no element across it, or it is frozen, or
/// it parts two tags. Invariants: `across` is an involution; `element_at(v)` names an element that has v, for
/// every vertex in use; a dead element has `no_id` as its first vertex and the value 2.
class tet_complex {
public:
  /// The elements must name points that exist. `numbers`, one per point, are those that the caller knows the
  /// points by; without them it is their places. Throws `mesh_error` when more than two elements meet at a
  /// side.
  tet_complex(std::vector<vec3> points, std::vector<simplex<3>> elements, std::vector<local_id> tags,
              std::vector<local_id> numbers = {});

  // -- what there is ---------------------------------------------------------------------------------------
  /// Element ids are in [0, element_slots()); dead ones among them are skipped with `is_alive`.
  local_id element_slots() const { return static_cast<local_id>(elements_.size()); }
  /// Vertices in use and gaps.
  local_id vertex_slots() const { return static_cast<local_id>(points_.size()); }
  std::size_t element_count() const { return alive_; } ///< elements that are alive
  bool is_alive(local_id e) const { return elements_[e][0] != no_id; }
  /// The four vertices of an element.
  const simplex<3>& vertices(local_id e) const { return elements_[e]; }
  /// Corner `corner` of an element.
  local_id vertex(local_id e, int corner) const { return elements_[e][corner]; }
  const vec3& point(local_id v) const { return points_[v]; } ///< where a vertex is
  /// The vertices in [0, given_vertices()) came with the mesh, the others were added.
  local_id given_vertices() const { return given_vertices_; }
  /// What the caller knows a vertex by that came with the mesh.
  local_id given_number(local_id v) const { return numbers_.empty() ? v : numbers_[v]; }
  half_side across(local_id e, int side) const { return across_[e][side]; }
  /// Whether a side must stay.
  bool is_fixed(local_id e, int side) const { return ((fixed_sides_[e] >> side) & 1U) != 0; }
  /// Whether any side must stay.
  bool has_fixed_side(local_id e) const { return fixed_sides_[e] != 0; }
  local_id element_at(local_id v) const { return element_at_[v]; } ///< an element that has the vertex
  vertex_kind kind(local_id v) const { return kinds_[v]; }         ///< what may be done with a vertex
  /// Whether it was taken out.
  bool is_gap(local_id v) const { return kinds_[v] == vertex_kind::removed; }
  /// Whether it may be moved and taken out.
  bool is_free(local_id v) const { return kinds_[v] == vertex_kind::free; }
  bool has_tags() const { return !tags_.empty(); } ///< whether elements have tags
  /// The tag of an element; 0 where there are none.
  local_id tag(local_id e) const { return tags_.empty() ? 0 : tags_[e]; }
  float value(local_id e) const { return values_[e]; }         ///< the measure of an element
  const std::vector<float>& values() const { return values_; } ///< by element, those of dead ones too
  /// The sum over all elements of what they lack to the target; kept up to date, O(1).
  double lacking() const { return lacking_; }
  /// What an element of this value lacks to the target, cubed: one really poor element weighs more than
  /// several that nearly reach it.
  double deficit(float value) const {
    if (!(value < target_))
      return 0;
    const auto missing = static_cast<double>(target_ - value);
    return missing * missing * missing;
  }
  /// The size that edges at `v` should have; 0 while there are no sizes.
  float size_at(local_id v) const { return sizes_.empty() ? 0.0F : sizes_[v]; }

  /// The corner of `e` at which `v` lies; `v` must be one of its vertices.
  int corner_of(local_id e, local_id v) const {
    const auto& element = elements_[e];
    return element[0] == v ? 0 : element[1] == v ? 1 : element[2] == v ? 2 : 3;
  }

  /// Some element has `v`.
  bool is_used(local_id v) const {
    const local_id e = element_at(v);
    return e != no_id && is_alive(e) && vertex(e, corner_of(e, v)) == v;
  }
  /// So many free vertices can be removed before too few are left to take all numbers under the last fixed
  /// one.
  local_id releasable() const { return releasable_; }

  // -- marks: a set of elements that is emptied in O(1) ----------------------------------------------------
  /// Takes all marks off.
  void clear_marks() {
    if (++current_mark_ == 0) {
      std::fill(element_marks_.begin(), element_marks_.end(), 0U);
      current_mark_ = 1;
    }
  }
  void mark(local_id e) { element_marks_[e] = current_mark_; } ///< marks an element
  /// Whether an element is marked.
  bool is_marked(local_id e) const { return element_marks_[e] == current_mark_; }

  /// Whether the mesh may overlap itself, because some elements are (or were) flat or inverted. Then positive
  /// orientation does not prove that a new side is new; changes are checked for that.
  bool is_tangled() const { return is_tangled_; }
  void set_tangled(bool tangled) { is_tangled_ = tangled; } ///< tells that elements may overlap each other

  // -- when things changed ---------------------------------------------------------------------------------
  /// Counts changes; starts at 1.
  std::uint32_t now() const { return now_; }
  /// When an element at `v` was last replaced or moved.
  std::uint32_t changed_at(local_id v) const { return changed_at_[v]; }
  void start_change() { ++now_; } ///< begins a change: vertices touched from now on are of it
  /// Notes that the elements at a vertex have changed.
  void touch(local_id v) { changed_at_[v] = now_; }
  /// Takes a touch back.
  void set_changed_at(local_id v, std::uint32_t when) { changed_at_[v] = when; }

  // -- changes ---------------------------------------------------------------------------------------------
  /// Sets the measure of an element.
  void set_value(local_id e, float value) {
    lacking_ += deficit(value) - deficit(values_[e]);
    values_[e] = value;
  }
  /// Elements with a smaller value lack something. O(elements).
  void set_target(float target) {
    target_ = target;
    lacking_ = 0;
    for (const float value : values_)
      lacking_ += deficit(value);
  }
  /// Takes the sizes over, one per vertex.
  void set_sizes(std::vector<float> sizes) { sizes_ = std::move(sizes); }
  /// Moves a vertex; the measures of its elements are set separately.
  void set_point(local_id v, vec3 p) { points_[v] = p; }
  /// Sets what may be done with a vertex.
  void set_kind(local_id v, vertex_kind kind) { kinds_[v] = kind; }
  /// To be called once when all fixed vertices are known.
  void finish_kinds();
  /// Makes a side stay.
  void fix_side(local_id e, int side) {
    fixed_sides_[e] = static_cast<std::uint8_t>(fixed_sides_[e] | (1U << side));
  }
  /// A new free vertex that is in no element yet; `size` counts only where there are sizes.
  local_id add_vertex(vec3 p, float size = 0);
  /// Gives up a vertex that no element uses any more.
  void release_vertex(local_id v) {
    kinds_[v] = vertex_kind::removed;
    element_at_[v] = no_id;
    --releasable_;
    free_vertices_.push_back(v);
  }

  /// Replaces the elements `old` by `fresh`, which must fill exactly the same cavity: every side of a fresh
  /// element lies against another one or on the cavity's boundary. `ids` (as long as `fresh`) receives the
  /// new elements' numbers: those of `old` first, then those given up last, so that replacing them by the old
  /// ones again restores all numbers. O(old + fresh). Vertices inside the cavity that `fresh` does not use
  /// are left without an element; the caller releases them.
  void replace(std::span<const local_id> old, std::span<const simplex<3>> fresh,
               std::span<const float> values, std::span<local_id> ids);

  /// The class invariant holds (see above); O(elements). For tests.
  bool is_consistent() const;

  // -- the result ------------------------------------------------------------------------------------------
  std::vector<vec3>& points() { return points_; }           ///< by vertex, to be changed in place
  std::vector<simplex<3>>& elements() { return elements_; } ///< by element, to be changed in place
  std::vector<local_id>& tags() { return tags_; }           ///< by element, to be changed in place

private:
  static constexpr float gone = 2; ///< the value of a dead element

  void join(local_id e, int side, cavity_side other) {
    across_[e][side] = other.outer;
    if (other.is_fixed)
      fix_side(e, side);
    if (other.outer != no_id)
      across_[element_of(other.outer)][side_of(other.outer)] = half_side_of(e, side);
  }
  local_id new_element();
  void kill(local_id e) {
    elements_[e][0] = no_id;
    set_value(e, gone);
    dead_elements_.push_back(e);
  }

  std::vector<vec3> points_;
  std::vector<simplex<3>> elements_;
  std::vector<local_id> tags_, numbers_;
  local_id given_vertices_;
  std::vector<std::array<half_side, 4>> across_;
  std::vector<float> values_, sizes_;
  float target_ = -2;
  double lacking_ = 0;
  std::vector<std::uint8_t> fixed_sides_;
  std::vector<std::uint32_t> element_marks_;
  std::uint32_t current_mark_ = 0;
  std::vector<std::uint32_t> changed_at_;
  std::uint32_t now_ = 1;
  std::vector<local_id> element_at_;
  std::vector<vertex_kind> kinds_;
  std::vector<local_id> dead_elements_, free_vertices_;
  local_id releasable_ = 0;
  bool is_tangled_ = false;
  std::size_t alive_;
  cavity_matcher matcher_;
};

} // namespace dovetail::improvement

#ifndef DOVETAIL_COMPILED
#include "dovetail/improver/tetrahedra/tet_complex.ipp"
#endif
