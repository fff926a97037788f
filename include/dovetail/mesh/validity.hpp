/// @file
/// Is this a mesh? Conformity, exact orientation, closed boundary, duplicates and isolated points. The answer
/// is data: what is wrong, how often, and where first.
#pragma once

#include "dovetail/core/predicates.hpp"
#include "dovetail/mesh/adjacency.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dovetail {

/// What can be wrong. The comment says what the example ids are.
enum class mesh_fault {
  missing_point,     ///< element that refers to a point that does not exist
  tags_mismatch,     ///< tags given, but not one per element (no example)
  non_finite_point,  ///< point with a coordinate that is not finite
  repeated_vertex,   ///< element that uses a point twice
  duplicate_element, ///< element with the same points as an earlier one
  inverted_element,  ///< element with negative volume (D = 3, exact)
  flat_element,      ///< element with zero volume (D = 3) or area (D = 2), exactly
  non_manifold_side, ///< side with more than two elements
  misoriented_side,  ///< side that its two elements pass in the same direction
  open_boundary,     ///< D = 2: side with one element; D = 3: ridge with an odd number of boundary sides
  coincident_point,  ///< point at exactly the place of an earlier one
  isolated_point     ///< point that no element uses
};

/// What a message calls a fault.
std::string_view name_of(mesh_fault kind);

/// One kind of fault: how often it occurs, and the first few entities that have it.
struct fault_count {
  static constexpr std::size_t max_examples = 10; ///< so many entities are kept

  mesh_fault kind;                ///< which kind
  std::int64_t count = 0;         ///< how often
  std::vector<local_id> examples; ///< the first ones; what they number is said at `mesh_fault`

  /// Counts an entity, and keeps it if it is one of the first.
  void add(local_id entity) {
    if (++count <= static_cast<std::int64_t>(max_examples))
      examples.push_back(entity);
  }
};

/// What is allowed. The defaults suit the mesh of a solid (D = 3) and of its boundary (D = 2).
struct validity_options {
  bool closed_boundary = true;     ///< false: a surface may have a boundary
  bool non_manifold_sides = false; ///< true: a shell may have sheets that meet (D = 2 only)
  bool isolated_points = false;    ///< true: points without elements are fine
};

/// The kinds of fault found, in the order of `mesh_fault`; empty for a valid mesh.
struct validity {
  std::vector<fault_count> faults; ///< one entry for each kind that occurs

  bool valid() const { return faults.empty(); } ///< whether there are no faults
  /// How often a kind of fault occurs.
  std::int64_t count(mesh_fault kind) const;
  /// One line such as "2 inverted elements (3, 17)"; empty for a valid mesh.
  std::string text() const;
};

namespace detail {

/// Collects faults by kind and keeps those that occurred.
class fault_collector {
public:
  fault_collector() {
    for (std::size_t k = 0; k < counts_.size(); ++k)
      counts_[k].kind = static_cast<mesh_fault>(k);
  }
  void add(mesh_fault kind, local_id entity) { counts_[static_cast<std::size_t>(kind)].add(entity); }
  void add(mesh_fault kind) { ++counts_[static_cast<std::size_t>(kind)].count; }
  bool has(mesh_fault kind) const { return counts_[static_cast<std::size_t>(kind)].count > 0; }
  validity result() const;

private:
  std::array<fault_count, 12> counts_{};
};

/// Exactly collinear, by the exact sign of the area in the three coordinate planes.
inline bool collinear(vec3 a, vec3 b, vec3 c) {
  return orient2d({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) == 0 &&
         orient2d({a.y, a.z}, {b.y, b.z}, {c.y, c.z}) == 0 &&
         orient2d({a.z, a.x}, {b.z, b.x}, {c.z, c.x}) == 0;
}

/// Do the two vertex lists of a side have opposite orientation, as seen from its two elements?
inline bool opposite(const simplex<1>& a, const simplex<1>& b) {
  return a[0] == b[1] && a[1] == b[0];
}
inline bool opposite(simplex<2> a, const simplex<2>& b) {
  std::swap(a[0], a[1]);
  std::rotate(a.begin(), std::find(a.begin(), a.end(), b[0]), a.end());
  return a == b;
}

template <int D>
void check_sides(const simplicial_mesh<D>& mesh, const side_table<D>& sides, const validity_options& allowed,
                 fault_collector& faults) {
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto side = static_cast<local_id>(s);
    if (sides.is_non_manifold(side)) {
      if (D == 3 || !allowed.non_manifold_sides)
        faults.add(mesh_fault::non_manifold_side, side);
      continue;
    }
    if (sides.is_boundary(side)) {
      if (D == 2 && allowed.closed_boundary)
        faults.add(mesh_fault::open_boundary, side);
      continue;
    }
    if (!opposite(sides.vertices[s], side_of_element(mesh, sides, side, sides.elements[s][1])))
      faults.add(mesh_fault::misoriented_side, side);
  }
}

/// Whether points and elements are without fault, each by itself: all but what is between elements.
template <int D>
bool each_is_valid(const simplicial_mesh<D>& mesh, const validity_options& allowed);

/// The boundary sides of a mesh of tetrahedra must meet in pairs at every edge.
void check_closed(const simplicial_mesh<3>& mesh, const side_table<3>& sides, fault_collector& faults);

} // namespace detail

/// Checks a mesh, D = 2 or 3. When references are broken only those are reported, since nothing else can be
/// asked then. About linear, but for one sort of the points.
/// Throws nothing: faults are the result.
/// \param mesh triangles or tetrahedra
/// \param allowed what is no fault, such as open sides
template <int D>
validity check_validity(const simplicial_mesh<D>& mesh, const validity_options& allowed = {});

/// The same, where the sides of the mesh are known: `build_sides(mesh)`.
/// \param sides `build_sides(mesh)`
template <int D>
validity check_validity(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                        const validity_options& allowed = {});

#ifdef DOVETAIL_COMPILED
extern template bool detail::each_is_valid<3>(const simplicial_mesh<3>& mesh,
                                              const validity_options& allowed);
extern template validity check_validity<2>(const simplicial_mesh<2>& mesh, const validity_options& allowed);
extern template validity check_validity<2>(const simplicial_mesh<2>& mesh, const side_table<2>& sides,
                                           const validity_options& allowed);
extern template validity check_validity<3>(const simplicial_mesh<3>& mesh, const validity_options& allowed);
extern template validity check_validity<3>(const simplicial_mesh<3>& mesh, const side_table<3>& sides,
                                           const validity_options& allowed);
#endif

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/validity.ipp"
#endif
