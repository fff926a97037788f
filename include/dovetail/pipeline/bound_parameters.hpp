/// @file
/// What the stages of the pipeline are instantiated with: the parameters as they are given, or with the
/// compiled library, which has one instantiation for each dimension, `any_parameters<D>`.
#pragma once

#include "dovetail/core/policy.hpp"
#include "dovetail/improver/wraps.hpp"
#include "dovetail/mesher/by_regions.hpp"
#include "dovetail/mesher/native.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/remembering.hpp"
#include "dovetail/pipeline/parameters.hpp"
#ifdef DOVETAIL_COMPILED
#include "dovetail/pipeline/any_parameters.hpp"
#endif

#include <concepts>

namespace dovetail {

namespace detail {

/// Whether mesher and improver are of dimension D; where not, the compiler's error says so.
template <int D, class Given>
consteval bool policies_fit() {
  using mesher_type = decltype(Given::mesh_it);
  constexpr bool fits = std::same_as<mesher_type, default_mesher> || boundary_keeping_mesher<mesher_type, D>;
  constexpr bool improves = improver<decltype(Given::improve_it), D>;
  static_assert(fits, "generate<D> needs a mesher of elements of dimension D, that keeps its boundary");
  static_assert(improves, "generate<D> needs an improver of elements of dimension D");
  constexpr bool knows_surface = D == 3 || !improvement::hides_surface_call<decltype(Given::improve_it)>();
  static_assert(knows_surface,
                "this improver's own call hides the wrapped one's call with a surface: add "
                "'using wraps::operator();' and a call with a surface_host, if that is to be another one");
  return fits && improves && knows_surface;
}

/// Whether meshers and improver may run where the executor runs them, as far as types say.
template <class Given>
consteval bool policies_may_run() {
  if constexpr (uses_threads<decltype(Given::run_tasks)>()) {
    constexpr bool improves = !is_never_thread_safe<decltype(Given::improve_it)>();
    static_assert(improves, "this improver may not run in threads: take parallel::processes or serial");
    constexpr bool remeshes = !never_runs_in_threads<decltype(Given::mesh_surface)>();
    static_assert(remeshes, "this surface mesher may not run in threads: take parallel::processes or serial");
    if constexpr (std::same_as<decltype(Given::mesh_it), default_mesher>) {
      return improves && remeshes;
    } else {
      constexpr bool meshes = !is_never_thread_safe<decltype(Given::mesh_it)>();
      static_assert(meshes, "this mesher may not run in threads: take parallel::processes or serial");
      return improves && remeshes && meshes;
    }
  }
  return true;
}

/// Whether `generate<D>` can run on these; where not, the compiler's first error says what it needs.
template <int D, class Given>
consteval bool checked_parameters() {
  static_assert(is_parameters<Given>,
                "generate takes parameters: options go into parameters<>{}.with_options(options), "
                "a mesher into .with_mesher(mesher)");
  if constexpr (!is_parameters<Given>)
    return false;
  else if constexpr (policies_fit<D, Given>())
    return policies_may_run<Given>();
  else
    return false;
}

} // namespace detail

/// Parameters that the stages of `generate<D>` take: all policies are there and fit, and the executor, which
/// is called once for many tasks, is behind its one type.
template <class Given, int D>
concept bound_parameters =
#ifdef DOVETAIL_COMPILED
    std::same_as<Given, any_parameters<D>>;
#else
    detail::is_parameters<Given> && std::same_as<decltype(Given::run_tasks), any_executor> &&
    boundary_keeping_mesher<decltype(Given::mesh_it), D> && improver<decltype(Given::improve_it), D>;
#endif

/// The same policies as the stages take them. Unless a mesher was chosen it is `mesher::native` in D = 3, the
/// surface mesher, by regions, in D = 2.
/// \param given what a caller of `generate` gives
template <int D, class Given>
  requires(!bound_parameters<Given, D>)
auto bind_parameters(const Given& given) {
  if constexpr (detail::checked_parameters<D, Given>()) {
    if constexpr (D == 3 && std::same_as<decltype(Given::mesh_it), default_mesher>) {
      return bind_parameters<D>(given.with_mesher(mesher::native{}));
    } else if constexpr (std::same_as<decltype(Given::mesh_it), default_mesher>) {
      using by_surface_mesher = mesher::by_regions<decltype(Given::mesh_surface)>;
      return bind_parameters<D>(given.with_mesher(by_surface_mesher{given.mesh_surface}));
    } else {
#ifdef DOVETAIL_COMPILED
      return any_parameters<D>(given);
#else
      return given.with_executor(any_executor(given.run_tasks));
#endif
    }
  }
}
template <int D, bound_parameters<D> Given>
const Given& bind_parameters(const Given& given) {
  return given;
}

/// The same with an executor that keeps what is made through it: as the one given does, else in memory.
/// \param given parameters that stages take
template <class Given>
Given with_memory(Given given) {
  if (!given.run_tasks.results())
    given.run_tasks = parallel::remembering(given.run_tasks);
  return given;
}

} // namespace dovetail
