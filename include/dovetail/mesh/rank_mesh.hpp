/// @file
/// What one rank of a parallel solver holds of a distributed mesh: plain data, in the order that solvers
/// want it.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/quadratic_element.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail {

/// What a rank shares with another one, by local ids. The other rank lists the same entities in the same
/// order, under its own ids: what one packs along a list, the other unpacks along its own.
struct rank_neighbour {
  local_id rank = no_id;          ///< the number of the other rank
  std::vector<local_id> vertices; ///< those that both hold
  std::vector<simplex<1>> edges;  ///< each from the same end on both sides
  /// Sides between two elements, one of each rank; D = 3. Outwards of this rank's element, so turned against
  /// that of the other rank; both start with the same vertex.
  std::vector<simplex<2>> faces;
};

/// Vertices come in three ranges: those the rank owns, those it holds but another rank owns, and those of
/// ghosts alone. Elements come in two: those the rank owns, and ghosts, which are the elements of other ranks
/// that touch a vertex it holds.
///
/// A vertex is owned by the lowest rank that has an element at it. Ids are contiguous per owner: vertex v of
/// the owned ones has id vertex_ids[0] + v, element e has id element_ids[0] + e, and the ids of the next rank
/// follow. The mesh's own numbers, which do not know of ranks (distributed_mesh.hpp), stand beside them.
///
/// The nodes in the middle of the edges of second-order elements are vertices like the corners, in the same
/// ranges, each owned by the lowest rank that has an element at its edge. Of the owned vertices the corners
/// come first. Numbers are those of nodes (mid_nodes.hpp).
template <int D>
struct rank_mesh {
  local_id rank = 0;              ///< the number of this rank
  local_id ranks = 1;             ///< how many there are
  std::size_t owned_vertices = 0; ///< of all its vertices, those that it owns come first
  std::size_t owned_corners = 0;  ///< the owned vertices before those in the middle of edges
  std::size_t held_vertices = 0;  ///< the owned ones with them; the others are of ghosts alone
  std::size_t owned_elements = 0; ///< of all its elements, those that it owns come first

  simplicial_mesh<D> mesh;                ///< tags: materials (D = 3), CAD faces (D = 2)
  std::vector<global_id> vertex_ids;      ///< per vertex
  std::vector<local_id> vertex_owners;    ///< per vertex: a rank
  std::vector<global_id> vertex_numbers;  ///< per vertex: its number in the distributed mesh
  std::vector<global_id> element_ids;     ///< per element
  std::vector<local_id> element_owners;   ///< per element: a rank
  std::vector<global_id> element_numbers; ///< per element: its number in the distributed mesh
  std::vector<local_id> subdomains;       ///< per element: its piece
  /// Of second-order elements, per element: the vertices in the middle of its edges, in the order of
  /// `numbering::edges`. Empty otherwise.
  std::vector<std::array<local_id, edges_per_element<D>>> middles;

  /// Sides of owned elements on CAD faces (D = 3) or curves (D = 2), each once, outwards of the first of its
  /// elements. One between two ranks is in the mesh of each.
  std::vector<simplex<D - 1>> sides;
  std::vector<local_id> side_hosts; ///< per side: its CAD face (D = 3) or curve (D = 2)
  /// Per side: the element that it faces outwards of, and the one in front of it, or no_id where the rank's
  /// elements end. Of an edge with more than two triangles (D = 2), the first two.
  std::vector<std::array<local_id, 2>> side_elements;
  std::vector<std::array<local_id, edges_per_element<D - 1>>> side_middles; ///< per side, as `middles`

  std::vector<rank_neighbour> neighbours; ///< by growing rank: those with which it shares a vertex
};

/// The vertices per element, those in the middle of its edges among them.
template <int D>
std::size_t nodes_per_element(const rank_mesh<D>& mesh) {
  return mesh.middles.empty() ? D + 1 : quadratic_nodes<D>;
}

/// Calls `take(v)` for the vertices of an element: its corners, then the middles of its edges. VTK's order.
template <int D, class Take>
void for_each_node(const rank_mesh<D>& mesh, std::size_t element, const Take& take) {
  for (const local_id v : mesh.mesh.elements[element])
    take(v);
  if (!mesh.middles.empty())
    for (const local_id v : mesh.middles[element])
      take(v);
}

/// The elements that the rank owns as ids of vertices: (owned elements) x `nodes_per_element`, row by row.
/// The `cells` of `dolfinx::mesh::create_mesh`, which takes a simplex's vertices in any order; those of
/// second order are in VTK's order, which is not DOLFINx's. O(elements).
template <int D>
std::vector<global_id> cells_by_ids(const rank_mesh<D>& mesh) {
  std::vector<global_id> ids;
  ids.reserve(nodes_per_element(mesh) * mesh.owned_elements);
  for (std::size_t e = 0; e < mesh.owned_elements; ++e)
    for_each_node(mesh, e, [&](local_id v) { ids.push_back(mesh.vertex_ids[v]); });
  return ids;
}

/// The same, and as large, in the order of PETSc's `DMPlexCreateFromCellListParallel`: the first three
/// vertices of its tetrahedra turn the other way, so the first two of each are exchanged (D = 3).
/// O(elements). Throws `usage_error` for elements of second order, which it does not take.
template <int D>
std::vector<global_id> cells_for_dmplex(const rank_mesh<D>& mesh) {
  if (!mesh.middles.empty())
    throw usage_error(
        "DMPlex takes elements of first order: make the ranks' meshes without middles of edges");
  auto cells = cells_by_ids(mesh);
  if constexpr (D == 3)
    for (std::size_t first = 0; first < cells.size(); first += 4)
      std::swap(cells[first], cells[first + 1]);
  return cells;
}

/// The sides on CAD faces or curves as ids of their corners: (sides) x D, row by row, for `side_hosts`. What
/// `dolfinx::io::distribute_entity_data` makes tags of. O(sides).
template <int D>
std::vector<global_id> sides_by_ids(const rank_mesh<D>& mesh) {
  std::vector<global_id> ids;
  ids.reserve(D * mesh.sides.size());
  for (const auto& side : mesh.sides)
    for (const local_id v : side)
      ids.push_back(mesh.vertex_ids[v]);
  return ids;
}

/// The coordinates that belong to these: (owned vertices) x 3, row by row, in the order of ids. The `x` of
/// `create_mesh`, the `vertexCoords` of `DMPlexCreateFromCellListParallel`, which both take a vertex from the
/// rank that owns it. O(vertices).
template <int D>
std::vector<double> owned_coordinates(const rank_mesh<D>& mesh) {
  std::vector<double> coordinates;
  coordinates.reserve(3 * mesh.owned_vertices);
  for (std::size_t v = 0; v < mesh.owned_vertices; ++v)
    for (int axis = 0; axis < 3; ++axis)
      coordinates.push_back(mesh.mesh.points[v][axis]);
  return coordinates;
}

} // namespace dovetail
