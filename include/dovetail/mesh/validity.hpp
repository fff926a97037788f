/// @file
/// Is this a mesh? Conformity, exact orientation, closed boundary, duplicates and isolated points. The answer
/// is data: what is wrong, how often, and where first.
#pragma once

#include "dovetail/core/predicates.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/adjacency.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
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
inline std::string_view name_of(mesh_fault kind) {
  constexpr std::array<std::string_view, 12> names{"missing point",   "tags mismatch",     "non-finite point",
                                                   "repeated vertex", "duplicate element", "inverted element",
                                                   "flat element",    "non-manifold side", "misoriented side",
                                                   "open boundary",   "coincident point",  "isolated point"};
  return names[static_cast<std::size_t>(kind)];
}

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
  std::int64_t count(mesh_fault kind) const {
    for (const fault_count& fault : faults)
      if (fault.kind == kind)
        return fault.count;
    return 0;
  }
  /// One line such as "2 inverted elements (3, 17)"; empty for a valid mesh.
  std::string text() const {
    std::string line;
    for (const fault_count& fault : faults) {
      line +=
          (line.empty() ? "" : "; ") + std::to_string(fault.count) + " x " + std::string(name_of(fault.kind));
      for (std::size_t k = 0; k < fault.examples.size(); ++k)
        line += (k == 0 ? " (" : ", ") + std::to_string(fault.examples[k]);
      if (!fault.examples.empty())
        line += static_cast<std::size_t>(fault.count) > fault.examples.size() ? ", ...)" : ")";
    }
    return line;
  }
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
  validity result() const {
    validity found;
    for (const fault_count& fault : counts_)
      if (fault.count > 0)
        found.faults.push_back(fault);
    return found;
  }

private:
  std::array<fault_count, 12> counts_{};
};

template <int D>
void check_references(const simplicial_mesh<D>& mesh, fault_collector& faults) {
  const auto count = static_cast<local_id>(mesh.points.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (std::any_of(mesh.elements[e].begin(), mesh.elements[e].end(),
                    [&](local_id v) { return v < 0 || v >= count; }))
      faults.add(mesh_fault::missing_point, static_cast<local_id>(e));
  if (!mesh.tags.empty() && mesh.tags.size() != mesh.elements.size())
    faults.add(mesh_fault::tags_mismatch);
}

template <int D>
void check_points(const simplicial_mesh<D>& mesh, const validity_options& allowed, fault_collector& faults) {
  const auto& points = mesh.points;
  std::vector<bool> used(points.size(), false);
  for (const auto& element : mesh.elements)
    for (const local_id v : element)
      used[static_cast<std::size_t>(v)] = true;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!std::isfinite(points[v].x) || !std::isfinite(points[v].y) || !std::isfinite(points[v].z))
      faults.add(mesh_fault::non_finite_point, static_cast<local_id>(v));
    if (!used[v] && !allowed.isolated_points)
      faults.add(mesh_fault::isolated_point, static_cast<local_id>(v));
  }
  if (faults.has(mesh_fault::non_finite_point))
    return;
  std::vector<local_id> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto coordinates = [&](local_id v) {
    const vec3& p = points[static_cast<std::size_t>(v)];
    return std::array{p.x, p.y, p.z};
  };
  sort_all(order, [&](local_id a, local_id b) {
    const auto pa = coordinates(a);
    const auto pb = coordinates(b);
    return pa != pb ? pa < pb : a < b;
  });
  std::vector<local_id> repeated;
  for (std::size_t k = 1; k < order.size(); ++k)
    if (coordinates(order[k]) == coordinates(order[k - 1]))
      repeated.push_back(order[k]);
  sort_all(repeated);
  for (const local_id v : repeated)
    faults.add(mesh_fault::coincident_point, v);
}

