/// @file
/// What `corner_angles.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/decomposition/corner_angles.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/quality.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>

namespace dovetail {

namespace detail {

/// Measures the corners that lines cut out of each part.
class corner_checker {
public:
  corner_checker(const corner_angles_input& input, double threshold_deg)
      : in_(input), threshold_(threshold_deg - rounding_deg) {
    require_valid_unless(in_.mesh_is, in_.mesh, in_.sides, "measure_corner_angles");
    if (in_.side_states.size() != in_.sides.size())
      throw usage_error("measure_corner_angles: " + std::to_string(in_.side_states.size()) + " states for " +
                        std::to_string(in_.sides.size()) + " sides; give one each");
    require_one_per_element(in_.part_of_element, in_.mesh.elements.size(),
                            std::numeric_limits<local_id>::max(), "measure_corner_angles", "parts");
  }

  interface_angles run() {
    for (std::size_t s = 0; s < in_.sides.size(); ++s)
      found_.interface_faces += is_cut(static_cast<local_id>(s)) ? 1 : 0;
    const ridge_table<2> vertices = build_ridges(in_.mesh, in_.sides);
    for (std::size_t v = 0; v < vertices.size(); ++v)
      for (std::size_t fan = vertices.fan_begins[v]; fan < vertices.fan_begins[v + 1]; ++fan)
        measure_between_lines(vertices.vertices[v][0], vertices.fan(fan), vertices.closed[fan]);
    sort_by_angle(found_.violations);
    return std::move(found_);
  }

private:
  static constexpr double rounding_deg = 1e-6;

  side_state state(local_id side) const { return in_.side_states[static_cast<std::size_t>(side)]; }
  bool is_fixed(local_id side) const { return state(side) == side_state::fixed; }
  bool is_cut(local_id side) const {
    if (is_fixed(side))
      return false;
    const auto [a, b] = in_.sides.elements[static_cast<std::size_t>(side)];
    return in_.part_of_element[static_cast<std::size_t>(a)] !=
           in_.part_of_element[static_cast<std::size_t>(b)];
  }
  bool is_line(local_id side) const { return is_fixed(side) || is_cut(side); }

  /// Adds up the corners of one fan from line to line.
  void measure_between_lines(local_id vertex, std::span<const std::uint32_t> codes, bool is_closed) {
    const auto first_behind = [&](auto is) {
      return static_cast<std::size_t>(
          std::find_if(codes.begin(), codes.end(), [&](std::uint32_t code) { return is(passed(code)[0]); }) -
          codes.begin());
    };
    // An open fan begins at a fixed side, and a closed one is begun there.
    std::size_t start = is_closed ? first_behind([&](local_id side) { return is_fixed(side); }) : 0;
    if (start == codes.size())
      start = first_behind([&](local_id side) { return is_line(side); });
    if (start == codes.size())
      return;
    corner run;
    double opening = 0; // since the last fixed side
    std::size_t first_found = found_.violations.size();
    for (std::size_t k = 0; k < codes.size(); ++k) {
      const std::uint32_t code = codes[(start + k) % codes.size()];
      const wedge at = ridge_table<2>::decode(code);
      const auto [from, to] = passed(code);
      if (run.from == no_id)
        run = {from, at.element, 0};
      const auto e = static_cast<std::size_t>(at.element);
      const double angle = wedge_angles(
          corners(span_of(in_.mesh.points), in_.mesh.elements[e]))[static_cast<std::size_t>(at.ridge)];
      run.angle += angle;
      opening += angle;
      if (is_line(to)) {
        measure(run, to, vertex);
        run = {};
      }
      if (is_fixed(to)) {
        if (opening < threshold_)
          for (std::size_t v = first_found; v < found_.violations.size(); ++v)
            found_.violations[v].cause = violation_cause::forced;
        opening = 0;
        first_found = found_.violations.size();
      }
    }
  }

  /// What lies between two lines at a vertex.
  struct corner {
    local_id from = no_id;
    local_id element = no_id; ///< one of its elements
    double angle = 0;
  };

  /// The two sides of a wedge, in the order of its fan.
  std::array<local_id, 2> passed(std::uint32_t code) const {
    const wedge at = ridge_table<2>::decode(code);
    const auto& of_element = in_.sides.of_element[static_cast<std::size_t>(at.element)];
    return {of_element[static_cast<std::size_t>(at.sides[0])],
            of_element[static_cast<std::size_t>(at.sides[1])]};
  }

  void measure(const corner& run, local_id to, local_id vertex) {
    const local_id from = run.from;
    if (is_fixed(from) && is_fixed(to)) // also the end of a line inside a part; a cut does not end there
      return;
    const double angle = angle_of(run, to, vertex);
    const least_angle here{angle, {from, to}, {vertex, no_id}};
    least_angle& minimum = is_fixed(from) || is_fixed(to) ? found_.surface_wedge : found_.interface_wedge;
    if (angle < minimum.angle_deg)
      minimum = here;
    if (angle >= threshold_)
      return;
    const auto e = static_cast<std::size_t>(run.element);
    found_.violations.push_back({angle, cause_of(from, to), here.sides, here.edge, in_.part_of_element[e],
                                 in_.mesh.points[static_cast<std::size_t>(vertex)]});
    if (!in_.mesh.tags.empty())
      found_.violations.back().cad = {{2, in_.mesh.tags[e]}};
  }

  double angle_of(const corner& run, local_id to, local_id vertex) const {
    if (!in_.leaves)
      return run.angle;
    const double between =
        degrees_per_radian * angle_between(in_.leaves(run.from, vertex), in_.leaves(to, vertex));
    return run.angle > 180 ? 360 - between : between;
  }

  violation_cause cause_of(local_id a, local_id b) const {
    return state(a) == side_state::refused || state(b) == side_state::refused ? violation_cause::refused
                                                                              : violation_cause::remeshing;
  }

  const corner_angles_input& in_;
  double threshold_;
  interface_angles found_;
};

} // namespace detail

DOVETAIL_INLINE interface_angles measure_corner_angles(const corner_angles_input& input,
                                                       double threshold_deg) {
  return detail::corner_checker(input, threshold_deg).run();
}

} // namespace dovetail
