#include "suppression.hpp"

#include "failure.hpp"

#include "dovetail/core/number_text.hpp"
#include "dovetail/models/virtual_model.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <cmath>
#include <utility>

namespace dovetail::app {

void suppress_details(model_source& source, const model_options& options) {
  if (options.suppress && (!(*options.suppress > 0) || !std::isfinite(*options.suppress)))
    throw command_line_error("--suppress: " + number_text(*options.suppress) +
                             " is not a length; give a positive number, or --keep-all");
  if (options.keep_all)
    return;
  const virtual_model model =
      options.suppress ? virtual_model(source.geometry, uniform_size(*options.suppress), {.share_of_size = 1})
                       : virtual_model(source.geometry, source.size);
  if (model.suppressed().empty())
    return;
  source.summary.children.push_back(model.summary());
  source.geometry = any_geometry(model);
}

} // namespace dovetail::app
