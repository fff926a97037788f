/// @file
/// How many tetrahedra will fill a closed surface, before there is any volume mesh.
#pragma once

#include "dovetail/core/octree.hpp"
#include "dovetail/mesh/inside_surface.hpp"
#include "dovetail/sizing/prediction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace dovetail {
namespace sizing {

/// A cube of the integration octree.
struct volume_cell {
  box3 box;                             ///< where the cube is
  std::vector<local_id> triangles = {}; ///< those that may pass through it; empty: wholly inside
  double integral = 0;                  ///< of h^-3 over the part of the cube that is inside
  double volume_inside = 0;             ///< by the same samples
  double error = 0;                     ///< of the quadrature, or of what the field's bound allows
  double variance = 0;                  ///< squared error of the sampled part inside, for cut cells
  double least_size = 0;                ///< a lower bound of the size in the cube or in one around it, or 0
};

/// A fixed pseudo-random sequence in [0, 1), so that samples do not line up with axis-parallel surfaces.
class sample_sequence {
public:
  /// The next number.
  double next() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

private:
  std::uint64_t state_ = 1;
};

/// Integrates h^-3 over the part of a cell that is inside: one sample per octant, at random in it for a cut
/// cell.
/// \param largest_unsampled a length: larger cells are split, where the field offers no bounds
template <sizing_field H>
void integrate(volume_cell& cell, const inside_surface& inside, const H& h, sample_sequence& random,
               double largest_unsampled) {
  const bool cut = !cell.triangles.empty();
  const vec3 extent = cell.box.upper - cell.box.lower;
  const double volume = extent.x * extent.y * extent.z;
  double least = std::numeric_limits<double>::infinity();
  double greatest = 0;
  double sum = 0;
  double all = 0;
  double squares = 0;
  int hits = 0;
  for (unsigned k = 0; k < 8; ++k) {
    const box3 part = octant(cell.box, k);
    const vec3 t = cut ? vec3{random.next(), random.next(), random.next()} : vec3{0.5, 0.5, 0.5};
    const vec3 p = part.lower + 0.5 * vec3{t.x * extent.x, t.y * extent.y, t.z * extent.z};
    const double size = dovetail::checked_size(h, p);
    const double density = density_at<3>(size);
    least = std::min(least, size);
    greatest = std::max(greatest, size);
    all += density / 8;
    squares += density * density / 8;
    if (!cut || inside(p)) {
      sum += density / 8;
      ++hits;
    }
  }
  cell.integral = volume * sum;
  const double spread = std::sqrt(std::max(0.0, squares - all * all));
  // The midpoints' spread over a linear h^-3 is not an error; what is left is of second order in it.
  const double quadrature = volume * std::min(spread, 2 * spread * spread / all);
  // The bound of a larger cube holds here as well, and only one that raises doubts is looked at closer.
  if (!(cell.least_size > 0 && cell.least_size >= suspicious_ratio * least))
    cell.least_size = dovetail::smallest_size_in(h, cell.box);
  const double bound = cell.least_size;
  cell.error = assumed_error<3>(quadrature, cell.integral, volume, least, bound);
  if (!(bound > 0)) {
    if (norm(extent) > largest_unsampled)
      cell.error = std::numeric_limits<double>::infinity();
    if (least < suspicious_ratio * greatest)
      cell.error = std::max(cell.error, 0.2 * volume * density_at<3>(least));
  }
  cell.volume_inside = volume * hits / 8;
  // Not from the hits: a cell that happens to be hit too rarely would then be split too rarely, a bias.
  cell.variance = cut ? volume * volume * all * all * 0.1 / 8 : 0.0;
}

/// The octants of a cell that are not outside; a part that no triangle meets is inside or outside as a whole.
/// \param largest_unsampled a length: larger cells are split, where the field offers no bounds
template <sizing_field H>
void append_children(const volume_cell& parent, const inside_surface& inside, const H& h,
                     sample_sequence& random, double largest_unsampled, std::vector<volume_cell>& to) {
  auto triangles = items_by_octant(parent.box, parent.triangles, [&](local_id t) {
    return [&inside, t](const box3& part) { return inside.may_meet(t, part); };
  });
  for (unsigned k = 0; k < 8; ++k) {
    volume_cell child{octant(parent.box, k), std::move(triangles[k])};
    child.least_size = parent.least_size;
    if (child.triangles.empty() && !parent.triangles.empty() && !inside(child.box.center()))
      continue;
    integrate(child, inside, h, random, largest_unsampled);
    to.push_back(std::move(child));
  }
}

/// Of two kinds of errors, adding up linearly and as independent samples, marks the cells to split. Returns
/// the total error.
/// \param allowed the error allowed in all
double mark_volume_cells(const std::vector<volume_cell>& cells, double allowed, std::vector<char>& marked);

/// The sum over all cells, the cut ones scaled so that the volume inside comes out as the surface encloses it
/// (unless its orientation is wrong, which shows in a factor far from one).
/// \param enclosed_volume the volume inside of the surface
double total_integral(const std::vector<volume_cell>& cells, double enclosed_volume);

} // namespace sizing

