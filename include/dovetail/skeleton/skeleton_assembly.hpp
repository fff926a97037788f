/// @file
/// Puts the patches of a skeleton together, in tasks: each has its place, which follows from counts alone.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/coarse_skeleton.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/parallel/common_arrays.hpp"
#include "dovetail/remesh/mesh_regions.hpp"
#include "dovetail/skeleton/fine_lines.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// What the patches of a skeleton are made of. The regions come first and the interface faces behind them.
struct patches_to_join {
  const coarse_skeleton& coarse;
  const numbered_lines& lines;
  const meshed_regions& meshes;
  const region_memo& made;
  std::function<bool(std::size_t)> is_reversed;
  std::span<const local_id> material_of_subdomain;

  bool is_region(std::size_t patch) const { return patch < coarse.regions.size(); }
  const skeleton_face& face(std::size_t patch) const { return coarse.faces[patch - coarse.regions.size()]; }
};

/// Consecutive patches of a skeleton, in its numbers.
struct patches_joined {
  std::vector<vec3> points;
  std::vector<host> point_hosts;
  std::vector<simplex<2>> sides;
  std::vector<std::array<local_id, 2>> subdomains;
  std::vector<local_id> side_hosts;
};

/// The points of lines are the first of a fine skeleton; the own points of patches follow, in their order.
class skeleton_assembly {
public:
  explicit skeleton_assembly(const patches_to_join& from)
      : from_(from), first_point_{from.lines.points.size()}, first_triangle_{0} {
    for (const kept<patch_mesh>& patch : from.meshes.of_region) {
      const region_memo::known_mesh& mesh = from.made.known.at(patch);
      first_point_.push_back(first_point_.back() + mesh.inner_points);
      first_triangle_.push_back(first_triangle_.back() + mesh.triangles);
    }
  }

  const std::vector<std::size_t>& first_triangles() const { return first_triangle_; }

  /// Points and sides; linear. On each rank the same.
  template <executor Executor>
  fine_skeleton run(const Executor& run, const progress& on_progress) const {
    const std::size_t points = first_point_.back(), sides = first_triangle_.back();
    common_arrays<vec3, host, simplex<2>, std::array<local_id, 2>, local_id> assembled(
        run, "assembled", {points, points, sides, sides, sides});
    const std::vector<std::size_t> begins = tasks();
    assembled.fill(run, begins.size() - 1,
                   [&](std::size_t task) {
                     const std::size_t begin = begins[task], end = begins[task + 1];
                     const std::size_t point = task == 0 ? 0 : first_point_[begin],
                                       side = first_triangle_[begin];
                     const patches_joined part = join(begin, end, task == 0);
                     assembled.template write<0>(point, part.points);
                     assembled.template write<1>(point, part.point_hosts);
                     assembled.template write<2>(side, part.sides);
                     assembled.template write<3>(side, part.subdomains);
                     assembled.template write<4>(side, part.side_hosts);
                   },
                   {.on_progress = on_progress, .stage = "skeleton"});
    fine_skeleton fine;
    std::tie(fine.points, fine.point_hosts, fine.sides, fine.subdomains, fine.side_hosts) = assembled.close();
    add_curve_edges(fine);
    return fine;
  }

private:
  static constexpr std::size_t triangles_per_task = 1 << 16;

  /// The first patch of each task, and the end of the last.
  std::vector<std::size_t> tasks() const {
    std::vector<std::size_t> begins{0};
    const std::size_t patches = from_.meshes.of_region.size();
    for (std::size_t p = 0; p < patches; ++p)
      if (first_triangle_[p] - first_triangle_[begins.back()] >= triangles_per_task)
        begins.push_back(p);
    begins.push_back(patches);
    return begins;
  }

  /// What consecutive patches are in the skeleton, with the points of lines before them or without.
  patches_joined join(std::size_t begin, std::size_t end, bool with_lines) const {
    patches_joined result;
    if (with_lines) {
      result.points = from_.lines.points;
      result.point_hosts = hosts_of_lines();
    }
    from_.meshes.for_each(from_.made, begin, end, [&](std::size_t p, const patch_mesh& mesh) {
      auto beside = from_.is_region(p) ? from_.coarse.regions[p].subdomains : from_.face(p).subdomains;
      const bool bounds_nothing_behind = beside[0] == no_id;
      if (bounds_nothing_behind)
        std::swap(beside[0], beside[1]);
      for_each_triangle(from_.meshes.labels[p], from_.is_reversed(p), mesh, first_point_[p],
                        [&](simplex<2> triangle, const simplex<2>&) {
                          if (bounds_nothing_behind)
                            std::swap(triangle[1], triangle[2]);
                          result.sides.push_back(triangle);
                        });
      result.subdomains.resize(result.sides.size(), beside);
      result.side_hosts.resize(result.sides.size(),
                               from_.is_region(p) ? from_.coarse.regions[p].cad_face : no_id);
      append(result.points, mesh.inner_points);
      result.point_hosts.resize(result.points.size(), host_of_inner_points(p));
    });
    return result;
  }

  host host_of_inner_points(std::size_t p) const {
    return from_.is_region(p) ? host{2, from_.coarse.regions[p].cad_face} : inside(from_.face(p));
  }
  /// Interfaces lie in the solid of the subdomains beside them.
  host inside(const skeleton_face& face) const {
    return {3, from_.material_of_subdomain[face.subdomains[0]]};
  }

  std::vector<host> hosts_of_lines() const {
    std::vector<host> hosts = from_.lines.hosts;
    for (std::size_t p = from_.coarse.regions.size(); p < from_.meshes.of_region.size(); ++p)
      for (const local_id number : from_.meshes.labels[p])
        if (host& on = hosts[number]; on.dimension == 3)
          on = inside(from_.face(p));
    return hosts;
  }

  void add_curve_edges(fine_skeleton& fine) const {
    const std::vector<skeleton_line>& keys = from_.lines.keys;
    for (std::size_t l = 0; l < keys.size(); ++l) {
      if (keys[l].on.dimension != 1)
        continue;
      const auto numbers = from_.lines.along(static_cast<local_id>(l), keys[l].vertices[0]);
      for (std::size_t i = 0; i + 1 < numbers.size(); ++i) {
        fine.curve_edges.push_back({numbers[i], numbers[i + 1]});
        fine.curves.push_back(keys[l].on.id);
      }
    }
  }

  const patches_to_join& from_;
  std::vector<std::size_t> first_point_;    ///< own ones of each patch; and the end
  std::vector<std::size_t> first_triangle_; ///< of each patch; and the end
};

} // namespace detail
} // namespace dovetail
