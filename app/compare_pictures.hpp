/// @file
/// Pictures of a run's result: the decomposition, its interfaces, its worst elements.
#pragma once

#include "dovetail/decomposition/interface_contract.hpp"
#include "dovetail/io/raster_image.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

namespace dovetail::app {

/// The subdomains pulled apart, each in a colour of its own.
io::raster_image picture_of_decomposition(const fine_skeleton& skeleton);

/// The interfaces inside the model, and the model's curves. What breaks the contract is red, as lines that
/// nothing hides.
io::raster_image picture_of_interfaces(const fine_skeleton& skeleton, const interface_contract& contract);

/// The elements with the smallest dihedral angles, drawn large enough to be seen, and the model's curves.
/// Red: under 12 degrees; orange: under 24; blue: better. Loads one piece after the other.
io::raster_image picture_of_worst_elements(const distributed_mesh& mesh);

/// How many elements that picture shows at most.
inline constexpr std::size_t worst_elements_shown = 200;

} // namespace dovetail::app
