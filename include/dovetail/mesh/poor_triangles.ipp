/// @file
/// What `poor_triangles.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/curve_corners.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/mesh/piece_numbers.hpp"
#include "dovetail/mesh/poor_triangles.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE std::string_view name_of_triangles(poor_cause cause) {
  return cause == poor_cause::thin_wall ? "narrow face" : name_of(cause);
}

namespace detail {

/// A triangle with a small angle.
struct poor_triangle {
  std::size_t element;
  std::size_t corner;
  double angle_deg;
};

inline std::vector<poor_triangle> find_poor_triangles(const simplicial_mesh<2>& mesh) {
  std::vector<poor_triangle> found;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto angles = dihedral_angles(corners(span_of(mesh.points), mesh.elements[e]));
    const auto least = std::min_element(angles.begin(), angles.end());
    if (*least < low_corner_deg)
      found.push_back({e, static_cast<std::size_t>(least - angles.begin()), *least});
  }
  return found;
}

/// The sides of a piece at some of its vertices, for questions about single corners.
class sides_at_corners {
public:
  /// Questions will be about the corners of these triangles.
  sides_at_corners(const simplicial_piece<2>& piece, const simplicial_skeleton<2>& skeleton,
                   std::span<const local_id> listed, const std::vector<poor_triangle>& poor)
      : mesh_(piece.mesh) {
    std::vector<std::uint8_t> is_asked(mesh_.points.size(), 0);
    for (const poor_triangle& one : poor)
      is_asked[mesh_.elements[one.element][one.corner]] = 1;
    const auto curves = curves_of_sides(piece, skeleton, listed);
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e)
      for (std::size_t k = 0; k < 3; ++k) {
        const local_id v = mesh_.elements[e][k];
        if (!is_asked[v])
          continue;
        for (const std::size_t other : {(k + 1) % 3, (k + 2) % 3}) {
          const local_id end = mesh_.elements[e][other];
          const auto edge = sorted_vertices(simplex<1>{v, end});
          const auto known = std::lower_bound(curves.begin(), curves.end(), edge,
                                              [](const auto& s, const auto& key) { return s.edge < key; });
          if (known != curves.end() && known->edge == edge)
            sides_.push_back({v, tag_of(e), end, known->curve != no_id});
        }
      }
    sort_unique(sides_);
  }

  /// The angle between the two sides that the smallest angle of a triangle is between, on its face, and
  /// whether both are on curves of the model. 360 where there are less than two.
  struct sector {
    double degrees = 360;
    bool on_curves = false;
  };
  sector sector_of(const poor_triangle& one) const {
    const auto& element = mesh_.elements[one.element];
    const auto p = corners(span_of(mesh_.points), element);
    const vec3 at = p[one.corner];
    const vec3 normal = normalized(cross(p[1] - p[0], p[2] - p[0]));
    const vec3 ahead = normalized(0.5 * (p[(one.corner + 1) % 3] + p[(one.corner + 2) % 3]) - at);
    const vec3 left = cross(normal, ahead);
    const side key{element[one.corner], tag_of(one.element), -1, false};
    double least = std::numeric_limits<double>::infinity(), most = -least;
    bool is_curve_left = false, is_curve_right = false;
    for (auto s = std::lower_bound(sides_.begin(), sides_.end(), key);
         s != sides_.end() && s->vertex == key.vertex && s->face == key.face; ++s) {
      const vec3 way = mesh_.points[s->end] - at;
      const double turn = degrees_per_radian * std::atan2(dot(way, left), dot(way, ahead));
      if (turn >= 0 && turn < least) {
        least = turn;
        is_curve_left = s->is_curve;
      }
      if (turn < 0 && turn > most) {
        most = turn;
        is_curve_right = s->is_curve;
      }
    }
    return least - most < 360 ? sector{least - most, is_curve_left && is_curve_right} : sector{};
  }

private:
  struct side {
    local_id vertex;
    local_id face;
    local_id end;
    bool is_curve;

    auto operator<=>(const side&) const = default;
  };
  struct curve_of_side {
    simplex<1> edge; ///< in the numbers of the piece, ascending
    local_id curve;
  };

  local_id tag_of(std::size_t e) const { return mesh_.tags.empty() ? 0 : mesh_.tags[e]; }

  static std::vector<curve_of_side> curves_of_sides(const simplicial_piece<2>& piece,
                                                    const simplicial_skeleton<2>& skeleton,
                                                    std::span<const local_id> listed) {
    const piece_numbers numbers(piece.skeleton_points);
    std::vector<curve_of_side> curves;
    for (const local_id s : listed) {
      const auto& [a, b] = skeleton.sides[s];
      curves.push_back({sorted_vertices(simplex<1>{numbers[a], numbers[b]}), skeleton.side_hosts[s]});
    }
    sort_all(curves, [](const auto& a, const auto& b) { return a.edge < b.edge; });
    return curves;
  }

  const simplicial_mesh<2>& mesh_;
  std::vector<side> sides_;
};

