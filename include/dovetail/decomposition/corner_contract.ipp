/// @file
/// What `corner_contract.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/decomposition/corner_contract.hpp"
#include "dovetail/decomposition/interface_contract.hpp"
#include "dovetail/mesh/wedge_runs.hpp"

#include <functional>

namespace dovetail {

namespace detail {

/// Measures the corners that lines cut out of each part.
class corner_checker {
public:
  corner_checker(const corner_contract_input& input, double threshold_deg)
      : in_(input), threshold_(threshold_deg - rounding_deg), runs_(input.mesh, input.sides) {}

  interface_contract run() {
    for (std::size_t s = 0; s < in_.sides.size(); ++s) {
      found_.interface_faces += is_cut(static_cast<local_id>(s)) ? 1 : 0;
      if (!is_line(static_cast<local_id>(s)))
        runs_.remove(static_cast<local_id>(s), [](std::uint32_t) {});
    }
    for (std::uint32_t w = 0; w < runs_.wedge_count(); ++w)
      if (runs_.is_name(w))
        measure(w);
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

  void measure(std::uint32_t wedge) {
    const auto [a, b] = runs_.bounding_sides(wedge);
    if (a == b || (is_fixed(a) && is_fixed(b)))
      return;
    const std::size_t element = wedge / wedge_runs<2>::per_element;
    const local_id vertex = in_.mesh.elements[element][static_cast<std::size_t>(
        numbering::ridges<2>[wedge % wedge_runs<2>::per_element][0])];
    const double angle = angle_of(wedge, a, b, vertex);
    const contract_minimum here{angle, {a, b}, {vertex, no_id}};
    contract_minimum& minimum = is_fixed(a) || is_fixed(b) ? found_.surface_wedge : found_.interface_wedge;
    if (angle < minimum.angle_deg)
      minimum = here;
    if (angle < threshold_)
      found_.violations.push_back(
          {angle, cause_of(a, b), here.triangles, here.edge, in_.part_of_element[element]});
  }

  double angle_of(std::uint32_t wedge, local_id a, local_id b, local_id vertex) const {
    const double through_triangles = runs_.angle(wedge);
    if (!in_.leaves)
      return through_triangles;
    const double between = degrees_per_radian * angle_between(in_.leaves(a, vertex), in_.leaves(b, vertex));
    return through_triangles > 180 ? 360 - between : between;
  }

  contract_cause cause_of(local_id a, local_id b) const {
    return state(a) == side_state::refused || state(b) == side_state::refused ? contract_cause::refused
                                                                              : contract_cause::remeshing;
  }

  const corner_contract_input& in_;
  double threshold_;
  wedge_runs<2> runs_;
  interface_contract found_;
};

} // namespace detail

DOVETAIL_INLINE interface_contract check_corner_contract(const corner_contract_input& input,
                                                         double threshold_deg) {
  return detail::corner_checker(input, threshold_deg).run();
}

} // namespace dovetail
