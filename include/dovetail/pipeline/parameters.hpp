/// @file
/// The parameters of `generate`, composed of policies: `parameters<>{}.with_mesher(mesher::tetgen{})`.
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/core/progress.hpp"
#include "dovetail/core/wrapped_policy.hpp"
#include "dovetail/improver/concepts.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/parallel/concepts.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/partition/concepts.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/remesh/concepts.hpp"
#include "dovetail/remesh/patch_remesher.hpp"
#include "dovetail/simplification/concepts.hpp"
#include "dovetail/simplification/paper.hpp"
#include "dovetail/simplification/types.hpp"
#include "dovetail/sizing/size_balls.hpp"

#include <concepts>
#include <filesystem>
#include <utility>
#include <vector>

namespace dovetail {

/// Stands for the mesher of a dimension: of tetrahedra `mesher::native`, of triangles the surface mesher.
struct default_mesher {};

/// Everything about `generate` that is not a policy. Lengths are in the model's unit.
struct generate_options {
  int subdomains = 0; ///< 0: from the predicted number of elements
  /// Predicted elements per subdomain when `subdomains` is 0; beyond `many_elements` subdomains grow larger,
  /// as the square root of their number. 0: what the mesher names (`elements_per_subdomain()`), or 31250.
  double elements_per_subdomain = 0;
  double many_elements = 1e6;
  /// When `subdomains` is 0, a mesh of fewer predicted elements is one piece: to decompose it would take
  /// longer than to mesh it.
  double undivided_elements = 0;
  int least_subdomains = 1; ///< when `subdomains` is 0, as far as there are elements enough
  /// Elements of the background mesh: at least so many per subdomain, and about `background_elements` where
  /// that is no more than a tenth of the final mesh. From there on the simplification hardly refuses
  /// anything.
  double background_elements_per_subdomain = 1250;
  double background_elements = 75000;
  /// Subdomains of which alone the pieces are made, growing; empty: of all. Each is, bit for bit, as in the
  /// whole mesh, as long as in that no subdomain fails, and in D = 2 no pieces cross.
  std::vector<local_id> only = {};
  /// D = 3, and `only` is not empty: of the skeleton only what lies around these subdomains is made, so that
  /// time and memory are those of the background mesh and of these pieces, however large the mesh is. Needs
  /// `repartition_locally` = false, as the whole decides which interfaces move. The pieces are those of the
  /// whole mesh as long as nothing that crosses has to be repaired: around them a warning tells, elsewhere
  /// nobody knows. `only` counts subdomains as they are before any are merged.
  bool alone = false;
  double coarse_scale = 0; ///< factor between coarse and final size; 0: from the above
  /// How heavy the simplification may make a super-element; its `subdomains` are those of the mesh, whatever
  /// is given.
  contraction_bound super_elements = {};
  /// A background element weighs, for bound and partitioner, the elements that the sizes predict in it;
  /// false: 1, as in the paper, section 3.4.
  bool predicted_weights = true;
  /// A graph of more super-elements is partitioned in groups of a twelfth of that (`partition::in_groups`).
  local_id partitioned_at_once = 200'000;
  bool match_segments = true; ///< D = 3: other numbers of segments are tried where a face has a small angle
  bool repartition_locally = true; ///< interfaces are moved from where remeshing makes an angle small
  /// Sizes that predict more elements are enlarged, all by one factor, until they predict so many; 0: never.
  double enlarged_above = 0;
  double largest_prediction = 0; ///< more predicted elements are refused (`too_many_elements`); 0: no limit
  /// More subdomains merged than this, in all rounds, is a failure; 2 of 8, or 1 of fewer, always may be.
  double largest_merged_fraction = 0.05;
  int refinement_rounds = 6; ///< of local refinement where CAD regions cross or stay folded over, at most
  /// Wall clock per task: an attempt at a subdomain, a batch of lines or of regions; the last resort. What it
  /// stops the summary counts (`stops_by_clock`): the mesh is not repeatable then.
  double limit_seconds = 600;
  std::filesystem::path failure_folder =
      {};                    ///< where facets of failed subdomains are written; empty: nowhere
  progress on_progress = {}; ///< told how the stages come along
};

/// One sweep of each kind towards 28 degrees: few elements have a smaller angle where the mesher has a form
/// for the background, and what is left the simplification contracts. More sweeps leave interfaces no
/// cleaner.
improvement::native default_background_improver();

namespace detail {

/// False, but only where a template is instantiated.
template <class>
inline constexpr bool never = false;

template <class Improver>
Improver first_background_improver() {
  if constexpr (std::convertible_to<improvement::native, Improver>)
    return default_background_improver();
  else
    return {};
}

} // namespace detail

/// Policies and options. Each `with_...` returns parameters with one policy replaced. All policies are bound
/// at compile time; those behind one type each are `any_parameters<D>`, to which all parameters convert.
template <class Mesher = default_mesher, class Partitioner = partition::greedy,
          class Improver = improvement::native, class Executor = parallel::serial,
          class Rule = simplifier::paper, class BackgroundImprover = improvement::native,
          class SurfaceMesher = remesh::patch_remesher>
struct parameters {
  static_assert(detail::wraps_by_itself<Mesher>() && detail::wraps_by_itself<Partitioner>() &&
                    detail::wraps_by_itself<Improver>() && detail::wraps_by_itself<Executor>() &&
                    detail::wraps_by_itself<Rule>() && detail::wraps_by_itself<BackgroundImprover>() &&
                    detail::wraps_by_itself<SurfaceMesher>(),
                "a policy derives from wraps<Self, Policy> with another Self than its own type");

