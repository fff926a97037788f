/// @file
/// What `transfer.hpp` declares.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/solver/transfer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// The elements of a mesh by where they are.
template <int D>
class element_places {
public:
  using corners = std::array<vec3, D + 1>;

  /// The nearest point of the mesh: weights of the element's corners.
  struct place {
    local_id element = no_id;
    std::array<double, D + 1> weights{};
    double distance_squared = std::numeric_limits<double>::infinity();
  };

  explicit element_places(const simplicial_mesh<D>& mesh) : mesh_(mesh) {
    if (mesh.elements.empty())
      throw mesh_error("fields cannot be transferred: a mesh has no elements");
    const auto points = static_cast<local_id>(mesh.points.size());
    std::vector<box3> boxes;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      box3 box;
      for (const local_id v : mesh.elements[e]) {
        if (v < 0 || v >= points)
          throw mesh_error("fields cannot be transferred: element " + std::to_string(e) +
                           " names a point that does not exist");
        box.include(mesh.points[v]);
      }
      boxes.push_back(box);
    }
    tree_ = box_tree(boxes);
  }

  const simplicial_mesh<D>& mesh() const { return mesh_; }
  const box_tree& tree() const { return tree_; }

  corners corners_of(local_id e) const {
    corners at;
    for (std::size_t i = 0; i < at.size(); ++i)
      at[i] = mesh_.points[mesh_.elements[e][i]];
    return at;
  }

  vec3 centre_of(local_id e) const {
    vec3 sum;
    for (const vec3 p : corners_of(e))
      sum = sum + p;
    return (1.0 / (D + 1)) * sum;
  }

  /// Of those elements that `accepts(element)`; of several the one with the smallest number.
  template <class Accepts>
  place nearest(vec3 p, const Accepts& accepts) const {
    place best;
    tree_.for_each_near(
        p, [&](const box3& box, std::size_t) { return distance_squared(box, p) <= best.distance_squared; },
        [&](local_id e) {
          if (!accepts(e))
            return;
          const place here = nearest_of(e, p);
          if (here.distance_squared < best.distance_squared ||
              (here.distance_squared == best.distance_squared && e < best.element))
            best = here;
        });
    return best;
  }

private:
  place nearest_of(local_id e, vec3 p) const {
    const corners at = corners_of(e);
    place best{e, {}, {}};
    if constexpr (D == 2) {
      best.weights = nearest_on_triangle(at[0], at[1], at[2], p);
      best.distance_squared = squared_distance(at, best.weights, p);
    } else {
      const double whole = signed_volume(at[0], at[1], at[2], at[3]);
      best.weights = {
          signed_volume(p, at[1], at[2], at[3]) / whole, signed_volume(at[0], p, at[2], at[3]) / whole,
          signed_volume(at[0], at[1], p, at[3]) / whole, signed_volume(at[0], at[1], at[2], p) / whole};
      if (std::all_of(best.weights.begin(), best.weights.end(), [](double w) { return w >= 0; })) {
        best.distance_squared = 0;
        return best;
      }
      best.distance_squared = std::numeric_limits<double>::infinity(); // also where it is flat
      for (std::size_t apex = 0; apex < 4; ++apex) {
        std::array<std::size_t, 3> side;
        for (std::size_t i = 0, k = 0; i < 4; ++i)
          if (i != apex)
            side[k++] = i;
        const auto on_side = nearest_on_triangle(at[side[0]], at[side[1]], at[side[2]], p);
        std::array<double, 4> weights{};
        for (std::size_t i = 0; i < 3; ++i)
          weights[side[i]] = on_side[i];
        if (const double away = squared_distance(at, weights, p); away < best.distance_squared) {
          best.distance_squared = away;
          best.weights = weights;
        }
      }
    }
    return best;
  }

  static double squared_distance(const corners& at, const std::array<double, D + 1>& weights, vec3 p) {
    vec3 q;
    for (std::size_t i = 0; i < at.size(); ++i)
      q = q + weights[i] * at[i];
    return dot(p - q, p - q);
  }

  const simplicial_mesh<D>& mesh_;
  box_tree tree_;
};

inline double measure_of(const std::array<vec3, 4>& t) {
  return std::abs(signed_volume(t[0], t[1], t[2], t[3]));
}
inline double measure_of(const std::array<vec3, 3>& t) {
  return 0.5 * norm(cross(t[1] - t[0], t[2] - t[0]));
}

