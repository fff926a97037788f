/// @file
/// What the boundary of a piece is like around its elements: small angles between its faces and curves, and
/// walls.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/curve_corners.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/mesh/piece_numbers.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// The boundary triangles of a piece at its edges, for questions about single elements.
class boundary_at_edges {
public:
  /// Questions will be about these elements of the piece; angles of the model are small below a limit, in
  /// degrees.
  boundary_at_edges(const mesh_piece& piece, const fine_skeleton& skeleton, std::span<const local_id> listed,
                    std::span<const simplex<3>> elements, double small_deg)
      : small_deg_(small_deg), states_(states_of_vertices(piece, skeleton, elements)),
        curve_corners_(corners_of_curves(piece, skeleton, listed, small_deg)) {
    const piece_numbers numbers(piece.skeleton_points);
    for (const local_id s : listed) {
      const auto side = static_cast<std::size_t>(s);
      const local_id face = skeleton.side_hosts[side];
      const auto& t = skeleton.sides[side];
      const double angle = smallest_corner_angle(corners(std::span<const vec3>(skeleton.points), t));
      simplex<2> own;
      for (std::size_t k = 0; k < 3; ++k)
        own[k] = numbers[t[k]];
      triangles_.push_back({sorted_vertices(own), angle, face});
      for (std::size_t k = 0; k < 3; ++k)
        flaps_.push_back(
            {sorted_vertices(simplex<1>{own[(k + 1) % 3], own[(k + 2) % 3]}), skeleton.points[t[k]], face});
      if (face != no_id)
        for (const local_id v : own)
          faces_of_vertices_.push_back({v, face});
    }
    sort_all(triangles_, [](const triangle& a, const triangle& b) { return a.vertices < b.vertices; });
    stable_sort_all(flaps_, [](const flap& a, const flap& b) { return a.edge < b.edge; });
    sort_unique(faces_of_vertices_);
    add_faces_around(piece);
    find_wedges(piece);
    const std::vector<turn> turns = turns_of_faces();
    find_touching(piece, turns);
    sort_unique(wedges_);
    find_corners(piece, turns);
  }

  /// Whether the element is between surfaces: each of its vertices is on the model's surface, or inside and
  /// joined to two at most that are not.
  bool is_in_wall(const simplex<3>& element) const {
    return all_are(element, [](state s) { return s == state::on_surface || s == state::inside_wall; });
  }

  /// Whether the element has vertices at two faces of the model that meet or touch, somewhere on this
  /// boundary, in a small angle: what is between them is thin for that. Vertices of interfaces may be between
  /// them too, if joined to two at most of this piece that are not on the surface.
  bool is_in_wedge(const simplex<3>& element) const {
    return all_are(element, [](state s) { return s != state::elsewhere; }) && is_at_wedge(element);
  }

  /// Whether the boundary triangle with these vertices is between two curves of its face that meet, somewhere
  /// on this boundary, in a small angle. Curves are known by their numbers, or by the faces beyond them.
  bool is_in_corner(const simplex<2>& side) const {
    if (curve_corners_.hold(side, 1))
      return true;
    const auto found = find_triangle(side);
    if (found == triangles_.end())
      return false;
    return std::any_of(corners_.begin(), corners_.end(), [&](const corner& one) {
      return one.face == found->face && touches(side, one.beyond[0]) && touches(side, one.beyond[1]);
    });
  }

  /// Whether the element goes across such a corner, where that is narrow beside the element's length.
  bool is_across_corner(const simplex<3>& element) const {
    constexpr double narrow = 0.4; // about the sine of a small angle
    return curve_corners_.hold(element, narrow);
  }

