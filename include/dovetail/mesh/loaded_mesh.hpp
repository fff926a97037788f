/// @file
/// A mesh as it is read from a file, with what else the file says about it.
#pragma once

#include "dovetail/mesh/quadratic_element.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::io {

/// A named array of scalars, one per point.
struct point_array {
  std::string name;           ///< as the file calls it
  std::vector<double> values; ///< by point
};

/// A named array of numbers, `components` for each point or element, one after the other.
struct mesh_field {
  std::string name;           ///< as the file calls it
  std::vector<double> values; ///< by point or element, then component
  int components = 1;         ///< 3 for a vector
};

/// More point arrays than this no reader takes: each is as long as the mesh has points, however little of it
/// is in the file.
inline constexpr std::size_t most_point_arrays = 256;

/// Which elements a reader takes.
enum class element_order {
  first, ///< others are refused
  any    ///< of second order too, whose `middles` it gives
};

/// The simplices of a file, on one set of points.
struct loaded_mesh {
  simplicial_mesh<3> mesh;             ///< tags: the material of each tetrahedron, 0 when the file has none
  std::vector<simplex<2>> triangles;   ///< in the file's orientation; indices into mesh.points
  std::vector<local_id> triangle_tags; ///< per triangle: its CAD face, group or entity
  std::vector<global_id> node_ids;     ///< per point: its global number in the file
  std::vector<local_id> subdomains;    ///< per tetrahedron; empty when the file has no subdomains
  std::vector<local_id> triangle_subdomains{}; ///< whose elements the triangles are; empty as these
  std::vector<point_array> point_scalars;      ///< all one-component point arrays
  std::vector<mesh_field> point_fields{};      ///< point arrays of several components, where asked for
  std::vector<mesh_field> element_fields{};    ///< of tetrahedra, without these of triangles, where asked for
  std::vector<std::pair<local_id, std::string>> material_names; ///< of the tags of the mesh
  std::vector<std::pair<local_id, std::string>> triangle_names; ///< of the tags of the triangles
  std::vector<std::string> passed_over;       ///< what else is in the file, such as "12 lines"; each once
  local_id parts = 0;                         ///< into which an MSH file says that the mesh is divided
  local_id parts_here = 0;                    ///< of these, which have elements in the file
  local_id first_part = no_id;                ///< the lowest of them, from 0
  std::vector<std::filesystem::path> files{}; ///< that it was read from, where each has a part
  /// Per tetrahedron of second order: the points in the middle of its edges, in the order of
  /// `numbering::edges<3>`. Empty where elements are of first order.
  std::vector<std::array<local_id, edges_per_element<3>>> middles{};
  std::vector<std::array<local_id, edges_per_element<2>>> triangle_middles{}; ///< the same of triangles

  /// Whether this is one part of a mesh whose others are in other files.
  bool is_one_part() const { return parts > 1 && parts_here == 1; }

  /// Notes what a reader does not take.
  void pass_over(const std::string& what) {
    if (std::find(passed_over.begin(), passed_over.end(), what) == passed_over.end())
      passed_over.push_back(what);
  }
  /// The values of a point array, or null when the file has none of that name.
  const std::vector<double>* scalars(const std::string& name) const;
};

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/loaded_mesh.ipp"
#endif
