/// @file
/// What `interface_angles.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/decomposition/subdomain_boundary.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/mesh/side_state.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace dovetail {

namespace detail {

class interface_checker {
public:
  interface_checker(const interface_angles_input& input, double threshold_deg)
      : in_(input), threshold_(threshold_deg - rounding_deg) {
    if (in_.subdomains.size() != in_.triangles.size() || in_.origins.size() != in_.triangles.size())
      throw usage_error("interface angles: " + std::to_string(in_.triangles.size()) + " triangles, but " +
                        std::to_string(in_.subdomains.size()) + " pairs of subdomains and " +
                        std::to_string(in_.origins.size()) + " origins");
    if (in_.mesh_is == mesh_state::unknown)
      require_triangles();
  }

  interface_angles run() {
    measure_faces();
    const bool all = in_.half_edges.empty();
    const auto half_edge = [&](std::size_t i) {
      return all ? static_cast<std::uint32_t>(i) : in_.half_edges[i];
    };
    std::vector<std::uint32_t> around;
    for_each_group<2>(
        all ? in_.triangles.size() * 3 : in_.half_edges.size(), in_.points.size(),
        [&](std::size_t i) {
          const std::uint32_t h = half_edge(i);
          return sorted_vertices(pick(in_.triangles[h / 3], numbering::sides<2>[h % 3]));
        },
        [&](const std::array<local_id, 2>& edge, std::span<const std::uint32_t> members) {
          around.clear();
          for (const std::uint32_t i : members)
            around.push_back(half_edge(i));
          measure_wedges(edge, around);
        });
    sort_by_angle(found_.violations);
    return std::move(found_);
  }

private:
  /// The same angle comes out differently when measured through elements, as the simplification does.
  static constexpr double rounding_deg = 1e-6;

  /// A triangle at an edge: its direction around the edge, and the subdomains on its two sides.
  struct flap {
    double direction; ///< angle around the edge, counter-clockwise seen against the edge
    local_id triangle;
    local_id before; ///< the subdomain on the clockwise side
    local_id after;  ///< on the counter-clockwise side
  };

  void require_triangles() const {
    constexpr std::string_view who = "measure_interface_angles";
    require_finite(in_.points, who);
    for (std::size_t t = 0; t < in_.triangles.size(); ++t) {
      const auto& vertices = in_.triangles[t];
      const std::string triangle =
          "triangle " + std::to_string(t) + " (points " + listed_points(vertices) + ")";
      for (const local_id v : vertices)
        if (v < 0 || static_cast<std::size_t>(v) >= in_.points.size())
          refuse_mesh(who, triangle + " refers to point " + std::to_string(v) + ", but there are " +
                               std::to_string(in_.points.size()) + " points");
      if (collinear(at(vertices[0]), at(vertices[1]), at(vertices[2])))
        refuse_mesh(who, triangle + " is flat: its area is 0; remove it or move a point of it");
    }
    for (const std::uint32_t h : in_.half_edges)
      if (h / 3 >= in_.triangles.size())
        throw usage_error("measure_interface_angles: there is no half edge " + std::to_string(h) + " of " +
                          std::to_string(in_.triangles.size()) + " triangles");
  }

  /// Of the flaps at an edge those in one direction are not one triangle twice, and none is turned over: on
  /// both of its sides there would be what its neighbours have there if it were not. Where the triangles are
  /// only some of a skeleton's, others may be missing on one side.
  void require_flaps(const std::array<local_id, 2>& edge) const {
    constexpr double rounding = 1e-9;
    const std::size_t count = flaps_.size();
    const auto points = [&](const flap& f) { return in_.triangles[static_cast<std::size_t>(f.triangle)]; };
    for (std::size_t k = 0; k < count; ++k) {
      const flap& before = flaps_[(k + count - 1) % count];
      const flap& here = flaps_[k];
      const flap& next = flaps_[(k + 1) % count];
      const auto name = [&] {
        return "triangle " + std::to_string(here.triangle) + " (points " + listed_points(points(here)) + ")";
      };
      if (k + 1 < count && next.direction - here.direction < rounding &&
          sorted_vertices(points(here)) == sorted_vertices(points(next)))
        refuse_mesh("measure_interface_angles", name() + " has the same points as triangle " +
                                                    std::to_string(next.triangle) + "; remove one of them");
      if (here.before != here.after && before.after == here.after && next.before == here.before)
        refuse_mesh("measure_interface_angles",
                    name() + " or its neighbours are turned over: at the edge (" + listed_points(edge) +
                        ") subdomain " + std::to_string(here.before) + " is on its one side and " +
                        std::to_string(here.after) +
                        " on the other, and they have them the other way round; orient each "
                        "triangle outwards of its first subdomain");
    }
  }

  bool is_cad(local_id t) const { return in_.origins[static_cast<std::size_t>(t)] == triangle_origin::cad; }
  bool is_refused(local_id t) const {
    return in_.origins[static_cast<std::size_t>(t)] == triangle_origin::refused;
  }
  violation_cause cause_of(local_id a, local_id b) const {
    return is_refused(a) || is_refused(b) ? violation_cause::refused : violation_cause::remeshing;
  }
  vec3 at(local_id v) const { return in_.points[static_cast<std::size_t>(v)]; }