/// The number of tetrahedra of edge length h that fill a closed surface: the integral of h^-3 over an octree
/// of its inside, with cut cells sampled, refined until the estimated error is below the one asked for.
/// Sources are treated as in `predict_elements`; `per_element` stays empty. Throws `geometry_error` when the
/// surface is open. Deterministic.
/// O(cells * cost of h).
/// \param closed_surface oriented triangles without open edges
/// \param h edge lengths, in the units of the surface
/// \param options the error asked for, and limits
template <sizing_field H>
element_prediction predict_volume_elements(const simplicial_mesh<2>& closed_surface, const H& h,
                                           const prediction_options& options = {}) {
  const inside_surface inside(closed_surface);
  const box3 bounds = inside.bounds();
  const vec3 extent = bounds.upper - bounds.lower;
  const double largest_unsampled = sizing::largest_unsampled(bounds);
  const double enclosed = inside.signed_volume_inside();
  sizing::sample_sequence random;

  // A cube that no model's symmetry planes divide.
  const double width = 1.0037 * std::max({extent.x, extent.y, extent.z});
  const vec3 lower = bounds.lower - 0.00171 * vec3{width, width, width};
  sizing::volume_cell root{{lower, lower + vec3{width, width, width}}};
  root.triangles.resize(inside.triangle_count());
  std::iota(root.triangles.begin(), root.triangles.end(), local_id{0});
  std::vector<sizing::volume_cell> cells{std::move(root)};
  cells.front().error = std::numeric_limits<double>::infinity();

  element_prediction result;
  std::vector<char> marked;
  std::vector<sizing::volume_cell> next;
  constexpr int sure_rounds = 4; // 16 cells across before any estimate is trusted
  double total = 0;
  for (int round = 0;; ++round) {
    total = sizing::total_integral(cells, enclosed);
    const double error = sizing::mark_volume_cells(cells, options.relative_error * total, marked);
    result.relative_error = total > 0 ? error / total : 1;
    const bool close = total > 0 && result.relative_error <= options.relative_error;
    const auto to_split = static_cast<std::size_t>(std::count(marked.begin(), marked.end(), 1));
    const bool too_many = cells.size() + 7 * to_split > options.largest_cells; // eight for each that is split
    // Sizes too small for any number give an infinite total, of which no cell is a part worth splitting.
    if (round >= sure_rounds && (close || too_many || cells.empty() || !std::isfinite(total)))
      break;
    next.clear();
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (marked[i] != 0 || round < sure_rounds)
        sizing::append_children(cells[i], inside, h, random, largest_unsampled, next);
      else
        next.push_back(std::move(cells[i]));
    cells.swap(next);
  }
  const double density = options.density > 0 ? options.density : elements_per_unit<3>;
  result.elements = density * total;
  result.cells = cells.size();
  return result;
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/sizing/volume_prediction.ipp"
#endif
