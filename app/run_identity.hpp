/// @file
/// What a run's result depends on, so that --resume never mixes two different runs.
#pragma once

#include "model_source.hpp"
#include "options.hpp"

#include "dovetail/parallel/spool.hpp"

#include <string>

namespace dovetail::app {

/// A number so that it can be read back to the last bit.
std::string all_digits(double value);

/// A checksum of the field itself, at points of a lattice of irrational steps: whatever file or option it
/// comes from.
std::string values_of_field(const any_sizing& size, const box3& box);

/// The input's content, the sizes and the parameters. Not the workers, the executor or the output: the mesh
/// does not depend on them.
run_identity identity_of_run(const mesh_options& options, const model_source& source);

} // namespace dovetail::app
