#include "resolved_walls.hpp"

#include "touching_faces.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/geometry/error_of_faces.hpp"
#include "dovetail/sizing/compose.hpp"

#include <utility>

namespace dovetail::app {
namespace {

/// Beyond, walls cost more elements than a default mesh should have.
constexpr double most_in_walls_by_default = 600'000;
/// Meshes with thin walls are not divided below, which is more than a mesh of default sizes has: a background
/// whose elements are not flat in walls is half as large as the mesh. One of 2 million elements took 42 s in
/// two pieces, its solids, and 86 s in 45.
constexpr double undivided_with_walls = 2.5e6;

/// Elements of the model with sizes that do not see thin walls; nothing where it cannot be planned as it was
/// drawn, which it may be without its details. That surfaces cross is thrown if it is to be told.
std::optional<double> elements_without(const model_source& source, const policies_of<3>& policies,
                                       generate_options options, bool crossing_is_told) {
  options.enlarged_above = 0;
  try {
    return plan_generation<3>(source.geometry, source.size, policies, options).predicted_elements;
  } catch (const blames_faces& problem) {
    if (crossing_is_told && is_crossing(problem))
      throw;
    return {};
  }
}

} // namespace

void resolve_walls(model_source& source, const model_options& wanted, const policies_of<3>& policies,
                   generate_options& options) {
  if (!source.thin_walls)
    return;
  const automatic_points points = *std::exchange(source.thin_walls, {});
  if (options.undivided_elements > 0)
    options.undivided_elements = undivided_with_walls;
  const auto elements = elements_without(source, policies, options, wanted.crossing_is_told);
  if (!elements) {
    source.summary.warnings.push_back("thin walls are meshed with flat elements: their sizes need a plan of "
                                      "the model as it was drawn, which "
                                      "could not be made");
    return;
  }
  const thin_wall_sizes walls =
      points.walls_within(wanted.elements.value_or(most_in_walls_by_default) - *elements);
  source.size_of_details = std::exchange(source.size, keep_bounds(points.field(walls)));
  if (walls.least > 0)
    source.summary.warnings.push_back(
        "walls thinner than about " + number_text(sizing::thin_wall * walls.least / walls.factor, 3) +
        " are meshed with flat elements; to resolve all of them about " +
        number_text(*elements + points.elements_in_walls(), 3) + " elements are needed: see --elements");
}

} // namespace dovetail::app