/// By vertex of a piece: whether it is where a face is narrow, on a curve of the model, or inside, of one of
/// these triangles, and joined to two at most that are not on one.
inline std::vector<std::uint8_t> vertices_in_strips(const simplicial_piece<2>& piece,
                                                    const simplicial_skeleton<2>& skeleton,
                                                    const std::vector<poor_triangle>& poor) {
  constexpr std::uint8_t elsewhere = 0, in_strip = 1, asked = 2;
  const simplicial_mesh<2>& mesh = piece.mesh;
  std::vector<std::uint8_t> state(mesh.points.size(), elsewhere);
  for (std::size_t v = 0; v < piece.skeleton_points.size(); ++v)
    if (skeleton.point_hosts[piece.skeleton_points[v]].dimension < 2)
      state[v] = in_strip;
  const auto shared = static_cast<local_id>(piece.skeleton_points.size());
  for (const poor_triangle& one : poor)
    for (const local_id v : mesh.elements[one.element])
      if (v >= shared)
        state[v] = asked;
  std::vector<std::array<local_id, 2>> joined; // to an asked one, neither on a curve
  for (const simplex<2>& element : mesh.elements)
    for (const local_id v : element)
      for (const local_id other : element)
        if (other != v && state[v] == asked && state[other] != in_strip)
          joined.push_back({v, other});
  sort_unique(joined);
  std::vector<int> count(mesh.points.size(), 0);
  for (const auto& pair : joined)
    ++count[pair[0]];
  for (std::size_t v = 0; v < state.size(); ++v)
    if (state[v] == asked)
      state[v] = count[v] <= 2 ? in_strip : elsewhere;
  return state;
}

/// The corners of curves that a piece's triangles show.
inline curve_corners corners_of_curves(const simplicial_piece<2>& piece,
                                       const simplicial_skeleton<2>& skeleton) {
  std::vector<host> hosts;
  for (const local_id v : piece.skeleton_points)
    hosts.push_back(skeleton.point_hosts[v]);
  std::vector<face_triangle> triangles;
  for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e)
    triangles.push_back({piece.mesh.elements[e], piece.mesh.tags.empty() ? 0 : piece.mesh.tags[e]});
  return {piece.mesh.points, std::move(hosts), triangles, 2 * bad_corner_deg};
}

/// The cause for one triangle whose smallest angle is below a limit.
/// \param in_strips as `vertices_in_strips` gives them
inline poor_cause cause_of(const simplicial_piece<2>& piece, const std::vector<std::uint8_t>& in_strips,
                           const sides_at_corners& sides, const curve_corners& in_corners,
                           const poor_triangle& one, double limit_deg) {
  if (const auto sector = sides.sector_of(one); sector.degrees < 2 * limit_deg)
    return sector.on_curves ? poor_cause::model_angle : poor_cause::interface_angle;
  const auto& element = piece.mesh.elements[one.element];
  if (in_corners.hold(element, 1))
    return poor_cause::model_angle;
  if (std::all_of(element.begin(), element.end(), [&](local_id v) { return in_strips[v] == 1; }))
    return poor_cause::thin_wall;
  const auto shared = static_cast<local_id>(piece.skeleton_points.size());
  return std::all_of(element.begin(), element.end(), [&](local_id v) { return v < shared; })
             ? poor_cause::thin_piece
             : poor_cause::inside;
}

/// The height of a triangle over its longest side.
inline double least_height(const std::array<vec3, 3>& p) {
  const double longest = std::max({distance(p[0], p[1]), distance(p[1], p[2]), distance(p[2], p[0])});
  return longest > 0 ? norm(cross(p[1] - p[0], p[2] - p[0])) / longest : 0;
}

} // namespace detail

DOVETAIL_INLINE poor_elements find_poor_elements(const simplicial_piece<2>& piece,
                                                 const simplicial_skeleton<2>& skeleton,
                                                 std::span<const local_id> listed) {
  poor_elements result;
  const auto found = detail::find_poor_triangles(piece.mesh);
  if (found.empty())
    return result;
  const detail::sides_at_corners sides(piece, skeleton, listed, found);
  const auto in_corners = detail::corners_of_curves(piece, skeleton);
  const auto in_strips = detail::vertices_in_strips(piece, skeleton, found);
  for (const detail::poor_triangle& one : found) {
    const bool is_bad = one.angle_deg < bad_corner_deg;
    const poor_cause cause =
        detail::cause_of(piece, in_strips, sides, in_corners, one, is_bad ? bad_corner_deg : low_corner_deg);
    const auto k = static_cast<std::size_t>(cause);
    ++result.low[k];
    if (!is_bad)
      continue;
    ++result.bad[k];
    if (cause != poor_cause::thin_wall)
      continue;
    const auto p = corners(span_of(piece.mesh.points), piece.mesh.elements[one.element]);
    poor_elements narrow;
    narrow.thinnest_wall = detail::least_height(p);
    narrow.thinnest_place = (1.0 / 3) * (p[0] + p[1] + p[2]);
    result.merge(narrow);
  }
  return result;
}

} // namespace dovetail
