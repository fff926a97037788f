#include "dovetail/adapters/metis.hpp"
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/background/coarse_volume.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/parallel/checkpointed.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/simplification/none.hpp"
#include "dovetail/sizing/sources.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "files/scratch_folder.hpp"
#include "solid_meshes.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Compound.hxx>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

using namespace dovetail;

namespace {

using testing::volume_of;

TopoDS_Shape drilled_block() {
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(2, 1.5, 1)).Shape();
  const TopoDS_Shape drill =
      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0.8, 0.7, -1), gp_Dir(0, 0, 1)), 0.35, 3).Shape();
  return BRepAlgoAPI_Cut(block, drill).Shape();
}

/// A ball with a spherical void: two shells.
TopoDS_Shape hollow_ball() {
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(1.0).Shape();
  return BRepAlgoAPI_Cut(ball, BRepPrimAPI_MakeSphere(0.4).Shape()).Shape();
}

/// Two boxes that touch: two materials with a shared face.
TopoDS_Shape two_boxes() {
  TopoDS_Compound both;
  BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(1, 1, 1)).Shape());
  builder.Add(both, BRepPrimAPI_MakeBox(gp_Pnt(1, 0.2, 0.1), gp_Pnt(2, 0.8, 0.9)).Shape());
  return both;
}

generate_options in_parts(int subdomains) {
  generate_options options;
  options.subdomains = subdomains;
  return options;
}

/// The whole pipeline with the serial executor unless another is given.
template <executor E = parallel::serial>
generate_result mesh_shape(const TopoDS_Shape& shape, double size, generate_options options, E run = {}) {
  return generate<3>(occt_shape_from(shape).model, uniform_size(size),
                     parameters<>{}
                         .with_mesher(mesher::tetgen{})
                         .with_partitioner(partition::metis{})
                         .with_executor(run)
                         .with_options(std::move(options)));
}

void require_valid(const generate_result& result) {
  REQUIRE(result.failures.empty());
  const auto validity = io::check_distributed(result.mesh);
  CHECK(validity.valid());
  CHECK(result.quality.elements > 0);
}

/// Makes what TetGen makes, and has no other parameters for a background.
struct without_form {
  static constexpr mesher_traits traits = mesher::tetgen::traits;
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const {
    return mesher::tetgen{}(input, size);
  }
};

} // namespace

TEST_CASE("a drilled block is meshed whole, in pieces, with the right volume and clean interfaces") {
  const auto result = mesh_shape(drilled_block(), 0.12, in_parts(5));
  require_valid(result);
  CHECK(result.mesh.counts.size() + static_cast<std::size_t>(result.summary.children[4].get("merges")) == 5);
  CHECK(volume_of(result.mesh) == doctest::Approx(3 - std::numbers::pi * 0.35 * 0.35).epsilon(0.01));
}

TEST_CASE("interfaces are clean in the background mesh, and the prediction is what docs/sizing.md says") {
  for (const double size : {0.12, 0.08}) {
    const auto result = mesh_shape(drilled_block(), size, in_parts(12)); // without the rule 2 and 6 are not
    CHECK(result.coarse_angles.violations.empty());
    CHECK(result.coarse_angles.min_dihedral_deg() >= 30);
    CHECK(result.coarse_angles.face_angle.angle_deg >= 30);
    CHECK(result.fine_angles.min_dihedral_deg() > 30);
    CHECK(result.fine_angles.face_angle.angle_deg > 24); // remeshing to the final size takes some of it
    if (size < 0.1)
      CHECK(result.plan.predicted_elements ==
            doctest::Approx(static_cast<double>(result.quality.elements)).epsilon(0.1));
  }
}

TEST_CASE("poles, seams and a void: a hollow ball") {
  const auto result = mesh_shape(hollow_ball(), 0.15, in_parts(4));
  require_valid(result);
  CHECK(volume_of(result.mesh) == doctest::Approx(4.0 / 3 * std::numbers::pi * (1 - 0.064)).epsilon(0.02));
}

TEST_CASE("a torus, whose face has no natural boundary") {
  const auto result = mesh_shape(BRepPrimAPI_MakeTorus(1.0, 0.4).Shape(), 0.15, in_parts(4));
  require_valid(result);
  CHECK(volume_of(result.mesh) ==
        doctest::Approx(2 * std::numbers::pi * std::numbers::pi * 0.16).epsilon(0.03));
}

