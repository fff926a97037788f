// A user's project: nothing but the installed package and the components it asked for. Two translation units
// include the same headers, so that a function that is not inline would fail to link.
#include "solve.hpp"

#include "dovetail/adapters/metis.hpp"
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/core/version.hpp"
#include "dovetail/models/occt_model.hpp"

#include <BRepPrimAPI_MakeBox.hxx>

#include <iostream>

int main() {
  const auto box = dovetail::occt_shape_from(BRepPrimAPI_MakeBox(1, 2, 3).Shape(), "box");
  const std::size_t faces = box.model.topology().faces.size();
  const std::size_t tetrahedra = mesh_of_a_tetrahedron().elements.size();
  const auto parts = halves_of_a_path_of_four();
  std::cout << "dovetail " << dovetail::version << ": " << faces << " faces, " << tetrahedra
            << " tetrahedra\n";
  return faces == 6 && tetrahedra >= 1 && parts[0] == parts[1] && parts[1] != parts[2] ? 0 : 1;
}
