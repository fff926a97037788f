/// @file
/// Statistics of a distributed mesh, streamed: one piece in memory at a time.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/io/global_numbering.hpp"
#include "dovetail/io/mesh_hash.hpp"
#include "dovetail/mesh/quality.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace dovetail::io {

/// What there is to say about a mesh in numbers.
struct distributed_statistics {
  quality_statistics quality; ///< `worst_element` is a global number
  global_id elements = 0;
  global_id points = 0;
  global_id largest_subdomain = 0; ///< elements of the largest subdomain
  global_id smallest_subdomain = 0;
  double volume = 0;
  std::vector<double> volume_of_material;
  std::vector<double> area_of_face; ///< per CAD face
  std::uint64_t hash = 0;           ///< as `mesh_hash`
};

/// The sum of the element volumes of a mesh.
inline double total_volume(const simplicial_mesh<3>& mesh) {
  double volume = 0;
  for (const auto& element : mesh.elements) {
    const auto p = corners(span_of(mesh.points), element);
    volume += signed_volume(p[0], p[1], p[2], p[3]);
  }
  return volume;
}

/// The area of each CAD face of a skeleton, up to the highest number that occurs.
inline std::vector<double> face_areas(const fine_skeleton& skeleton) {
  std::vector<double> areas;
  for (std::size_t t = 0; t < skeleton.sides.size(); ++t) {
    if (skeleton.side_hosts[t] == no_id)
      continue;
    const auto f = static_cast<std::size_t>(skeleton.side_hosts[t]);
    if (f >= areas.size())
      areas.resize(f + 1, 0.0);
    const auto p = corners(span_of(skeleton.points), skeleton.sides[t]);
    areas[f] += 0.5 * norm(cross(p[1] - p[0], p[2] - p[0]));
  }
  return areas;
}

/// Quality, volumes, areas and hash in one pass over the pieces.
inline distributed_statistics measure_distributed(const distributed_mesh& mesh) {
  const auto numbers = number_globally(mesh);
  distributed_statistics result;
  result.elements = numbers.elements();
  result.points = numbers.points();
  result.area_of_face = face_areas(mesh.skeleton);
  mesh_hasher hasher;
  hash_skeleton(hasher, mesh.skeleton);
  for (std::size_t p = 0; p < mesh.counts.size(); ++p) {
    const auto piece = load_checked(mesh, static_cast<local_id>(p));
    const auto count = mesh.counts[p].elements;
    result.quality.merge(measure_quality(piece.mesh), numbers.first_element[p]);
    result.largest_subdomain = std::max(result.largest_subdomain, count);
    result.smallest_subdomain = p == 0 ? count : std::min(result.smallest_subdomain, count);
    const auto m = static_cast<std::size_t>(mesh.counts[p].material);
    if (m >= result.volume_of_material.size())
      result.volume_of_material.resize(m + 1, 0.0);
    const double volume = total_volume(piece.mesh);
    result.volume_of_material[m] += volume;
    result.volume += volume;
    hash_piece(hasher, piece, numbers);
  }
  result.hash = hasher.value();
  return result;
}

} // namespace dovetail::io