  Mesher mesh_it{};           ///< makes the elements of a subdomain
  Partitioner partition_it{}; ///< cuts the graph of super-elements
  Improver improve_it{};      ///< improves the elements of a subdomain
  Executor run_tasks{};       ///< runs the tasks
  generate_options options{}; ///< all that is no policy
  Rule simplify_by{};         ///< says which sides are to be no interfaces
  /// Makes the coarse elements good (D = 3), so that clean interfaces are found everywhere.
  BackgroundImprover improve_background = detail::first_background_improver<BackgroundImprover>();
  /// Of the coarse surface and of regions; in D = 2 of the pieces too, unless a mesher was chosen.
  SurfaceMesher mesh_surface{};

  // Of each dimension a function, not one with a disjunction: of that compilers do not say what is missing.
  /// A copy with another mesher of tetrahedra.
  template <boundary_keeping_mesher<3> M>
  auto with_mesher(M mesher) const {
    return with(std::move(mesher), partition_it, improve_it, run_tasks, simplify_by, improve_background,
                mesh_surface);
  }
  template <boundary_keeping_mesher<2> M>
    requires(!boundary_keeping_mesher<M, 3>)
  auto with_mesher(M mesher) const {
    return with(std::move(mesher), partition_it, improve_it, run_tasks, simplify_by, improve_background,
                mesh_surface);
  }
  /// A copy with another partitioner.
  template <graph_partitioner P>
  auto with_partitioner(P partitioner) const {
    return with(mesh_it, std::move(partitioner), improve_it, run_tasks, simplify_by, improve_background,
                mesh_surface);
  }
  /// A copy with another improver of tetrahedra.
  template <improver<3> I>
  auto with_improver(I improver) const {
    return with(mesh_it, partition_it, std::move(improver), run_tasks, simplify_by, improve_background,
                mesh_surface);
  }
  template <improver<2> I>
    requires(!improver<I, 3>)
  auto with_improver(I improver) const {
    return with(mesh_it, partition_it, std::move(improver), run_tasks, simplify_by, improve_background,
                mesh_surface);
  }
  /// A copy with another executor.
  template <executor E>
  auto with_executor(E executor) const {
    return with(mesh_it, partition_it, improve_it, std::move(executor), simplify_by, improve_background,
                mesh_surface);
  }
  /// A rule for the surface (2) and the volume (3).
  template <simplification_rule<2> R>
    requires(simplification_rule<R, 3>)
  auto with_simplifier(R rule) const {
    return with(mesh_it, partition_it, improve_it, run_tasks, std::move(rule), improve_background,
                mesh_surface);
  }
  /// A copy with another improver of the background mesh.
  template <improver<3> I>
  auto with_background_improver(I improver) const {
    return with(mesh_it, partition_it, improve_it, run_tasks, simplify_by, std::move(improver), mesh_surface);
  }
  /// A copy with another mesher of surfaces.
  template <surface_mesher S>
  auto with_surface_mesher(S mesher) const {
    return with(mesh_it, partition_it, improve_it, run_tasks, simplify_by, improve_background,
                std::move(mesher));
  }

