/// @file
/// The skeleton of a decomposition: lines, regions and interface faces, each once, with the subdomains that
/// share it (paper, sections 3.4 and 3.5). All are named by coarse vertices, so every subdomain derives the
/// same keys.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace dovetail {

/// A coarse edge on subdomain boundaries or on a CAD curve. Its key is `vertices`, in growing order.
struct skeleton_line {
  std::array<local_id, 2> vertices{no_id, no_id};
  host on = {};                 ///< {1, curve}, {2, CAD face} or {3, no_id} for a line inside the domain
  std::array<double, 2> t = {}; ///< curve parameters of the two vertices, for a line on a curve
  std::array<vec2, 2> uv = {};  ///< face parameters of the two vertices, for a line on a CAD face
  int segments = 0;             ///< that it falls into; 0: as the sizes ask
  double bias = 0;              ///< of `segments`: as in `remesh::line_spacing`
};

/// Coarse triangles of one CAD face between the same two subdomains, connected across edges that are no
/// lines.
struct skeleton_region {
  local_id cad_face = no_id;                        ///< the number of the face in the model
  std::array<local_id, 2> subdomains{no_id, no_id}; ///< behind the oriented triangles, and in front of them
  std::vector<local_id> triangles = {};             ///< of the coarse surface mesh, growing
  std::vector<local_id> fixed_points = {}; ///< coarse vertices inside the region that interfaces touch
};

/// A coarse face between two subdomains of one material, oriented outwards of `subdomains[0]`, the smaller
/// one. Its key is the sorted vertices; `vertices` starts with the smallest.
struct skeleton_face {
  simplex<2> vertices{no_id, no_id, no_id};
  std::array<local_id, 2> subdomains{no_id, no_id}; ///< the smaller number first
  local_id side = no_id;                            ///< of the coarse mesh
  bool is_curved = false; ///< has an edge on the CAD surface, and leaves its coarse plane when remeshed
};

/// All that is between subdomains, in coarse entities.
struct coarse_skeleton {
  std::vector<skeleton_line> lines;     ///< sorted by `vertices`
  std::vector<skeleton_region> regions; ///< by their first triangle
  std::vector<skeleton_face> faces;     ///< sorted by key
};

/// Index of the line between two coarse vertices, or no_id. O(log lines).
local_id find_line(const std::vector<skeleton_line>& lines, local_id a, local_id b);

/// Finds lines by their ends in a few steps: for a look at all lines of a skeleton. It must not outlive the
/// lines.
class line_index {
public:
  explicit line_index(const std::vector<skeleton_line>& lines);
  /// As `find_line`.
  local_id find(local_id a, local_id b) const;

private:
  const std::vector<skeleton_line>& lines_;
  std::vector<local_id> first_; ///< per point: the first line of which it is the smaller end; and the end
};

/// Whether two orders of the same three vertices turn the same way.
inline bool same_turn(const simplex<2>& a, const simplex<2>& b) {
  const auto at = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
  return b[(at + 1) % 3] == a[1];
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/coarse_skeleton.ipp"
#endif
