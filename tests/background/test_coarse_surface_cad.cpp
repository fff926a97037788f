#include "dovetail/background/coarse_surface.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/remesh/patch_remesher.hpp"
#include "surface_checks.hpp"

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <numbers>

using namespace dovetail;
using namespace dovetail::test;

namespace {

constexpr double pi = std::numbers::pi;

background::coarse_surface_result mesh(const occt_model& model, double size) {
  return background::coarse_surface(
      model, [size](vec3) { return size; }, {}, parallel::serial{}, remesh::patch_remesher{});
}

void check_primitive(const TopoDS_Shape& shape, double size, double volume, double error) {
  const auto read = occt_shape_from(shape);
  const auto result = mesh(read.model, size);
  CHECK(open_edges(result.surface, read.model.topology()) == 0);
  CHECK(crowded_edges(result.surface) == 0);
  CHECK(parameter_error(result.surface, read.model) < 1e-9);
  CHECK(volume_of(result.surface) == doctest::Approx(volume).epsilon(error));
  CHECK(result.summary.get("min_angle_deg") > 25);
}

std::filesystem::path shared_folder() {
  const char* folder = std::getenv("DOVETAIL_SHARED");
  return folder ? folder : "";
}

/// Meshes a file at diagonal / 25 and checks that the result is a closed surface.
void check_file(const std::string& name) {
  CAPTURE(name);
  const auto read = read_occt_model(shared_folder() / name);
  const auto result = mesh(read.model, read.model.bounds().diagonal() / 25);
  CHECK(open_edges(result.surface, read.model.topology()) == 0);
  CHECK(volume_of(result.surface) > 0);
  double tolerance = 0;
  for (const auto& curve : read.model.topology().curves)
    tolerance = std::max(tolerance, curve.tolerance);
  for (const auto& vertex : read.model.topology().vertices)
    tolerance = std::max(tolerance, vertex.tolerance);
  CHECK(parameter_error(result.surface, read.model) <= 2 * tolerance + 1e-7);
}

} // namespace

TEST_CASE("tubes far thinner than the size have no edge of four triangles") {
  for (const TopoDS_Shape& shape :
       {BRepPrimAPI_MakeTorus(10, 9.9).Shape(), BRepPrimAPI_MakeCone(1, 0, 50).Shape()}) {
    const auto read = occt_shape_from(shape);
    const auto result = mesh(read.model, read.model.bounds().diagonal() / 8);
    CHECK(open_edges(result.surface, read.model.topology()) == 0);
    CHECK(crowded_edges(result.surface) == 0);
  }
}

TEST_CASE("boxes, balls, rings and cones of the CAD kernel are closed and have their volume") {
  check_primitive(BRepPrimAPI_MakeBox(1, 2, 3).Shape(), 0.5, 6, 1e-12);
  check_primitive(BRepPrimAPI_MakeSphere(2).Shape(), 0.3, 4 * pi / 3 * 8, 0.02);
  check_primitive(BRepPrimAPI_MakeTorus(3, 1).Shape(), 0.3, 2 * pi * pi * 3, 0.03);
  check_primitive(BRepPrimAPI_MakeCone(1, 0, 2).Shape(), 0.1, 2 * pi / 3, 0.02);
}

TEST_CASE("real models are meshed at their default size") {
  if (shared_folder().empty()) {
    MESSAGE("SKIPPED: DOVETAIL_SHARED is not set");
    return;
  }
  check_file("models/linkrods.step");
  check_file("models/SampleCrankshaft4A.stp");
  check_file("models/wing_fuselage.step");
  check_file("corpus/OCC12121-CrankArm.brep"); // narrow faces between nearly touching curves
  check_file("corpus/OCC13116_sh1.brep");
  check_file("corpus/bug27760_leid.brep"); // a disc in polar coordinates
  check_file("corpus/bug28345_30338.stp");
}
