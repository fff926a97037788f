/// @file
/// How many elements a mesh will have, before there is one: the integral of h^-D over a simplicial mesh.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/sizing/checked_size.hpp"
#include "dovetail/sizing/erased.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// Regular elements of edge length 1 per unit of measure: 6 sqrt(2) tetrahedra, 4 / sqrt(3) triangles, 1
/// edge.
template <int D>
inline constexpr double elements_per_unit = D == 3   ? 6 * std::numbers::sqrt2
                                            : D == 2 ? 4 / std::numbers::sqrt3
                                                     : 1;

/// How exactly a number of elements is predicted.
struct prediction_options {
  /// Elements of edge length 1 per unit of volume or area; 0 takes `elements_per_unit<D>`.
  double density = 0;
  double relative_error = 0.05;          ///< refine until the estimated error of the total is below this
  std::size_t largest_cells = 1'000'000; ///< about the most; the error may then be larger
};

/// A predicted number of elements.
struct element_prediction {
  double elements = 0;       ///< predicted number of elements in total
  double relative_error = 0; ///< estimated; above the one asked for only when `largest_cells` was hit
  std::vector<double>
      per_element;       ///< share of each element of the mesh integrated over; its sum is `elements`
  std::size_t cells = 0; ///< integration cells at the end
};