TEST_CASE("two materials share the triangles of their common face, and no subdomain has both") {
  const auto result = mesh_shape(two_boxes(), 0.12, in_parts(4));
  require_valid(result);
  CHECK(volume_of(result.mesh) == doctest::Approx(1 + 0.48).epsilon(1e-9));
  double between_materials = 0;
  const fine_skeleton& skeleton = result.mesh.skeleton;
  for (std::size_t t = 0; t < skeleton.sides.size(); ++t) {
    const auto [a, b] = skeleton.subdomains[t];
    if (b == no_id || result.mesh.counts[a].material == result.mesh.counts[b].material)
      continue;
    CHECK(skeleton.side_hosts[t] != no_id);
    const auto at = [&](std::size_t i) { return skeleton.points[skeleton.sides[t][i]]; };
    between_materials += 0.5 * norm(cross(at(1) - at(0), at(2) - at(0)));
  }
  CHECK(between_materials == doctest::Approx(0.48).epsilon(1e-9));
}

TEST_CASE(
    "sizes of a background with many surface triangles are doubled, where the mesher regards its angles") {
  const auto scale_with = [](const any_mesher<3>& mesher, double elements_per_subdomain) {
    generate_options options = in_parts(2);
    options.background_elements_per_subdomain = elements_per_subdomain;
    return make_background<3>(occt_shape_from(drilled_block()).model, uniform_size(0.1),
                              parameters<>{}.with_mesher(mesher).with_options(options))
        .plan.coarse_scale;
  };
  const any_mesher<3> formed(mesher::tetgen{}), plain(without_form{});
  CHECK(scale_with(formed, 10) == doctest::Approx(2 * scale_with(plain, 10)));
  CHECK(scale_with(formed, 1e4) == doctest::Approx(scale_with(plain, 1e4)));
}

TEST_CASE("a background of thin walls is not so coarse that its elements are flat") {
  constexpr double size = 0.05, thick = 0.02;
  const auto of_sheet = [&](double given_scale) {
    generate_options options = in_parts(4);
    options.background_elements_per_subdomain = 100;
    options.coarse_scale = given_scale;
    return generate<3>(occt_shape_from(BRepPrimAPI_MakeBox(2, 1, thick).Shape()).model, uniform_size(size),
                       parameters<>{}.with_options(options));
  };
  const auto fine = of_sheet(0);
  REQUIRE(fine.plan.coarse_scale * size > 2 * 2.5 * thick);
  const auto coarse = of_sheet(fine.plan.coarse_scale); // where it is given walls do not count
  const auto elements = [](const auto& made) { return made.summary.find("background").get("elements"); };
  CHECK(elements(fine) > 2 * elements(coarse));
  CHECK(fine.quality.min_dihedral_deg > coarse.quality.min_dihedral_deg + 3);
}

TEST_CASE("one subdomain needs no volume: the mesh is the one that comes of a background with it") {
  for (const TopoDS_Shape& shape : {drilled_block(), hollow_ball(), two_boxes()}) {
    const any_geometry model(occt_shape_from(shape).model);
    const any_parameters<3> given(parameters<>{}.with_mesher(mesher::tetgen{}).with_options(in_parts(1)));
    const auto surface_alone = make_background<3>(model, uniform_size(0.2), given);
    CHECK(surface_alone.mesh.volume.elements.empty());
    auto with_volume = surface_alone;
    with_volume.mesh.volume =
        background::coarse_volume(with_volume.mesh.surface, model.topology(), uniform_size(0.4),
                                  given.mesh_it, improvement::none{}, given.run_tasks)
            .mesh;
    const auto made = generate_from_background<3>(model, surface_alone, given);
    require_valid(made);
    CHECK(made.mesh.counts.size() == model.topology().solids.size());
    CHECK(made.background.volume.elements.empty());
    CHECK(made.subdomain_of_element.empty());
    CHECK(io::mesh_hash(made.mesh) ==
          io::mesh_hash(generate_from_background<3>(model, with_volume, given).mesh));
  }
}

TEST_CASE("the mesh is the same for every executor and number of workers") {
  const auto hash_with = [](const auto& run) {
    return io::mesh_hash(mesh_shape(drilled_block(), 0.15, in_parts(6), run).mesh);
  };
  const auto expected = hash_with(parallel::serial{});
  for (const int workers : {1, 2, 4})
    CHECK(hash_with(parallel::processes{.worker_count = workers}) == expected);
}

TEST_CASE("in solids whose graph is partitioned in groups interfaces are as clean") {
  generate_options options = in_parts(20);
  const auto hash_with = [&](const auto& run) {
    const auto made = mesh_shape(drilled_block(), 0.12, options, run);
    require_valid(made);
    CHECK(made.coarse_angles.violations.empty());
    return io::mesh_hash(made.mesh);
  };
  const auto at_once = hash_with(parallel::serial{});
  options.partitioned_at_once = 120;
  const auto in_groups = hash_with(parallel::serial{});
  CHECK(in_groups != at_once);
  CHECK(hash_with(parallel::processes{.worker_count = 2}) == in_groups);
}