  /// The smallest angle between boundary triangles at the edge from p to q that has the place `within` in it,
  /// in degrees, and whether both are on the surface. 360 where there is none.
  struct sector {
    double degrees = 360;
    bool on_surface = false;
  };
  sector sector_at(const simplex<1>& edge, vec3 p, vec3 q, vec3 within) const {
    const std::span<const flap> around = flaps_at(edge);
    const auto across = [&](vec3 place) { return off_line(place, p, q - p); };
    const vec3 middle = across(within);
    sector found;
    for (auto a = around.begin(); a != around.end(); ++a)
      for (auto b = a + 1; b != around.end(); ++b) {
        const double between = degrees(across(a->tip), across(b->tip));
        const double by_way = degrees(across(a->tip), middle) + degrees(middle, across(b->tip));
        if (between < found.degrees && by_way < between + rounding_deg)
          found = {between, a->face != no_id && b->face != no_id};
      }
    return found;
  }

  /// The smallest angle of the boundary triangle with these vertices, in degrees; 180 where there is none.
  double smallest_angle(const simplex<2>& side) const {
    const auto found = find_triangle(side);
    return found != triangles_.end() ? found->angle_deg : 180;
  }

private:
  static constexpr double rounding_deg = 1e-6;
  /// Where a vertex is.
  enum class state : std::uint8_t {
    elsewhere,
    on_surface,       ///< of the model
    inside_wall,      ///< joined to few that are not on it
    interface_in_wall ///< the same, of an interface
  };
  struct triangle {
    simplex<2> vertices; ///< sorted, of the piece
    double angle_deg;
    local_id face; ///< of the model, or no_id
  };
  /// A triangle as seen from one of its edges.
  struct flap {
    simplex<1> edge; ///< sorted, of the piece
    vec3 tip;        ///< the vertex opposite to it
    local_id face;   ///< of the model, or no_id
  };
  /// A corner of a triangle on a face of the model.
  struct turn {
    local_id vertex, face;
    std::array<local_id, 2> others;
  };
  /// Where two curves of a face meet in a small angle.
  struct corner {
    local_id face;
    std::array<local_id, 2> beyond; ///< the faces on the other sides of the curves
    auto operator<=>(const corner&) const = default;
  };

  template <class Holds>
  bool all_are(const simplex<3>& element, const Holds& holds) const {
    return std::all_of(element.begin(), element.end(), [&](local_id v) { return holds(states_[v]); });
  }
  bool is_at_wedge(const simplex<3>& element) const {
    return std::any_of(wedges_.begin(), wedges_.end(), [&](const auto& pair) {
      const auto [first, second] = pair;
      return touches(element, first) && touches(element, second);
    });
  }

  std::span<const flap> flaps_at(const simplex<1>& edge) const {
    const auto [first, last] =
        std::equal_range(flaps_.begin(), flaps_.end(), flap{sorted_vertices(edge), {}, no_id},
                         [](const flap& a, const flap& b) { return a.edge < b.edge; });
    return {first, last};
  }

  bool touches(std::span<const local_id> vertices, local_id face) const {
    return std::any_of(vertices.begin(), vertices.end(), [&](local_id v) {
      return std::binary_search(faces_of_vertices_.begin(), faces_of_vertices_.end(), std::pair(v, face));
    });
  }

  /// The end where there is none.
  std::vector<triangle>::const_iterator find_triangle(const simplex<2>& side) const {
    const simplex<2> wanted = sorted_vertices(side);
    const auto found =
        std::lower_bound(triangles_.begin(), triangles_.end(), wanted,
                         [](const triangle& a, const simplex<2>& b) { return a.vertices < b; });
    return found != triangles_.end() && found->vertices == wanted ? found : triangles_.end();
  }

  static curve_corners corners_of_curves(const mesh_piece& piece, const fine_skeleton& skeleton,
                                         std::span<const local_id> listed, double small_deg) {
    std::vector<host> hosts;
    for (const local_id v : piece.skeleton_points)
      hosts.push_back(skeleton.point_hosts[v]);
    const piece_numbers numbers(piece.skeleton_points);
    std::vector<face_triangle> triangles;
    for (const local_id s : listed)
      if (skeleton.side_hosts[s] != no_id) {
        const auto& t = skeleton.sides[s];
        triangles.push_back({{numbers[t[0]], numbers[t[1]], numbers[t[2]]}, skeleton.side_hosts[s]});
      }
    return {piece.mesh.points, std::move(hosts), triangles, small_deg};
  }

