/// @file
/// What `coarse_volume.hpp` declares.
#pragma once

#include "dovetail/background/coarse_volume.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/geometry/error_of_faces.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/mesher/element_labels.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::background {

namespace detail {

/// The surface's triangles as the solids see them: each outwards of a solid, a shared face once for each.
struct oriented_boundary {
  std::vector<simplex<2>> triangles;
  std::vector<local_id> solids; ///< per triangle
  std::vector<local_id> faces;  ///< per triangle
};

inline oriented_boundary orient_boundary(const surface_mesh& surface, const geometry_topology& topology) {
  oriented_boundary boundary;
  const auto add = [&](const simplex<2>& triangle, local_id solid, local_id face) {
    boundary.triangles.push_back(triangle);
    boundary.solids.push_back(solid);
    boundary.faces.push_back(face);
  };
  for (std::size_t t = 0; t < surface.mesh.elements.size(); ++t) {
    const auto& [a, b, c] = surface.mesh.elements[t];
    const local_id f = surface.mesh.tags[t];
    const auto& face = topology.faces[f];
    if (face.solids[0] == no_id && face.solids[1] == no_id)
      throw geometry_error(entity_name("face", f, face.name) + " bounds no solid; remove it from the model");
    if (face.solids[0] != no_id)
      add({a, b, c}, face.solids[0], f);
    if (face.solids[1] != no_id)
      add({a, c, b}, face.solids[1], f);
  }
  return boundary;
}

/// Every edge of a solid's triangles is passed as often one way as the other; else a `geometry_error` names
/// the face at the gap.
inline void require_closed(const oriented_boundary& boundary, const geometry_topology& topology) {
  struct passage {
    local_id solid;
    std::array<local_id, 2> edge;
    int direction;
    local_id face;
  };
  std::vector<passage> passages;
  for (std::size_t t = 0; t < boundary.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const local_id a = boundary.triangles[t][k];
      const local_id b = boundary.triangles[t][(k + 1) % 3];
      passages.push_back(
          {boundary.solids[t], sorted_vertices(std::array{a, b}), a < b ? 1 : -1, boundary.faces[t]});
    }
  sort_all(passages, [](const passage& p, const passage& q) {
    return std::pair(p.solid, p.edge) < std::pair(q.solid, q.edge);
  });
  for (std::size_t first = 0; first < passages.size();) {
    int balance = 0;
    std::size_t last = first;
    for (; last < passages.size() && passages[last].solid == passages[first].solid &&
           passages[last].edge == passages[first].edge;
         ++last)
      balance += passages[last].direction;
    if (balance != 0) {
      const auto& [solid, edge, direction, face] = passages[first];
      throw geometry_error("the surface of " + entity_name("solid", solid, topology.solids[solid].name) +
                           " is open at an edge of " + entity_name("face", face, topology.faces[face].name));
    }
    first = last;
  }
}

/// The triangles of one solid, or of all for no_id, on points numbered afresh in the surface's order.
inline subdomain_input piece_of_boundary(const surface_mesh& surface, const oriented_boundary& boundary,
                                         local_id solid) {
  subdomain_input piece;
  std::vector<local_id> number(surface.mesh.points.size(), no_id);
  const auto belongs = [&](std::size_t t) { return solid == no_id || boundary.solids[t] == solid; };
  for (std::size_t t = 0; t < boundary.triangles.size(); ++t)
    if (belongs(t))
      for (const local_id v : boundary.triangles[t])
        number[v] = 0;
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] != no_id) {
      number[v] = static_cast<local_id>(piece.skeleton_points.size());
      piece.skeleton_points.push_back(static_cast<local_id>(v));
      piece.boundary.boundary.points.push_back(surface.mesh.points[v]);
    }
  for (std::size_t t = 0; t < boundary.triangles.size(); ++t)
    if (belongs(t)) {
      simplex<2> triangle = boundary.triangles[t];
      for (local_id& v : triangle)
        v = number[v];
      piece.boundary.boundary.elements.push_back(triangle);
    }
  piece.boundary.material = solid == no_id ? 0 : solid;
  return piece;
}

[[noreturn]] inline void throw_failed(const std::vector<piece_failure>& failures,
                                      const geometry_topology& topology) {
  const piece_failure& first = failures.front();
  std::string text = entity_name("solid", first.subdomain, topology.solids[first.subdomain].name) +
                     " could not be filled with a coarse mesh: " + joined_reasons(first.reasons);
  if (first.crossing_facets > 0)
    text += "; " + std::to_string(first.crossing_facets) + " of its surface triangles cross others";
  if (!first.facets.empty())
    text += "; its facets are in " + first.facets.string();
  throw mesher_error(text);
}

/// The boundary of a model's solids. Throws `geometry_error` when there is none or it is open.
inline oriented_boundary closed_boundary(const surface_mesh& surface, const geometry_topology& topology) {
  if (topology.solids.empty())
    throw geometry_error("the model has no solid to mesh");
  oriented_boundary boundary = orient_boundary(surface, topology);
  require_closed(boundary, topology);
  return boundary;
}

DOVETAIL_INLINE coarse_volume_result fill_solids(const surface_mesh& surface,
                                                 const geometry_topology& topology,
                                                 const pieces_mesher& mesh_them,
                                                 const coarse_volume_options& options) {
  const stopwatch clock;
  const auto boundary = closed_boundary(surface, topology);

  meshing_options attempt;
  attempt.on_progress = options.on_progress;
  meshing_result made;
  bool one_by_one = topology.solids.size() == 1;
  if (!one_by_one) {
    const subdomain_source together = [&](local_id) { return piece_of_boundary(surface, boundary, no_id); };
    made = mesh_them(1, together, attempt);
    one_by_one = !made.failures.empty();
  }
  if (one_by_one) {
    const subdomain_source separately = [&](local_id solid) {
      return piece_of_boundary(surface, boundary, solid);
    };
    attempt.on_failure = options.on_failure;
    made = mesh_them(topology.solids.size(), separately, attempt);
    if (!made.failures.empty())
      throw_failed(made.failures, topology);
  }

  coarse_volume_result result;
  result.mesh.points = surface.mesh.points;
  for (std::size_t p = 0; p < made.pieces.size(); ++p)
    append_piece(result.mesh, made.load(static_cast<local_id>(p)));
  result.mesh.tags = label_elements(result.mesh, span_of(boundary.triangles), span_of(boundary.solids));
  result.quality = made.quality;
  result.summary.name = "coarse volume";
  result.summary.seconds = clock.seconds();
  result.summary.set(coarse_volume_counts{.elements = result.mesh.elements.size(),
                                          .points = result.mesh.points.size(),
                                          .min_dihedral_deg = result.quality.min_dihedral_deg,
                                          .one_by_one = one_by_one && topology.solids.size() > 1});
  result.summary.warnings = made.summary.warnings;
  result.summary.children.push_back(std::move(made.summary));
  return result;
}

} // namespace detail

DOVETAIL_INLINE std::vector<std::array<local_id, 2>>
solids_beside_surface(const surface_mesh& surface, const geometry_topology& topology) {
  detail::closed_boundary(surface, topology);
  std::vector<std::array<local_id, 2>> solids;
  solids.reserve(surface.mesh.elements.size());
  for (const local_id face : surface.mesh.tags)
    solids.push_back(topology.faces[face].solids);
  return solids;
}

} // namespace dovetail::background
