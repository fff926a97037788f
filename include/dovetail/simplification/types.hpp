/// @file
/// What the simplification is given and what it gives.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/graph/csr_graph.hpp"
#include "dovetail/mesh/side_state.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <array>
#include <span>
#include <vector>

namespace dovetail {

/// Thresholds and bound; the defaults are those of the paper.
template <int D>
struct simplify_parameters {
  double wedge_threshold_deg = D == 2 ? 50 : 30; ///< smaller wedges are removed
  double shape_threshold_deg = D == 2 ? 0 : 30;  ///< sides with a smaller own angle are removed; 0: none
  double subdomains = 1;                         ///< how many parts the partition will have
  /// A super-element weighs at most this fraction of the average subdomain ...
  double bound_fraction = 0.1;
  /// ... but so many average elements are always allowed. Infinity switches the bound off.
  double always_allowed_elements = 8;
  /// Graph edge weight of a refused side: 1 + refusal_price at its threshold, growing linearly with the
  /// missing angle by up to refusal_penalty.
  double refusal_price = 10;
  double refusal_penalty = 200;
};

/// A ridge whose sides must go, or are to be avoided, because of what was decided one dimension below.
template <int D>
struct coupled_ridge {
  simplex<D - 2> vertices{};
  double angle_deg = 0;     ///< the angle that made it so; the smallest are treated first
  double threshold_deg = 0; ///< the angle that would have been good enough
  bool refused = false;     ///< true: it stayed below, so its sides are only penalised
};

/// What is given beside the mesh. All may be empty.
template <int D>
struct simplify_constraints {
  std::span<const simplex<D - 1>> fixed_sides = {};      ///< in any order of vertices
  std::span<const coupled_ridge<D>> coupled_ridges = {}; ///< all interior sides there are removed
  std::span<const double> element_weights = {};          ///< predicted final elements; empty: 1 each
};

/// A side that the bound refused.
struct refused_side {
  local_id side = no_id;
  double angle_deg = 0;     ///< the angle under the threshold: its own, or that of a wedge it bounds
  double threshold_deg = 0; ///< the threshold it missed
};

/// A wedge under the threshold between two fixed sides: nothing can be done about it.
struct forced_wedge {
  std::array<local_id, 2> sides{};
  double angle_deg = 0;
};

template <int D>
struct simplification {
  std::vector<side_state> side_states;
  std::vector<local_id> super_of_element;
  local_id super_count = 0;
  csr_graph graph; ///< contracted element-dual graph: node = super-element, weights as in the parameters
  std::vector<refused_side> refused; ///< sides in state `refused`, growing
  std::vector<forced_wedge> forced;  ///< by growing angle; boundary against boundary included
  report summary;
};

} // namespace dovetail