  /// From a line, at a right angle, to a place.
  static vec3 off_line(vec3 place, vec3 on_line, vec3 direction) {
    const vec3 d = place - on_line;
    return d - dot(d, direction) / norm_squared(direction) * direction;
  }
  static double degrees(vec3 a, vec3 b) {
    return degrees_per_radian * std::atan2(norm(cross(a, b)), dot(a, b));
  }

  /// Of the vertices on the model's surface, and of those others of the elements that are joined to few of
  /// the piece that are not on it.
  static std::vector<state> states_of_vertices(const mesh_piece& piece, const fine_skeleton& skeleton,
                                               std::span<const simplex<3>> elements) {
    constexpr std::ptrdiff_t most_beside = 2; // a layer between two surfaces has more, a chain has not
    const auto shared = static_cast<local_id>(piece.skeleton_points.size());
    std::vector<state> states(piece.mesh.points.size(), state::elsewhere);
    for (local_id v = 0; v < shared; ++v)
      if (skeleton.point_hosts[piece.skeleton_points[v]].dimension < 3)
        states[v] = state::on_surface;
    std::vector<bool> asked(piece.mesh.points.size(), false);
    for (const simplex<3>& element : elements)
      for (const local_id v : element)
        asked[v] = states[v] != state::on_surface;
    std::vector<std::pair<local_id, local_id>> beside; // a vertex, another one that is not on the surface
    for (const simplex<3>& element : piece.mesh.elements)
      for (const local_id v : element)
        for (const local_id other : element)
          if (asked[v] && other != v && states[other] != state::on_surface)
            beside.push_back({v, other});
    sort_unique(beside);
    for (auto first = beside.begin(), last = first; first != beside.end(); first = last) {
      last = std::find_if(first, beside.end(), [&](const auto& pair) { return pair.first != first->first; });
      asked[first->first] = last - first <= most_beside;
    }
    for (local_id v = 0; v < static_cast<local_id>(asked.size()); ++v)
      if (asked[v])
        states[v] = v < shared ? state::interface_in_wall : state::inside_wall;
    return states;
  }

  /// A vertex between the surfaces of a wall is at the faces of those that it is joined to.
  void add_faces_around(const mesh_piece& piece) {
    const auto on_faces = faces_of_vertices_;
    const auto faces_at = [&](local_id v) {
      const auto first = std::lower_bound(on_faces.begin(), on_faces.end(), std::pair(v, no_id));
      return std::span(first,
                       std::find_if(first, on_faces.end(), [&](const auto& at) { return at.first != v; }));
    };
    for (const simplex<3>& element : piece.mesh.elements)
      for (const local_id between : element) {
        if (states_[between] == state::elsewhere || !faces_at(between).empty())
          continue;
        for (const local_id v : element)
          for (const auto& at : faces_at(v))
            faces_of_vertices_.push_back({between, at.second});
      }
    sort_unique(faces_of_vertices_);
  }

  void find_wedges(const mesh_piece& piece) {
    for (std::size_t first = 0, last = 0; first < flaps_.size(); first = last) {
      const simplex<1> edge = flaps_[first].edge;
      while (last < flaps_.size() && flaps_[last].edge == edge)
        ++last;
      const vec3 p = piece.mesh.points[edge[0]], axis = piece.mesh.points[edge[1]] - p;
      for (std::size_t a = first; a < last; ++a)
        for (std::size_t b = a + 1; b < last; ++b) {
          const auto [lower, upper] = std::minmax(flaps_[a].face, flaps_[b].face);
          if (lower != no_id && lower != upper &&
              degrees(off_line(flaps_[a].tip, p, axis), off_line(flaps_[b].tip, p, axis)) < small_deg_)
            wedges_.push_back({lower, upper});
        }
    }
  }

