/// @file
/// Any improver behind one type, so that the pipeline is compiled once and not once per improver.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/improver/concepts.hpp"
#include "dovetail/improver/improve_on_host.hpp"
#include "dovetail/improver/surface_host.hpp"

#include <concepts>
#include <functional>
#include <string>
#include <utility>

namespace dovetail {

/// Holds any improver of D by value; an improver converts to it. Made by default it holds none and leaves
/// meshes as they are. A call costs one indirect call.
template <int D>
class any_improver {
public:
  /// What every held improver promises; its own traits are `actual_traits`.
  static constexpr improver_traits traits{};

  any_improver() = default;
  template <class I>
    requires(!std::same_as<I, any_improver> && improver<I, D>)
  any_improver(I policy, std::string name = {}) // NOLINT: converts, as std::function does
      : name_(std::move(name)), actual_traits_(I::traits),
        call_([held = std::move(policy)](simplicial_mesh<D>& mesh, const frozen_entities<D>& frozen,
                                         const any_sizing& size, [[maybe_unused]] const surface_host& host) {
          if constexpr (D == 2)
            return improve_on_host(held, mesh, frozen, size, host);
          else
            return held(mesh, frozen, size);
        }) {}

  explicit operator bool() const { return static_cast<bool>(call_); } ///< whether it holds one
  /// The name it was given, for reports; may be empty.
  const std::string& name() const { return name_; }
  const improver_traits& actual_traits() const { return actual_traits_; }
  /// `host` is what the vertices of triangles stay on (D = 2). Without a held policy the report is empty.
  report operator()(simplicial_mesh<D>& mesh, const frozen_entities<D>& frozen, const any_sizing& size,
                    const surface_host& host = {}) const {
    return call_ ? call_(mesh, frozen, size, host) : report{};
  }

private:
  std::string name_;
  improver_traits actual_traits_ = {.thread_safe = true}; // of nothing, which is what it holds at first
  std::function<report(simplicial_mesh<D>&, const frozen_entities<D>&, const any_sizing&,
                       const surface_host&)>
      call_;
};
static_assert(surface_improver<any_improver<2>> && improver<any_improver<3>, 3>);

} // namespace dovetail
