/// @file
/// From options to policies and parameters: what `mesh` and `plan` have in common.
#pragma once

#include "options.hpp"
#include "pipeline.hpp"

namespace dovetail::app {

/// Throws `command_line_error` for names that do not exist and policies that do not go together.
template <int D>
policies_of<D> make_policies_of(const mesh_options& options);

/// With `--paper` chooses as the paper does what is not chosen yet: METIS, its rule without a bound, equal
/// weights, a raw background mesh, and interfaces as remeshing leaves them.
void choose_as_paper(mesh_options& options);
/// With `--alone` local repartition is off where nothing else is chosen.
void choose_for_alone(mesh_options& options);

/// How many ranks of a machine compute as one at most, 0: all of them. Before the options are checked.
int largest_rank_group(const mesh_options& options);
/// Of a rank that computes: for each rank of its group as many as wanted, one by default, but no more than it
/// has processors, unless one rank was given more.
int workers_of_rank(const mesh_options& options);

/// Throws `command_line_error` for numbers out of range.
generate_options make_generate_options(const mesh_options& options);

} // namespace dovetail::app