  /// The corners of triangles of the model's faces, by vertex and face.
  std::vector<turn> turns_of_faces() const {
    std::vector<turn> turns;
    for (const triangle& t : triangles_)
      for (std::size_t k = 0; k < 3 && t.face != no_id; ++k)
        turns.push_back({t.vertices[k], t.face, {t.vertices[(k + 1) % 3], t.vertices[(k + 2) % 3]}});
    stable_sort_all(turns, [](const turn& a, const turn& b) {
      return std::pair(a.vertex, a.face) < std::pair(b.vertex, b.face);
    });
    return turns;
  }

  /// Faces that touch at a vertex, a sphere in another for example, meet in a small angle, though at no edge.
  void find_touching(const mesh_piece& piece, std::span<const turn> turns) {
    for (auto first = turns.begin(), last = first; first != turns.end(); first = last) {
      last = std::find_if(first, turns.end(), [&](const turn& t) { return t.vertex != first->vertex; });
      if (first->face == std::prev(last)->face)
        continue;
      for (auto a = first; a != last; ++a)
        for (auto b = a + 1; b != last; ++b)
          if (a->face != b->face && (is_above(piece, *a, *b) || is_above(piece, *b, *a)))
            wedges_.push_back({a->face, b->face});
    }
  }
  /// Whether the middle of a corner is over another one of the same vertex, and in a small angle to it.
  bool is_above(const mesh_piece& piece, const turn& upper, const turn& lower) const {
    const vec3 p = piece.mesh.points[upper.vertex];
    const auto towards = [&](local_id v) { return normalized(piece.mesh.points[v] - p); };
    const vec3 middle = towards(upper.others[0]) + towards(upper.others[1]);
    const vec3 a = towards(lower.others[0]), b = towards(lower.others[1]);
    const vec3 normal = cross(a, b);
    const vec3 below = off_line(middle, {}, normal);
    return dot(cross(a, below), normal) > 0 && dot(cross(below, b), normal) > 0 &&
           degrees(middle, below) < small_deg_;
  }

  /// The angles of a face's triangles at a vertex sum up to the angle of its boundary there. Where the sum is
  /// small, and two curves begin at the vertex, there is a corner.
  void find_corners(const mesh_piece& piece, std::span<const turn> turns) {
    for (auto first = turns.begin(), last = first; first != turns.end(); first = last) {
      last = std::find_if(first, turns.end(),
                          [&](const turn& t) { return t.vertex != first->vertex || t.face != first->face; });
      double turned = 0;
      std::vector<local_id> ends;
      for (auto at = first; at != last; ++at) {
        const vec3 p = piece.mesh.points[at->vertex];
        turned += degrees(piece.mesh.points[at->others[0]] - p, piece.mesh.points[at->others[1]] - p);
        ends.insert(ends.end(), at->others.begin(), at->others.end());
      }
      if (turned < small_deg_)
        add_corners(first->vertex, first->face, std::move(ends));
    }
    sort_unique(corners_);
  }

  void add_corners(local_id vertex, local_id face, std::vector<local_id> ends) {
    sort_unique(ends);
    std::vector<local_id> beyond; // with repetition: one face may be beyond both curves
    for (const local_id end : ends)
      for (const flap& one : flaps_at(simplex<1>{vertex, end}))
        if (one.face != face)
          beyond.push_back(one.face);
    for (std::size_t a = 0; a < beyond.size(); ++a)
      for (std::size_t b = a + 1; b < beyond.size(); ++b)
        corners_.push_back({face, {beyond[a], beyond[b]}});
  }

  double small_deg_;
  std::vector<state> states_; ///< of each vertex of the elements
  std::vector<triangle> triangles_;
  std::vector<flap> flaps_;
  std::vector<std::pair<local_id, local_id>> faces_of_vertices_; ///< vertex, face
  std::vector<std::pair<local_id, local_id>> wedges_; ///< faces that meet or touch in a small angle
  std::vector<corner> corners_;
  curve_corners curve_corners_;
};

} // namespace dovetail::detail
