/// @file
/// The parameters of `generate`, composed of policies: `parameters<>{}.with_mesher(mesher::tetgen{})`.
#pragma once

#include "dovetail/core/progress.hpp"
#include "dovetail/improver/any_improver.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/spool.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/remesh/any_surface_mesher.hpp"
#include "dovetail/simplification/any_simplification_rule.hpp"
#include "dovetail/simplification/paper.hpp"
#include "dovetail/simplification/types.hpp"
#include "dovetail/sizing/size_balls.hpp"

#include <filesystem>
#include <optional>
#include <utility>

namespace dovetail {

/// Stands for the mesher that has to be chosen: all meshers are adapters of other libraries.
struct no_mesher {};

/// Everything about `generate` that is not a policy. Lengths are in the model's unit.
struct generate_options {
  int subdomains = 0; ///< 0: from the predicted number of elements
  /// Predicted elements per subdomain when `subdomains` is 0; beyond `many_elements` subdomains grow larger,
  /// as the square root of their number. 0: what the mesher names (`elements_per_subdomain()`), or 31250.
  double elements_per_subdomain = 0;
  double many_elements = 1e6;
  /// Elements of the background mesh: at least so many per subdomain, and about `background_elements` where
  /// that is no more than a tenth of the final mesh. From there on the simplification hardly refuses
  /// anything.
  double background_elements_per_subdomain = 1250;
  double background_elements = 75000;
  double coarse_scale = 0; ///< factor between coarse and final size; 0: from the above
  /// How heavy the simplification may make a super-element; its `subdomains` are those of the mesh, whatever
  /// is given.
  contraction_bound super_elements = {};
  /// Sizes that predict more elements are enlarged, all by one factor, until they predict so many; 0: never.
  double enlarged_above = 0;
  double largest_prediction = 0; ///< more predicted elements are refused (`too_many_elements`); 0: no limit
  /// More subdomains merged than this, in all rounds, is a failure; 2 of 8, or 1 of fewer, always may be.
  double largest_merged_fraction = 0.05;
  int refinement_rounds = 6; ///< rounds of local refinement where two CAD regions cross
  /// Wall clock per task: an attempt at a subdomain, a batch of lines or of regions; the last resort. What it
  /// stops the summary counts (`stops_by_clock`): the mesh is not repeatable then.
  double limit_seconds = 600;
  /// Where the background mesh, lines, patches and finished subdomains go; a later run in a spool of the same
  /// identity, which must hold all that the mesh depends on, takes them from there. None: they stay in
  /// memory.
  std::optional<spool> store = std::nullopt;
  std::filesystem::path failure_folder =
      {}; ///< where facets of failed subdomains are written; empty: nowhere
  progress on_progress = {};
};

/// One sweep of each kind towards 28 degrees: few elements have a smaller angle where the mesher has a form
/// for the background, and what is left the simplification contracts. More sweeps leave interfaces no
/// cleaner.
inline any_improver<3> default_background_improver() {
  return improvement::native{.target_angle = 28,
                             .stubborn_angle = 15,
                             .passes = 1,
                             .hard_passes = 1,
                             .search_iterations = 1,
                             .statistics = false};
}

/// Policies and options. Each `with_...` returns parameters with one policy replaced.
template <class Mesher = no_mesher, class Partitioner = partition::greedy,
          class Improver = improvement::native, class Executor = parallel::serial>
struct parameters {
  Mesher mesh_it{};
  Partitioner partition_it{};
  Improver improve_it{};
  Executor run_tasks{};
  generate_options options{};
  any_simplification_rule simplify_by{simplifier::paper{}, "paper"};
  /// Makes the coarse elements good (D = 3), so that clean interfaces are found everywhere.
  any_improver<3> improve_background = default_background_improver();
  /// Of the coarse surface and of regions; in D = 2 of the pieces too, unless a mesher was chosen.
  any_surface_mesher mesh_surface{};

  // Of each dimension a function, not one with a disjunction: of that compilers do not say what is missing.
  template <boundary_keeping_mesher<3> M>
  parameters<M, Partitioner, Improver, Executor> with_mesher(M mesher) const {
    return with(std::move(mesher), partition_it, improve_it, run_tasks);
  }
  template <boundary_keeping_mesher<2> M>
    requires(!boundary_keeping_mesher<M, 3>)
  parameters<M, Partitioner, Improver, Executor> with_mesher(M mesher)
  const { return with(std::move(mesher), partition_it, improve_it, run_tasks); }
  template <graph_partitioner P>
  parameters<Mesher, P, Improver, Executor> with_partitioner(P partitioner) const {
    return with(mesh_it, std::move(partitioner), improve_it, run_tasks);
  }
  template <improver<3> I>
  parameters<Mesher, Partitioner, I, Executor> with_improver(I improver) const {
    return with(mesh_it, partition_it, std::move(improver), run_tasks);
  }
  template <improver<2> I>
    requires(!improver<I, 3>)
  parameters<Mesher, Partitioner, I, Executor> with_improver(I improver)
  const { return with(mesh_it, partition_it, std::move(improver), run_tasks); }
  template <executor E>
  parameters<Mesher, Partitioner, Improver, E> with_executor(E executor) const {
    return with(mesh_it, partition_it, improve_it, std::move(executor));
  }
  parameters with_background_improver(any_improver<3> improver) const {
    parameters changed = *this;
    changed.improve_background = std::move(improver);
    return changed;
  }
  parameters with_surface_mesher(any_surface_mesher mesher) const {
    parameters changed = *this;
    changed.mesh_surface = std::move(mesher);
    return changed;
  }
  /// A rule for the surface (2) and the volume (3).
  template <simplification_rule<2> R>
    requires(simplification_rule<R, 3>)
  parameters with_simplifier(R rule)
  const {
    parameters changed = *this;
    changed.simplify_by = std::move(rule);
    return changed;
  }
  parameters with_options(generate_options different) const {
    parameters changed = *this;
    changed.options = std::move(different);
    return changed;
  }

private:
  template <class M, class P, class I, class E>
  parameters<M, P, I, E> with(M mesher, P partitioner, I improver, E executor) const {
    return {std::move(mesher), std::move(partitioner), std::move(improver), std::move(executor), options,
            simplify_by,       improve_background,     mesh_surface};
  }
};

} // namespace dovetail
