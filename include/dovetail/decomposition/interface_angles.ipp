/// @file
/// What `interface_angles.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/angle_collector.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// Measures through the elements of a mesh.
template <int D>
class mesh_angles {
public:
  mesh_angles(const decomposed_mesh<D>& given, const wanted_angles& wanted)
      : in_(given), collector_(wanted), is_fixed_(given.sides.size()), is_interface_(given.sides.size()) {
    constexpr std::string_view who = "measure_interface_angles";
    require_valid_unless(in_.mesh_is, in_.mesh, in_.sides, who);
    if (!in_.side_states.empty() && in_.side_states.size() != in_.sides.size())
      throw usage_error(std::string(who) + ": " + std::to_string(in_.side_states.size()) + " states for " +
                        std::to_string(in_.sides.size()) + " sides; give one each or none");
    require_one_per_element(in_.part_of_element, in_.mesh.elements.size(),
                            std::numeric_limits<local_id>::max(), who, "parts");
    for (std::size_t s = 0; s < is_fixed_.size(); ++s) {
      const auto [a, b] = in_.sides.elements[s];
      const bool is_interior = in_.sides.is_interior(static_cast<local_id>(s));
      is_fixed_[s] = !is_interior ||
                     (in_.side_states.empty() ? changes_tag(a, b) : in_.side_states[s] == side_state::fixed);
      is_interface_[s] = !is_fixed_[s] && part(a) != part(b);
    }
  }

  interface_angles run() {
    for (std::size_t s = 0; s < is_interface_.size(); ++s)
      if (is_interface_[s]) {
        ++collector_.found.interface_faces;
        if constexpr (D == 3)
          collector_.add_face(static_cast<local_id>(s),
                              corners(span_of(in_.mesh.points), in_.sides.vertices[s]),
                              cause_at(static_cast<local_id>(s)));
      }
    if (collector_.found.interface_faces > 0) {
      const ridge_table<D> ridges = build_ridges_at<D>(in_.mesh, in_.sides, points_of_interfaces());
      for (std::size_t r = 0; r < ridges.size(); ++r)
        for (std::size_t fan = ridges.fan_begins[r]; fan < ridges.fan_begins[r + 1]; ++fan)
          measure_fan(ridges.vertices[r], ridges.fan(fan), ridges.closed[fan]);
    }
    return collector_.take();
  }

private:
  /// Not zero for such points: what lies elsewhere has no dihedral beside an interface.
  std::vector<std::uint8_t> points_of_interfaces() const {
    std::vector<std::uint8_t> are(in_.mesh.points.size(), 0);
    for (std::size_t s = 0; s < is_interface_.size(); ++s)
      if (is_interface_[s])
        for (const local_id v : in_.sides.vertices[s])
          are[v] = 1;
    return are;
  }

  local_id part(local_id element) const { return in_.part_of_element[element]; }
  bool changes_tag(local_id a, local_id b) const {
    return !in_.mesh.tags.empty() && in_.mesh.tags[a] != in_.mesh.tags[b];
  }
  bool is_fixed(local_id side) const { return is_fixed_[side]; }
  /// Whether a dihedral ends at the side.
  bool is_end(local_id side) const { return is_fixed_[side] || is_interface_[side]; }
  violation_cause cause_at(local_id side) const {
    return !in_.side_states.empty() && in_.side_states[side] == side_state::refused
               ? violation_cause::refused
               : violation_cause::remeshing;
  }

  /// An element at the ridge, passed from side to side.
  struct passage {
    local_id element, from, to;
    double angle;
  };

  passage decoded(std::uint32_t code) const {
    const dihedral w = ridge_table<D>::decode(code);
    const auto& sides = in_.sides.of_element[w.element];
    const auto angles = dihedral_angles(corners(span_of(in_.mesh.points), in_.mesh.elements[w.element]));
    return {w.element, sides[w.sides[0]], sides[w.sides[1]], angles[w.ridge]};
  }

