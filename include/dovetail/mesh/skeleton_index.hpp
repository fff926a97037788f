/// @file
/// Which skeleton sides and points belong to which subdomain.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace dovetail::io {

/// The sides of the skeleton listed by subdomain. A side between two subdomains is in both lists; one
/// with the same subdomain on both sides is in its list twice.
template <int D>
class sides_by_subdomain {
public:
  /// O(sides + subdomains). Throws `mesh_error` when a side names a subdomain or a point that does
  /// not exist, so that consumers may index freely.
  explicit sides_by_subdomain(const distributed_simplicial_mesh<D>& mesh) {
    check(mesh);
    sides_ = sort_by_subdomain(mesh.skeleton, mesh.counts.size());
  }

  std::span<const local_id> operator[](local_id subdomain) const { return sides_[subdomain]; }

private:
  static void check(const distributed_simplicial_mesh<D>& mesh) {
    const auto& skeleton = mesh.skeleton;
    const auto& sides = skeleton.sides;
    if (skeleton.subdomains.size() != sides.size() || skeleton.side_hosts.size() != sides.size())
      throw mesh_error("the skeleton does not list subdomains and CAD entity of every side");
    for (std::size_t t = 0; t < sides.size(); ++t) {
      for (const auto v : sides[t])
        if (v < 0 || static_cast<std::size_t>(v) >= skeleton.points.size())
          throw mesh_error("skeleton side " + std::to_string(t) + " refers to a point that does not exist");
      const auto [behind, front] = skeleton.subdomains[t];
      const auto count = static_cast<local_id>(mesh.counts.size());
      if (behind < 0 || behind >= count || front < no_id || front >= count)
        throw mesh_error("skeleton side " + std::to_string(t) + " refers to a subdomain that does not exist");
    }
  }

  sides_of_subdomains sides_;
};

} // namespace dovetail::io