namespace sizing {

/// A cell of the integration domain with its integral of h^-D and the error estimated for it.
template <int D>
struct integration_cell {
  std::array<vec3, D + 1> corners; ///< of the cell, a simplex
  double measure;                  ///< its area or volume
  std::size_t owner;               ///< the mesh element it is a part of
  double integral = 0;             ///< of h^-D over the cell
  double error = 0;                ///< estimated, of the integral
};

/// The area or volume of a simplex.
template <int D>
double measure_of(const std::array<vec3, D + 1>& c) {
  if constexpr (D == 3)
    return std::abs(signed_volume(c[0], c[1], c[2], c[3]));
  else
    return 0.5 * norm(cross(c[1] - c[0], c[2] - c[0]));
}

/// An element as one cell, whose integral is still to be found.
template <int D>
integration_cell<D> cell_of_element(const simplicial_mesh<D>& mesh, std::size_t element) {
  std::array<vec3, D + 1> corners;
  for (std::size_t i = 0; i <= D; ++i)
    corners[i] = mesh.points[mesh.elements[element][i]];
  return {corners, measure_of<D>(corners), element};
}

/// How far apart samples may be in a field of which nothing but samples tells.
inline double largest_unsampled(const box3& domain) {
  return domain.diagonal() / 24;
}

/// Elements per measure at size `h`, up to a constant: h^-D.
template <int D>
double density_at(double h) {
  return D == 3 ? 1 / (h * h * h) : 1 / (h * h);
}

/// A size below this fraction of the smallest one sampled in a cell, if the field's bound allows it somewhere
/// in the cell, means that the samples may have missed a source.
inline constexpr double suspicious_ratio = 0.5;

/// The error to assume for a cell: that of its quadrature, or all that its lower bound allows when that is
/// suspicious.
/// \param quadrature_error what two quadratures differ by
/// \param integral the value found
/// \param measure area or volume of the cell
/// \param sampled_least the smallest size among the samples
/// \param bound a lower bound of the size, or 0
template <int D>
double assumed_error(double quadrature_error, double integral, double measure, double sampled_least,
                     double bound) {
  if (bound > 0 && bound < suspicious_ratio * sampled_least)
    return std::max(quadrature_error, measure * density_at<D>(bound) - integral);
  return quadrature_error;
}

/// Two rules of degree 2 that share no point; their difference is the error estimate.
/// \param most_unsampled a length: larger cells are split, where the field offers no bounds
template <int D, sizing_field H>
void integrate(integration_cell<D>& cell, const H& h, double most_unsampled) {
  constexpr double inner = D == 3 ? 0.58541019662496845 : 2.0 / 3;
  constexpr double outer = (1 - inner) / D;
  double least = std::numeric_limits<double>::infinity();
  double greatest = 0;
  const auto density = [&](vec3 p) {
    const double size = dovetail::checked_size(h, p);
    least = std::min(least, size);
    greatest = std::max(greatest, size);
    return density_at<D>(size);
  };
  vec3 sum{};
  box3 box;
  for (const vec3& corner : cell.corners) {
    sum += corner;
    box.include(corner);
  }
  double gauss = 0;
  double closed = 0;
  for (const vec3& corner : cell.corners) {
    gauss += density(outer * sum + (inner - outer) * corner) / (D + 1);
    closed += density(corner) / ((D + 1) * (D + 2));
  }
  closed += density(sum / (D + 1)) * (D + 1) / (D + 2);
  cell.integral = cell.measure * gauss;
  const double bound = smallest_size_in(h, box);
  cell.error =
      assumed_error<D>(cell.measure * std::abs(gauss - closed), cell.integral, cell.measure, least, bound);
  if (bound > 0)
    return;
  // Nothing but samples tells: look everywhere, and doubt a cell that may hold a jump.
  if (box.diagonal() > most_unsampled)
    cell.error = std::numeric_limits<double>::infinity();
  if (least < suspicious_ratio * greatest)
    cell.error = std::max(cell.error, 0.2 * cell.measure * density_at<D>(least));
}

/// The 2^D similar parts of a simplex (Bey's order for D = 3: four corners and the octahedron along one
/// diagonal).
template <int D>
void append_children(const integration_cell<D>& parent, std::vector<integration_cell<D>>& to) {
  const auto& c = parent.corners;
  const double measure = parent.measure / (1 << D);
  const auto add = [&](const std::array<vec3, D + 1>& corners) {
    to.push_back({corners, measure, parent.owner});
  };
  const auto mid = [&](std::size_t i, std::size_t j) { return midpoint(c[i], c[j]); };
  if constexpr (D == 2) {
    add({c[0], mid(0, 1), mid(0, 2)});
    add({mid(0, 1), c[1], mid(1, 2)});
    add({mid(0, 2), mid(1, 2), c[2]});
    add({mid(0, 1), mid(1, 2), mid(0, 2)});
  } else {
    const vec3 m01 = mid(0, 1);
    const vec3 m02 = mid(0, 2);
    const vec3 m03 = mid(0, 3);
    const vec3 m12 = mid(1, 2);
    const vec3 m13 = mid(1, 3);
    const vec3 m23 = mid(2, 3);
    add({c[0], m01, m02, m03});
    add({m01, c[1], m12, m13});
    add({m02, m12, c[2], m23});
    add({m03, m13, m23, c[3]});
    add({m01, m02, m03, m13});
    add({m01, m02, m12, m13});
    add({m02, m03, m13, m23});
    add({m02, m12, m13, m23});
  }
}

/// Marks the cells with the largest errors, so many that the errors of the others add up to at most
/// `allowed`. Returns the sum of all errors. Ties by index.
/// \param cells the cells with their errors
template <class Cell>
double mark_largest_errors(const std::vector<Cell>& cells, double allowed, std::vector<char>& marked) {
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  sort_all(order, [&](std::size_t a, std::size_t b) {
    return cells[a].error != cells[b].error ? cells[a].error < cells[b].error : a < b;
  });
  marked.assign(cells.size(), 0);
  double sum = 0;
  for (const std::size_t i : order) {
    sum += cells[i].error;
    marked[i] = sum > allowed ? 1 : 0;
  }
  return sum;
}

/// The sum in the order in which `mark_largest_errors` adds up, so the same to the last bit.
/// \param errors of all cells
inline double sum_of_errors(std::vector<double> errors) {
  sort_all(errors);
  return std::accumulate(errors.begin(), errors.end(), 0.0);
}

} // namespace sizing

/// The integral of h^-D over an element, and the error estimated for it.
struct integral_estimate {
  double integral = 0; ///< of h^-D
  double error = 0;    ///< estimated, of the integral
};

/// The elements first, first + 1, ... last - 1 of a mesh, before any is split: what `predict_elements` begins
/// with, so that several can share the work. O(n * cost of h) and once all points.
/// \param first the first element
/// \param last one behind the last element
template <int D, sizing_field H>
std::vector<integral_estimate> integrate_elements(const simplicial_mesh<D>& mesh, const H& h,
                                                  std::size_t first, std::size_t last) {
  box3 domain;
  for (const vec3& p : mesh.points)
    domain.include(p);
  std::vector<integral_estimate> estimates;
  estimates.reserve(last - first);
  for (std::size_t e = first; e < last; ++e) {
    auto cell = sizing::cell_of_element<D>(mesh, e);
    sizing::integrate(cell, h, sizing::largest_unsampled(domain));
    estimates.push_back({cell.integral, cell.error});
  }
  return estimates;
}

