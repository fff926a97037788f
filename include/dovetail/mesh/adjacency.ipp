/// @file
/// What `adjacency.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/side_table.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

template <int D>
void require_valid_vertices(std::span<const simplex<D>> elements, std::size_t point_count) {
  constexpr std::size_t codes_per_element = 2 * numbering::ridges<D>.size();
  if (elements.size() > std::numeric_limits<std::uint32_t>::max() / codes_per_element)
    throw mesh_error("a mesh of " + std::to_string(elements.size()) +
                     " elements is too large for 32-bit adjacency; split it into pieces");
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const local_id v : elements[e])
      if (v < 0 || static_cast<std::size_t>(v) >= point_count)
        throw mesh_error("element " + std::to_string(e) + " refers to point " + std::to_string(v) +
                         ", but the mesh has " + std::to_string(point_count) + " points");
}

/// Orders the dihedrals of one ridge into fans. `ends[i]` are the sides of dihedral i, `codes[i]` its code.
template <int D>
class fan_builder {
public:
  fan_builder(const side_table<D>& sides, ridge_table<D>& ridges) : sides_(sides), ridges_(ridges) {}

  /// Appends the fans of a ridge whose dihedrals are `members` (element x ridges per element + local ridge).
  void append(std::span<const std::uint32_t> members) {
    load(members);
    for (std::size_t first = 0; first < dihedrals_.size();) {
      std::size_t last = extend(first, first + 1);
      const local_id start = dihedrals_[first].from;
      const bool is_closed = dihedrals_[last - 1].to == start && interior(start);
      if (!is_closed) {
        reverse(first, last);
        last = extend(first, last);
      }
      for (std::size_t i = first; i < last; ++i)
        ridges_.dihedral_codes.push_back(dihedrals_[i].code);
      ridges_.dihedral_begins.push_back(static_cast<std::uint32_t>(ridges_.dihedral_codes.size()));
      ridges_.closed.push_back(is_closed);
      first = last;
    }
    ridges_.fan_begins.push_back(static_cast<std::uint32_t>(ridges_.closed.size()));
  }

private:
  struct link {
    local_id from;
    local_id to;
    std::uint32_t code;

    void flip() {
      std::swap(from, to);
      code ^= 1U;
    }
  };

  bool interior(local_id side) const { return sides_.is_interior(side); }

  void load(std::span<const std::uint32_t> members) {
    dihedrals_.clear();
    for (const std::uint32_t member : members) {
      const dihedral w = ridge_table<D>::decode(member * 2);
      const auto& of_element = sides_.of_element[w.element];
      dihedrals_.push_back({of_element[w.sides[0]], of_element[w.sides[1]], member * 2});
    }
  }

  /// Grows the run [first, last) at its end by dihedrals found behind it; returns the new end.
  std::size_t extend(std::size_t first, std::size_t last) {
    while (last < dihedrals_.size()) {
      const local_id open = dihedrals_[last - 1].to;
      if (!interior(open) || open == dihedrals_[first].from)
        break;
      std::size_t next = last;
      while (next < dihedrals_.size() && dihedrals_[next].from != open && dihedrals_[next].to != open)
        ++next;
      if (next == dihedrals_.size())
        break;
      std::swap(dihedrals_[last], dihedrals_[next]);
      if (dihedrals_[last].from != open)
        dihedrals_[last].flip();
      ++last;
    }
    return last;
  }

  void reverse(std::size_t first, std::size_t last) {
    const auto run = std::span(dihedrals_).subspan(first, last - first);
    std::reverse(run.begin(), run.end());
    for (link& w : run)
      w.flip();
  }

  const side_table<D>& sides_;
  ridge_table<D>& ridges_;
  std::vector<link> dihedrals_;
};

} // namespace detail

template <int D>
side_table<D> build_sides(std::span<const simplex<D>> elements, std::size_t point_count) {
  detail::require_valid_vertices<D>(elements, point_count);
  constexpr std::size_t n = D + 1;
  side_table<D> table;
  table.of_element.resize(elements.size());
  table.vertices.reserve(elements.size() * n * 11 / 20);
  table.elements.reserve(elements.size() * n * 11 / 20);
  const auto side_vertices = [&](std::size_t half_side) {
    return detail::pick(elements[half_side / n], numbering::sides<D>[half_side % n]);
  };
  for_each_group<static_cast<std::size_t>(D)>(
      elements.size() * n, point_count, [&](std::size_t h) { return sorted_vertices(side_vertices(h)); },
      [&](const auto&, std::span<const std::uint32_t> half_sides) {
        const auto side = static_cast<local_id>(table.elements.size());
        const auto element_of = [&](std::size_t k) { return static_cast<local_id>(half_sides[k] / n); };
        table.vertices.push_back(side_vertices(half_sides[0]));
        table.elements.push_back({element_of(0), half_sides.size() > 1 ? element_of(1) : no_id});
        for (std::size_t k = 2; k < half_sides.size(); ++k)
          table.further_elements.push_back({side, element_of(k)});
        for (const std::uint32_t h : half_sides)
          table.of_element[h / n][h % n] = side;
      });
  return table;
}

template <int D>
side_table<D> build_sides(const simplicial_mesh<D>& mesh) {
  return build_sides<D>(span_of(mesh.elements), mesh.points.size());
}

