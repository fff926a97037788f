/// @file
/// The parameters of `generate<D>` with every policy behind its type-erased model: what the pipeline runs on,
/// so that each stage is compiled once, whatever policies are chosen.
#pragma once

#include "dovetail/improver/any_improver.hpp"
#include "dovetail/mesher/any_mesher.hpp"
#include "dovetail/mesher/by_regions.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/partition/any_partitioner.hpp"
#include "dovetail/pipeline/parameters.hpp"

#include <concepts>
#include <utility>

namespace dovetail {

namespace detail {

/// Whether mesher and improver are of dimension D; where not, the compiler's error says so.
template <int D, class Given>
consteval bool policies_fit() {
  using mesher_type = decltype(Given::mesh_it);
  constexpr bool has_mesher = D == 2 || !std::same_as<mesher_type, no_mesher>;
  constexpr bool fits = std::same_as<mesher_type, no_mesher> || boundary_keeping_mesher<mesher_type, D>;
  constexpr bool improves = improver<decltype(Given::improve_it), D>;
  static_assert(has_mesher, "generate<3> needs a mesher: parameters<>{}.with_mesher(mesher::tetgen{})");
  static_assert(fits, "generate<D> needs a mesher of elements of dimension D, that keeps its boundary");
  static_assert(improves, "generate<D> needs an improver of elements of dimension D");
  return has_mesher && fits && improves;
}

} // namespace detail

/// `parameters` convert to it. In D = 2 the mesher is the surface mesher, by regions, unless another one was
/// chosen; in D = 3 one has to be. An improver must be one of D.
template <int D>
struct any_parameters {
  any_mesher<D> mesh_it;
  any_partitioner partition_it;
  any_improver<D> improve_it;
  any_executor run_tasks;
  generate_options options;
  any_simplification_rule simplify_by;
  any_improver<3> improve_background = default_background_improver();
  any_surface_mesher mesh_surface = {};

  any_parameters(any_mesher<D> mesher, any_partitioner partitioner, any_improver<D> improver,
                 any_executor executor, generate_options given, any_simplification_rule rule)
      : mesh_it(std::move(mesher)), partition_it(std::move(partitioner)), improve_it(std::move(improver)),
        run_tasks(std::move(executor)), options(std::move(given)), simplify_by(std::move(rule)) {}

  template <class M, class P, class I, class E>
  any_parameters(const parameters<M, P, I, E>& given) // NOLINT: converts
      : any_parameters(mesher_of(given), given.partition_it, given.improve_it, given.run_tasks, given.options,
                       given.simplify_by) {
    static_assert(detail::policies_fit<D, parameters<M, P, I, E>>());
    improve_background = given.improve_background;
    mesh_surface = given.mesh_surface;
  }

private:
  template <class M, class P, class I, class E>
  static any_mesher<D> mesher_of(const parameters<M, P, I, E>& given) {
    if constexpr (boundary_keeping_mesher<M, D>)
      return given.mesh_it;
    else if constexpr (D == 2)
      return mesher::by_regions<any_surface_mesher>{given.mesh_surface};
    else
      return {};
  }
};

namespace detail {

template <class T>
inline constexpr bool is_parameters = false;
template <class M, class P, class I, class E>
inline constexpr bool is_parameters<parameters<M, P, I, E>> = true;
template <int D>
inline constexpr bool is_parameters<any_parameters<D>> = true;

/// Whether `generate<D>` can run on these; where not, the compiler's first error says what it needs.
template <int D, class Given>
consteval bool checked_parameters() {
  static_assert(is_parameters<Given>,
                "generate takes parameters: options go into parameters<>{}.with_options(options), "
                "a mesher into .with_mesher(mesher)");
  if constexpr (!is_parameters<Given>)
    return false;
  else if constexpr (std::same_as<Given, any_parameters<D>>)
    return true;
  else
    return policies_fit<D, Given>();
}

} // namespace detail

} // namespace dovetail
