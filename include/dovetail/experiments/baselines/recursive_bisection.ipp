/// @file
/// What `recursive_bisection.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/experiments/baselines/recursive_bisection.hpp"
#include "dovetail/experiments/baselines/recursive_bisection/spanning_surface.hpp"
#include "dovetail/experiments/baselines/recursive_bisection/surface_cut.hpp"
#include "dovetail/intersection/crossing_triangles.hpp"
#include "dovetail/mesher/shells.hpp"
#include "dovetail/meshing/subdomain_surface.hpp"
#include "dovetail/parallel/serial.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

namespace dovetail::baselines {

namespace detail {

/// A plane's result.
struct bi_division {
  surface_cut cut;
  spanning_surface spanning;
  double dihedral_deg = 0;
};

/// The counter of planes that were refused for one reason; null where a plane is not.
using refusal = std::size_t bisection_counts::*;

/// One run of `recursive_bisection`.
class bisection_run {
public:
  bisection_run(fine_skeleton surface, std::vector<local_id> materials, const any_sizing& size,
                const recursive_bisection& given)
      : fine_(std::move(surface)), materials_(std::move(materials)), size_(size), given_(given) {}

  bisected_surface run() {
    const stopwatch clock;
    summary_.name = "recursive bisection";
    sides_.resize(materials_.size());
    stays_whole_.resize(materials_.size(), 0);
    for (std::size_t t = 0; t < fine_.sides.size(); ++t)
      for (const local_id s : fine_.subdomains[t])
        if (s != no_id)
          sides_[s].push_back(static_cast<local_id>(t));
    while (given_.most_subdomains == 0 || sides_.size() < given_.most_subdomains) {
      given_.on_progress("recursive bisection", sides_.size(), given_.most_subdomains);
      const local_id s = largest();
      if (s == no_id)
        break;
      if (!divide(s)) {
        stays_whole_[s] = 1;
        ++counts_.whole;
      }
    }
    for (const auto& sides : sides_)
      counts_.most_faces = std::max(counts_.most_faces, sides.size());
    counts_.subdomains = sides_.size();
    counts_.least_dihedral_deg = least_dihedral_deg_;
    summary_.set(counts_);
    summary_.seconds = clock.seconds();
    return {std::move(fine_), std::move(materials_), std::move(summary_)};
  }

private:
  /// Of the subdomains that have too many faces and may be divided, the one with the most; or no_id.
  local_id largest() const {
    local_id found = no_id;
    std::size_t most = given_.most_faces;
    for (std::size_t s = 0; s < sides_.size(); ++s)
      if (stays_whole_[s] == 0 && sides_[s].size() > most) {
        found = static_cast<local_id>(s);
        most = sides_[s].size();
      }
    return found;
  }

  /// The boundary of a subdomain, oriented outwards; its triangles are in the order of `sides_`.
  subdomain_sides<3> boundary_of(local_id s) const {
    subdomain_sides<3> made;
    auto& numbers = made.skeleton_points;
    for (const local_id t : sides_[s])
      append(numbers, fine_.sides[t]);
    sort_unique(numbers);
    for (const local_id v : numbers)
      made.boundary.points.push_back(fine_.points[v]);
    for (const local_id t : sides_[s]) {
      simplex<2> side = fine_.sides[t];
      if (fine_.subdomains[t][0] != s)
        std::swap(side[1], side[2]);
      for (local_id& v : side)
        v = static_cast<local_id>(std::lower_bound(numbers.begin(), numbers.end(), v) - numbers.begin());
      made.boundary.elements.push_back(side);
    }
    return made;
  }

  /// Planes across the axes, the longest first, that have half of the triangles on each side, then others.
  static std::vector<cut_plane> planes_for(const simplicial_mesh<2>& surface) {
    const box3 box = box_around(surface.points);
    std::array<int, 3> axes{0, 1, 2};
    std::stable_sort(axes.begin(), axes.end(),
                     [&](int a, int b) { return box.upper[a] - box.lower[a] > box.upper[b] - box.lower[b]; });
    std::array<std::vector<double>, 3> places;
    for (std::size_t t = 0; t < surface.elements.size(); ++t)
      for (int axis = 0; axis < 3; ++axis)
        places[axis].push_back(centre_of_triangle(surface, t)[axis]);
    for (auto& along : places)
      sort_all(along);
    std::vector<cut_plane> planes;
    for (const double share : {0.5, 0.42, 0.58, 0.34, 0.66})
      for (const int axis : axes) {
        const auto& along = places[axis];
        cut_plane plane;
        plane.normal[axis] = 1;
        plane.offset = along[static_cast<std::size_t>(share * static_cast<double>(along.size()))];
        planes.push_back(plane);
      }
    return planes;
  }

  /// What a plane makes of a surface, or the name of the reason why it is no cut.
  refusal try_plane(const simplicial_mesh<2>& surface, const side_table<2>& table, const cut_plane& plane,
                    double better_than_deg, bi_division& made) const {
    made.cut = cut_surface(surface, table, plane);
    if (made.cut.loops.empty() || !made.cut.simple)
      return &bisection_counts::without_loops;
    const std::size_t all = surface.elements.size();
    const auto above =
        static_cast<std::size_t>(std::count(made.cut.above.begin(), made.cut.above.end(), std::uint8_t{1}));
    const double least = given_.least_share * static_cast<double>(all);
    if (static_cast<double>(std::min(above, all - above)) < least)
      return &bisection_counts::uneven;
    auto spanning = span_loops(surface, table, made.cut, plane, given_.mesh_interface, size_);
    if (!spanning)
      return &bisection_counts::unspanned;
    made.spanning = *std::move(spanning);
    if (std::max(above, all - above) + made.spanning.triangles.size() >= all)
      return &bisection_counts::uneven; // it would not end
    made.dihedral_deg = least_dihedral_at_loops(surface, made.cut, made.spanning);
    if (made.dihedral_deg <= better_than_deg)
      return &bisection_counts::too_sharp;
    return crosses(surface, made.spanning) ? &bisection_counts::crossing : nullptr;
  }

