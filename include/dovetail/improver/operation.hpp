/// @file
/// What an operation of the native improver is, and a list of them.
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/improver/operation_log.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>

namespace dovetail::improvement {

class tet_complex;
class surface_complex;

/// The mesh that operations change: elements with their neighbours.
template <int D>
using complex_of = std::conditional_t<D == 3, tet_complex, surface_complex>;

/// What operations keep to, with `is_poor(mesh, element)`; see tetrahedra/ and
/// triangles/operation_limits.hpp.
template <int D>
struct operation_limits;

/// When an operation is tried on a poor element.
enum class turn {
  always, ///< in every sweep: one after another as long as the element is poor
  hard    ///< then, in hard sweeps: one after another until one helps. For what costs more
};

/// The role `mesh_operation<O, D>`: something that the native improver tries on a poor element.
///
/// Valid expressions for `O& o`, `complex_of<D>& mesh`, `local_id e`, `const operation_limits<D>& limits`,
/// `const recorded_tries& tries`:
///
/// - `O::names`: the names of its attempts in reports, a constexpr static `std::array` of texts
/// - `O::when`: the `turn` at which it is tried, constexpr static
/// - `o.mend(mesh, e, limits, tries)`: whether it changed the mesh
///
/// and it is made from the mesh, `O(mesh)`, or by default.
///
/// Semantics: `mend` makes each of its attempts through `tries`, which counts them and returns what they
/// return. An attempt leaves the mesh as it was, or valid and with no element worse than the worst that it
/// replaced; fixed sides and vertices stay. `e` is alive and poor until an attempt succeeds. Deterministic.
///
/// Complexity: that of the elements around `e`.
///
/// Failure: none; what cannot be done is an attempt that returns false.
///
/// Models: best_change (of edge removal and face removal), vertex_smoothing, shell_transformation,
/// edge_contraction and vertex_insertion for D = 3; side_flip, triangle_smoothing, vertex_removal and
/// side_insertion for D = 2. They are listed in operations.hpp.
template <class O, int D>
concept mesh_operation = requires(O& o, complex_of<D>& mesh, local_id e, const operation_limits<D>& limits,
                                  const recorded_tries& tries) {
  {std::span<const char* const>(O::names)};
  { O::when } -> std::convertible_to<turn>;
  { o.mend(mesh, e, limits, tries) } -> std::same_as<bool>;
};

namespace detail {

template <class Operation>
struct held_operation {
  template <class Complex>
  explicit held_operation(Complex& mesh, operation_log& log)
      : operation(made_for(mesh)), tries(log, log.add(Operation::names)) {}

  template <class Complex>
  static Operation made_for(Complex& mesh) {
    if constexpr (std::constructible_from<Operation, Complex&>)
      return Operation(mesh);
    else {
      static_assert(std::default_initializable<Operation>,
                    "an operation is made from the mesh, or by default");
      return Operation();
    }
  }

  Operation operation;
  recorded_tries tries;
};

} // namespace detail

/// Operations with their working memory and their log: nothing is allocated per try. They are tried in the
/// order of the list. No operation may be in it twice.
template <int D, mesh_operation<D>... Operations>
class operation_list {
public:
  /// The list with more operations at its end.
  template <class... More>
  using with = operation_list<D, Operations..., More...>;

  explicit operation_list(complex_of<D>& mesh) : mesh_(mesh), held_(mesh, log_) {}
  operation_list(const operation_list&) = delete; // points into itself
  operation_list& operator=(const operation_list&) = delete;

  operation_log& log() { return log_; } ///< what was tried and what came of it

  /// Tries to replace element `e` or to move its vertices; false when nothing helped.
  bool mend(local_id e, const operation_limits<D>& limits, bool is_hard) {
    bool helped = false;
    ((Operations::when == turn::always && limits.is_poor(mesh_, e) &&
      (helped = attempt<Operations>(e, limits) || helped)),
     ...);
    if (!is_hard || !limits.is_poor(mesh_, e))
      return helped;
    return ((Operations::when == turn::hard && attempt<Operations>(e, limits)) || ...) || helped;
  }

private:
  struct all_held : detail::held_operation<Operations>... {
    all_held(complex_of<D>& mesh, operation_log& log) : detail::held_operation<Operations>(mesh, log)... {}
  };
  template <class Operation>
  bool attempt(local_id e, const operation_limits<D>& limits) {
    auto& held = static_cast<detail::held_operation<Operation>&>(held_);
    return held.operation.mend(mesh_, e, limits, held.tries);
  }

  complex_of<D>& mesh_;
  operation_log log_;
  all_held held_;
};

} // namespace dovetail::improvement
