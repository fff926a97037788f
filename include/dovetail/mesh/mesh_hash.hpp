/// @file
/// One number for a whole mesh, to tell whether two runs gave the same.
///
/// The hash covers the points by global number and the elements by the global numbers of their points. It
/// does not depend on the pieces, on the order of pieces, elements or an element's vertices (but on its
/// orientation): it is a sum over points and elements, modulo 2^64.
#pragma once

#include "dovetail/core/hash.hpp"
#include "dovetail/mesh/global_numbering.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dovetail::io {

/// Adds up the hashes of points and elements.
class mesh_hasher {
public:
  /// Adds a point under its global number.
  void point(global_id id, vec3 at);
  /// An element, triangle or tetrahedron, given by the global numbers of its points.
  template <std::size_t N>
  void element(std::array<global_id, N> vertices) {
    std::uint64_t mirrored = 0;
    const auto order = [&](std::size_t i, std::size_t j) { // without branches: they could not be foretold
      mirrored ^= vertices[j] < vertices[i] ? 1U : 0U;
      const global_id low = std::min(vertices[i], vertices[j]);
      vertices[j] = std::max(vertices[i], vertices[j]);
      vertices[i] = low;
    };
    if constexpr (N == 4)
      order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
    else
      order(0, 1), order(1, 2), order(0, 1);
    content_hash hash;
    hash.word(1 + mirrored);
    for (const auto v : vertices)
      hash.word(static_cast<std::uint64_t>(v));
    sum_ += hash.value();
  }
  /// Adds what another hasher has seen.
  void merge(const mesh_hasher& other) { sum_ += other.sum_; }

  /// The hash of all that was added.
  std::uint64_t value() const {
    content_hash hash;
    hash.word(sum_);
    return hash.value();
  }

private:
  std::uint64_t sum_ = 0;
};

/// Adds the inner points and the elements of a piece. O(piece).
template <int D>
void hash_piece(mesh_hasher& hasher, const simplicial_piece<D>& piece, const global_numbering& numbers) {
  const auto shared = static_cast<local_id>(piece.skeleton_points.size());
  for (local_id i = shared; i < static_cast<local_id>(piece.mesh.points.size()); ++i)
    hasher.point(global_point(piece, numbers, i), piece.mesh.points[i]);
  for (const auto& element : piece.mesh.elements) {
    std::array<global_id, D + 1> vertices;
    for (std::size_t k = 0; k < vertices.size(); ++k)
      vertices[k] = global_point(piece, numbers, element[k]);
    hasher.element(vertices);
  }
}

/// Adds the elements of a piece, each known by the places of its points and by its tag alone: neither numbers
/// nor the division into pieces matter. O(piece).
template <int D>
void hash_elements_by_place(mesh_hasher& hasher, const simplicial_piece<D>& piece) {
  std::vector<global_id> places;
  places.reserve(piece.mesh.points.size());
  for (const vec3& p : piece.mesh.points) {
    content_hash hash;
    for (int axis = 0; axis < 3; ++axis)
      hash.number(p[axis]);
    places.push_back(static_cast<global_id>(hash.value()));
  }
  for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e) {
    const local_id tag = piece.mesh.tags.empty() ? piece.material : piece.mesh.tags[e];
    std::array<global_id, D + 1> vertices;
    for (std::size_t k = 0; k < vertices.size(); ++k)
      vertices[k] = places[piece.mesh.elements[e][k]] ^ tag;
    hasher.element(vertices);
  }
}

/// Adds the points of the skeleton. O(skeleton).
template <int D>
void hash_skeleton(mesh_hasher& hasher, const simplicial_skeleton<D>& skeleton) {
  global_id id = 0;
  for (const auto& p : skeleton.points)
    hasher.point(id++, p);
}

/// The hash of a distributed mesh; one piece in memory at a time.
/// Linear. Throws `mesh_error` when a piece and the skeleton disagree.
/// \param mesh a distributed mesh, or triangles or tetrahedra in memory
template <int D>
std::uint64_t mesh_hash(const distributed_simplicial_mesh<D>& mesh) {
  const auto numbers = number_globally(mesh);
  mesh_hasher hasher;
  hash_skeleton(hasher, mesh.skeleton);
  for (std::size_t p = 0; p < mesh.counts.size(); ++p)
    hash_piece(hasher, load_checked(mesh, static_cast<local_id>(p)), numbers);
  return hasher.value();
}

/// The hash of a mesh held in memory, its points numbered as they are stored.
template <int D>
std::uint64_t mesh_hash(const simplicial_mesh<D>& mesh) {
  mesh_hasher hasher;
  global_id id = 0;
  for (const auto& p : mesh.points)
    hasher.point(id++, p);
  for (const auto& e : mesh.elements) {
    std::array<global_id, D + 1> vertices;
    std::copy(e.begin(), e.end(), vertices.begin());
    hasher.element(vertices);
  }
  return hasher.value();
}

/// The hash of a mesh read from a file, by the global numbers of the file: that of the mesh it was written
/// from. Triangles count where there are no tetrahedra.
/// \param loaded what `read_mesh` gives
std::uint64_t mesh_hash(const loaded_mesh& loaded);

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/mesh_hash.ipp"
#endif
