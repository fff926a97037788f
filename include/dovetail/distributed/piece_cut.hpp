/// @file
/// Cuts pieces whose elements go to several others, and puts the elements together again: the new skeleton
/// and the new pieces. Plain data; who loads and keeps pieces is another matter.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/distributed/super_graph.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// The new sides inside an old piece. Points are those of the old skeleton by their numbers; own point
/// `points[k]` of the piece is -1 - k.
template <int D>
struct piece_cut {
  std::vector<local_id> points;      ///< own points of the piece that come onto the skeleton, growing
  std::vector<vec3> places;          ///< of these
  std::vector<host> hosts;           ///< of these
  std::vector<simplex<D - 1>> sides; ///< by its points, outwards of the first of the new pieces beside it
  std::vector<std::array<local_id, 2>> subdomains; ///< of the new pieces; oriented outwards of [0]
  std::vector<std::uint8_t> refused;               ///< not zero: the side ought to have been removed

  using fields = field_list<&piece_cut::points, &piece_cut::places, &piece_cut::hosts, &piece_cut::sides,
                            &piece_cut::subdomains, &piece_cut::refused>;
};

/// Cuts a piece between elements that go to different new pieces. `on_skeleton` is what
/// `find_skeleton_sides` has found, `refused` lists sides of the table, growing. Linear.
template <int D>
piece_cut<D> cut_piece(const simplicial_piece<D>& piece, const side_table<D>& table,
                       const sides_of_piece& on_skeleton, std::span<const local_id> new_piece_of_element,
                       std::span<const local_id> refused) {
  const auto goes_to = [&](local_id e) { return new_piece_of_element[e]; };
  std::vector<std::uint8_t> is_old(table.size(), 0);
  for (const local_id s : on_skeleton.sides)
    is_old[s] = 1;
  piece_cut<D> cut;
  std::vector<local_id> hosts_of(piece.mesh.points.size(), no_id); // an element at each own point
  for (std::size_t s = 0; s < table.size(); ++s) {
    const auto side = static_cast<local_id>(s);
    const auto [a, b] = table.elements[s];
    if (is_old[s] != 0 || !table.is_interior(side) || goes_to(a) == goes_to(b))
      continue;
    cut.sides.push_back(table.vertices[s]);
    cut.subdomains.push_back({goes_to(a), goes_to(b)});
    cut.refused.push_back(std::binary_search(refused.begin(), refused.end(), side) ? 1 : 0);
    for (const local_id v : table.vertices[s])
      hosts_of[v] = a;
  }
  for (std::size_t v = piece.skeleton_points.size(); v < hosts_of.size(); ++v)
    if (hosts_of[v] != no_id) {
      cut.points.push_back(static_cast<local_id>(v));
      cut.places.push_back(piece.mesh.points[v]);
      const auto e = static_cast<std::size_t>(hosts_of[v]);
      cut.hosts.push_back({D, D == 2 && !piece.mesh.tags.empty() ? piece.mesh.tags[e] : piece.material});
    }
  for (auto& side : cut.sides)
    for (local_id& v : side)
      v = static_cast<std::size_t>(v) < piece.skeleton_points.size()
              ? piece.skeleton_points[v]
              : static_cast<local_id>(cut.points.begin() -
                                      std::lower_bound(cut.points.begin(), cut.points.end(), v)) -
                    1;
  return cut;
}

/// The skeleton of the new pieces.
template <int D>
struct new_skeleton {
  simplicial_skeleton<D> fine;        ///< their boundaries
  std::vector<std::uint8_t> avoided;  ///< per side: not zero where it ought to be no interface
  std::vector<local_id> number;       ///< per point of the old skeleton: its number in the new one, or no_id
  std::vector<local_id> first_of_cut; ///< per old piece: the number of the first of its own points
  std::size_t seams = 0;              ///< sides inside solids that were in the old skeleton and still are
};

