/// @file
/// From the fine boundaries of a decomposition to its meshed pieces, for D = 2 and D = 3.
#pragma once

#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/intersection/offending_facets.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/meshing/subdomain_surface.hpp"
#include "dovetail/pipeline/realize.hpp"

#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace dovetail {

namespace detail {

/// The input of each piece's mesher, made in the worker. `sorted` are the skeleton's sides.
piece_source<3> source_of_pieces(const any_geometry&, const simplicial_background<3>&,
                                 const realized<3>& skeleton,
                                 const std::shared_ptr<const sides_of_subdomains>& sorted, bool);

/// `own_model`: a model that is not thread-safe is copied for every piece.
piece_source<2> source_of_pieces(const any_geometry& model, const simplicial_background<2>& mesh,
                                 const realized<2>& skeleton,
                                 const std::shared_ptr<const sides_of_subdomains>& sorted, bool own_model);

/// Predicted elements of each subdomain, the cost that decides which is meshed first.
template <int D>
std::vector<double> weights_of_subdomains(const realized<D>& skeleton, std::span<const double> weights) {
  std::vector<double> sums(skeleton.material_of_subdomain.size(), 0);
  for (std::size_t e = 0; e < weights.size(); ++e)
    sums[skeleton.subdomain_of_element[e]] += weights[e];
  return sums;
}

} // namespace detail

/// Meshes all pieces of a realized decomposition that are wanted and were not made before.
template <int D, bound_parameters<D> Parameters>
meshed_pieces<D> mesh_wanted_pieces(const any_geometry& model, const simplicial_background<D>& mesh,
                                    const realized<D>& skeleton, std::span<const double> weights,
                                    const refined_sizing& size, const Parameters& given) {
  const auto sorted = std::make_shared<const sides_of_subdomains>(
      sort_by_subdomain(skeleton.fine, skeleton.material_of_subdomain.size()));
  // The skeleton itself goes into the finished mesh, and its pieces may be loaded as long as that is.
  const auto sides = std::make_shared<const shared_array<simplex<D - 1>>>(skeleton.fine.sides);
  meshing_options options;
  options.skeleton_points = [sides, sorted](local_id s) {
    return points_of_subdomain<D>(span_of(*sides), *sorted, s);
  };
  options.predicted_cost = detail::weights_of_subdomains(skeleton, weights);
  options.wanted = given.options.only;
  options.on_failure = write_facets_of_failures(given.options.failure_folder);
  options.on_progress = given.options.on_progress;
  const bool own_model = runs_in_threads(given.run_tasks) && !model.thread_safe();
  return mesh_subdomains<D>(skeleton.material_of_subdomain.size(),
                            detail::source_of_pieces(model, mesh, skeleton, sorted, own_model), given.mesh_it,
                            given.improve_it, size, given.run_tasks, options);
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/pipeline/piece_meshing.ipp"
#endif
