/// @file
/// Second-order elements: nodes in the middle of edges, on the CAD model where the edges are.
///
/// The middle of an edge on a CAD curve or face is the point of that entity nearest the straight middle, a
/// pure function of the edge's two points and the entity; all others are straight. Where such an element
/// would be inverted, its curved middles go back towards the straight ones by halves, all at once and in all
/// elements that share them, until it is not.
#pragma once

#include "dovetail/core/progress.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/mid_nodes.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/solver/gather.hpp"

#include <vector>

namespace dovetail::io {

/// How nodes are put in the middle of edges.
struct second_order_options {
  double least_jacobian =
      0.1; ///< an element is inverted when `dovetail::least_jacobian` is below this, over 0
  double limit_seconds = 600; ///< wall clock per task; the last resort
  progress on_progress = {};  ///< told how the pieces come along
};

/// Gives a distributed mesh its `mid_nodes`; the mesh itself does not change. Pieces are loaded one per
/// worker, again when what they share has moved. The result does not depend on the executor. `model` is the
/// one that the mesh is of. Throws `mesh_error` when pieces, skeleton and model disagree or when a task
/// fails. Returns `middle_counts`, and warnings where middles are not on the model. Memory: 36 bytes per edge
/// of the skeleton. An executor that keeps its results on a disk keeps the nodes too: a resumed run finds
/// them, whose pieces may have been given up.
/// Complexity: linear, and a few evaluations of the model per edge on it.
/// \param mesh gets `mid_nodes`
/// \param model what the mesh is of
/// \param run_tasks carries out independent tasks; the result does not depend on it
/// \param options the least Jacobian, time limit
template <int D>
report add_mid_nodes(distributed_simplicial_mesh<D>& mesh, const any_geometry& model,
                     const any_executor& run_tasks = parallel::serial{},
                     const second_order_options& options = {});

/// A gathered mesh with second-order elements, in the same order.
template <int D>
struct second_order_mesh {
  std::vector<vec3> points;                    ///< the mesh's, then the middles of its edges
  std::vector<quadratic_simplex<D>> elements;  ///< nodes in VTK's order
  std::vector<quadratic_simplex<D - 1>> sides; ///< those on CAD entities
  report summary;                              ///< as that of `add_mid_nodes`
};

/// About linear, and a few evaluations of the model per edge on it. Throws `mesh_error` as above.
/// \param mesh what `gather` gives
/// \param model what the mesh is of
/// \param options the least Jacobian, where nodes are kept, time limit
template <int D>
second_order_mesh<D> second_order(const gathered_mesh<D>& mesh, const any_geometry& model,
                                  const second_order_options& options = {});

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/solver/second_order.ipp"
#endif
