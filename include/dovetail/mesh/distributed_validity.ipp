/// @file
/// What `distributed_validity.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/chain_sum.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesh/global_numbering.hpp"
#include "dovetail/mesh/skeleton_index.hpp"
#include "dovetail/mesh/validity.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dovetail::io {

DOVETAIL_INLINE std::string_view name_of(seam_fault kind) {
  constexpr std::array<std::string_view, 5> names{
      "moved skeleton point", "repeated skeleton point", "missing skeleton side",
      "boundary side that is not in the skeleton", "wrong material"};
  return names[static_cast<std::size_t>(kind)];
}

DOVETAIL_INLINE void subdomain_faults::add(seam_fault kind, local_id entity) {
  for (auto& fault : seams)
    if (fault.kind == kind) {
      ++fault.count;
      return;
    }
  seams.push_back({kind, 1, entity});
}

DOVETAIL_INLINE std::string subdomain_faults::text() const {
  std::string line = "subdomain " + std::to_string(subdomain) + ": " + inside.text();
  for (const auto& fault : seams)
    line += (line.ends_with(": ") ? "" : "; ") + std::to_string(fault.count) + " x " +
            std::string(name_of(fault.kind)) + " (first: " + std::to_string(fault.first) + ")";
  return line;
}

DOVETAIL_INLINE std::string distributed_validity::text() const {
  std::string lines;
  for (const auto& faults : subdomains)
    lines += faults.text() + "\n";
  return lines;
}

namespace detail {

template <int D>
void check_shared_points(const simplicial_piece<D>& piece, const simplicial_skeleton<D>& skeleton,
                         subdomain_faults& faults) {
  for (std::size_t i = 0; i < piece.skeleton_points.size(); ++i)
    if (piece.mesh.points[i] != skeleton.points[piece.skeleton_points[i]])
      faults.add(seam_fault::moved_point, piece.skeleton_points[i]);
  auto sorted = piece.skeleton_points;
  sort_all(sorted);
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i] == sorted[i - 1])
      faults.add(seam_fault::repeated_point, sorted[i]);
}

/// The boundary sides of the piece against those of the skeleton. Where sheets meet in D = 2, every element
/// has a boundary side of its own.
template <int D>
void check_boundary(const simplicial_piece<D>& piece, const side_table<D>& table,
                    const simplicial_skeleton<D>& skeleton, std::span<const local_id> listed,
                    subdomain_faults& faults) {
  const auto expected = expected_sides<D>(skeleton, listed, piece.subdomain);
  std::vector<oriented_side<D>> found;
  for (std::size_t s = 0; s < table.size(); ++s) {
    const auto id = static_cast<local_id>(s);
    const bool boundary = table.is_boundary(id);
    auto vertices = table.vertices[s];
    const bool on_skeleton = std::all_of(vertices.begin(), vertices.end(), [&](local_id v) {
      return static_cast<std::size_t>(v) < piece.skeleton_points.size();
    });
    if (!on_skeleton) {
      if (boundary)
        faults.add(seam_fault::surplus_side, table.elements[s][0]);
      continue;
    }
    const auto in_skeleton = [&](simplex<D - 1> side) {
      for (auto& v : side)
        v = piece.skeleton_points[v];
      return side;
    };
    if (D == 2 && table.is_non_manifold(id)) {
      for (const local_id e : table.all_elements(id))
        found.push_back(make_oriented<D>(in_skeleton(side_of_element(piece.mesh, table, id, e)), e));
      continue;
    }
    vertices = in_skeleton(vertices);
    const auto side = make_oriented<D>(vertices, table.elements[s][0]);
    if (boundary) {
      found.push_back(side);
      continue;
    }
    std::swap(vertices[D - 2], vertices[D - 1]);
    const auto mirrored = make_oriented<D>(vertices, table.elements[s][1]);
    if (std::binary_search(expected.begin(), expected.end(), side) &&
        std::binary_search(expected.begin(), expected.end(), mirrored)) { // both sides of a sheet
      found.push_back(side);
      found.push_back(mirrored);
    }
  }
  sort_all(found);
  compare_sides<D>(
      expected, found, [&](local_id i) { faults.add(seam_fault::missing_triangle, listed[i]); },
      [&](local_id element) { faults.add(seam_fault::surplus_side, element); });
}

