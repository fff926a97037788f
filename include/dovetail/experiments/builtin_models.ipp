/// @file
/// What `builtin_models.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/experiments/builtin_models.hpp"
#include "dovetail/experiments/builtin_models/aircraft.hpp"
#include "dovetail/experiments/builtin_models/combustor.hpp"
#include "dovetail/experiments/builtin_models/orbiter.hpp"

#include <string>
#include <utility>

namespace dovetail {

DOVETAIL_INLINE_OCCT std::vector<builtin_model_info> builtin_models() {
  return {
      {"aircraft", "flow around a fighter with wing, tail and stores under the wings, in a far-field box"},
      {"combustor", "perforated cylindrical combustor liner: hundreds of small holes"},
      {"orbiter", "flow around a blunt-nosed orbiter with a delta wing, in a far-field box"}};
}

DOVETAIL_INLINE_OCCT builtin_model_result builtin_model(std::string_view name) {
  const auto made = [&](occt::attributed_shape shape, double size, std::vector<grid_source> sources) {
    shape.source = "built-in model " + std::string(name);
    occt_read_result result = occt_model_from(std::move(shape));
    return builtin_model_result{std::move(result.model), size, std::move(sources), std::move(result.report)};
  };
  if (name == "aircraft")
    return made(builtin::aircraft_shape(), 3.0, builtin::aircraft_sources(0.09));
  if (name == "combustor")
    return made(builtin::combustor_shape(), 2.0, {});
  if (name == "orbiter")
    return made(builtin::orbiter_shape(), 7.0, builtin::orbiter_sources(0.18));
  std::string known;
  for (const auto& info : builtin_models())
    known += (known.empty() ? "" : ", ") + std::string(info.name);
  throw input_error("there is no built-in model '" + std::string(name) + "'; there are: " + known);
}

} // namespace dovetail
