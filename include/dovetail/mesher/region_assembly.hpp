/// @file
/// From the meshes of a piece's regions to the mesh of the piece: shared by all meshers of D = 2.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/remesh/chords.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

namespace dovetail {

namespace detail {

/// Appends a region's own points and its triangles.
inline void append_region(const surface_region& region, const patch_mesh& made, mesher_result<2>& result) {
  simplicial_mesh<2>& mesh = result.mesh;
  const auto& labels = region.boundary.labels;
  const auto frozen = static_cast<local_id>(labels.size());
  const auto first_inner = static_cast<local_id>(mesh.points.size());
  append(mesh.points, made.inner_points);
  mesh.elements.reserve(mesh.elements.size() + made.triangles.size());
  result.corner_uv.reserve(mesh.elements.size() + made.triangles.size());
  for (simplex<2> triangle : made.triangles) {
    if (region.reversed)
      std::swap(triangle[1], triangle[2]);
    auto& uv = result.corner_uv.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      uv[k] = triangle[k] < frozen ? region.boundary.uv[static_cast<std::size_t>(triangle[k])]
                                   : made.inner_uv[static_cast<std::size_t>(triangle[k] - frozen)];
    for (local_id& v : triangle)
      v = v < frozen ? labels[static_cast<std::size_t>(v)] : first_inner + v - frozen;
    mesh.elements.push_back(triangle);
    mesh.tags.push_back(region.face);
  }
}

/// Adds to a region's forbidden edges those inner edges between boundary points that it must not have; false
/// when it has none.
inline bool forbid_chords(const surface_region& region, const patch_mesh& made, patch_boundary& boundary) {
  if (!region.forbids)
    return false;
  auto& forbidden = boundary.forbidden_edges;
  const std::size_t before = forbidden.size();
  chord_finder(boundary).for_each(made.triangles, [&](std::size_t, const std::array<local_id, 2>& chord) {
    if (region.forbids(chord[0], chord[1]) &&
        std::find(forbidden.begin(), forbidden.end(), chord) == forbidden.end())
      forbidden.push_back(chord);
  });
  return forbidden.size() > before;
}

/// Splits the inner edges that join forbidden labels in the middle, until there are none.
class forbidden_chord_splitter {
public:
  forbidden_chord_splitter(const any_surface& surface, const patch_boundary& boundary, patch_mesh& made)
      : surface_(surface), boundary_(boundary), made_(made), chord_of_(boundary),
        frozen_(static_cast<local_id>(boundary.labels.size())) {}

  void run() {
    for (std::size_t t = 0; t < made_.triangles.size(); ++t) // their number grows
      for (std::size_t k = 0; k < 3;)
        k = is_forbidden(made_.triangles[t][k], made_.triangles[t][(k + 1) % 3]) ? split(t, k) : k + 1;
  }

private:
  bool is_forbidden(local_id a, local_id b) const {
    const auto chord = chord_of_(a, b);
    const auto& forbidden = boundary_.forbidden_edges;
    return chord && std::find(forbidden.begin(), forbidden.end(), *chord) != forbidden.end();
  }

  /// Splits side k of triangle t; returns the side to go on with.
  std::size_t split(std::size_t t, std::size_t k) {
    const simplex<2> whole = made_.triangles[t];
    const local_id a = whole[k], b = whole[(k + 1) % 3], c = whole[(k + 2) % 3];
    const local_id m = middle(a, b);
    made_.triangles[t] = {a, m, c};
    made_.triangles.push_back({m, b, c});
    return 0;
  }

  /// The same for both triangles of an edge.
  local_id middle(local_id a, local_id b) {
    const auto next = frozen_ + static_cast<local_id>(made_.inner_uv.size());
    const auto [at, is_new] = middles_.try_emplace(sorted_vertices(std::array{a, b}), next);
    if (is_new) {
      made_.inner_uv.push_back(
          0.5 * (boundary_.uv[static_cast<std::size_t>(a)] + boundary_.uv[static_cast<std::size_t>(b)]));
      made_.inner_points.push_back(surface_.frame(made_.inner_uv.back()).point);
    }
    return at->second;
  }

  const any_surface& surface_;
  const patch_boundary& boundary_;
  patch_mesh& made_;
  chord_finder chord_of_;
  local_id frozen_;
  std::map<std::array<local_id, 2>, local_id> middles_;
};

/// Meshes a region, again when it has edges that it must not have: a mesher may know how to avoid them. What
/// is left of them is split.
template <class MeshRegion>
patch_mesh mesh_without_forbidden_chords(const surface_region& region, const MeshRegion& mesh_region) {
  patch_mesh made = mesh_region(region.surface, region.boundary);
  patch_boundary boundary = region.boundary;
  for (int round = 0; round < 6 && forbid_chords(region, made, boundary); ++round)
    made = mesh_region(region.surface, boundary);
  if (!boundary.forbidden_edges.empty())
    forbidden_chord_splitter(region.surface, boundary, made).run();
  return made;
}

/// Meshes a region, again with smaller sizes inside as long as triangles turn away from its surface; of these
/// attempts the one with the fewest such triangles.
template <class MeshRegion>
patch_mesh mesh_without_folds(const surface_region& region, const any_sizing& size,
                              const MeshRegion& mesh_region) {
  const auto with_size = [&](const any_sizing& inner) {
    return mesh_without_forbidden_chords(region,
                                         [&](const any_surface& surface, const patch_boundary& boundary) {
                                           return mesh_region(surface, boundary, inner);
                                         });
  };
  patch_mesh best = with_size(size);
  double factor = 1;
  for (int round = 0; round < 6 && !best.folded.empty(); ++round) {
    factor *= 0.8;
    patch_mesh made = with_size([&size, factor](vec3 p) { return factor * size(p); });
    if (made.folded.size() < best.folded.size())
      best = std::move(made);
  }
  return best;
}

} // namespace detail

namespace mesher {

/// Meshes the regions of a piece one by one, `mesh_region(surface, boundary, size)` giving a `patch_mesh`,
/// and joins them along their lines. Throws `mesher_error` naming the face when the lines of a region cross
/// in its parameter plane or its triangles cannot be kept from folding over.
template <class MeshRegion>
mesher_result<2> assemble_regions(const mesher_input<2>& input, const any_sizing& size,
                                  const MeshRegion& mesh_region) {
  mesher_result<2> result;
  result.mesh.points = input.boundary.points;
  for (const surface_region& region : input.regions) {
    const patch_mesh made = dovetail::detail::mesh_without_folds(region, size, mesh_region);
    if (!made.crossings.empty() || !made.misplaced.empty())
      throw mesher_error("a region of face " + std::to_string(region.face) +
                         ": its boundary lines cross in the parameter plane");
    if (!made.folded.empty())
      throw mesher_error("a region of face " + std::to_string(region.face) + ": " +
                         std::to_string(made.folded.size()) +
                         " triangles stay folded over; repair the face or give a smaller size there");
    dovetail::detail::append_region(region, made, result);
  }
  result.summary.set("regions", static_cast<double>(input.regions.size()));
  return result;
}

} // namespace mesher
} // namespace dovetail