/// Whether the sides of a piece's tetrahedra add up to those that the skeleton lists for it: each side inside
/// is passed as often in one direction as in the other, none of the skeleton is missing, and there is no
/// other. With positive tetrahedra it follows that these fill what the sides enclose once.
DOVETAIL_INLINE bool add_up_to_skeleton(const mesh_piece& piece, const fine_skeleton& skeleton,
                                        std::span<const local_id> listed) {
  chain_sum expected, found;
  for (const local_id s : listed) {
    simplex<2> side = skeleton.sides[s];
    if (skeleton.subdomains[s][0] != piece.subdomain)
      std::swap(side[1], side[2]);
    expected.add(side);
  }
  // Points of the skeleton by their numbers there, others behind them.
  const auto shared = static_cast<local_id>(piece.skeleton_points.size());
  const auto first_own = static_cast<local_id>(skeleton.points.size()) - shared;
  for (simplex<3> element : piece.mesh.elements) {
    for (local_id& v : element)
      v = v < shared ? piece.skeleton_points[v] : v + first_own;
    found.add_sides_of(element);
  }
  return found == expected;
}

/// Whether a piece is without fault, found out without tables. Never of one with a sheet inside, whose sides
/// are listed twice and do not add up.
DOVETAIL_INLINE bool is_surely_valid(const mesh_piece& piece, const fine_skeleton& skeleton,
                                     std::span<const local_id> listed) {
  return dovetail::detail::each_is_valid(piece.mesh, {.closed_boundary = true}) &&
         add_up_to_skeleton(piece, skeleton, listed);
}

} // namespace detail

template <int D>
subdomain_faults check_piece(const simplicial_piece<D>& piece, const simplicial_skeleton<D>& skeleton,
                             std::span<const local_id> listed) {
  subdomain_faults faults;
  faults.subdomain = piece.subdomain;
  detail::check_shared_points(piece, skeleton, faults);
  bool is_valid = false;
  if constexpr (D == 3)
    is_valid = detail::is_surely_valid(piece, skeleton, listed);
  if (!is_valid) {
    const auto table = build_sides(piece.mesh);
    faults.inside =
        check_validity(piece.mesh, table, {.closed_boundary = D == 3, .non_manifold_sides = D == 2});
    detail::check_boundary(piece, table, skeleton, listed, faults);
  }
  for (std::size_t e = 0; D == 3 && e < piece.mesh.tags.size(); ++e)
    if (piece.mesh.tags[e] != piece.material)
      faults.add(seam_fault::wrong_material, static_cast<local_id>(e));
  return faults;
}

template <int D>
distributed_validity check_distributed(const distributed_simplicial_mesh<D>& mesh) {
  const sides_by_subdomain<D> sides(mesh);
  distributed_validity result;
  for (local_id p = 0; p < static_cast<local_id>(mesh.counts.size()); ++p) {
    auto faults = check_piece<D>(load_checked(mesh, p), mesh.skeleton, sides[p]);
    if (!faults.valid())
      result.subdomains.push_back(std::move(faults));
  }
  return result;
}

#ifdef DOVETAIL_COMPILED
template subdomain_faults check_piece<2>(const simplicial_piece<2>& piece,
                                         const simplicial_skeleton<2>& skeleton,
                                         std::span<const local_id> listed);
template distributed_validity check_distributed<2>(const distributed_simplicial_mesh<2>& mesh);
template subdomain_faults check_piece<3>(const simplicial_piece<3>& piece,
                                         const simplicial_skeleton<3>& skeleton,
                                         std::span<const local_id> listed);
template distributed_validity check_distributed<3>(const distributed_simplicial_mesh<3>& mesh);
#endif

} // namespace dovetail::io
