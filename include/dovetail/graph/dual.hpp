/// @file
/// The dual graphs of a mesh as views that model Boost.Graph: nothing is stored beyond the adjacency.
///
/// element_dual (EDG): node = element, edge = interior side; `edge_index` is the side.
/// side_dual (SDG): node = side, edge = wedge, that is two sides of one element and the ridge where they
/// meet; `edge_index` is element x wedges per element + local ridge.
#pragma once

#include "dovetail/graph/boost_adaptor.hpp"
#include "dovetail/mesh/adjacency.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace dovetail {

/// The element-dual graph. Sides whose entry in `cut` is not zero are left out; `cut` may be empty. Both
/// tables must outlive the view, unchanged.
template <int D>
class element_dual {
public:
  explicit element_dual(const side_table<D>& sides, std::span<const std::uint8_t> cut = {})
      : sides_(&sides), cut_(cut), leaves_out_(!cut.empty() || !sides.further_elements.empty()) {}

  std::size_t element_count() const { return sides_->of_element.size(); }
  std::size_t side_count() const { return sides_->size(); }
  /// The edge across local side i of an element; false when there is none.
  bool across(local_id element, std::size_t i, graph_edge& e) const {
    const local_id side = sides_->of_element[static_cast<std::size_t>(element)][i];
    const auto& pair = sides_->elements[static_cast<std::size_t>(side)]; // {element, no_id} on the boundary
    e = {element, pair[0] == element ? pair[1] : pair[0], side};
    return e.target != no_id && !is_left_out(side);
  }
  /// The edge that is dual to a side; false when there is none.
  bool dual_to(std::size_t side, graph_edge& e) const {
    const auto& pair = sides_->elements[side];
    e = {pair[0], pair[1], static_cast<std::int64_t>(side)};
    return e.target != no_id && !is_left_out(static_cast<local_id>(side));
  }

private:
  /// Two elements meet at the side, and yet it is no edge.
  bool is_left_out(local_id side) const {
    return leaves_out_ && ((!cut_.empty() && cut_[static_cast<std::size_t>(side)] != 0) ||
                           (!sides_->further_elements.empty() && is_non_manifold(side)));
  }
  /// Out of line, so that a walk over a manifold mesh is small enough to become a part of the user's loop.
  [[gnu::noinline]] bool is_non_manifold(local_id side) const { return sides_->is_non_manifold(side); }

  const side_table<D>* sides_;
  std::span<const std::uint8_t> cut_;
  bool leaves_out_; ///< whether `is_left_out` of any side; known once, since every slot of every walk asks
};

/// The side-dual graph. The table must outlive the view.
template <int D>
class side_dual {
public:
  static constexpr std::size_t wedges_per_element = numbering::ridges<D>.size();

  explicit side_dual(const side_table<D>& sides) : sides_(&sides) {}

  std::size_t side_count() const { return sides_->size(); }
  std::size_t wedge_count() const { return sides_->of_element.size() * wedges_per_element; }
  /// D wedges in each element at the side.
  std::size_t wedges_at(local_id side) const {
    if (sides_->is_boundary(side))
      return D;
    return sides_->is_non_manifold(side) ? D * sides_->all_elements(side).size() : std::size_t{2 * D};
  }
  /// The k-th wedge at a side, seen from that side.
  graph_edge wedge_at(local_id side, std::size_t k) const {
    const std::size_t which = k / D;
    const local_id element = which < 2 ? sides_->elements[static_cast<std::size_t>(side)][which]
                                       : sides_->all_elements(side)[which];
    std::size_t seen = 0;
    for (std::size_t r = 0; r < wedges_per_element; ++r) {
      const graph_edge e = wedge_edge(static_cast<std::size_t>(element) * wedges_per_element + r);
      if (e.source == side || e.target == side)
        if (seen++ == k % D)
          return e.source == side ? e : graph_edge{e.target, e.source, e.index};
    }
    return {};
  }
  /// The edge that is a given wedge (element x wedges per element + local ridge).
  graph_edge wedge_edge(std::size_t wedge) const {
    const auto& of_element = sides_->of_element[wedge / wedges_per_element];
    const auto& local = numbering::sides_of_ridge<D>[wedge % wedges_per_element];
    return {of_element[static_cast<std::size_t>(local[0])], of_element[static_cast<std::size_t>(local[1])],
            static_cast<std::int64_t>(wedge)};
  }

private:
  const side_table<D>* sides_;
};

template <int D>
struct graph_access<element_dual<D>> {
  using edge_parallel_category = boost::allow_parallel_edge_tag; // two elements may share two sides

  static std::size_t vertex_count(const element_dual<D>& g) { return g.element_count(); }
  static std::size_t row_slots(const element_dual<D>& /*g*/, local_id /*element*/) { return D + 1; }
  static bool row_edge(const element_dual<D>& g, local_id element, std::size_t slot, graph_edge& e) {
    return g.across(element, slot, e);
  }
  static std::size_t edge_slots(const element_dual<D>& g) { return g.side_count(); }
  static bool list_edge(const element_dual<D>& g, std::size_t slot, graph_edge& e) {
    return g.dual_to(slot, e);
  }
};

template <int D>
struct graph_access<side_dual<D>> {
  using edge_parallel_category = boost::allow_parallel_edge_tag; // two sides may belong to two elements

  static std::size_t vertex_count(const side_dual<D>& g) { return g.side_count(); }
  static std::size_t row_slots(const side_dual<D>& g, local_id side) { return g.wedges_at(side); }
  static bool row_edge(const side_dual<D>& g, local_id side, std::size_t slot, graph_edge& e) {
    e = g.wedge_at(side, slot);
    return true;
  }
  static std::size_t edge_slots(const side_dual<D>& g) { return g.wedge_count(); }
  static bool list_edge(const side_dual<D>& g, std::size_t slot, graph_edge& e) {
    e = g.wedge_edge(slot);
    return true;
  }
};

} // namespace dovetail
