/// @file
/// Is a distributed mesh a mesh? Each piece is checked by itself and against the skeleton: together this says
/// that the whole conforms, without ever holding the whole.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/global_numbering.hpp"
#include "dovetail/mesh/skeleton_index.hpp"
#include "dovetail/mesh/validity.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <tuple>
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
inline std::string_view name_of(seam_fault kind) {
  constexpr std::array<std::string_view, 5> names{
      "moved skeleton point", "repeated skeleton point", "missing skeleton side",
      "boundary side that is not in the skeleton", "wrong material"};
  return names[static_cast<std::size_t>(kind)];
}

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
  void add(seam_fault kind, local_id entity) {
    for (auto& fault : seams)
      if (fault.kind == kind) {
        ++fault.count;
        return;
      }
    seams.push_back({kind, 1, entity});
  }
  bool valid() const { return inside.valid() && seams.empty(); } ///< whether it has no faults
  /// The faults in one line.
  std::string text() const {
    std::string line = "subdomain " + std::to_string(subdomain) + ": " + inside.text();
    for (const auto& fault : seams)
      line += (line.ends_with(": ") ? "" : "; ") + std::to_string(fault.count) + " x " +
              std::string(name_of(fault.kind)) + " (first: " + std::to_string(fault.first) + ")";
    return line;
  }
};

/// The subdomains that have faults; none for a valid mesh.
struct distributed_validity {
  std::vector<subdomain_faults> subdomains; ///< those that have faults, by number

  bool valid() const { return subdomains.empty(); } ///< whether no subdomain has faults
  /// One line per faulty subdomain.
  std::string text() const {
    std::string lines;
    for (const auto& faults : subdomains)
      lines += faults.text() + "\n";
    return lines;
  }
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

template <int D>
void check_shared_points(const simplicial_piece<D>& piece, const simplicial_skeleton<D>& skeleton,
                         subdomain_faults& faults) {
  for (std::size_t i = 0; i < piece.skeleton_points.size(); ++i)
    if (piece.mesh.points[i] != skeleton.points[static_cast<std::size_t>(piece.skeleton_points[i])])
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
        v = piece.skeleton_points[static_cast<std::size_t>(v)];
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
      expected, found,
      [&](local_id i) { faults.add(seam_fault::missing_triangle, listed[static_cast<std::size_t>(i)]); },
      [&](local_id element) { faults.add(seam_fault::surplus_side, element); });
}

} // namespace detail

/// Checks one piece by itself and against the skeleton.
template <int D>
subdomain_faults check_piece(const simplicial_piece<D>& piece, const simplicial_skeleton<D>& skeleton,
                             std::span<const local_id> listed) {
  subdomain_faults faults;
  faults.subdomain = piece.subdomain;
  const auto table = build_sides(piece.mesh);
  faults.inside =
      check_validity(piece.mesh, table, {.closed_boundary = D == 3, .non_manifold_sides = D == 2});
  detail::check_shared_points(piece, skeleton, faults);
  detail::check_boundary(piece, table, skeleton, listed, faults);
  for (std::size_t e = 0; D == 3 && e < piece.mesh.tags.size(); ++e)
    if (piece.mesh.tags[e] != piece.material)
      faults.add(seam_fault::wrong_material, static_cast<local_id>(e));
  return faults;
}

/// Checks all pieces, one in memory at a time. Inside a piece: references, exact orientation, conformity,
/// duplicates. Against the skeleton: same coordinates, and every skeleton side is a side of exactly the
/// one or two subdomains that it names, facing outwards of each. Throws `mesh_error` when pieces cannot even
/// be indexed. About linear.
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

} // namespace dovetail::io