TEST_CASE("points lie on the CAD entities that they are said to lie on") {
  const auto model = occt_shape_from(drilled_block()).model;
  const auto result = generate<3>(model, uniform_size(0.15),
                                  parameters<>{}.with_mesher(mesher::tetgen{}).with_options(in_parts(5)));
  REQUIRE(result.failures.empty());
  const fine_skeleton& skeleton = result.mesh.skeleton;
  const double tolerance = 1e-9 * model.bounds().diagonal();
  int on_cylinder = 0;
  for (std::size_t t = 0; t < skeleton.sides.size(); ++t) {
    if (skeleton.side_hosts[t] == no_id)
      continue;
    for (const local_id v : skeleton.sides[t]) {
      const vec3 p = skeleton.points[v];
      const double from_axis = std::hypot(p.x - 0.8, p.y - 0.7);
      const bool on_box = std::abs(p.x) < tolerance || std::abs(p.x - 2) < tolerance ||
                          std::abs(p.y) < tolerance || std::abs(p.y - 1.5) < tolerance ||
                          std::abs(p.z) < tolerance || std::abs(p.z - 1) < tolerance;
      const bool on_drill = std::abs(from_axis - 0.35) < tolerance;
      on_cylinder += on_drill;
      REQUIRE((on_box || on_drill));
    }
  }
  CHECK(on_cylinder > 50);
}

namespace {

/// Fails on the piece at the block's corner as long as it is small.
struct fails_on_a_small_corner {
  static constexpr mesher_traits traits = mesher::tetgen::traits;

  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const {
    const auto& points = input.boundary.points;
    const bool has_corner = std::find(points.begin(), points.end(), vec3{0, 0, 0}) != points.end();
    if (has_corner && enclosed_volume(points, input.boundary.elements) < 0.25 * 2.6)
      throw mesher_error("the corner piece is too small for this mesher");
    return mesher::tetgen{}(input, size);
  }
};

} // namespace

TEST_CASE("a subdomain that no attempt can mesh is merged with its neighbour") {
  const auto result =
      generate<3>(occt_shape_from(drilled_block()).model, uniform_size(0.15),
                  parameters<>{}.with_mesher(fails_on_a_small_corner{}).with_options(in_parts(6)));
  require_valid(result);
  CHECK(result.mesh.counts.size() < 6);
  CHECK(result.summary.find("intersection").get("merged_after_failure") >= 1);
  // All but the piece that came of the last merge are found under their keys.
  CHECK(result.summary.children.back().get("reused") == static_cast<double>(result.mesh.counts.size()) - 1);
  // A merge makes no new lines, and new patches only where two regions of a face become one.
  const report& skeleton = result.summary.children[3];
  REQUIRE(skeleton.name == "skeleton");
  CHECK(skeleton.get("lines_made") == 0);
  CHECK(skeleton.get("patches_made") < 0.5 * (skeleton.get("regions") + skeleton.get("interface_faces")));
  CHECK(volume_of(result.mesh) == doctest::Approx(3 - std::numbers::pi * 0.35 * 0.35).epsilon(0.01));
}

TEST_CASE("a run in the spool of an earlier one makes nothing again") {
  const testing::scratch_folder folder("generate");
  const auto run = [&](const spool& disk) {
    return generate<3>(occt_shape_from(drilled_block()).model, uniform_size(0.15),
                       parameters<>{}
                           .with_mesher(mesher::tetgen{})
                           .with_executor(parallel::checkpointed(parallel::processes{2}, disk))
                           .with_options(in_parts(6)));
  };
  const auto first = run(spool::start(folder, {}));
  const auto second = run(spool::resume(folder, {}));
  const auto& stages = second.summary.children;
  CHECK(first.summary.children[0].get("kept", 0) == 0);
  CHECK(stages[0].get("kept") == 1);
  CHECK(first.summary.children[3].get("patches_made") > 0);
  CHECK(stages[3].get("lines_made") == 0);
  CHECK(stages[3].get("patches_made") == 0);
  CHECK(stages[5].get("reused") == static_cast<double>(second.mesh.counts.size()));
  CHECK(second.mesh.skeleton.points == first.mesh.skeleton.points);
  CHECK(second.mesh.skeleton.sides == first.mesh.skeleton.sides);
  CHECK(second.plan.predicted_elements == first.plan.predicted_elements);
}

