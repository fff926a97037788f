#include "dovetail/experiments/builtin_models.hpp"
#include "dovetail/models/occt/shape.hpp"
#include "dovetail/models/occt/triangulation.hpp"
#include "models/model_checks.hpp"
#include "models/triangulation_checks.hpp"

#include <BRepCheck_Analyzer.hxx>
#include <doctest/doctest.h>

#include <numbers>
#include <set>

using namespace dovetail;

namespace {

std::set<std::string> groups_of(const occt_model& model) {
  std::set<std::string> groups;
  for (const auto& face : model.topology().faces)
    groups.insert(face.group);
  return groups;
}

/// Everything that holds for all built-in models; returns the volume.
double check_soundness(const builtin_model_result& made, int shells) {
  const occt_model& model = made.model;
  CHECK(made.report.warnings.empty());
  CHECK(BRepCheck_Analyzer(model.shape()).IsValid());
  CHECK(model.topology().solids.size() == 1);
  CHECK(occt::sub_shapes(model.shape(), TopAbs_SHELL).Extent() == shells);
  CHECK(testing::joined(testing::faults_of(model)) == "");
  for (const auto& curve : model.topology().curves)
    CHECK(curve.tolerance <= 1e-5 * model.bounds().diagonal());
  const double deflection = 2e-4 * model.bounds().diagonal();
  const surface_mesh surface = occt_triangulation(model, {.deflection = deflection});
  CHECK(testing::open_edges(model.topology(), surface) == 0);
  const double volume = occt_solid_volumes(model).front();
  CHECK(testing::enclosed_volumes(model.topology(), surface).front() ==
        doctest::Approx(volume).epsilon(0.005));
  CHECK(made.size > 0);
  CHECK(made.size < model.bounds().diagonal() / 10);
  return volume;
}

} // namespace

TEST_CASE("the aircraft is the flow domain around one body and two free stores") {
  const auto made = builtin_model("aircraft");
  const double volume = check_soundness(made, 4); // far field, aircraft, two missiles
  const double body = 75 * 60 * 60 - volume;
  CHECK(body > 30);
  CHECK(body < 45);
  CHECK(groups_of(made.model) ==
        std::set<std::string>{"farfield", "fuselage", "pylon", "store", "tail", "wing"});
  CHECK(made.sources.size() > 20);
  CHECK_NOTHROW(source_field(made.size, made.sources));
}

TEST_CASE("the left half of the aircraft mirrors the right one") {
  const auto made = builtin_model("aircraft");
  const std::vector<double> areas = occt_face_areas(made.model);
  double left = 0, right = 0;
  for (std::size_t f = 0; f < areas.size(); ++f) {
    const auto& face = made.model.topology().faces[f];
    if (face.group != "wing" && face.group != "store" && face.group != "pylon")
      continue;
    const vec2 uv = made.model.curve_uv(static_cast<local_id>(f), 0, 0.0);
    const double y = made.model.face_point(static_cast<local_id>(f), uv).y;
    (y > 0 ? right : left) += areas[f];
  }
  CHECK(left > 1);
  CHECK(left == doctest::Approx(right).epsilon(1e-6));
}

TEST_CASE("the combustor liner has hundreds of holes") {
  const auto made = builtin_model("combustor");
  const double volume = check_soundness(made, 1);
  using std::numbers::pi;
  const double annulus = pi * (100 * 100 - 96 * 96) * 240;
  const double holes = 4 * pi * (288 * 2.5 * 2.5 + 24 * 6 * 6); // as if the liner were flat
  CHECK(volume == doctest::Approx(annulus - holes).epsilon(0.001));
  CHECK(groups_of(made.model) == std::set<std::string>{"ends", "holes", "inner", "outer"});
}

TEST_CASE("the orbiter is the flow domain around one body") {
  const auto made = builtin_model("orbiter");
  const double body = 150 * 120 * 120 - check_soundness(made, 2);
  CHECK(body > 700);
  CHECK(body < 900);
  CHECK(groups_of(made.model) == std::set<std::string>{"farfield", "fuselage", "pods", "tail", "wing"});
  CHECK_NOTHROW(source_field(made.size, made.sources));
}

TEST_CASE("an unknown model is refused, naming those there are") {
  CHECK_THROWS_WITH_AS(builtin_model("teapot"), doctest::Contains("aircraft, combustor, orbiter"),
                       input_error);
  for (const auto& info : builtin_models())
    CHECK(!info.description.empty());
}