/// Exactly collinear, by the exact sign of the area in the three coordinate planes.
inline bool collinear(vec3 a, vec3 b, vec3 c) {
  return orient2d({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) == 0 &&
         orient2d({a.y, a.z}, {b.y, b.z}, {c.y, c.z}) == 0 &&
         orient2d({a.z, a.x}, {b.z, b.x}, {c.z, c.x}) == 0;
}

template <int D>
void check_elements(const simplicial_mesh<D>& mesh, fault_collector& faults) {
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto id = static_cast<local_id>(e);
    const auto key = sorted_vertices(mesh.elements[e]);
    if (std::adjacent_find(key.begin(), key.end()) != key.end()) {
      faults.add(mesh_fault::repeated_vertex, id);
      continue;
    }
    const auto at = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(mesh.elements[e][k])]; };
    if constexpr (D == 3) {
      const double sign = orient3d(at(0), at(1), at(2), at(3));
      if (sign < 0)
        faults.add(mesh_fault::inverted_element, id);
      else if (sign == 0)
        faults.add(mesh_fault::flat_element, id);
    } else if (collinear(at(0), at(1), at(2))) {
      faults.add(mesh_fault::flat_element, id);
    }
  }
}

template <int D>
void check_duplicates(const simplicial_mesh<D>& mesh, fault_collector& faults) {
  std::vector<local_id> repeated;
  for_each_group<static_cast<std::size_t>(D + 1)>(
      mesh.elements.size(), mesh.points.size(),
      [&](std::size_t e) { return sorted_vertices(mesh.elements[e]); },
      [&](const auto&, std::span<const std::uint32_t> members) {
        for (std::size_t k = 1; k < members.size(); ++k)
          repeated.push_back(static_cast<local_id>(members[k]));
      });
  sort_all(repeated);
  for (const local_id e : repeated)
    faults.add(mesh_fault::duplicate_element, e);
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

/// The boundary sides of a mesh of tetrahedra must meet in pairs at every edge.
inline void check_closed(const simplicial_mesh<3>& mesh, const side_table<3>& sides,
                         fault_collector& faults) {
  std::vector<std::array<local_id, 2>> edges;
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (sides.is_boundary(static_cast<local_id>(s)))
      for (const auto& local : numbering::sides<2>)
        edges.push_back(sorted_vertices(pick(sides.vertices[s], local)));
  local_id edge = 0;
  for_each_group<2>(
      edges.size(), mesh.points.size(), [&](std::size_t k) { return edges[k]; },
      [&](const auto&, std::span<const std::uint32_t> members) {
        if (members.size() % 2 == 1)
          faults.add(mesh_fault::open_boundary, edge);
        ++edge;
      });
}

/// `sides()` is called when references are known to be right.
template <int D, class Sides>
validity check_all(const simplicial_mesh<D>& mesh, const Sides& sides, const validity_options& allowed) {
  fault_collector faults;
  check_references(mesh, faults);
  if (faults.has(mesh_fault::missing_point))
    return faults.result();
  check_points(mesh, allowed, faults);
  if (!faults.has(mesh_fault::non_finite_point))
    check_elements(mesh, faults);
  check_duplicates(mesh, faults);
  if (faults.has(mesh_fault::repeated_vertex))
    return faults.result();
  const side_table<D>& table = sides();
  check_sides(mesh, table, allowed, faults);
  if constexpr (D == 3)
    if (allowed.closed_boundary)
      check_closed(mesh, table, faults);
  return faults.result();
}

} // namespace detail

/// Checks a mesh, D = 2 or 3. When references are broken only those are reported, since nothing else can be
/// asked then. About linear, but for one sort of the points.
template <int D>
validity check_validity(const simplicial_mesh<D>& mesh, const validity_options& allowed = {}) {
  side_table<D> sides;
  return detail::check_all(
      mesh,
      [&]() -> const side_table<D>& {
        sides = build_sides(mesh);
        return sides;
      },
      allowed);
}

/// The same, where the sides of the mesh are known: `build_sides(mesh)`.
template <int D>
validity check_validity(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                        const validity_options& allowed = {}) {
  return detail::check_all(
      mesh, [&]() -> const side_table<D>& { return sides; }, allowed);
}

} // namespace dovetail