  // What is no policy of the role: the compiler's first error says what was expected, the next what is
  // missing.
  template <class Other>
  parameters with_mesher(Other /*mesher*/) const {
    static_assert(detail::never<Other>, "with_mesher takes a boundary_keeping_mesher (mesher/concepts.hpp)");
    static_assert(boundary_keeping_mesher<Other, 3>);
    return *this;
  }
  template <class Other>
  parameters with_partitioner(Other /*partitioner*/) const {
    static_assert(detail::never<Other>,
                  "with_partitioner takes a graph_partitioner (partition/concepts.hpp)");
    static_assert(graph_partitioner<Other>);
    return *this;
  }
  template <class Other>
  parameters with_improver(Other /*improver*/) const {
    static_assert(detail::never<Other>, "with_improver takes an improver (improver/concepts.hpp)");
    static_assert(improver<Other, 3>);
    return *this;
  }
  template <class Other>
  parameters with_executor(Other /*executor*/) const {
    static_assert(detail::never<Other>, "with_executor takes an executor (parallel/concepts.hpp)");
    static_assert(executor<Other>);
    return *this;
  }
  template <class Other>
  parameters with_simplifier(Other /*rule*/) const {
    static_assert(detail::never<Other>,
                  "with_simplifier takes a simplification_rule for 2 and 3 (simplification/concepts.hpp)");
    static_assert(simplification_rule<Other, 2>);
    static_assert(simplification_rule<Other, 3>);
    return *this;
  }
  template <class Other>
  parameters with_background_improver(Other /*improver*/) const {
    static_assert(detail::never<Other>,
                  "with_background_improver takes an improver of tetrahedra (improver/concepts.hpp)");
    static_assert(improver<Other, 3>);
    return *this;
  }
  template <class Other>
  parameters with_surface_mesher(Other /*mesher*/) const {
    static_assert(detail::never<Other>, "with_surface_mesher takes a surface_mesher (remesh/concepts.hpp)");
    static_assert(surface_mesher<Other>);
    return *this;
  }

  /// A copy with other options.
  parameters with_options(generate_options different) const {
    parameters changed = *this;
    changed.options = std::move(different);
    return changed;
  }

  /// To parameters with policies to which each of these converts.
  template <class M, class P, class I, class E, class R, class B, class S>
    requires std::convertible_to<Mesher, M> && std::convertible_to<Partitioner, P> &&
        std::convertible_to<Improver, I> && std::convertible_to<Executor, E> &&
        std::convertible_to<Rule, R> && std::convertible_to<BackgroundImprover, B> &&
        std::convertible_to<SurfaceMesher, S>
  operator parameters<M, P, I, E, R, B, S>() const {
    return {mesh_it, partition_it, improve_it,         run_tasks,
            options, simplify_by,  improve_background, mesh_surface};
  }

private:
  template <class M, class P, class I, class E, class R, class B, class S>
  parameters<M, P, I, E, R, B, S> with(M mesher, P partitioner, I improver, E executor, R rule, B background,
                                       S surface) const {
    return {std::move(mesher), std::move(partitioner), std::move(improver),   std::move(executor),
            options,           std::move(rule),        std::move(background), std::move(surface)};
  }
};

namespace detail {

template <class T>
inline constexpr bool is_parameters = false;
template <class... Policies>
inline constexpr bool is_parameters<parameters<Policies...>> = true;

} // namespace detail

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/pipeline/parameters.ipp"
#endif