template <int D>
std::vector<std::array<local_id, D + 1>> element_neighbours(const side_table<D>& sides) {
  std::vector<std::array<local_id, D + 1>> neighbours(sides.of_element.size());
  for (std::size_t e = 0; e < neighbours.size(); ++e)
    for (std::size_t i = 0; i <= static_cast<std::size_t>(D); ++i)
      neighbours[e][i] = sides.across(sides.of_element[e][i], static_cast<local_id>(e));
  return neighbours;
}

namespace detail {

/// The vertices of local ridge `w % n` of element `w / n`, n per element.
template <int D>
simplex<D - 2> ridge_vertices(std::span<const simplex<D>> elements, std::size_t w) {
  constexpr std::size_t n = ridge_table<D>::per_element;
  return pick(elements[w / n], numbering::ridges<D>[w % n]);
}

/// The ridges of `count` dihedrals, which are `number(i)` (element x ridges per element + local ridge),
/// growing; all dihedrals of a ridge are among them, or none.
template <int D, class Number>
ridge_table<D> ridges_of(std::span<const simplex<D>> elements, std::size_t point_count,
                         const side_table<D>& sides, std::size_t count, const Number& number) {
  constexpr std::size_t n = ridge_table<D>::per_element;
  ridge_table<D> table;
  table.of_element.resize(elements.size());
  if (count < elements.size() * n)
    for (auto& its : table.of_element)
      its.fill(no_id);
  table.dihedral_codes.reserve(count);
  fan_builder<D> fans(sides, table);
  std::vector<std::uint32_t> numbers;
  for_each_group<static_cast<std::size_t>(D - 1)>(
      count, point_count,
      [&](std::size_t i) { return sorted_vertices(ridge_vertices<D>(elements, number(i))); },
      [&](const auto& key, std::span<const std::uint32_t> members) {
        const auto ridge = static_cast<local_id>(table.vertices.size());
        table.vertices.push_back(key);
        numbers.clear();
        for (const std::uint32_t i : members) {
          const auto w = static_cast<std::uint32_t>(number(i));
          numbers.push_back(w);
          table.of_element[w / n][w % n] = ridge;
        }
        fans.append(numbers);
      });
  return table;
}

} // namespace detail

template <int D>
ridge_table<D> build_ridges(std::span<const simplex<D>> elements, std::size_t point_count,
                            const side_table<D>& sides) {
  return detail::ridges_of<D>(elements, point_count, sides, elements.size() * ridge_table<D>::per_element,
                              [](std::size_t w) { return w; });
}

template <int D>
ridge_table<D> build_ridges_at(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                               std::span<const std::uint8_t> is_wanted) {
  const auto elements = span_of(mesh.elements);
  std::vector<std::uint32_t> wanted;
  for (std::size_t w = 0; w < elements.size() * ridge_table<D>::per_element; ++w) {
    const auto vertices = detail::ridge_vertices<D>(elements, w);
    if (std::all_of(vertices.begin(), vertices.end(), [&](local_id v) { return is_wanted[v] != 0; }))
      wanted.push_back(static_cast<std::uint32_t>(w));
  }
  return detail::ridges_of<D>(elements, mesh.points.size(), sides, wanted.size(),
                              [&](std::size_t i) { return wanted[i]; });
}

template <int D>
ridge_table<D> build_ridges(const simplicial_mesh<D>& mesh, const side_table<D>& sides) {
  return build_ridges<D>(mesh.elements, mesh.points.size(), sides);
}

template <int D>
local_id find_side(const side_table<D>& sides, const simplex<D - 1>& vertices) {
  const auto key = sorted_vertices(vertices);
  const auto found =
      std::lower_bound(sides.vertices.begin(), sides.vertices.end(), key,
                       [](const auto& side, const auto& wanted) { return sorted_vertices(side) < wanted; });
  return found != sides.vertices.end() && sorted_vertices(*found) == key
             ? static_cast<local_id>(found - sides.vertices.begin())
             : no_id;
}

#ifdef DOVETAIL_COMPILED
template side_table<2> build_sides<2>(std::span<const simplex<2>> elements, std::size_t point_count);
template side_table<2> build_sides<2>(const simplicial_mesh<2>& mesh);
template std::vector<std::array<local_id, 3>> element_neighbours<2>(const side_table<2>& sides);
template ridge_table<2> build_ridges<2>(std::span<const simplex<2>> elements, std::size_t point_count,
                                        const side_table<2>& sides);
template ridge_table<2> build_ridges<2>(const simplicial_mesh<2>& mesh, const side_table<2>& sides);
template ridge_table<2> build_ridges_at<2>(const simplicial_mesh<2>& mesh, const side_table<2>& sides,
                                           std::span<const std::uint8_t> is_wanted);
template local_id find_side<2>(const side_table<2>& sides, const simplex<1>& vertices);
template side_table<3> build_sides<3>(std::span<const simplex<3>> elements, std::size_t point_count);
template side_table<3> build_sides<3>(const simplicial_mesh<3>& mesh);
template std::vector<std::array<local_id, 4>> element_neighbours<3>(const side_table<3>& sides);
template ridge_table<3> build_ridges<3>(std::span<const simplex<3>> elements, std::size_t point_count,
                                        const side_table<3>& sides);
template ridge_table<3> build_ridges<3>(const simplicial_mesh<3>& mesh, const side_table<3>& sides);
template ridge_table<3> build_ridges_at<3>(const simplicial_mesh<3>& mesh, const side_table<3>& sides,
                                           std::span<const std::uint8_t> is_wanted);
template local_id find_side<3>(const side_table<3>& sides, const simplex<2>& vertices);
#endif

} // namespace dovetail