TEST_CASE("sizes that make no sense are refused") {
  CHECK_THROWS_AS(mesh_shape(drilled_block(), 50, in_parts(2)), sizing_error);
}

TEST_CASE("sizes that predict more elements than wanted are enlarged: in the plan, in the mesh, in a run "
          "that goes on") {
  const testing::scratch_folder folder("enlarged");
  const auto model = occt_shape_from(drilled_block()).model;
  auto options = in_parts(2);
  options.enlarged_above = 5000;
  const auto policies = parameters<>{}.with_mesher(mesher::tetgen{});
  const auto plan = plan_background<3>(model, uniform_size(0.02), policies.with_options(options));
  CHECK(plan.predicted_elements <= 5000); // fewer by what improvement and interfaces take
  CHECK(plan.predicted_elements > 4400);
  CHECK(plan.size_scale > 5);
  const auto background_in = [&](const spool& disk) {
    return make_background<3>(
        model, uniform_size(0.02),
        policies.with_executor(parallel::checkpointed(parallel::serial{}, disk)).with_options(options));
  };
  const auto made = background_in(spool::start(folder, {}));
  const auto kept = background_in(spool::resume(folder, {}));
  CHECK(kept.summary.get("kept") == 1);
  for (const auto& background : {made, kept}) {
    CHECK(background.size({1, 1, 0.5}) == doctest::Approx(0.02 * plan.size_scale));
    REQUIRE(background.summary.warnings.size() == 1);
    CHECK(background.summary.warnings[0].find("enlarged by a factor of ") != std::string::npos);
  }
  const auto result = generate_from_background<3>(model, kept, policies.with_options(options));
  require_valid(result);
  CHECK(static_cast<double>(result.quality.elements) == doctest::Approx(5000).epsilon(0.3));

  options.enlarged_above = 1e7;
  CHECK(plan_background<3>(model, uniform_size(0.02), policies.with_options(options)).size_scale == 1);
}

TEST_CASE("multiples of a field are planned as they are one by one") {
  const auto model = any_geometry(occt_shape_from(drilled_block()).model);
  const erased_sizing size(source_field(0.1, {point_source({1, 1, 0.5}, 0.1, 0.5, 0.03)}));
  const auto check = [&](const auto dimension) {
    constexpr int d = decltype(dimension)::value;
    const auto plan_times = plan_multiples<d>(model, size, parameters<>{});
    for (const double factor : {1.0, 0.5, 2.0, 8.0}) { // the last is beyond the largest coarse size
      const mesh_plan one = plan_background<d>(model, scaled(size, factor), parameters<>{});
      const mesh_plan of_many = plan_times(factor);
      CHECK(of_many.predicted_elements == doctest::Approx(one.predicted_elements).epsilon(0.02));
      CHECK(of_many.relative_error == doctest::Approx(one.relative_error).epsilon(0.2));
      CHECK(of_many.subdomains == one.subdomains);
    }
    CHECK(plan_times(0.5).predicted_elements > 3 * plan_times(1).predicted_elements);
    CHECK_THROWS_AS(plan_times(1000), sizing_error); // larger than the model
    CHECK_THROWS_AS(plan_times(1e-12), sizing_error);
  };
  check(std::integral_constant<int, 3>{});
  check(std::integral_constant<int, 2>{});
}

TEST_CASE(
    "a mesh of fewer elements than one piece may have is not divided, unless subdomains are asked for") {
  const auto model = occt_shape_from(drilled_block()).model;
  const auto subdomains = [&](double undivided, int wanted) {
    return plan_background<3>(
               model, uniform_size(0.02),
               parameters<>{}.with_options({.subdomains = wanted, .undivided_elements = undivided}))
        .subdomains;
  };
  const int many = subdomains(0, 0);
  CHECK(many > 4);
  CHECK(subdomains(1e9, 0) == 1);
  CHECK(subdomains(1e4, 0) == many);
  CHECK(subdomains(1e9, 3) == 3);
}

TEST_CASE("the simplification is by the rule chosen; by none a mesh is made too, for comparison") {
  const auto removed_sides = [](const auto& rule) {
    const auto result = generate<3>(
        occt_shape_from(drilled_block()).model, uniform_size(0.15),
        parameters<>{}.with_mesher(mesher::tetgen{}).with_simplifier(rule).with_options(in_parts(5)));
    require_valid(result);
    const report& simplification = result.summary.children[1];
    REQUIRE(simplification.name == "simplification");
    return simplification.children[0].get("removed_sides") + simplification.children[1].get("removed_sides");
  };
  CHECK(removed_sides(simplifier::none{}) == 0);
  CHECK(removed_sides(simplifier::paper{}) > 0);
}
