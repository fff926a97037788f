/// @file
/// The regions into which triangles divide space, found from the triangles alone.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace dovetail {

/// What triangles enclose. Every edge has two triangles or more and no two triangles cross: these say so, for
/// two sides of triangles that face each other across an edge are sides of the same region, and what hangs
/// together so is a shell. All tests are exact but the sign of a shell's volume, which is a rounded sum: what
/// is thinner than some 1e-15 of its extent may be taken for the outside.
class enclosed_regions {
public:
  /// O(n log n). Throws `geometry_error` for an edge of a single triangle, and for triangles that lie upon
  /// each other at an edge. `surface` must last as long as this.
  explicit enclosed_regions(const simplicial_mesh<2>& surface);

  /// Regions are numbered from 0 in the order of their first triangle; the outside has no number.
  local_id count() const { return count_; }
  /// Per triangle: the region behind it and the one that its normal points to; `no_id` is the outside.
  const std::vector<std::array<local_id, 2>>& beside() const { return beside_; }
  /// The region that a point is in. About O(sqrt n). A point on a triangle is in one of those beside it.
  local_id at(vec3 p) const { return region_around(p, no_id); }

private:
  struct edge_side; ///< a triangle as it is seen along an edge

  void join_across_edges();
  void measure_shells();
  void number_regions();
  local_id region_around(vec3 p, local_id component) const;
  vec3 point_of_shell(local_id shell) const;
  int passes(std::size_t triangle, vec3 p) const;
  vec3 corner(std::size_t triangle, std::size_t k) const;

  const simplicial_mesh<2>& surface_;
  std::vector<local_id> component_;            ///< per triangle: of those that are connected across edges
  std::vector<std::array<local_id, 2>> shell_; ///< per triangle: behind and in front of it
  std::vector<local_id> first_triangle_;       ///< per shell
  std::vector<double> volume_; ///< per shell: that it encloses; negative for one around others
  std::vector<local_id> region_of_shell_;
  std::vector<local_id> only_component_; ///< per point: whose it is, or `no_id` of several
  std::vector<std::array<local_id, 2>> beside_;
  local_id count_ = 0;
  box_tree tree_; ///< of the triangles
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesher/enclosed_regions.ipp"
#endif
