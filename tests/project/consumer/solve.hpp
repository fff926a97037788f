#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <vector>

dovetail::simplicial_mesh<3> mesh_of_a_tetrahedron();
std::vector<dovetail::local_id> halves_of_a_path_of_four();
