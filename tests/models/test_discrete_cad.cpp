// CAD parts tessellated by their kernel, written as STL and read back: needles, caps and rounding as in
// practice.
#include "discrete_shapes.hpp"
#include "dovetail/models/discrete_model.hpp"
#include "dovetail/models/occt/triangulation.hpp"
#include "dovetail/models/occt_model.hpp"
#include "model_checks.hpp"

#include <cstdlib>
#include <doctest/doctest.h>

using namespace dovetail;
using namespace dovetail::testing;

namespace {

double volume(const simplicial_mesh<2>& mesh) {
  double sum = 0;
  for (const auto& t : mesh.elements)
    sum += signed_volume({}, mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
  return sum;
}

} // namespace

TEST_CASE("tessellated CAD parts become models of the same volume") {
  const char* shared = std::getenv("DOVETAIL_SHARED");
  if (!shared) {
    MESSAGE("SKIPPED: DOVETAIL_SHARED is not set");
    return;
  }
  const scratch_folder folder("test_discrete_cad");
  for (const char* name : {"linkrods.step", "SampleCrankshaft4A.stp", "U_Joint_2.stp"}) {
    const std::string part = name;
    CAPTURE(part);
    const std::filesystem::path file = std::filesystem::path(shared) / "models" / name;
    const auto cad = read_occt_model(file);
    const auto mesh = occt_triangulation(cad.model).mesh;
    write_binary_stl(folder / "part.stl", {mesh.points, mesh.elements, {}, {}});
    const auto model = read_discrete_model(folder / "part.stl");
    CHECK(volume(model.surface().mesh) == doctest::Approx(volume(mesh)).epsilon(1e-3));
    CHECK(model.topology().solids.size() == 1);
    for (const std::string& fault : faults_of(model))
      FAIL_CHECK(fault);
    MESSAGE(part, ": ", mesh.elements.size(), " triangles, ", cad.model.topology().faces.size(),
            " CAD faces, ", model.topology().faces.size(), " charts");
  }
}
