#include "solve.hpp"

#include "dovetail/adapters/metis.hpp"
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/models/occt_model.hpp"

dovetail::simplicial_mesh<3> mesh_of_a_tetrahedron() {
  dovetail::mesher_input<3> input;
  input.boundary.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  input.boundary.elements = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return dovetail::mesher::tetgen{}(input, [](dovetail::vec3) { return 1.0; }).mesh;
}

std::vector<dovetail::local_id> halves_of_a_path_of_four() {
  dovetail::csr_graph path;
  path.offsets = {0, 1, 3, 5, 6};
  path.neighbours = {1, 0, 2, 1, 3, 2};
  path.edge_weights.assign(6, 1.0);
  path.node_weights.assign(4, 1.0);
  return dovetail::partition::metis{}(path, 2);
}