  void measure_faces() {
    for (std::size_t t = 0; t < in_.triangles.size(); ++t) {
      const auto id = static_cast<local_id>(t);
      if (is_cad(id))
        continue;
      ++found_.interface_faces;
      const auto p = corners(in_.points, in_.triangles[t]);
      const double smallest = smallest_corner_angle(p);
      if (smallest < found_.face_angle.angle_deg)
        found_.face_angle = {smallest, {id, no_id}, {no_id, no_id}};
      const vec3 centroid = (p[0] + p[1] + p[2]) / 3.0;
      if (smallest < threshold_)
        found_.violations.push_back(
            {smallest, cause_of(id, id), {id, no_id}, {no_id, no_id}, no_id, centroid});
    }
  }

  void measure_wedges(const std::array<local_id, 2>& edge, std::span<const std::uint32_t> half_edges) {
    const bool all_cad = std::all_of(half_edges.begin(), half_edges.end(),
                                     [&](std::uint32_t h) { return is_cad(static_cast<local_id>(h / 3)); });
    if (all_cad || half_edges.size() < 2)
      return;
    collect_flaps(edge, half_edges);
    if (in_.mesh_is == mesh_state::unknown)
      require_flaps(edge);
    for (std::size_t k = 0; k < flaps_.size(); ++k) {
      const flap& here = flaps_[k];
      const flap& next = flaps_[(k + 1) % flaps_.size()];
      if (here.after == no_id || here.after != next.before ||
          (is_cad(here.triangle) && is_cad(next.triangle)))
        continue; // outside of the domain, or none of the interfaces' business
      const double turn =
          next.direction - here.direction + (k + 1 == flaps_.size() ? 2 * std::numbers::pi : 0.0);
      note_wedge(edge, here, next, turn * degrees_per_radian);
    }
  }

  void collect_flaps(const std::array<local_id, 2>& edge, std::span<const std::uint32_t> half_edges) {
    const vec3 origin = at(edge[0]);
    const vec3 axis = normalized(at(edge[1]) - origin);
    const auto apex = [&](std::uint32_t h) {
      return in_.triangles[h / 3][h % 3];
    }; // side i is opposite vertex i
    const vec3 to_first = at(apex(half_edges[0])) - origin;
    const vec3 x = normalized(to_first - dot(to_first, axis) * axis);
    const vec3 y = cross(axis, x);
    flaps_.clear();
    for (const std::uint32_t h : half_edges) {
      const auto t = static_cast<local_id>(h / 3);
      const vec3 d = at(apex(h)) - origin;
      const auto vertices = pick(in_.triangles[h / 3], numbering::sides<2>[h % 3]);
      // A triangle that passes the edge in the edge's direction has its normal, which points out of
      // subdomains[0], on the counter-clockwise side.
      const auto& both = in_.subdomains[h / 3];
      const bool along = vertices[0] == edge[0];
      flaps_.push_back({h == half_edges[0] ? 0.0 : std::atan2(dot(d, y), dot(d, x)), t,
                        along ? both[0] : both[1], along ? both[1] : both[0]});
    }
    sort_all(flaps_, [](const flap& a, const flap& b) {
      return std::pair(a.direction, a.triangle) < std::pair(b.direction, b.triangle);
    });
  }

  void note_wedge(const std::array<local_id, 2>& edge, const flap& a, const flap& b, double angle) {
    least_angle& minimum =
        is_cad(a.triangle) || is_cad(b.triangle) ? found_.surface_wedge : found_.interface_wedge;
    if (angle < minimum.angle_deg)
      minimum = {angle, {a.triangle, b.triangle}, edge};
    if (angle < threshold_)
      found_.violations.push_back({angle,
                                   cause_of(a.triangle, b.triangle),
                                   {a.triangle, b.triangle},
                                   edge,
                                   a.after,
                                   midpoint(at(edge[0]), at(edge[1]))});
  }

  const interface_angles_input& in_;
  double threshold_;
  interface_angles found_;
  std::vector<flap> flaps_; ///< scratch
};

} // namespace detail

DOVETAIL_INLINE std::vector<triangle_origin> triangle_origins(const subdomain_boundary_sides<3>& boundary,
                                                              std::span<const side_state> side_states) {
  std::vector<triangle_origin> origins(boundary.sides.size(), triangle_origin::cad);
  for (std::size_t k = 0; k < origins.size(); ++k)
    if (boundary.on_surface[k] == 0)
      origins[k] = side_states[static_cast<std::size_t>(boundary.side_ids[k])] == side_state::refused
                       ? triangle_origin::refused
                       : triangle_origin::kept;
  return origins;
}

DOVETAIL_INLINE interface_angles measure_interface_angles(const interface_angles_input& input,
                                                          double threshold_deg) {
  return detail::interface_checker(input, threshold_deg).run();
}

} // namespace dovetail