  /// Adds up the angles of a fan from one side where dihedrals end to the next.
  void measure_fan(const simplex<D - 2>& ridge, std::span<const std::uint32_t> codes, bool is_closed) {
    const auto has = [&](std::uint32_t code, auto is_wanted) {
      const dihedral w = ridge_table<D>::decode(code);
      return is_wanted(in_.sides.of_element[w.element][w.sides[0]]);
    };
    const auto first = [&](auto is_wanted) {
      return std::find_if(codes.begin(), codes.end(), [&](auto code) { return has(code, is_wanted); });
    };
    if (first([&](local_id side) { return is_interface_[side]; }) == codes.end())
      return;                   // no interface here; an open fan ends at a fixed side
    auto begin = codes.begin(); // of an open fan a fixed side
    if (is_closed) {
      begin = first([&](local_id side) { return is_fixed(side); });
      if (begin == codes.end())
        begin = first([&](local_id side) { return is_end(side); });
    }
    passage run{no_id, no_id, no_id, 0};
    double opening = 0; // between fixed sides
    std::size_t first_found = collector_.found.violations.size();
    for (std::size_t k = 0; k < codes.size(); ++k) {
      const passage here =
          decoded(codes[(static_cast<std::size_t>(begin - codes.begin()) + k) % codes.size()]);
      if (run.element == no_id)
        run = {here.element, here.from, no_id, 0};
      run.angle += here.angle;
      run.to = here.to;
      opening += here.angle;
      if (!is_end(here.to))
        continue;
      measure_dihedral(ridge, run);
      run.element = no_id;
      if (!is_fixed(here.to))
        continue;
      auto& violations = collector_.found.violations;
      if (collector_.is_small_dihedral(opening))
        for (; first_found < violations.size(); ++first_found)
          violations[first_found].cause = violation_cause::forced;
      opening = 0;
      first_found = violations.size();
    }
  }

  void measure_dihedral(const simplex<D - 2>& ridge, const passage& run) {
    if (is_fixed(run.from) && is_fixed(run.to)) // also where a fixed line ends inside a part
      return;
    std::array<local_id, 2> edge{no_id, no_id};
    std::copy(ridge.begin(), ridge.end(), edge.begin());
    const vec3 place = midpoint(in_.mesh.points[ridge.front()], in_.mesh.points[ridge.back()]);
    const bool is_refused =
        cause_at(run.from) == violation_cause::refused || cause_at(run.to) == violation_cause::refused;
    const bool is_small = collector_.add_dihedral(
        {angle_of(run, edge[0]), {run.from, run.to}, edge}, is_fixed(run.from) || is_fixed(run.to),
        is_refused ? violation_cause::refused : violation_cause::remeshing, part(run.element), place);
    if (D == 2 && is_small && !in_.mesh.tags.empty())
      collector_.found.violations.back().cad = {{2, in_.mesh.tags[run.element]}};
  }

  double angle_of(const passage& run, local_id vertex) const {
    if (!in_.leaves)
      return run.angle;
    const double between =
        degrees_per_radian * angle_between(in_.leaves(run.from, vertex), in_.leaves(run.to, vertex));
    return run.angle > 180 ? 360 - between : between;
  }

  const decomposed_mesh<D>& in_;
  angle_collector collector_;
  std::vector<bool> is_fixed_, is_interface_; ///< per side
};

inline std::array<local_id, 2> ends_of_half_edge(const fine_skeleton& fine, std::uint32_t half_edge) {
  return sorted_vertices(pick(fine.sides[half_edge / 3], numbering::sides<2>[half_edge % 3]));
}
inline std::size_t share_of_edge(const fine_skeleton& fine, std::uint32_t half_edge, std::size_t shares) {
  const auto smaller = static_cast<std::uint32_t>(ends_of_half_edge(fine, half_edge)[0]);
  return smaller % static_cast<std::uint32_t>(shares); // of 32 bits, which takes a third of the time
}

/// Measures between the triangles of a fine skeleton.
class skeleton_angles {
public:
  skeleton_angles(const fine_skeleton& fine, const wanted_angles& wanted,
                  std::span<const std::uint8_t> refused,
                  std::optional<std::span<const std::uint32_t>> half_edges, mesh_state skeleton_is)
      : fine_(fine), collector_(wanted), refused_(refused), half_edges_(half_edges),
        is_known_(skeleton_is == mesh_state::valid) {
    if (!is_known_)
      require_triangles();
  }

  interface_angles run(const angle_share& share) {
    const std::size_t triangles = fine_.sides.size();
    for (std::size_t t = triangles * share.number / share.of; t < triangles * (share.number + 1) / share.of;
         ++t)
      if (const auto id = static_cast<local_id>(t); !is_fixed(id)) {
        ++collector_.found.interface_faces;
        collector_.add_face(id, corners(span_of(fine_.points), fine_.sides[t]), cause_of(id, id));
      }
    std::vector<std::uint32_t> its;
    const auto take = [&](std::uint32_t h) {
      if (share_of_edge(fine_, h, share.of) == share.number)
        its.push_back(h);
    };
    if (half_edges_)
      std::for_each(half_edges_->begin(), half_edges_->end(), take);
    else
      for (std::size_t h = 0; h < 3 * triangles; ++h)
        take(static_cast<std::uint32_t>(h));
    const auto shares = static_cast<local_id>(share.of), number = static_cast<local_id>(share.number);
    std::vector<std::uint32_t> around;
    for_each_group<2>(
        its.size(), fine_.points.size() / share.of + 1,
        [&](std::size_t i) {
          const auto edge = ends_of_half_edge(fine_, its[i]);
          return std::array{edge[0] / shares, edge[1]};
        },
        [&](const std::array<local_id, 2>& edge, std::span<const std::uint32_t> members) {
          around.clear();
          for (const std::uint32_t i : members)
            around.push_back(its[i]);
          measure_dihedrals({edge[0] * shares + number, edge[1]}, around);
        });
    return collector_.take();
  }

private:
  /// A triangle at an edge: its direction around the edge, and the subdomains on its two sides.
  struct flap {
    double direction; ///< angle around the edge, counter-clockwise seen against the edge
    local_id triangle;
    local_id before; ///< the subdomain on the clockwise side
    local_id after;  ///< on the counter-clockwise side
  };

