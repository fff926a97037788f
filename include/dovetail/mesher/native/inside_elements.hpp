/// @file
/// The elements of a triangulation that lie inside the oriented triangles of a boundary.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/mesher/boundary_sides.hpp"
#include "dovetail/triangulation/triangulation.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dovetail {

namespace detail {

/// Tells the inside of a boundary from its outside, from the triangles to the elements beside them and on.
class inside_flood {
public:
  inside_flood(const triangulation<3>& mesh, const boundary_sides& boundary, local_id given_points)
      : mesh_(mesh), boundary_(boundary), given_points_(given_points),
        place_(mesh.cells.size(), place::unknown), walls_(mesh.cells.size(), 0) {}

  /// Per element, whether it is inside. Throws `mesher_error` when a triangle is no side of an element, or
  /// the boundary contradicts itself.
  std::vector<char> run() {
    std::size_t found = 0;
    for (local_id e = 0; e < static_cast<local_id>(mesh_.cells.size()); ++e)
      if (mesh_.is_alive(e)) {
        found += raise_walls(e);
        if (mesh_.is_ghost(e))
          set(e, place::outside);
      }
    if (found != 2 * boundary_.entries().size())
      throw mesher_error("triangles of the boundary are no sides of elements");
    spread();
    std::vector<char> inside(place_.size());
    for (std::size_t e = 0; e < inside.size(); ++e)
      inside[e] = mesh_.is_alive(static_cast<local_id>(e)) && place_[e] == place::inside;
    return inside;
  }

private:
  enum class place : std::uint8_t { unknown, inside, outside };

  void set(local_id e, place where) {
    place& known = place_[e];
    if (known == where)
      return;
    if (known != place::unknown)
      throw_contradiction(e);
    known = where;
    front_.push_back(e);
  }
  [[noreturn, gnu::noinline]] void throw_contradiction(local_id e) const {
    throw mesher_error("the element at " + place_text(middle_of(e)) +
                       " is inside and outside of the boundary at once; check that it is closed and that "
                       "its triangles are oriented outwards");
  }
  /// Of a ghost, that of its side.
  vec3 middle_of(local_id e) const {
    vec3 sum{};
    double count = 0;
    for (const local_id v : mesh_[e].vertices)
      if (v >= 0) {
        sum += mesh_.point(v);
        ++count;
      }
    return sum / count;
  }
  /// Notes which sides of an element are triangles of the boundary; the number of them.
  std::size_t raise_walls(local_id e) {
    const auto& v = mesh_[e].vertices;
    const auto is_given = [&](local_id one) { return one >= 0 && one < given_points_; };
    if (is_given(v[0]) + is_given(v[1]) + is_given(v[2]) + is_given(v[3]) < 3)
      return 0;
    std::size_t found = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& local = numbering::sides<3>[i];
      const simplex<2> side{v[local[0]], v[local[1]], v[local[2]]};
      const bool may_be_one = is_given(side[0]) && is_given(side[1]) && is_given(side[2]);
      const auto match = may_be_one ? boundary_.find(side) : boundary_sides::match{};
      if (!match)
        continue;
      ++found;
      walls_[e] = static_cast<std::uint8_t>(walls_[e] | 1U << i);
      set(e, boundary_.listed(match) != no_id ? place::inside : place::outside);
    }
    return found;
  }
  void spread() {
    while (!front_.empty()) {
      const local_id e = front_.back();
      front_.pop_back();
      const unsigned walls = walls_[e];
      const place where = place_[e];
      for (std::size_t i = 0; i < 4; ++i)
        if ((walls >> i & 1U) == 0)
          set(triangulation<3>::element_of(mesh_[e].across[i]), where);
    }
  }

  const triangulation<3>& mesh_;
  const boundary_sides& boundary_;
  local_id given_points_;
  std::vector<place> place_;
  std::vector<std::uint8_t> walls_; // per element: bit i when side i is a triangle of the boundary
  std::vector<local_id> front_;
};

} // namespace detail

/// The elements inside of a boundary, whose triangles are all sides of elements, are oriented outwards of the
/// inside and have their vertices among the first `given_points`; one inside is listed in both directions.
/// All of these points come first in the result, then the others that are used, in their order. Linear.
/// Throws `mesher_error` when a triangle is missing or the boundary contradicts itself.
inline simplicial_mesh<3> inside_elements(const triangulation<3>& t, const boundary_sides& boundary,
                                          std::size_t given_points) {
  const std::vector<char> inside =
      detail::inside_flood(t, boundary, static_cast<local_id>(given_points)).run();
  std::vector<local_id> number(t.points.size(), no_id);
  for (std::size_t v = 0; v < given_points; ++v)
    number[v] = 0;
  std::size_t count = 0;
  for (std::size_t e = 0; e < inside.size(); ++e)
    if (inside[e] != 0) {
      ++count;
      for (const local_id v : t.cells[e].vertices)
        number[v] = 0;
    }
  simplicial_mesh<3> result;
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] != no_id) {
      number[v] = static_cast<local_id>(result.points.size());
      result.points.push_back(t.points[v]);
    }
  result.elements.reserve(count);
  for (std::size_t e = 0; e < inside.size(); ++e)
    if (inside[e] != 0) {
      auto vertices = t.cells[e].vertices;
      for (local_id& v : vertices)
        v = number[v];
      result.elements.push_back(vertices);
    }
  return result;
}

} // namespace dovetail
