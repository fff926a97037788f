/// @file
/// A writer around another one.
#pragma once

#include "dovetail/core/wrapped_policy.hpp"
#include "dovetail/files/concepts.hpp"

#include <filesystem>

namespace dovetail::io {

/// Base of a writer that does something before or after another one: several workers write pieces with it
/// where they do with `Writer`. A changed call `w(mesh, folder)` should go with a changed `begin`.
template <class Self, class Writer>
struct wraps : wrapped_policy<Self, Writer> {
  static_assert(mesh_writer<Writer, 2> || mesh_writer<Writer, 3>,
                "io::wraps holds a mesh_writer (files/concepts.hpp)");
  using wrapped_policy<Self, Writer>::wrapped_policy;
  using wrapped_policy<Self, Writer>::wrapped;

  /// Writes as the wrapped writer does.
  template <int D>
    requires(mesh_writer<Writer, D>)
  report operator()(const distributed_simplicial_mesh<D>& mesh, const std::filesystem::path& folder) const {
    return wrapped(mesh, folder);
  }
  template <int D>
    requires(piecewise_mesh_writer<Writer, D>)
  piecewise_output<D> begin(const distributed_simplicial_mesh<D>& mesh,
                            const std::filesystem::path& unfinished)
  const { return wrapped.begin(mesh, unfinished); }
};

} // namespace dovetail::io