  void require_triangles() const {
    constexpr std::string_view who = "measure_skeleton_angles";
    require_finite(span_of(fine_.points), who);
    for (std::size_t t = 0; t < fine_.sides.size(); ++t) {
      const auto& vertices = fine_.sides[t];
      const std::string triangle =
          "triangle " + std::to_string(t) + " (points " + listed_points(vertices) + ")";
      for (const local_id v : vertices)
        if (v < 0 || static_cast<std::size_t>(v) >= fine_.points.size())
          refuse_mesh(who, triangle + " refers to point " + std::to_string(v) + ", but there are " +
                               std::to_string(fine_.points.size()) + " points");
      if (collinear(at(vertices[0]), at(vertices[1]), at(vertices[2])))
        refuse_mesh(who, triangle + " is flat: its area is 0; remove it or move a point of it");
    }
    for (const std::uint32_t h : half_edges_.value_or(std::span<const std::uint32_t>()))
      if (h / 3 >= fine_.sides.size())
        throw usage_error("measure_skeleton_angles: there is no half edge " + std::to_string(h) + " of " +
                          std::to_string(fine_.sides.size()) + " triangles");
  }

  /// Of the flaps at an edge those in one direction are not one triangle twice, and none is turned over: on
  /// both of its sides there would be what its neighbours have there if it were not. Where the triangles are
  /// only some of a skeleton's, others may be missing on one side.
  void require_flaps(const std::array<local_id, 2>& edge) const {
    constexpr double rounding = 1e-9;
    const std::size_t count = flaps_.size();
    const auto points = [&](const flap& f) { return fine_.sides[f.triangle]; };
    for (std::size_t k = 0; k < count; ++k) {
      const flap& before = flaps_[(k + count - 1) % count];
      const flap& here = flaps_[k];
      const flap& next = flaps_[(k + 1) % count];
      const auto name = [&] {
        return "triangle " + std::to_string(here.triangle) + " (points " + listed_points(points(here)) + ")";
      };
      if (k + 1 < count && next.direction - here.direction < rounding &&
          sorted_vertices(points(here)) == sorted_vertices(points(next)))
        refuse_mesh("measure_skeleton_angles", name() + " has the same points as triangle " +
                                                   std::to_string(next.triangle) + "; remove one of them");
      if (here.before != here.after && before.after == here.after && next.before == here.before)
        refuse_mesh("measure_skeleton_angles",
                    name() + " or its neighbours are turned over: at the edge (" + listed_points(edge) +
                        ") subdomain " + std::to_string(here.before) + " is on its one side and " +
                        std::to_string(here.after) +
                        " on the other, and they have them the other way round; orient each "
                        "triangle outwards of its first subdomain");
    }
  }

  bool is_fixed(local_id t) const {
    const auto [behind, front] = fine_.subdomains[t];
    return fine_.side_hosts[t] != no_id || front == no_id || front == behind;
  }
  violation_cause cause_of(local_id a, local_id b) const {
    const bool is_refused = !refused_.empty() && (refused_[a] != 0 || refused_[b] != 0);
    return is_refused ? violation_cause::refused : violation_cause::remeshing;
  }
  vec3 at(local_id v) const { return fine_.points[v]; }

