/// @file
/// Any surface mesher behind one type, so that the stages are compiled once and not once per mesher.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/remesh/concepts.hpp"
#include "dovetail/remesh/patch_remesher.hpp"

#include <concepts>
#include <functional>
#include <string>
#include <utility>

namespace dovetail {

/// Holds a surface mesher by value; a surface mesher converts to it. Made by default it is the native one. A
/// call costs one indirect call.
class any_surface_mesher {
public:
  static constexpr bool thread_safe = false; ///< of any; of the one held see `may_run_in_threads`

  any_surface_mesher() : any_surface_mesher(remesh::patch_remesher{}, "native") {}
  template <class M>
    requires(!std::same_as<M, any_surface_mesher> && surface_mesher<M>)
  any_surface_mesher(M policy, std::string name = {}) // NOLINT: converts, as std::function does
      : name_(std::move(name)), runs_in_threads_(dovetail::may_run_in_threads(policy)),
        call_(std::move(policy)) {}

  /// The name it was given, for reports; may be empty.
  const std::string& name() const { return name_; }
  /// Whether it may run in several threads of one process.
  bool may_run_in_threads() const { return runs_in_threads_; }
  patch_mesh operator()(const any_surface& surface, const patch_boundary& boundary,
                        const any_sizing& size) const {
    return call_policy<mesher_error>([&] { return named_policy("surface mesher", name_); },
                                     [&] { return call_(surface, boundary, size); });
  }

private:
  std::string name_;
  bool runs_in_threads_;
  std::function<patch_mesh(const any_surface&, const patch_boundary&, const any_sizing&)> call_;
};
static_assert(surface_mesher<any_surface_mesher>);

} // namespace dovetail