/// Joins what is left of a skeleton with the cuts of its pieces. `new_pieces` are those behind and in front
/// of each old side. Sides inside a solid go where both are the same piece; sides on CAD entities stay.
/// Linear.
template <int D>
new_skeleton<D> join_cuts(const simplicial_skeleton<D>& old,
                          const std::vector<std::array<local_id, 2>>& new_pieces,
                          const std::vector<double>& penalty_of_side, const std::vector<piece_cut<D>>& cuts) {
  new_skeleton<D> made;
  auto& fine = made.fine;
  made.number.assign(old.points.size(), no_id);
  const auto keep = [&](const simplex<D - 1>& side) {
    for (const local_id v : side)
      if (v >= 0)
        made.number[v] = 0;
  };
  std::vector<std::size_t> kept;
  for (std::size_t s = 0; s < old.sides.size(); ++s)
    if (new_pieces[s][0] != new_pieces[s][1] || old.side_hosts[s] != no_id) {
      kept.push_back(s);
      keep(old.sides[s]);
    }
  for (const auto& cut : cuts)
    for (const auto& side : cut.sides)
      keep(side);
  for (std::size_t v = 0; v < made.number.size(); ++v)
    if (made.number[v] != no_id) {
      made.number[v] = static_cast<local_id>(fine.points.size());
      fine.points.own().push_back(old.points[v]);
      fine.point_hosts.own().push_back(old.point_hosts[v]);
    }
  for (const auto& cut : cuts) {
    made.first_of_cut.push_back(static_cast<local_id>(fine.points.size()));
    append(fine.points.own(), cut.places);
    append(fine.point_hosts.own(), cut.hosts);
  }
  const auto add = [&](simplex<D - 1> side, local_id first_own, const std::array<local_id, 2>& subdomains,
                       local_id on, bool avoided) {
    for (local_id& v : side)
      v = v < 0 ? first_own - v - 1 : made.number[v];
    fine.sides.own().push_back(side);
    fine.subdomains.own().push_back(subdomains);
    fine.side_hosts.own().push_back(on);
    made.avoided.push_back(avoided ? 1 : 0);
  };
  for (const std::size_t s : kept) {
    add(old.sides[s], no_id, new_pieces[s], old.side_hosts[s], penalty_of_side[s] > 1);
    made.seams += old.side_hosts[s] == no_id ? 1 : 0;
  }
  for (std::size_t p = 0; p < cuts.size(); ++p)
    for (std::size_t k = 0; k < cuts[p].sides.size(); ++k)
      add(cuts[p].sides[k], made.first_of_cut[p], cuts[p].subdomains[k], no_id, cuts[p].refused[k] != 0);
  for (std::size_t c = 0; c < old.curve_edges.size(); ++c) {
    simplex<1> edge = old.curve_edges[c];
    for (local_id& v : edge)
      v = made.number[v];
    if (edge[0] == no_id || edge[1] == no_id)
      continue;
    fine.curve_edges.push_back(edge);
    fine.curves.push_back(old.curves[c]);
  }
  return made;
}

/// A new piece in the making.
template <int D>
class gathered_piece {
public:
  gathered_piece(local_id number, local_id material) : number_(number) {
    piece_.subdomain = number;
    piece_.material = material;
  }

  /// Adds the elements of an old piece that go to this one, in their order. `own` are the piece's own points
  /// on the new skeleton. Linear in the old piece.
  void add(const simplicial_piece<D>& old, std::span<const local_id> new_piece_of_element,
           const new_skeleton<D>& skeleton, std::span<const local_id> own) {
    const std::size_t shared = old.skeleton_points.size();
    std::vector<local_id> place(old.mesh.points.size(), no_id); // in this piece, as `vertex_of` has it
    const auto find_place = [&](std::size_t v) {
      if (v < shared) {
        const local_id before = old.skeleton_points[v];
        const local_id now = skeleton.number[before];
        return now != no_id ? -2 - now : add_seam_point(before, old.mesh.points[v]);
      }
      const auto on = std::lower_bound(own.begin(), own.end(), static_cast<local_id>(v));
      if (on != own.end() && *on == static_cast<local_id>(v))
        return -2 - (skeleton.first_of_cut[old.subdomain] + static_cast<local_id>(on - own.begin()));
      return add_point(old.mesh.points[v]);
    };
    for (std::size_t e = 0; e < old.mesh.elements.size(); ++e) {
      if (new_piece_of_element[e] != number_)
        continue;
      simplex<D> element = old.mesh.elements[e];
      for (local_id& v : element) {
        local_id& at = place[v];
        if (at == no_id)
          at = find_place(static_cast<std::size_t>(v));
        v = at;
      }
      piece_.mesh.elements.push_back(element);
      if (D == 2 || !old.mesh.tags.empty())
        piece_.mesh.tags.push_back(old.mesh.tags.empty() ? old.material : old.mesh.tags[e]);
    }
  }

  /// The piece: its points of the skeleton in growing order, then its own in the order in which they came.
  simplicial_piece<D> finish(const simplicial_skeleton<D>& skeleton) {
    auto& elements = piece_.mesh.elements;
    auto& shared = piece_.skeleton_points;
    for (const auto& element : elements)
      for (const local_id v : element)
        if (v < no_id)
          shared.push_back(-2 - v);
    sort_unique(shared);
    const auto count = static_cast<local_id>(shared.size());
    for (auto& element : elements)
      for (local_id& v : element)
        v = v < no_id ? static_cast<local_id>(std::lower_bound(shared.begin(), shared.end(), -2 - v) -
                                              shared.begin())
                      : count + v;
    auto& points = piece_.mesh.points;
    for (const local_id s : shared)
      points.push_back(skeleton.points[s]);
    append(points, own_points_);
    if (piece_.mesh.tags.size() != elements.size())
      piece_.mesh.tags.clear();
    return std::move(piece_);
  }

private:
  local_id add_point(vec3 at) {
    own_points_.push_back(at);
    return static_cast<local_id>(own_points_.size() - 1);
  }
  /// A point of the old skeleton that is inside now: old pieces share it.
  local_id add_seam_point(local_id before, vec3 at) {
    const auto [known, is_new] = of_seams_.try_emplace(before, no_id);
    if (is_new)
      known->second = add_point(at);
    return known->second;
  }

  local_id number_;
  simplicial_piece<D> piece_;
  std::vector<vec3> own_points_;
  std::map<local_id, local_id> of_seams_;
};

} // namespace dovetail
