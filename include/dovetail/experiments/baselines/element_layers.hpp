/// @file
/// Layers of elements beside the interfaces, and their way to other pieces: what the improvers that go back
/// to the interfaces have in common.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace dovetail::baselines {

/// An interface is what may be meshed otherwise, a side inside a solid between two pieces; not a material
/// face or another CAD face, which stays.
inline bool is_interface(const fine_skeleton& skeleton, std::size_t side) {
  const auto [behind, front] = skeleton.subdomains[side];
  return skeleton.side_hosts[side] == no_id && front != no_id && front != behind;
}

/// No piece: more than the number of any.
inline constexpr local_id no_piece = std::numeric_limits<local_id>::max();

/// The points of interfaces with the pieces that have them there.
class interface_points {
public:
  /// O(interfaces log interfaces).
  explicit interface_points(const distributed_mesh& mesh) {
    for (std::size_t s = 0; s < mesh.skeleton.sides.size(); ++s) {
      if (!is_interface(mesh.skeleton, s))
        continue;
      const auto [behind, front] = mesh.skeleton.subdomains[s];
      const local_id material = mesh.counts[behind].material;
      for (const local_id v : mesh.skeleton.sides[s])
        least_.push_back({v, material, std::min(behind, front)});
    }
    sort_unique(least_);
  }

  /// For each point of the piece the least piece that has it on an interface inside the piece's solid, or
  /// `no_piece`. O(points of the skeleton in the piece, log interfaces).
  std::vector<local_id> least_pieces(const mesh_piece& piece) const {
    std::vector<local_id> of_point(piece.mesh.points.size(), no_piece);
    for (std::size_t v = 0; v < piece.skeleton_points.size(); ++v) {
      const local_id point = piece.skeleton_points[v];
      const auto at =
          std::lower_bound(least_.begin(), least_.end(), std::array<local_id, 3>{point, piece.material, 0});
      if (at != least_.end() && (*at)[0] == point && (*at)[1] == piece.material)
        of_point[v] = (*at)[2];
    }
    return of_point;
  }

private:
  std::vector<std::array<local_id, 3>> least_; ///< point, material and the lower piece of a side; growing
};

/// For each element the least value within so many layers. The first layer of a value are the elements with a
/// vertex that has it; each further one those that share a vertex with the layer before. Linear per layer.
inline std::vector<local_id> least_within_layers(const simplicial_mesh<3>& mesh,
                                                 std::vector<local_id> of_point, int layers) {
  std::vector<local_id> of_element(mesh.elements.size(), no_piece);
  for (int layer = 0; layer < layers; ++layer) {
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
      for (const local_id v : mesh.elements[e])
        of_element[e] = std::min(of_element[e], of_point[v]);
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
      for (const local_id v : mesh.elements[e]) {
        local_id& at = of_point[v];
        at = std::min(at, of_element[e]);
      }
  }
  return of_element;
}

} // namespace dovetail::baselines
