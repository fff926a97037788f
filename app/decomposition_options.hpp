/// @file
/// Options that the commands which mesh have in common.
#pragma once

#include <CLI/CLI.hpp>

namespace dovetail::app {

/// Adds in how many parts something is meshed, and by how many workers. `Options` has the members named like
/// the options.
template <class Options>
void add_part_options(CLI::App& command, Options& options) {
  command.add_option("--subdomains", options.subdomains,
                     "Number of subdomains (default: from the predicted number of elements)");
  command.add_option("--coarsening", options.coarsening,
                     "Edge length of the background mesh over the target (default: from the prediction)");
  command.add_option("-j,--workers", options.workers, "Worker processes (default: the number of processors)");
}

/// Adds what is meshed and in how many parts.
template <class Options>
void add_decomposition_options(CLI::App& command, Options& options) {
  command
      .add_option(
          "--dimension", options.dimension,
          "Dimension of the elements: 3, or 2 for triangles on the model's surface or in a plane domain")
      ->check(CLI::IsMember({2, 3}))
      ->capture_default_str();
  add_part_options(command, options);
}

} // namespace dovetail::app
