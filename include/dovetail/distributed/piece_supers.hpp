/// @file
/// The super-elements of one piece: its fine elements, joined by the rule that coarse sides are judged by.
#pragma once

#include "dovetail/core/fields.hpp"
#include "dovetail/distributed/super_graph.hpp"
#include "dovetail/graph/contraction.hpp"
#include "dovetail/partition/multilevel.hpp"
#include "dovetail/simplification/any_simplification_rule.hpp"
#include "dovetail/simplification/simplify.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// The super-element of each element of a piece, and the sides that ought to have been removed, growing.
struct elements_of_supers {
  std::vector<local_id> super_of_element; ///< by element of the piece
  std::vector<local_id> refused;          ///< sides of the piece that the bound refused to remove

  using fields = field_list<&elements_of_supers::super_of_element, &elements_of_supers::refused>;
};

namespace detail {

template <int D>
std::vector<vec3> centres_of_elements(const simplicial_mesh<D>& mesh) {
  std::vector<vec3> centres;
  centres.reserve(mesh.elements.size());
  for (const auto& element : mesh.elements) {
    vec3 sum{};
    for (const local_id v : element)
      sum += mesh.points[v];
    centres.push_back(sum / (D + 1.0));
  }
  return centres;
}

/// What each side of a piece's boundary would cost as an interface, for its own quality and for the dihedrals
/// that it makes with another fixed side.
inline std::vector<double> penalties_of_sides(std::span<const local_id> sides, const side_judgement& judged,
                                              const simplification& simplified,
                                              const any_simplification_rule& rule) {
  std::map<local_id, double> worst;                         // angle of the smallest dihedral
  for (const forced_dihedral& dihedral : simplified.forced) // by growing angle
    for (const local_id side : dihedral.sides)
      worst.try_emplace(side, dihedral.angle_deg);
  std::vector<double> penalties;
  for (const local_id side : sides) {
    double penalty = 1;
    const double quality = judged.quality[side];
    if (quality < judged.wanted_quality)
      penalty = std::max(penalty, rule.penalty({quality, judged.wanted_quality}));
    if (const auto dihedral = worst.find(side); dihedral != worst.end())
      penalty = std::max(penalty, rule.penalty({dihedral->second, judged.wanted_angle_deg}));
    penalties.push_back(penalty);
  }
  return penalties;
}

} // namespace detail

/// Joins the elements of a piece to about `most` super-elements: first what the rule wants removed, then
/// along heavy edges.
template <int D>
std::pair<simplified_piece, elements_of_supers>
simplify_piece(const simplicial_piece<D>& piece, const simplicial_skeleton<D>& skeleton,
               std::span<const local_id> listed, const any_simplification_rule& rule, int most) {
  const auto table = build_sides(piece.mesh);
  const sides_of_piece on_skeleton = find_skeleton_sides<D>(piece, table, skeleton, listed);
  auto fixed = detail::fixed_inside<D>(piece.mesh, table, {});
  for (const local_id side : on_skeleton.sides)
    fixed[side] = 1;
  const side_judgement judged = rule(piece.mesh, table);
  const contraction_bound bound{.subdomains = static_cast<double>(most), .fraction = 1.5};
  simplification simplified =
      contract_bounded(element_dual<D>(table, {}, span_of(fixed)),
                       side_dual<D>(piece.mesh, table, mesh_state::valid), judged, rule, bound);
  std::pair<simplified_piece, elements_of_supers> result;
  auto& [known, supers] = result;
  supers.super_of_element = std::move(simplified.super_of_element);
  for (const refused_side& refused : simplified.refused)
    supers.refused.push_back(refused.side);
  known.penalty_of_side = detail::penalties_of_sides(on_skeleton.sides, judged, simplified, rule);
  known.graph = std::move(simplified.graph);
  for (coarsened_graph& level : coarsened_levels(known.graph, 1, {.coarse_nodes_per_part = most})) {
    for (local_id& super : supers.super_of_element)
      super = level.node_of[super];
    known.graph = std::move(level.graph);
  }
  const auto centres = detail::centres_of_elements(piece.mesh);
  known.graph.positions =
      mean_positions(span_of(centres), span_of(supers.super_of_element), known.graph.node_count());
  for (const local_id e : on_skeleton.elements)
    known.super_at_side.push_back(supers.super_of_element[e]);
  return result;
}

} // namespace dovetail
