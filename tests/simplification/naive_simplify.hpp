/// @file
/// The simplification as its definition reads: everything is computed anew at every step, from the fans of
/// the ridge table. Slow, short, and independent of the data structures under test.
#pragma once

#include "dovetail/mesh/quality.hpp"
#include "dovetail/mesh/side_state.hpp"
#include "dovetail/simplification/side_shape.hpp"
#include "support/adjacency.hpp"

#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <vector>

namespace dovetail_test {

/// Dihedrals between consecutive remaining sides, for given remaining sides.
struct naive_dihedral {
  double angle;
  dovetail::local_id from;
  dovetail::local_id to;
};

template <int D>
std::vector<naive_dihedral> remaining_dihedrals(const dovetail::simplicial_mesh<D>& mesh,
                                                const dovetail_test::adjacency<D>& adj,
                                                const std::vector<bool>& gone) {
  using namespace dovetail;
  std::vector<naive_dihedral> dihedrals;
  for (std::size_t f = 0; f < adj.fan_count(); ++f) {
    std::vector<naive_dihedral> parts;
    for (const std::uint32_t code : adj.ridges.fan(f)) {
      const dihedral w = ridge_table<D>::decode(code);
      const auto e = static_cast<std::size_t>(w.element);
      const auto angles = dihedral_angles(corners(std::span(mesh.points), mesh.elements[e]));
      parts.push_back(
          {angles[w.ridge], adj.sides.of_element[e][w.sides[0]], adj.sides.of_element[e][w.sides[1]]});
    }
    if (adj.ridges.closed[f]) { // start behind a remaining side
      std::size_t start = 0;
      while (start < parts.size() && gone[parts[start].from])
        ++start;
      if (start == parts.size())
        continue;
      std::rotate(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(start), parts.end());
    }
    naive_dihedral run = parts[0];
    for (std::size_t k = 1; k < parts.size(); ++k)
      if (gone[run.to]) {
        run.angle += parts[k].angle;
        run.to = parts[k].to;
      } else {
        dihedrals.push_back(run);
        run = parts[k];
      }
    dihedrals.push_back(run);
  }
  return dihedrals;
}

template <int D>
struct naive_result {
  std::vector<dovetail::side_state> states;
  std::vector<dovetail::local_id> super;
};

template <int D>
naive_result<D> naive_simplify(const dovetail::simplicial_mesh<D>& mesh,
                               const dovetail_test::adjacency<D>& adj, const std::vector<bool>& fixed,
                               const std::vector<double>& weights, double bound, double shape_threshold,
                               double dihedral_threshold) {
  using namespace dovetail;
  const auto shapes = side_shapes(mesh, adj.sides);
  std::vector<local_id> super(mesh.elements.size());
  std::iota(super.begin(), super.end(), 0);
  std::vector<bool> refused(adj.sides.size(), false);
  const auto ends = [&](local_id s) {
    const auto [a, b] = adj.sides.elements[s];
    return std::pair(super[a], super[b]);
  };
  const auto weight = [&](local_id label) {
    double total = 0;
    for (std::size_t e = 0; e < super.size(); ++e)
      total += super[e] == label ? weights[e] : 0.0;
    return total;
  };
  const auto contract = [&](local_id s) {
    const auto [a, b] = ends(s);
    if (a != b && weight(a) + weight(b) > bound) {
      refused[s] = true;
      return;
    }
    for (local_id& label : super)
      if (label == std::max(a, b))
        label = std::min(a, b);
  };
  const auto internal = [&](local_id s) { return !fixed[s] && ends(s).first == ends(s).second; };

  std::vector<std::pair<double, local_id>> bad;
  for (std::size_t s = 0; s < adj.sides.size(); ++s)
    if (!fixed[s] && shapes[s] < shape_threshold)
      bad.emplace_back(shapes[s], static_cast<local_id>(s));
  std::sort(bad.begin(), bad.end());
  for (const auto& [shape, s] : bad)
    contract(s);

  while (true) {
    std::vector<bool> gone(adj.sides.size());
    for (std::size_t s = 0; s < gone.size(); ++s)
      gone[s] = internal(static_cast<local_id>(s));
    naive_dihedral worst{dihedral_threshold, no_id, no_id};
    for (const naive_dihedral& w : remaining_dihedrals(mesh, adj, gone)) {
      const bool stuck = (fixed[w.from] && fixed[w.to]) || refused[w.from] || refused[w.to];
      if (!stuck && w.angle < worst.angle)
        worst = w;
    }
    if (worst.from == no_id)
      break;
    const auto key = [&](local_id s) { return std::tuple(fixed[s], shapes[s], s); };
    contract(key(worst.from) < key(worst.to) ? worst.from : worst.to);
  }

  naive_result<D> result;
  result.super = super;
  for (std::size_t s = 0; s < adj.sides.size(); ++s)
    result.states.push_back(fixed[s]                             ? side_state::fixed
                            : internal(static_cast<local_id>(s)) ? side_state::removed
                            : refused[s]                         ? side_state::refused
                                                                 : side_state::kept);
  return result;
}

} // namespace dovetail_test
