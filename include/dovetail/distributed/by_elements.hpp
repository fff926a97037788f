/// @file
/// The redistributor of the paper (section 4): elements migrate, so that the ranks of a solver are
/// even, whatever the pieces were, and what was an interface becomes interior where that can be.
#pragma once

#include "dovetail/core/progress.hpp"
#include "dovetail/distributed/concepts.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/partition/any_distributed_partitioner.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/simplification/any_simplification_rule.hpp"
#include "dovetail/simplification/paper.hpp"

namespace dovetail::redistribution_by {

/// Joins the fine elements of each piece to super-elements, by the rule that coarse sides are judged by and
/// with the piece's boundary fixed; joins the graphs of all pieces over the skeleton, partitions that graph,
/// and makes new pieces, of what is connected of a rank within a material. A rank is connected where the mesh
/// is.
///
/// Super-elements are made per piece, never per rank, so the result is the same for any executor and number
/// of its workers, unless the partitioner `depends_on_ranks`: then the pieces are the same up to here.
/// Memory: the new skeleton, the joined graph, a list of the points that come onto the skeleton, and of each
/// worker a new piece and the largest old one.
struct elements {
  any_distributed_partitioner partitioner = partition::greedy{}; ///< of the graph of super-elements
  any_simplification_rule simplify_by = simplifier::paper{};     ///< what joins elements to super-elements
  int super_elements = 2000;                                     ///< about so many of each piece
  double seam_weight = 4;  ///< of a side that is an interface already; of others it is 1
  double imbalance = 1.03; ///< largest over average rank that is tried for; a warning where it is more
  any_executor run_tasks = parallel::serial{}; ///< loads, joins and cuts pieces, and keeps them
  progress on_progress = {};                   ///< told how the stages come along

  /// The summary has, beside what `describe_redistribution` says: super_elements, seams_before and
  /// seams_after (sides inside solids that were interfaces, and still are), interface_sides, depends_on_ranks
  /// (1 where the partitioner does, with a warning that says what this means); in D = 3 also
  /// min_face_angle_deg, min_dihedral_deg, small_angles (smaller than the rule wants) and, of these,
  /// avoidable_angles, at sides that the rule had not refused; children "simplification", "partition",
  /// "migration" with their seconds.
  ///
  /// Throws what the partitioner and the rule throw, `partition_error` for ranks that cannot have a piece
  /// each, `mesh_error` when pieces and skeleton disagree or an element would be lost, `usage_error` for a
  /// mesh of second order, `io_error` of what is kept, and `cancelled`.
  template <int D>
  redistribution<D> operator()(const distributed_simplicial_mesh<D>& mesh, int ranks) const;
};

} // namespace dovetail::redistribution_by

#ifndef DOVETAIL_COMPILED
#include "dovetail/distributed/by_elements.ipp"
#endif
