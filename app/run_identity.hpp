/// @file
/// What a run's result depends on, so that --resume never mixes two different runs.
#pragma once

#include "model_source.hpp"
#include "options.hpp"

#include "dovetail/parallel/spool.hpp"

namespace dovetail::app {

/// The input's content, the sizes and the parameters. Not the workers, the executor or the output: the mesh
/// does not depend on them.
run_identity identity_of_run(const mesh_options& options, const model_source& source);

} // namespace dovetail::app