/// The volume of the part of `t` that is inside of the sides of `cut` from side `k` on. What one side leaves
/// of a tetrahedron is at most three.
inline double volume_inside(const std::array<vec3, 4>& t, const std::array<vec3, 4>& cut, std::size_t k) {
  if (k == 4)
    return measure_of(t);
  const vec3 a = cut[(k + 1) % 4], b = cut[(k + 2) % 4], c = cut[(k + 3) % 4];
  const double inner = signed_volume(cut[k], a, b, c);
  std::array<double, 4> height;
  std::array<std::size_t, 4> order{}; // those inside first
  std::size_t inside = 0, outside = 4;
  for (std::size_t i = 0; i < 4; ++i) {
    height[i] = inner > 0 ? signed_volume(t[i], a, b, c) : -signed_volume(t[i], a, b, c);
    order[height[i] > 0 ? inside++ : --outside] = i;
  }
  if (inside == 0)
    return 0;
  if (inside == 4)
    return volume_inside(t, cut, k + 1);
  const auto corner = [&](std::size_t i) { return t[order[i]]; };
  const auto between = [&](std::size_t i, std::size_t j) { // where an edge from inside to outside is cut
    const double share = height[order[i]] / (height[order[i]] - height[order[j]]);
    return (1 - share) * corner(i) + share * corner(j);
  };
  const auto of = [&](vec3 p, vec3 q, vec3 r, vec3 s) { return volume_inside({p, q, r, s}, cut, k + 1); };
  if (inside == 1)
    return of(corner(0), between(0, 1), between(0, 2), between(0, 3));
  // A prism with the triangles (p0 p1 p2) and (q0 q1 q2), p over q.
  const auto of_prism = [&](const std::array<vec3, 3>& p, const std::array<vec3, 3>& q) {
    return of(p[0], p[1], p[2], q[0]) + of(p[1], p[2], q[0], q[1]) + of(p[2], q[0], q[1], q[2]);
  };
  if (inside == 2)
    return of_prism({corner(0), between(0, 2), between(0, 3)}, {corner(1), between(1, 2), between(1, 3)});
  return of_prism({corner(0), corner(1), corner(2)}, {between(0, 3), between(1, 3), between(2, 3)});
}

inline double overlap_of(const std::array<vec3, 4>& a, const std::array<vec3, 4>& b) {
  return volume_inside(a, b, 0);
}

/// Of `a`, projected along the normal of `b`; none where it faces the other way, as the other side of a sheet
/// does.
inline double overlap_of(const std::array<vec3, 3>& a, const std::array<vec3, 3>& b) {
  const vec3 normal = cross(b[1] - b[0], b[2] - b[0]);
  const double length = norm(normal);
  if (!(dot(normal, cross(a[1] - a[0], a[2] - a[0])) > 0))
    return 0;
  std::vector<vec3> polygon;
  for (const vec3 p : a)
    polygon.push_back(p - (dot(p - b[0], normal) / (length * length)) * normal);
  for (std::size_t k = 0; k < 3 && !polygon.empty(); ++k) {
    const vec3 inwards = cross(normal, b[(k + 1) % 3] - b[k]);
    std::vector<vec3> left;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const vec3 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
      const double of_p = dot(p - b[k], inwards), of_q = dot(q - b[k], inwards);
      if (of_p >= 0)
        left.push_back(p);
      if ((of_p >= 0) != (of_q >= 0))
        left.push_back(p + (of_p / (of_p - of_q)) * (q - p));
    }
    polygon = std::move(left);
  }
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice += dot(cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]), normal) / length;
  return std::max(0.0, 0.5 * twice);
}

/// How much of an element of the new mesh is an old one's.
struct element_share {
  local_id old_element;
  local_id new_element;
  double measure;
};

/// Shares of all elements of the new mesh, in their order, so that each is shared out whole.
template <int D>
std::vector<element_share> element_shares(const element_places<D>& old_mesh, const simplicial_mesh<D>& mesh,
                                          const element_places<D>& new_mesh) {
  const auto& old_tags = old_mesh.mesh().tags;
  const bool by_tag = !old_tags.empty() && !mesh.tags.empty();
  std::vector<element_share> shares;
  for (std::size_t n = 0; n < mesh.elements.size(); ++n) {
    const auto id = static_cast<local_id>(n);
    const auto corners = new_mesh.corners_of(id);
    const double whole = measure_of(corners);
    if (!(whole > 0))
      throw mesh_error("fields cannot be transferred: element " + std::to_string(n) + " is flat");
    const auto is_of_tag = [&](local_id o) { return !by_tag || old_tags[o] == mesh.tags[n]; };
    box3 box;
    for (const vec3 p : corners)
      box.include(p);
    if (D == 2) { // chords of a curved surface lie beside each other
      const vec3 margin = (0.1 * box.diagonal()) * vec3{1, 1, 1};
      box.lower = box.lower - margin;
      box.upper = box.upper + margin;
    }
    const auto first = static_cast<std::ptrdiff_t>(shares.size());
    old_mesh.tree().for_each([&](const box3& other, std::size_t) { return other.overlaps(box); },
                             [&](local_id o) {
                               if (!is_of_tag(o))
                                 return;
                               const double common = overlap_of(old_mesh.corners_of(o), corners);
                               if (common > 1e-14 * whole)
                                 shares.push_back({o, id, common});
                             });
    std::sort(shares.begin() + first, shares.end(),
              [](const auto& a, const auto& b) { return a.old_element < b.old_element; });
    double covered = 0;
    for (auto s = shares.begin() + first; s != shares.end(); ++s)
      covered += s->measure;
    if (covered > (1 - 1e-12) * whole)
      continue;
    auto nearest = old_mesh.nearest(new_mesh.centre_of(id), is_of_tag);
    if (nearest.element == no_id)
      nearest = old_mesh.nearest(new_mesh.centre_of(id), [](local_id) { return true; });
    shares.push_back({nearest.element, id, whole - covered});
  }
  return shares;
}

