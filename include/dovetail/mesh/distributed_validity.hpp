/// @file
/// Is a distributed mesh a mesh? Each piece is checked by itself and against the skeleton: together this says
/// that the whole conforms, without ever holding the whole.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/global_numbering.hpp"
#include "dovetail/mesh/skeleton_index.hpp"
#include "dovetail/mesh/validity.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dovetail::io {

/// What can be wrong between a piece and the skeleton; the comment says what the example ids are.
enum class seam_fault {
  moved_point,      ///< skeleton point whose coordinates differ in the piece
  repeated_point,   ///< skeleton point that the piece has twice
  missing_triangle, ///< skeleton side of the subdomain that its piece has not, seen from outside
  surplus_side,     ///< element of the piece with a boundary side that is not in the skeleton
  wrong_material    ///< element with a tag other than the subdomain's material
};

/// What a message calls a fault.
std::string_view name_of(seam_fault kind);

/// The faults of one subdomain.
struct subdomain_faults {
  /// A kind of fault and how often it occurs.
  struct seam {
    seam_fault kind;        ///< which kind
    std::int64_t count = 0; ///< how often
    local_id first = no_id; ///< the first example
  };
  local_id subdomain = no_id; ///< the number of the subdomain
  validity inside;            ///< faults of the piece as a mesh by itself
  std::vector<seam> seams;    ///< faults between piece and skeleton, by kind

  /// Notes a fault; of each kind the first entity is kept.
  void add(seam_fault kind, local_id entity);
  bool valid() const { return inside.valid() && seams.empty(); } ///< whether it has no faults
  /// The faults in one line.
  std::string text() const;
};

/// The subdomains that have faults; none for a valid mesh.
struct distributed_validity {
  std::vector<subdomain_faults> subdomains; ///< those that have faults, by number

  bool valid() const { return subdomains.empty(); } ///< whether no subdomain has faults
  /// One line per faulty subdomain.
  std::string text() const;
};

namespace detail {

/// A side with its vertices as skeleton points, in one order per orientation.
template <int D>
struct oriented_side {
  simplex<D - 1> vertices;
  local_id origin; ///< its place in a list of skeleton sides, or an element

  friend bool operator<(const oriented_side& a, const oriented_side& b) { return a.vertices < b.vertices; }
};

template <int D>
oriented_side<D> make_oriented(simplex<D - 1> vertices, local_id origin) {
  if constexpr (D == 3) // the order of two vertices is their orientation
    std::rotate(vertices.begin(), std::min_element(vertices.begin(), vertices.end()), vertices.end());
  return {vertices, origin};
}

/// The sides that the skeleton says a subdomain has, outwards. A sheet inside the subdomain is there twice.
template <int D>
std::vector<oriented_side<D>> expected_sides(const simplicial_skeleton<D>& skeleton,
                                             std::span<const local_id> listed, local_id subdomain) {
  std::vector<oriented_side<D>> sides;
  for (std::size_t i = 0; i < listed.size(); ++i) {
    const auto t = static_cast<std::size_t>(listed[i]);
    auto vertices = skeleton.sides[t];
    const bool second_side_of_sheet = i > 0 && listed[i - 1] == listed[i];
    if (skeleton.subdomains[t][0] != subdomain || second_side_of_sheet)
      std::swap(vertices[D - 2], vertices[D - 1]);
    sides.push_back(make_oriented<D>(vertices, static_cast<local_id>(i)));
  }
  sort_all(sides);
  return sides;
}

/// Both lists ascending; calls `only_first` and `only_second` for sides that the other list lacks.
template <int D, class F, class G>
void compare_sides(const std::vector<oriented_side<D>>& first, const std::vector<oriented_side<D>>& second,
                   F only_first, G only_second) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < first.size() || j < second.size()) {
    if (j == second.size() || (i < first.size() && first[i] < second[j]))
      only_first(first[i++].origin);
    else if (i == first.size() || second[j] < first[i])
      only_second(second[j++].origin);
    else
      ++i, ++j;
  }
}

} // namespace detail

/// Checks one piece by itself and against the skeleton.
/// About linear. Throws `mesh_error` when the piece cannot be indexed.
/// \param piece of a distributed mesh
/// \param skeleton of the same mesh
/// \param listed numbers of the skeleton's sides on the piece's boundary, as in `sort_by_subdomain`
template <int D>
subdomain_faults check_piece(const simplicial_piece<D>& piece, const simplicial_skeleton<D>& skeleton,
                             std::span<const local_id> listed);

/// Checks all pieces, one in memory at a time. Inside a piece: references, exact orientation, conformity,
/// duplicates. Against the skeleton: same coordinates, and every skeleton side is a side of exactly the
/// one or two subdomains that it names, facing outwards of each. Throws `mesh_error` when pieces cannot even
/// be indexed. About linear.
/// \param mesh what `generate` makes, or a reader
template <int D>
distributed_validity check_distributed(const distributed_simplicial_mesh<D>& mesh);

#ifdef DOVETAIL_COMPILED
extern template subdomain_faults check_piece<2>(const simplicial_piece<2>& piece,
                                                const simplicial_skeleton<2>& skeleton,
                                                std::span<const local_id> listed);
extern template distributed_validity check_distributed<2>(const distributed_simplicial_mesh<2>& mesh);
extern template subdomain_faults check_piece<3>(const simplicial_piece<3>& piece,
                                                const simplicial_skeleton<3>& skeleton,
                                                std::span<const local_id> listed);
extern template distributed_validity check_distributed<3>(const distributed_simplicial_mesh<3>& mesh);
#endif

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/distributed_validity.ipp"
#endif
