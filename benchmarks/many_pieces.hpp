/// @file
/// A mesh in memory that has many pieces.
#pragma once

#include "dovetail/adapters/metis.hpp"
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/experiments/builtin_models.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/compose.hpp"

#include <cmath>
#include <string>
#include <utility>

namespace dovetail {

struct wanted_mesh {
  std::string model; ///< built-in
  double elements;   ///< about
  int subdomains;
};

struct many_pieces {
  generated<3> made;
  any_sizing size;
};

/// Made by TetGen and METIS, in this process.
inline many_pieces mesh_in_pieces(const wanted_mesh& wanted, const any_improver<3>& improve) {
  auto built = builtin_model(wanted.model);
  const any_geometry model(std::move(built.model));
  const any_sizing size = keep_bounds(source_field(built.size, std::move(built.sources)));
  generate_options options;
  options.subdomains = wanted.subdomains;
  const any_parameters<3> policies(parameters<>{}
                                       .with_mesher(mesher::tetgen{})
                                       .with_improver(improve)
                                       .with_partitioner(partition::metis{})
                                       .with_options(options));
  double scale = 1;
  for (int step = 0; step < 3; ++step)
    scale *=
        std::cbrt(plan_background<3>(model, keep_bounds(scaled(size, scale)), policies).predicted_elements /
                  wanted.elements);
  const any_sizing given = keep_bounds(scaled(size, scale));
  return {generate<3>(model, given, policies), given};
}

} // namespace dovetail
