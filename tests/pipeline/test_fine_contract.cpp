#include "dovetail/geometry/builtin_models.hpp"
#include "dovetail/geometry/occt_read.hpp"
#include "dovetail/mesher/tetgen.hpp"
#include "dovetail/parallel/processes.hpp"
#include "dovetail/partition/metis.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/simplification/none.hpp"
#include "dovetail/sizing/sources.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

using namespace dovetail;

namespace {

/// Angles under 30 degrees that the CAD does not force, of which the fine interfaces still have a few.
struct unforced_angles {
  std::size_t faces = 0;
  std::size_t wedges = 0;
};

generate_result mesh_model(const any_geometry& model, const any_sizing& size) {
  return generate<3>(model, size,
                     parameters<>{}
                         .with_mesher(mesher::tetgen{})
                         .with_partitioner(partition::metis{})
                         .with_improver(improvement::none{})
                         .with_executor(parallel::processes{}));
}

unforced_angles unforced(const interface_angles& angles) {
  unforced_angles found;
  for (const angle_violation& v : angles.violations)
    if (v.cause != violation_cause::forced)
      ++(v.is_wedge() ? found.wedges : found.faces);
  return found;
}

void check_fine(const generate_result& result, const unforced_angles& allowed) {
  const unforced_angles found = unforced(result.fine_angles);
  CHECK(result.fine_angles.interface_faces > 1000);
  CHECK(found.faces <= allowed.faces);
  CHECK(found.wedges <= allowed.wedges);
  CHECK(result.fine_angles.face_angle.angle_deg > 28);
  CHECK(result.fine_angles.min_wedge_deg() > 21);
}

} // namespace

TEST_CASE("fine interfaces of real parts have next to no unforced angles under 30 degrees") {
  const char* shared = std::getenv("DOVETAIL_SHARED");
  if (shared == nullptr) {
    MESSAGE("SKIPPED: DOVETAIL_SHARED is not set");
    return;
  }
  struct part {
    std::string file;
    double size;
    unforced_angles allowed;
  };
  for (const part& each : {part{"linkrods.step", 0.06, {4, 3}}, part{"A319_in_a_box.brep", 2200, {}},
                           part{"SampleCrankshaft4A.stp", 4.8, {}}, part{"U_Joint_2.stp", 1.4, {1, 3}},
                           part{"wing_fuselage.step", 4.5, {}}}) {
    CAPTURE(each.file);
    const auto read = read_occt_model(std::filesystem::path(shared) / "models" / each.file);
    check_fine(mesh_model(read.model, uniform_size(each.size)), each.allowed);
  }
}

TEST_CASE("fine interfaces of a built-in model have no unforced angles under 30 degrees but a few wedges") {
  const auto built = builtin_model("orbiter");
  const any_sizing plain = source_field(built.size, built.sources);
  check_fine(mesh_model(built.model, [&](vec3 p) { return 1.9 * plain(p); }), {0, 2});
}

TEST_CASE(
    "where interfaces end on a sharp edge of the CAD, the angles there are forced, and its entities named") {
  BRepBuilderAPI_MakePolygon corner(gp_Pnt(0, 0, 0), gp_Pnt(3, 0, 0), gp_Pnt(3, 1, 0), true);
  const auto read =
      occt_shape_from(BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(corner.Wire()).Face(), gp_Vec(0, 0, 20)));
  generate_options options;
  options.subdomains = 8;
  const auto result = generate<3>(read.model, uniform_size(0.15),
                                  parameters<>{}
                                      .with_mesher(mesher::tetgen{})
                                      .with_partitioner(partition::metis{})
                                      .with_simplifier(simplifier::none{})
                                      .with_improver(improvement::none{})
                                      .with_options(options));
  CHECK(result.coarse_angles.count(violation_cause::forced) > 0);
  CHECK(result.fine_angles.count(violation_cause::forced) > 0);
  for (const angle_violation& v : result.fine_angles.violations)
    if (v.cause == violation_cause::forced) {
      CHECK(v.cad.size() >= 3);
      CHECK(v.cad.front().dimension == 1);
      CHECK(v.place.x < 0.3);
    }
}
