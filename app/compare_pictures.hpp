/// @file
/// Pictures of a run's result: the decomposition, its interfaces, its worst elements.
#pragma once

#include "dovetail/pipeline/generate.hpp"
#include "raster_image.hpp"

namespace dovetail::app {

/// The subdomains, each in a colour of its own; of dimension 3 pulled apart.
raster_image picture_of_decomposition(const generated<3>& result);
raster_image picture_of_decomposition(const generated<2>& result);

/// The interfaces inside the model, and the model's curves. What is under the threshold is red, as lines that
/// nothing hides; of dimension 2 a cross at a corner.
raster_image picture_of_interfaces(const generated<3>& result);
raster_image picture_of_interfaces(const generated<2>& result);

/// The elements with the smallest angles, drawn large enough to be seen, and the model's curves. Red: bad
/// ones; orange: low ones; blue: better (`words_of`). Loads one piece after the other. D: 2 or 3.
template <int D>
raster_image picture_of_worst_elements(const generated<D>& result);

/// How many elements that picture shows at most.
inline constexpr std::size_t worst_elements_shown = 200;

} // namespace dovetail::app
