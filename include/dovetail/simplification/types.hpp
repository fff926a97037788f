/// @file
/// What the simplification is given and what it gives.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/graph/csr_graph.hpp"
#include "dovetail/mesh/require_valid.hpp"
#include "dovetail/mesh/side_state.hpp"
#include "dovetail/mesh/simplex.hpp"
#include "dovetail/simplification/concepts.hpp"

#include <array>
#include <vector>

namespace dovetail {

/// How heavy a super-element may become. Without a bound the rules can percolate: on a strongly graded mesh
/// two thirds of all elements may end in one super-element.
struct contraction_bound {
  double subdomains = 1; ///< how many parts the partition will have
  /// A super-element weighs at most this fraction of the average subdomain ...
  double fraction = 0.1;
  /// ... but so many average elements are always allowed. Infinity in either switches the bound off.
  double always_allowed_elements = 8;
};

/// A side that must go, or is to be avoided, whatever its own quality.
struct coupled_side {
  local_id side = no_id;   ///< the number of the side
  ridge_decision decision; ///< what is to become of it
};

/// A ridge whose sides must go, or are to be avoided, because of what was decided one dimension below.
template <int D>
struct coupled_ridge {
  simplex<D - 2> vertices{}; ///< of the ridge, sorted
  ridge_decision decision;   ///< what is to become of its sides
};

/// A side that the bound refused, and what it falls short of: of its own quality, or a dihedral it bounds.
struct refused_side {
  local_id side = no_id; ///< the number of the side
  deficit missed;        ///< what it falls short of
};

/// A dihedral under the threshold between two fixed sides: nothing can be done about it.
struct forced_dihedral {
  std::array<local_id, 2> sides{}; ///< both fixed
  double angle_deg = 0;            ///< between them
};

/// What a simplification decided.
struct simplification {
  std::vector<side_state> side_states;    ///< by side
  std::vector<local_id> super_of_element; ///< by element
  local_id super_count = 0;               ///< how many there are
  /// The EDG contracted: node = super-element. Edges that become one add up, each the weight of its side, for
  /// a refused one times its penalty.
  csr_graph graph;
  std::vector<refused_side> refused;   ///< sides in state `refused`, growing
  std::vector<double> quality;         ///< of each side, as the rule judged it
  std::vector<forced_dihedral> forced; ///< by growing angle; boundary against boundary included
  report summary;                      ///< what was counted on the way
};

/// What is counted of a simplification.
struct simplification_counts {
  std::size_t elements = 0;          ///< of the background mesh
  local_id super_elements = 0;       ///< what they became
  std::int64_t kept_sides = 0;       ///< that may be interfaces
  std::int64_t removed_sides = 0;    ///< inside super-elements
  std::int64_t refused_sides = 0;    ///< that the bound kept from being removed
  std::int64_t fixed_sides = 0;      ///< that are interfaces in any case
  std::size_t forced_dihedrals = 0;  ///< small ones between fixed sides
  double weight_bound = 0;           ///< no super-element was made heavier
  double heaviest_super_element = 0; ///< its weight

  using fields = field_list<&simplification_counts::elements, &simplification_counts::super_elements,
                            &simplification_counts::kept_sides, &simplification_counts::removed_sides,
                            &simplification_counts::refused_sides, &simplification_counts::fixed_sides,
                            &simplification_counts::forced_dihedrals, &simplification_counts::weight_bound,
                            &simplification_counts::heaviest_super_element>;
};

} // namespace dovetail
