// The compiled mesher of CGAL is called: without triangles there is nothing to mesh.
#include "dovetail/adapters/cgal_mesh_3.hpp"
#include "dovetail/core/error.hpp"

#include <cstdio>

int main() {
  const dovetail::simplicial_mesh<2> nothing;
  try {
    dovetail::mesher::cgal_mesh_3{}({nothing, 0}, [](dovetail::vec3) { return 1.0; });
  } catch (const dovetail::error& refused) {
    std::puts(refused.what());
    return 0;
  }
  return 1;
}
