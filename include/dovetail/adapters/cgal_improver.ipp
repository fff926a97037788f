/// @file
/// What `cgal_improver.hpp` declares.
#pragma once

#include "dovetail/adapters/cgal_improver.hpp"
#include "dovetail/adapters/library_pieces.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/distributed/run_in_child.hpp"

#pragma push_macro("Handle") // Open CASCADE defines it
#undef Handle
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Tetrahedral_remeshing/Remeshing_triangulation_3.h>
#include <CGAL/tetrahedral_remeshing.h>
#include <CGAL/version.h>
#if CGAL_VERSION_NR >= 1050600000 // 5.6 moved it
#include <CGAL/SMDS_3/tet_soup_to_c3t3.h>
#else
#include <CGAL/Mesh_3/tet_soup_to_c3t3.h>
#endif
#pragma pop_macro("Handle")

#include <array>
#include <map>
#include <vector>

namespace dovetail::improvement {

namespace detail {

using cgal_triangulation = CGAL::Tetrahedral_remeshing::Remeshing_triangulation_3<
    CGAL::Exact_predicates_inexact_constructions_kernel>;

/// Whether the result is valid in the sense of CGAL is not asked: with one infinite vertex it is not when the
/// boundary has handles, and yet the remesher works. CGAL's documented function, new in 5.6, asserts a convex
/// mesh.
inline bool build_for_cgal(cgal_triangulation& mesh, const library_piece& piece, int inside) {
  std::vector<cgal_triangulation::Point> points;
  for (const vec3& p : piece.mesh.points)
    points.emplace_back(p.x, p.y, p.z);
  const std::map<std::array<int, 3>, cgal_triangulation::Cell::Surface_patch_index> no_patches;
#if CGAL_VERSION_NR >= 1050600000
  std::vector<std::array<int, 4>> cells;
  for (const auto& [a, b, c, d] : piece.mesh.elements)
    cells.push_back({a, b, c, d});
  return CGAL::SMDS_3::build_triangulation_one_subdomain(mesh, points, cells, inside, no_patches, false,
                                                         false, false);
#else
  std::vector<std::array<int, 5>> cells;
  for (const auto& [a, b, c, d] : piece.mesh.elements)
    cells.push_back({a, b, c, d, inside});
  std::vector<cgal_triangulation::Vertex_handle> vertices;
  constexpr bool unchecked = true;
  return CGAL::build_triangulation<cgal_triangulation, unchecked>(mesh, points, cells, no_patches, vertices);
#endif
}

inline simplicial_mesh<3> remesh_with_cgal(const cgal& parameters, const library_piece& piece,
                                           const any_sizing& size) {
  const int inside = 1;
  cgal_triangulation mesh;
  if (!build_for_cgal(mesh, piece, inside))
    throw mesher_error("CGAL does not take the mesh");

  const double mean = mean_edge_length(piece.mesh);
  // Since 6.0 CGAL also says on what the point is.
  const auto target = [&](const cgal_triangulation::Point& p, const auto&...) {
    return size ? size({p.x(), p.y(), p.z()}) : mean;
  };
  CGAL::tetrahedral_isotropic_remeshing(
      mesh, target,
      CGAL::parameters::number_of_iterations(static_cast<std::size_t>(parameters.iterations))
          .remesh_boundaries(false));

  simplicial_mesh<3> made;
  std::map<cgal_triangulation::Vertex_handle, local_id> number;
  for (const auto v : mesh.finite_vertex_handles()) {
    number.emplace(v, static_cast<local_id>(made.points.size()));
    made.points.push_back({v->point().x(), v->point().y(), v->point().z()});
  }
  for (const auto cell : mesh.finite_cell_handles()) {
    if (cell->subdomain_index() != inside)
      continue;
    simplex<3> element;
    for (int k = 0; k < 4; ++k)
      element[k] = number.at(cell->vertex(k));
    made.elements.push_back(element);
  }
  return made;
}

} // namespace detail

DOVETAIL_INLINE_CGAL report cgal::operator()(simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen,
                                             const any_sizing& size) const {
  return improve_by_library("CGAL", mesh, frozen, [&](const library_piece& piece) {
    return run_in_child("its process", limit_seconds,
                        [&] { return detail::remesh_with_cgal(*this, piece, size); });
  });
}

} // namespace dovetail::improvement