  static bool crosses(const simplicial_mesh<2>& surface, const spanning_surface& spanning) {
    std::vector<vec3> points = surface.points;
    append(points, spanning.inner_points);
    std::vector<simplex<2>> triangles = surface.elements;
    append(triangles, spanning.triangles);
    const auto old = static_cast<local_id>(surface.elements.size());
    return !crossing_triangles(
                span_of(points), span_of(triangles),
                [old](local_id i, local_id j) { return (i < old) == (j < old); }, parallel::serial{})
                .empty();
  }

  /// Cuts a subdomain in two; whether a plane could.
  bool divide(local_id s) {
    const subdomain_sides<3> whole = boundary_of(s);
    const auto table = build_sides(whole.boundary);
    if (!table.further_elements.empty()) // where it touches itself, or there is a sheet in it
      return false;
    std::optional<bi_division> best;
    for (const cut_plane& plane : planes_for(whole.boundary)) {
      ++counts_.planes;
      bi_division made;
      if (const refusal reason = try_plane(whole.boundary, table, plane,
                                           best ? best->dihedral_deg : given_.least_dihedral_deg, made)) {
        ++(counts_.*reason);
        continue;
      }
      best = std::move(made);
      if (best->dihedral_deg >= given_.good_dihedral_deg)
        break;
    }
    if (!best)
      return false;
    apply(s, whole, *best);
    return true;
  }

  void apply(local_id s, const subdomain_sides<3>& whole, const bi_division& made) {
    const auto above = static_cast<local_id>(materials_.size());
    move_sides(s, [&](std::size_t k) { return made.cut.above[k] != 0 ? above : s; });
    const auto first_own = static_cast<local_id>(fine_.points.size());
    const auto known = static_cast<local_id>(whole.skeleton_points.size());
    append(fine_.points.own(), made.spanning.inner_points);
    fine_.point_hosts.own().resize(fine_.points.size(), {3, materials_[s]});
    for (simplex<2> triangle : made.spanning.triangles) {
      for (local_id& v : triangle)
        v = v < known ? whole.skeleton_points[v] : first_own + v - known;
      for (const local_id side_of : {s, above})
        sides_[side_of].push_back(static_cast<local_id>(fine_.sides.size()));
      fine_.sides.own().push_back(triangle);
      fine_.subdomains.own().push_back({s, above});
      fine_.side_hosts.own().push_back(no_id);
    }
    ++counts_.cuts;
    counts_.interface_faces += made.spanning.triangles.size();
    least_dihedral_deg_ = std::min(least_dihedral_deg_, made.dihedral_deg);
    for (const local_id part : {s, above})
      separate_bodies(part);
  }

  /// Makes subdomains of what a cut has left unconnected.
  void separate_bodies(local_id s) {
    const subdomain_sides<3> made = boundary_of(s);
    const auto bodies = bodies_of(made.boundary);
    if (bodies.size() < 2)
      return;
    const auto sorted = [](simplex<2> triangle) {
      sort_all(triangle);
      return triangle;
    };
    std::map<simplex<2>, local_id> subdomain_of;
    for (std::size_t b = 1; b < bodies.size(); ++b) {
      const auto number = static_cast<local_id>(materials_.size() + b - 1);
      for (const auto& triangle : bodies[b].outer)
        subdomain_of[sorted(triangle)] = number;
      for (const auto& shell : bodies[b].voids)
        for (const auto& triangle : shell)
          subdomain_of[sorted(triangle)] = number;
    }
    move_sides(s, [&](std::size_t k) {
      const auto found = subdomain_of.find(sorted(made.boundary.elements[k]));
      return found == subdomain_of.end() ? s : found->second;
    });
  }

  /// Gives the k-th side of a subdomain to `new_subdomain(k)`, which may not be there yet.
  template <class NewSubdomain>
  void move_sides(local_id s, const NewSubdomain& new_subdomain) {
    const auto listed = std::move(sides_[s]);
    sides_[s].clear();
    for (std::size_t k = 0; k < listed.size(); ++k) {
      const local_id to = new_subdomain(k);
      if (static_cast<std::size_t>(to) >= sides_.size()) {
        sides_.resize(to + 1);
        stays_whole_.resize(to + 1, 0);
        materials_.resize(to + 1, materials_[s]);
      }
      auto& pair = fine_.subdomains.own()[listed[k]];
      (pair[0] == s ? pair[0] : pair[1]) = to;
      sides_[to].push_back(listed[k]);
    }
  }

  fine_skeleton fine_;
  std::vector<local_id> materials_;
  const any_sizing& size_;
  const recursive_bisection& given_;
  std::vector<std::vector<local_id>> sides_; ///< per subdomain, growing
  std::vector<std::uint8_t> stays_whole_;    ///< per subdomain: not zero where no plane divides it
  double least_dihedral_deg_ = 360;
  report summary_;
  bisection_counts counts_;
};

} // namespace detail

DOVETAIL_INLINE bisected_surface recursive_bisection::operator()(fine_skeleton surface,
                                                                 std::vector<local_id> material_of_subdomain,
                                                                 const any_sizing& size) const {
  return detail::bisection_run(std::move(surface), std::move(material_of_subdomain), size, *this).run();
}

} // namespace dovetail::baselines