template <int D>
void require_values(std::span<const double> values, std::size_t wanted, int components, const char* what) {
  if (components < 1 || values.size() != wanted * static_cast<std::size_t>(components))
    throw mesh_error("fields cannot be transferred: there are " + std::to_string(values.size()) +
                     " values for " + std::to_string(wanted) + " " + what + "s with " +
                     std::to_string(components) + " each");
  const auto bad = std::find_if_not(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  if (bad != values.end())
    throw mesh_error("fields cannot be transferred: a value of " + std::string(what) + " " +
                     std::to_string((bad - values.begin()) / components) +
                     " is not finite; give it one, or leave the field out");
}

} // namespace detail

template <int D>
std::vector<double> transferred_to_points(const simplicial_mesh<D>& from, std::span<const double> values,
                                          std::span<const vec3> to, int components) {
  detail::require_values<D>(values, from.points.size(), components, "point");
  const detail::element_places<D> places(from);
  const auto count = static_cast<std::size_t>(components);
  std::vector<double> result(to.size() * count, 0);
  for (std::size_t p = 0; p < to.size(); ++p) {
    const auto at = places.nearest(to[p], [](local_id) { return true; });
    if (at.element == no_id)
      throw mesh_error("fields cannot be transferred: point " + std::to_string(p) + " is at " +
                       place_text(to[p]) + "; give finite coordinates");
    const auto& element = from.elements[at.element];
    for (std::size_t i = 0; i < element.size(); ++i)
      for (std::size_t c = 0; c < count; ++c)
        result[p * count + c] += at.weights[i] * values[static_cast<std::size_t>(element[i]) * count + c];
  }
  return result;
}

template <int D>
std::vector<double> transferred_to_elements(const simplicial_mesh<D>& from, std::span<const double> values,
                                            const simplicial_mesh<D>& to, int components) {
  detail::require_values<D>(values, from.elements.size(), components, "element");
  const detail::element_places<D> old_mesh(from), new_mesh(to);
  auto shares = detail::element_shares(old_mesh, to, new_mesh);

  std::vector<double> given(from.elements.size(), 0); // to how much of the new mesh an old element gives
  for (const auto& share : shares)
    given[share.old_element] += share.measure;
  for (std::size_t o = 0; o < given.size(); ++o) { // what is outside of the new mesh
    if (given[o] > 0)
      continue;
    const auto id = static_cast<local_id>(o);
    const bool by_tag = !from.tags.empty() && !to.tags.empty();
    auto nearest = new_mesh.nearest(old_mesh.centre_of(id),
                                    [&](local_id n) { return !by_tag || to.tags[n] == from.tags[o]; });
    if (nearest.element == no_id)
      nearest = new_mesh.nearest(old_mesh.centre_of(id), [](local_id) { return true; });
    shares.push_back({id, nearest.element, 1});
    given[o] = 1;
  }

  const auto count = static_cast<std::size_t>(components);
  std::vector<double> result(to.elements.size() * count, 0);
  for (const auto& [old_element, new_element, measure] : shares) {
    const auto o = static_cast<std::size_t>(old_element), n = static_cast<std::size_t>(new_element);
    const double part = detail::measure_of(old_mesh.corners_of(old_element)) * (measure / given[o]) /
                        detail::measure_of(new_mesh.corners_of(new_element));
    for (std::size_t c = 0; c < count; ++c)
      result[n * count + c] += part * values[o * count + c];
  }
  return result;
}

#ifdef DOVETAIL_COMPILED
template std::vector<double> transferred_to_points(const simplicial_mesh<2>&, std::span<const double>,
                                                   std::span<const vec3>, int);
template std::vector<double> transferred_to_points(const simplicial_mesh<3>&, std::span<const double>,
                                                   std::span<const vec3>, int);
template std::vector<double> transferred_to_elements(const simplicial_mesh<2>&, std::span<const double>,
                                                     const simplicial_mesh<2>&, int);
template std::vector<double> transferred_to_elements(const simplicial_mesh<3>&, std::span<const double>,
                                                     const simplicial_mesh<3>&, int);
#endif

} // namespace dovetail
