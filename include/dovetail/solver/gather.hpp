/// @file
/// A distributed mesh as one mesh in memory: what a solver on one machine assembles on.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/files/face_groups.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/global_numbering.hpp"
#include "dovetail/solver/make_rank_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::io {

/// A whole mesh, with the sides that lie on CAD entities. Its elements and points are in the order of the
/// global numbers of distributed_mesh.hpp; every point belongs to an element.
template <int D>
struct gathered_mesh {
  simplicial_mesh<D> mesh;          ///< tags: materials (D = 3), CAD faces (D = 2)
  std::vector<local_id> subdomains; ///< per element

  std::vector<simplex<D - 1>> sides; ///< on CAD faces (D = 3) or curves (D = 2), each once
  std::vector<local_id> side_hosts;  ///< per side: its CAD face (D = 3) or curve (D = 2)
  /// Per side: the element that it faces outwards of, and the one in front of it, or no_id where the domain
  /// ends. Of an edge with more than two triangles (D = 2), the first two.
  std::vector<std::array<local_id, 2>> side_elements;

  std::vector<simplex<1>> curve_edges; ///< on CAD curves, in D = 3; in D = 2 they are sides
  std::vector<local_id> curves;        ///< the CAD curve of each such edge

  std::vector<std::string> material_names; ///< per material, none empty; D = 3
  std::vector<std::string> group_names;    ///< of the groups of faces, distinct
  std::vector<local_id> group_of_face;     ///< per CAD face: its group
};

/// Gathers a distributed mesh: the mesh of the one rank that there is. Loads every piece once; linear, but
/// for a search per side of an element at the skeleton. Memory: the result, and 20 bytes per point and
/// element. Throws `mesh_error` when pieces and skeleton disagree, or when the mesh has more elements or
/// points than local ids can number.
/// \param mesh what `generate` makes, or a reader
template <int D>
gathered_mesh<D> gather(const distributed_simplicial_mesh<D>& mesh) {
  const global_numbering numbers = number_globally(mesh);
  if (std::max(numbers.points(), numbers.elements()) > std::numeric_limits<local_id>::max())
    throw mesh_error("a mesh of " + std::to_string(numbers.elements()) +
                     " elements is too large to be gathered; read its pieces one at a time");
  const rank_numbering one_rank = number_by_ranks(mesh, std::vector<local_id>(mesh.counts.size(), 0), 1);
  auto whole = make_rank_mesh<D>(mesh, one_rank, 0);
  gathered_mesh<D> result{std::move(whole.mesh),
                          std::move(whole.subdomains),
                          std::move(whole.sides),
                          std::move(whole.side_hosts),
                          std::move(whole.side_elements),
                          {},
                          mesh.skeleton.curves,
                          {},
                          {},
                          {}};
  const auto vertex = [&](local_id point) {
    const global_id id = one_rank.point_ids[point];
    if (id < 0)
      throw mesh_error("an edge of the skeleton that lies on the CAD model belongs to no element");
    return static_cast<local_id>(id);
  };
  for (const auto& [a, b] : mesh.skeleton.curve_edges)
    result.curve_edges.push_back({vertex(a), vertex(b)});
  std::size_t faces = 0;
  if constexpr (D == 3)
    result.material_names = collect_material_names(mesh);
  else
    for (const local_id face : result.mesh.tags)
      faces = std::max(faces, static_cast<std::size_t>(face) + 1);
  auto groups = collect_face_groups(mesh, faces);
  result.group_names = std::move(groups.names);
  result.group_of_face = std::move(groups.of_face);
  return result;
}

} // namespace dovetail::io
