/// @file
/// From options to policies and parameters: what `mesh` and `plan` have in common.
#pragma once

#include "options.hpp"
#include "pipeline.hpp"

namespace dovetail::app {

/// Throws `command_line_error` for names that do not exist and policies that do not go together.
chosen_policies make_policies(const mesh_options& options);
chosen_surface_policies make_surface_policies(const mesh_options& options);

/// The policies of a run of D.
template <int D>
policies_of<D> make_policies_of(const mesh_options& options) {
  if constexpr (D == 3)
    return make_policies(options);
  else
    return make_surface_policies(options);
}

/// Throws `command_line_error` for numbers out of range.
generate_options make_generate_options(const mesh_options& options);

} // namespace dovetail::app
