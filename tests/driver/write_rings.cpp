// Writes CAD files of bars that touch themselves, nearly do, or pass through themselves:
//   write_rings FOLDER
#include "models/rings.hpp"

#include <BRepTools.hxx>

#include <string>

int main(int, char** argv) {
  using namespace dovetail::testing;
  const std::string folder = argv[1];
  const auto write = [&](const TopoDS_Shape& shape, const char* name) {
    return BRepTools::Write(shape, (folder + "/" + name).c_str());
  };
  const bool ok = write(ring_with_tip(3), "touching.brep") && write(ring_with_slit(1e-4), "slit.brep") &&
                  write(ring_through_itself(), "crossing.brep") && write(pin_in_hole(5e-5), "pin.brep");
  return ok ? 0 : 1;
}
