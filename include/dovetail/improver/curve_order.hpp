/// @file
/// Puts next to each other in memory what is next to each other in space: points along a Hilbert curve,
/// elements by their first point on it. Work that goes from an element to its neighbours then waits for
/// memory as rarely in a large mesh as in a small one.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace dovetail::improvement {

namespace detail {

/// The Hilbert curve through a cube, as an automaton that is fed the octants of a point from the largest to
/// the smallest, two at a time. A state is the corner at which the curve enters the octant and the axis along
/// which it leaves: C. Hamilton, "Compact Hilbert Indices" (2006).
class hilbert_automaton {
public:
  constexpr hilbert_automaton() {
    for (unsigned state = 0; state < states; ++state)
      for (unsigned octants = 0; octants < 64; ++octants) {
        const auto [middle, high] = step_of(state, octants >> 3U);
        const auto [next, low] = step_of(middle, octants & 7U);
        steps_[64 * state + octants] = static_cast<std::uint16_t>(64 * next + 8 * high + low);
      }
  }
  /// The place along the curve of the cell whose octants these are, three bits each, the largest on top.
  constexpr std::uint64_t place_of(std::uint64_t octants, int levels) const {
    std::uint64_t place = 0;
    unsigned state = 0; // times 64
    for (int shift = 3 * levels - 6; shift >= 0; shift -= 6) {
      const unsigned found = steps_[state + (octants >> shift & 63U)];
      place = place << 6U | (found & 63U);
      state = found & ~63U;
    }
    return place;
  }

private:
  static constexpr unsigned states = 24;
  struct step {
    unsigned state, place;
  };
  static constexpr step step_of(unsigned state, unsigned octant) {
    const unsigned entry = state / 3, axis = state % 3;
    const unsigned place = inverse_gray(rotated(octant ^ entry, 3 - (axis + 1) % 3));
    const unsigned next_entry = entry ^ rotated(entry_of(place), (axis + 1) % 3);
    return {3 * next_entry + (axis + axis_of(place) + 1) % 3, place};
  }
  static constexpr unsigned gray(unsigned i) { return i ^ (i >> 1U); }
  static constexpr unsigned inverse_gray(unsigned g) { return g ^ (g >> 1U) ^ (g >> 2U); }
  /// The three bits turned to the left.
  static constexpr unsigned rotated(unsigned bits, unsigned by) {
    return ((bits << by) | (bits >> (3 - by))) & 7U;
  }
  static constexpr unsigned entry_of(unsigned place) { return place == 0 ? 0 : gray((place - 1) & ~1U); }
  static constexpr unsigned axis_of(unsigned place) {
    unsigned ones = place == 0 ? 0 : place % 2 == 0 ? place - 1 : place;
    unsigned trailing = 0;
    for (; (ones & 1U) != 0; ones >>= 1U)
      ++trailing;
    return trailing % 3;
  }
  std::array<std::uint16_t, std::size_t{64} * states> steps_{};
};

/// The 16 lowest bits, two zeros before each.
constexpr std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 16U) & 0xff00'00ffU;
  bits = (bits | bits << 8U) & 0xf0'0f00'f00fU;
  bits = (bits | bits << 4U) & 0xc30'c30c'30c3U;
  return (bits | bits << 2U) & 0x2492'4924'9249U;
}

inline constexpr int curve_levels = 16; ///< cells per axis: 2^16

/// The place along the curve of a cell, 48 bits.
inline std::uint64_t place_on_curve(const std::array<std::uint32_t, 3>& cell) {
  static constexpr hilbert_automaton automaton;
  return automaton.place_of(spread(cell[0]) | spread(cell[1]) << 1U | spread(cell[2]) << 2U, curve_levels);
}

struct placed_point {
  std::uint64_t place;
  local_id point;
};

/// Stable; by counting, digit after digit. O(points).
inline void sort_by_place(std::vector<placed_point>& points) {
  constexpr unsigned digit_bits = 12, mask = (1U << digit_bits) - 1;
  std::vector<placed_point> sorted(points.size());
  std::vector<std::uint32_t> begins(mask + 2);
  for (unsigned shift = 0; shift < 3 * curve_levels; shift += digit_bits) {
    std::fill(begins.begin(), begins.end(), 0U);
    for (const auto& p : points)
      ++begins[(p.place >> shift & mask) + 1];
    for (std::size_t digit = 0; digit < mask; ++digit)
      begins[digit + 1] += begins[digit];
    for (const auto& p : points)
      sorted[begins[p.place >> shift & mask]++] = p;
    points.swap(sorted);
  }
}

/// The numbers of the points in the order of the curve.
inline std::vector<placed_point> along_curve(const std::vector<vec3>& points) {
  std::vector<placed_point> placed(points.size());
  if (points.empty())
    return placed;
  vec3 lower = points[0], upper = points[0];
  for (const vec3& p : points) {
    lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
    upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
  }
  const vec3 extent = upper - lower;
  const double longest = std::max({extent.x, extent.y, extent.z});
  const double scale = longest > 0 ? ((1U << curve_levels) - 1) / longest : 0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    const vec3 place = scale * (points[v] - lower);
    placed[v] = {place_on_curve({static_cast<std::uint32_t>(place.x), static_cast<std::uint32_t>(place.y),
                                 static_cast<std::uint32_t>(place.z)}),
                 static_cast<local_id>(v)};
  }
  sort_by_place(placed);
  return placed;
}

/// Renames the elements' points and sorts the elements, with their tags, by their smallest new name; those
/// that share it keep their order. O(elements).
inline void rename_and_sort(simplicial_mesh<3>& mesh, const std::vector<local_id>& names) {
  const auto first_of = [](const simplex<3>& v) {
    return static_cast<std::size_t>(std::min(std::min(v[0], v[1]), std::min(v[2], v[3])));
  };
  std::vector<std::uint32_t> begins(names.size() + 1, 0);
  for (auto& element : mesh.elements) {
    for (auto& v : element)
      v = names[static_cast<std::size_t>(v)];
    ++begins[first_of(element) + 1];
  }
  for (std::size_t v = 0; v + 1 < begins.size(); ++v)
    begins[v + 1] += begins[v];
  std::vector<simplex<3>> elements(mesh.elements.size());
  std::vector<local_id> tags(mesh.tags.size());
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const std::uint32_t to = begins[first_of(mesh.elements[e])]++;
    elements[to] = mesh.elements[e];
    if (!tags.empty())
      tags[to] = mesh.tags[e];
  }
  mesh.elements = std::move(elements);
  mesh.tags = std::move(tags);
}

} // namespace detail

/// Renumbers points and elements as said above; returns the number that each point had. The elements' corners
/// keep their order. O(points + elements); the elements must name points that exist.
inline std::vector<local_id> order_along_curve(simplicial_mesh<3>& mesh) {
  const auto order = detail::along_curve(mesh.points);
  std::vector<local_id> numbers_before(order.size()), numbers_now(order.size());
  std::vector<vec3> points(order.size());
  for (std::size_t v = 0; v < order.size(); ++v) {
    const auto before = static_cast<std::size_t>(order[v].point);
    points[v] = mesh.points[before];
    numbers_before[v] = order[v].point;
    numbers_now[before] = static_cast<local_id>(v);
  }
  mesh.points = std::move(points);
  detail::rename_and_sort(mesh, numbers_now);
  return numbers_before;
}

} // namespace dovetail::improvement