namespace detail {

/// Whether no cell need be split. Sizes too small for any number give an infinite total, of which no cell is
/// a part worth splitting.
inline bool is_predicted(double relative_error, std::size_t cells, double total,
                         const prediction_options& options) {
  return relative_error <= options.relative_error || cells > options.largest_cells || !std::isfinite(total);
}

/// What is predicted where no element need be split: then nothing is known of cells but their integrals.
inline std::optional<element_prediction>
prediction_without_splits(std::span<const integral_estimate> estimates, double density,
                          const prediction_options& options) {
  std::vector<double> errors;
  errors.reserve(estimates.size());
  double total = 0;
  for (const integral_estimate& estimate : estimates) {
    total += estimate.integral;
    errors.push_back(estimate.error);
  }
  element_prediction result;
  result.relative_error = total > 0 ? sizing::sum_of_errors(std::move(errors)) / total : 0;
  if (!is_predicted(result.relative_error, estimates.size(), total, options))
    return std::nullopt;
  result.per_element.reserve(estimates.size());
  for (const integral_estimate& estimate : estimates)
    result.per_element.push_back(density * estimate.integral);
  result.elements = density * total;
  result.cells = estimates.size();
  return result;
}

} // namespace detail

/// The number of D-simplices of edge length h that fill `mesh`, and the share of each of its elements, D = 2
/// or 3. `known` are all of `integrate_elements`, or empty. Adaptive: cells are split, worst first, until the
/// estimated error is below the one asked for; a source smaller than a cell is found by the field's
/// `smallest_size_in`, or, where the field has none, only if it shows up in samples about 1/48 of the domain
/// apart. O(cells * cost of h). Deterministic. Throws `sizing_error` that names the place of a size that is
/// no length.
/// \param mesh what is to be filled: triangles (D = 2) or tetrahedra (D = 3)
/// \param h edge lengths, in the units of the mesh
/// \param options the error asked for, and limits
/// \param known one per element, or empty
template <int D, sizing_field H>
element_prediction predict_elements(const simplicial_mesh<D>& mesh, const H& h,
                                    const prediction_options& options = {},
                                    std::span<const integral_estimate> known = {}) {
  static_assert(D == 2 || D == 3, "elements are triangles or tetrahedra");
  using cell = sizing::integration_cell<D>;
  const std::vector<integral_estimate> own =
      known.empty() ? integrate_elements(mesh, h, 0, mesh.elements.size()) : std::vector<integral_estimate>{};
  const auto estimates = known.empty() ? std::span(own) : known;
  const double density = options.density > 0 ? options.density : elements_per_unit<D>;
  if (auto unsplit = detail::prediction_without_splits(estimates, density, options))
    return *std::move(unsplit);
  box3 domain;
  for (const vec3& p : mesh.points)
    domain.include(p);

  std::vector<cell> cells;
  cells.reserve(mesh.elements.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    cells.push_back(sizing::cell_of_element<D>(mesh, e));
    cells.back().integral = estimates[e].integral;
    cells.back().error = estimates[e].error;
  }

  element_prediction result;
  std::vector<char> marked;
  std::vector<cell> next;
  double total = 0;
  while (true) {
    total = 0;
    for (const cell& c : cells)
      total += c.integral;
    const double error = sizing::mark_largest_errors(cells, 0.5 * options.relative_error * total, marked);
    result.relative_error = total > 0 ? error / total : 0;
    if (detail::is_predicted(result.relative_error, cells.size(), total, options))
      break;
    next.clear();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!marked[i]) {
        next.push_back(cells[i]);
        continue;
      }
      const std::size_t first = next.size();
      sizing::append_children(cells[i], next);
      for (std::size_t k = first; k < next.size(); ++k)
        sizing::integrate(next[k], h, sizing::largest_unsampled(domain));
    }
    cells.swap(next);
  }

  result.per_element.assign(mesh.elements.size(), 0.0);
  for (const cell& c : cells)
    result.per_element[c.owner] += density * c.integral;
  result.elements = density * total;
  result.cells = cells.size();
  return result;
}

} // namespace dovetail