  void measure_dihedrals(const std::array<local_id, 2>& edge, std::span<const std::uint32_t> half_edges) {
    const bool all_fixed = std::all_of(half_edges.begin(), half_edges.end(), [&](std::uint32_t h) {
      return is_fixed(static_cast<local_id>(h / 3));
    });
    if (all_fixed || half_edges.size() < 2)
      return;
    collect_flaps(edge, half_edges);
    if (!is_known_)
      require_flaps(edge);
    for (std::size_t k = 0; k < flaps_.size(); ++k) {
      const flap& here = flaps_[k];
      const flap& next = flaps_[(k + 1) % flaps_.size()];
      const int fixed = (is_fixed(here.triangle) ? 1 : 0) + (is_fixed(next.triangle) ? 1 : 0);
      if (here.after == no_id || here.after != next.before || fixed == 2)
        continue; // outside of the domain, or no interface's
      const double turn =
          next.direction - here.direction + (k + 1 == flaps_.size() ? 2 * std::numbers::pi : 0.0);
      collector_.add_dihedral({turn * degrees_per_radian, {here.triangle, next.triangle}, edge}, fixed > 0,
                              cause_of(here.triangle, next.triangle), here.after,
                              midpoint(at(edge[0]), at(edge[1])));
    }
  }

  void collect_flaps(const std::array<local_id, 2>& edge, std::span<const std::uint32_t> half_edges) {
    const vec3 origin = at(edge[0]);
    const vec3 axis = normalized(at(edge[1]) - origin);
    const auto apex = [&](std::uint32_t h) {
      return fine_.sides[h / 3][h % 3];
    }; // side i is opposite vertex i
    const vec3 to_first = at(apex(half_edges[0])) - origin;
    const vec3 x = normalized(to_first - dot(to_first, axis) * axis);
    const vec3 y = cross(axis, x);
    flaps_.clear();
    for (const std::uint32_t h : half_edges) {
      const auto t = static_cast<local_id>(h / 3);
      const vec3 d = at(apex(h)) - origin;
      const auto vertices = pick(fine_.sides[h / 3], numbering::sides<2>[h % 3]);
      // A triangle that passes the edge in the edge's direction has its normal, which points out of
      // subdomains[0], on the counter-clockwise side.
      const auto& both = fine_.subdomains[h / 3];
      const bool along = vertices[0] == edge[0];
      flaps_.push_back({h == half_edges[0] ? 0.0 : std::atan2(dot(d, y), dot(d, x)), t,
                        along ? both[0] : both[1], along ? both[1] : both[0]});
    }
    sort_all(flaps_, [](const flap& a, const flap& b) {
      return std::pair(a.direction, a.triangle) < std::pair(b.direction, b.triangle);
    });
  }

  const fine_skeleton& fine_;
  angle_collector collector_;
  std::span<const std::uint8_t> refused_;
  std::optional<std::span<const std::uint32_t>> half_edges_; ///< all unless given
  bool is_known_;                                            ///< to be valid
  std::vector<flap> flaps_;                                  ///< scratch
};

} // namespace detail

template <int D>
interface_angles measure_interface_angles(const decomposed_mesh<D>& given, const wanted_angles& wanted) {
  return detail::mesh_angles<D>(given, wanted).run();
}

DOVETAIL_INLINE interface_angles measure_skeleton_angles(
    const fine_skeleton& fine, const wanted_angles& wanted, std::span<const std::uint8_t> refused,
    std::optional<std::span<const std::uint32_t>> half_edges, mesh_state skeleton_is, angle_share share) {
  if (share.number >= share.of)
    throw usage_error("measure_skeleton_angles: there is no share " + std::to_string(share.number) + " of " +
                      std::to_string(share.of));
  return detail::skeleton_angles(fine, wanted, refused, half_edges, skeleton_is).run(share);
}

DOVETAIL_INLINE compressed_rows<std::uint32_t> half_edges_of_shares(const fine_skeleton& fine,
                                                                    std::span<const std::uint32_t> half_edges,
                                                                    std::size_t shares) {
  return sorted_into_rows<std::uint32_t>(shares, [&](const auto& put) {
    for (const std::uint32_t h : half_edges)
      put(detail::share_of_edge(fine, h, shares), h);
  });
}

DOVETAIL_INLINE interface_angles joined_shares(std::span<const interface_angles> shares) {
  interface_angles joined;
  const auto keep_smaller = [](least_angle& least, const least_angle& other) {
    const auto order = [](const least_angle& angle) {
      return std::tuple(angle.angle_deg, angle.edge, angle.sides);
    };
    if (order(other) < order(least))
      least = other;
  };
  for (const interface_angles& share : shares) {
    joined.interface_faces += share.interface_faces;
    keep_smaller(joined.face_angle, share.face_angle);
    keep_smaller(joined.interface_dihedral, share.interface_dihedral);
    keep_smaller(joined.surface_dihedral, share.surface_dihedral);
    append(joined.violations, share.violations);
  }
  detail::sort_violations(joined.violations);
  return joined;
}

#ifdef DOVETAIL_COMPILED
template interface_angles measure_interface_angles<2>(const decomposed_mesh<2>&, const wanted_angles&);
template interface_angles measure_interface_angles<3>(const decomposed_mesh<3>&, const wanted_angles&);
#endif

} // namespace dovetail
