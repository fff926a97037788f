/// @file
/// The fields of a mesh file, carried over to another mesh of the same domain.
#pragma once

#include "dovetail/mesh/loaded_mesh.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <string>
#include <vector>

namespace dovetail::app {

struct mesh_fields {
  std::vector<io::mesh_field> at_points, in_elements;
};

/// Those of a mesh that was read with fields, in the order of the file. Throws `input_error` naming the file
/// where there are none, and where a value is no finite number.
mesh_fields fields_of(const io::loaded_mesh& mesh, const std::string& file);

/// Their names.
std::string in_words(const mesh_fields& fields);

/// `transferred_to_points` and `transferred_to_elements`, of all fields at once.
template <int D>
mesh_fields carried_over(const mesh_fields& fields, const simplicial_mesh<D>& from,
                         const simplicial_mesh<D>& to);

} // namespace dovetail::app
