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
  explicit sides_by_subdomain(const distributed_simplicial_mesh<D>& mesh)
      : start_(mesh.counts.size() + 1, 0) {
    const auto& skeleton = mesh.skeleton;
    check(mesh);
    for (const auto& pair : skeleton.subdomains)
      for (const auto s : pair)
        if (s != no_id)
          ++start_[static_cast<std::size_t>(s) + 1];
    for (std::size_t s = 1; s < start_.size(); ++s)
      start_[s] += start_[s - 1];
    items_.resize(start_.back());
    auto next = start_;
    for (std::size_t t = 0; t < skeleton.subdomains.size(); ++t)
      for (const auto s : skeleton.subdomains[t])
        if (s != no_id)
          items_[next[static_cast<std::size_t>(s)]++] = static_cast<local_id>(t);
  }

  std::span<const local_id> operator[](local_id subdomain) const {
    const auto s = static_cast<std::size_t>(subdomain);
    return std::span(items_).subspan(start_[s], start_[s + 1] - start_[s]);
  }

private:
  static void check(const distributed_simplicial_mesh<D>& mesh) {
    const auto& skeleton = mesh.skeleton;
    const auto& sides = sides_of(skeleton);
    if (skeleton.subdomains.size() != sides.size() || hosts_of_sides(skeleton).size() != sides.size())
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

  std::vector<std::size_t> start_;
  std::vector<local_id> items_;
};

using triangles_by_subdomain = sides_by_subdomain<3>;

} // namespace dovetail::io
