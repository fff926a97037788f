/// @file
/// Any improver behind one type, so that the pipeline is compiled once and not once per improver.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/improver/concepts.hpp"
#include "dovetail/improver/surface_host.hpp"

#include <concepts>
#include <functional>
#include <string>
#include <utility>

namespace dovetail {

namespace detail {

template <class I>
inline constexpr bool takes_host = requires(const I& improve, simplicial_mesh<2>& mesh,
                                            const frozen_entities<2>& frozen, const any_sizing& size,
                                            const surface_host& host) {
  improve(mesh, frozen, size, host);
};

} // namespace detail

/// Holds any improver of D by value; an improver converts to it. Made by default it holds none and leaves
/// meshes as they are. A call costs one indirect call.
template <int D>
class any_improver {
public:
  any_improver() = default;
  template <class I>
    requires(!std::same_as<I, any_improver> && improver<I, D>)
  any_improver(I policy, std::string name = {}) // NOLINT: converts, as std::function does
      : name_(std::move(name)), takes_host_(detail::takes_host<I>) {
    if constexpr (D == 2)
      call_ = [held = std::move(policy)](simplicial_mesh<2>& mesh, const frozen_entities<2>& frozen,
                                         const any_sizing& size, const surface_host& host) {
        if constexpr (detail::takes_host<I>) {
          return held(mesh, frozen, size, host);
        } else {
          frozen_entities<2> in_place = frozen;
          if (host) // it cannot know the surface: flips alone keep points there
            in_place.points = static_cast<local_id>(mesh.points.size());
          return held(mesh, in_place, size);
        }
      };
    else
      call_ = [held = std::move(policy)](simplicial_mesh<D>& mesh, const frozen_entities<D>& frozen,
                                         const any_sizing& size,
                                         const surface_host& /*none*/) { return held(mesh, frozen, size); };
  }

  explicit operator bool() const { return static_cast<bool>(call_); }
  /// The name it was given, for reports; may be empty.
  const std::string& name() const { return name_; }
  /// Whether the held policy can keep vertices on a host; otherwise it moves none of a mesh that has one.
  bool takes_host() const { return takes_host_; }
  /// `host` is what the vertices of triangles stay on (D = 2). Without a held policy the report is empty.
  report operator()(simplicial_mesh<D>& mesh, const frozen_entities<D>& frozen, const any_sizing& size,
                    const surface_host& host = {}) const {
    return call_ ? call_(mesh, frozen, size, host) : report{};
  }

private:
  std::string name_;
  bool takes_host_ = false;
  std::function<report(simplicial_mesh<D>&, const frozen_entities<D>&, const any_sizing&,
                       const surface_host&)>
      call_;
};
static_assert(improver<any_improver<2>, 2> && improver<any_improver<3>, 3>);

} // namespace dovetail
