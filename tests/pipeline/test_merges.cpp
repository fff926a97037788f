#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/intersection/merge_subdomains.hpp"
#include "dovetail/intersection/suppression.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesher/native_surface.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/models/plane/read.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/parallel/checkpointed.hpp"
#include "dovetail/parallel/kept.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/spool.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/pipeline/divide.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/pipeline/given_up.hpp"
#include "dovetail/pipeline/rounds.hpp"
#include "dovetail/simplification/none.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "files/scratch_folder.hpp"
#include "pipeline/decomposed_shell.hpp"
#include "support/refusal.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Compound.hxx>
#include <doctest/doctest.h>
#include <gp_Pln.hxx>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <vector>

using namespace dovetail;
using dovetail::testing::decomposed_shell;
using dovetail::testing::shell;

namespace {

/// A thin shell where one merge leads to another. How many parts that takes is a matter of the version of
/// METIS.
std::unique_ptr<decomposed_shell> shell_of_many_rounds() {
  for (const int parts : {24, 48, 64, 80}) {
    auto given = std::make_unique<decomposed_shell>(0.975, parts);
    auto rounds = given->rounds(1);
    if (rounds.realize_boundaries() && rounds.intersection().get("rounds") > 2)
      return given;
  }
  REQUIRE_MESSAGE(false, "no merge leads to another");
  return {};
}

/// Folds each patch over at an inner point.
patch_mesh fold(const any_surface& surface, const patch_boundary& boundary, const any_sizing& size) {
  patch_mesh mesh = remesh::patch_remesher{}(surface, boundary, size);
  for (std::size_t t = 0; t < mesh.triangles.size() && mesh.folded.empty(); ++t)
    if (std::all_of(mesh.triangles[t].begin(), mesh.triangles[t].end(), [&](local_id v) {
          return static_cast<std::size_t>(v) >= boundary.points.size();
        })) { // the triangle's first point goes beyond the opposite side
      const auto inner = [&](std::size_t corner) {
        return static_cast<std::size_t>(mesh.triangles[t][corner]) - boundary.points.size();
      };
      vec2& uv = mesh.inner_uv[inner(0)];
      uv = mesh.inner_uv[inner(1)] + mesh.inner_uv[inner(2)] - uv;
      mesh.inner_points[inner(0)] = surface.frame(uv).point;
      mesh.folded = {static_cast<local_id>(t)};
    }
  return mesh;
}

/// Whether they are all on one sphere about the origin, as those of faces of a shell and of a ball.
bool on_one_sphere(const std::vector<vec3>& points) {
  return std::all_of(points.begin(), points.end(),
                     [&](vec3 p) { return std::abs(norm(p) - norm(points.front())) < 1e-3; });
}

/// Two triangles that cross in their middles.
fine_skeleton crossing_triangles_on(local_id first_face, local_id second_face) {
  fine_skeleton skeleton;
  skeleton.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, -1}, {0.5, 0.5, 1}, {-3, -3, 0.5}};
  skeleton.sides = {{0, 1, 2}, {3, 4, 5}};
  skeleton.subdomains = {{2, 7}, {1, 9}};
  skeleton.side_hosts = {first_face, second_face};
  return skeleton;
}

suppression_plan plan_for(const fine_skeleton& skeleton, bool planar = false) {
  return plan_suppression(skeleton, std::vector<bool>(skeleton.sides.size(), planar), parallel::serial{});
}

using pairs = std::vector<std::array<local_id, 2>>;

/// Fails on the piece at the origin, whatever its size.
struct fails_at_origin {
  static constexpr mesher_traits traits = mesher::native_surface::traits;
  mesher_result<2> operator()(const mesher_input<2>& input, const any_sizing& size) const {
    const auto& points = input.boundary.points;
    if (std::find(points.begin(), points.end(), vec3{0, 0, 0}) != points.end())
      throw mesher_error("not here");
    return mesher::native_surface{}(input, size);
  }
};

} // namespace

TEST_CASE("An interface that crosses the surface goes, with the two subdomains at it merged") {
  for (const bool first_is_inner : {true, false}) {
    const auto plan =
        plan_for(first_is_inner ? crossing_triangles_on(no_id, 4) : crossing_triangles_on(4, no_id));
    CHECK(plan.crossings == 1);
    CHECK(plan.merges == (first_is_inner ? pairs{{2, 7}} : pairs{{1, 9}}));
    CHECK(plan.surface_crossings.empty());
  }
}

TEST_CASE(
    "Of two interfaces that cross the one with the smaller pair goes; those of the coarse mesh cannot") {
  CHECK(plan_for(crossing_triangles_on(no_id, no_id)).merges == pairs{{1, 9}});
  CHECK(plan_for(crossing_triangles_on(no_id, no_id), true).empty());
}

TEST_CASE("Where two CAD faces cross a smaller size is asked for, by their names and place") {
  const auto plan = plan_for(crossing_triangles_on(4, 5));
  CHECK(plan.merges.empty());
  REQUIRE(plan.surface_crossings.size() == 1);
  const surface_crossing& crossing = plan.surface_crossings.front();
  CHECK(crossing.cad_faces == std::array<local_id, 2>{4, 5});
  CHECK(crossing.size > 2);
  CHECK(crossing.size < 5);
  CHECK(distance(crossing.center, {-1.0 / 12, -1.0 / 12, 1.0 / 12}) < 1);
}

TEST_CASE("What a run may merge is counted from its beginning, whoever asks") {
  std::vector<local_id> of_element{0, 1, 2, 3, 4, 5, 6, 7};
  merge_account account(8, 0.05);
  for (int round = 0; round < 2; ++round) {
    CHECK(account.refusal_of({{0, 1}}).empty());
    account.merge(of_element, {{0, 1}});
  }
  CHECK(account.subdomains() == 6);
  CHECK(account.merged() == 2);
  CHECK(account.largest() == 3);
  CHECK(account.refusal_of({{0, 5}}) == "3 of 8 subdomains would have to be merged, 2 may be");
  CHECK(account.merged() == 2);
  CHECK(of_element == std::vector<local_id>{0, 0, 0, 1, 2, 3, 4, 5});
}

TEST_CASE("One of four subdomains may be merged, two may not; of many a fraction") {
  const auto most_of = [](local_id subdomains) {
    local_id merged = 0;
    std::vector<local_id> of_element(static_cast<std::size_t>(subdomains));
    std::iota(of_element.begin(), of_element.end(), local_id{0});
    merge_account account(subdomains, 0.05);
    for (; account.subdomains() > 1 && account.refusal_of({{0, 1}}).empty(); ++merged)
      account.merge(of_element, {{0, 1}});
    return merged;
  };
  CHECK(most_of(1) == 0);
  CHECK(most_of(2) == 1);
  CHECK(most_of(4) == 1);
  CHECK(most_of(8) == 2);
  CHECK(most_of(39) == 2);
  CHECK(most_of(100) == 5);
}

TEST_CASE("The measuring of interface angles is a step of its own, with its time in the account") {
  constexpr double slow = 0.3;
  decomposed_shell given(0.5, 6);
  int steps = 0;
  given.given.options.on_progress.update = [&](std::string_view stage, std::size_t done, std::size_t total) {
    if (stage != "intersection" || done + total > 0)
      return;
    ++steps;
    std::this_thread::sleep_for(std::chrono::duration<double>(slow));
  };
  auto rounds = given.rounds(1);
  rounds.realize_boundaries();
  CHECK(steps > rounds.intersection().get("rounds")); // the searches for crossings, and this
  CHECK(rounds.intersection().seconds >= slow * steps);
}

TEST_CASE("Crossing interfaces of a thin shell are merged until none is left, each merge counted once") {
  const auto shell = shell_of_many_rounds();
  decomposed_shell& given = *shell;
  auto rounds = given.rounds(1);
  const auto result = rounds.realize_boundaries().value();
  const merge_account& account = rounds.merges();
  CHECK(plan_for(result.fine).empty());
  CHECK(rounds.intersection().get("rounds") > 2);
  std::map<local_id, std::set<local_id>> made_of;
  std::map<local_id, std::set<local_id>> went_to;
  for (std::size_t e = 0; e < result.subdomain_of_element.size(); ++e) {
    made_of[result.subdomain_of_element[e]].insert(given.pieces.part_of_element[e]);
    went_to[given.pieces.part_of_element[e]].insert(result.subdomain_of_element[e]);
  }
  std::size_t largest = 0;
  for (const auto& [subdomain, parts] : made_of)
    largest = std::max(largest, parts.size());
  for (const auto& [part, subdomains] : went_to)
    CHECK(subdomains.size() == 1);
  CHECK(largest > 2);
  CHECK(account.largest() == static_cast<local_id>(largest));
  CHECK(account.subdomains() == static_cast<local_id>(made_of.size()));
  CHECK(account.merged() == given.pieces.parts - static_cast<local_id>(made_of.size()));

  auto few = given.rounds(0.05);
  CHECK(!few.realize_boundaries());
  CHECK(testing::has(few.too_many_merges(), "subdomains would have to be merged"));
}

TEST_CASE(
    "Where too many subdomains would have to be merged fewer are made, and what was done is told of all") {
  const testing::scratch_folder scratch("given_up");
  std::vector<int> asked;
  const auto partitioner = [&asked](const auto& graph, int parts) {
    asked.push_back(parts);
    return partition::greedy{}(graph, parts);
  };
  generate_options options;
  options.subdomains = 16;
  options.coarse_scale = testing::flat_in_shells;
  const any_executor keeps = parallel::checkpointed(parallel::serial{}, spool::start(scratch, {}));
  int searches = 0;
  options.on_progress.update = [&searches](std::string_view stage, std::size_t, std::size_t tasks) {
    // where one for crossings begins, or for angles
    searches += stage == "intersection" && tasks == 0 ? 1 : 0;
  };
  const auto run = [&] {
    asked.clear();
    searches = 0;
    return generate<3>(shell(0.97), uniform_size(0.2),
                       parameters<>{}
                           .with_mesher(mesher::tetgen{})
                           .with_partitioner(partitioner)
                           .with_executor(keeps)
                           .with_options(options));
  };
  const auto result = run();
  const report& account = result.summary.find("intersection");
  CHECK(result.failures.empty());
  CHECK(asked.front() == 16);
  CHECK(result.plan.subdomains == asked.back());
  CHECK(result.plan.subdomains < 16);
  CHECK(result.mesh.counts.size() <= static_cast<std::size_t>(result.plan.subdomains));
  REQUIRE_FALSE(account.warnings.empty());
  CHECK(testing::has(account.warnings[0], "16 subdomains were too many, so 8 were asked for: "));
  CHECK(testing::has(account.warnings[0], " of 16 subdomains would have to be merged, 2 may be"));
  CHECK(account.get("rounds") + 1 == searches); // angles are measured in the end
  CHECK(account.children.empty());              // times of stages are with these

  // A run that goes on does not begin with what was given up, and tells the same.
  const int last = asked.back();
  const auto resumed = run();
  CHECK(asked == std::vector<int>{last});
  CHECK(searches > 0);
  CHECK(searches < account.get("rounds"));
  CHECK(resumed.summary.find("intersection").counters == account.counters);
  CHECK(resumed.summary.find("intersection").warnings == account.warnings);
  CHECK(resumed.mesh.skeleton.points == result.mesh.skeleton.points);
}

TEST_CASE("What stages of a decomposition that was given up took is time of the same stages") {
  report account;
  account.seconds = 1;
  add_time(account, "partition", 2);
  add_time(account, "skeleton", 3);
  add_time(account, "partition", 4);
  std::vector<report> stages(2);
  stages[0].name = "partition";
  stages[0].seconds = 10;
  stages[1].name = "meshing";
  stages[1].seconds = 20;
  give_time_to_stages(account, stages);
  CHECK(stages[0].seconds == 16);
  CHECK(stages[1].seconds == 20);
  CHECK(account.seconds == 1);
  CHECK(account.children.empty());
}

TEST_CASE("Regions that stay folded over ask for fewer subdomains, as long as there are more than solids") {
  TopoDS_Compound balls; // one within a cavity of the other
  BRep_Builder().MakeCompound(balls);
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(1.0).Shape();
  BRep_Builder().Add(balls, BRepAlgoAPI_Cut(ball, BRepPrimAPI_MakeSphere(0.5).Shape()).Shape());
  BRep_Builder().Add(balls, BRepPrimAPI_MakeSphere(0.25).Shape());
  const any_geometry two(occt_shape_from(balls).model);
  for (const auto& [model, count, can_be_fewer] : {std::tuple{shell(0.5), 4, true}, {two, 2, false}}) {
    const int parts = count; // named, since clang 14 captures no structured binding
    CAPTURE(parts);
    decomposed_shell given(model, parts);
    REQUIRE(given.pieces.parts == parts);
    given.given.mesh_surface =
        any_surface_mesher([](const any_surface& s, const patch_boundary& b, const any_sizing& h) {
          return on_one_sphere(b.points) ? fold(s, b, h) : remesh::patch_remesher{}(s, b, h);
        });
    auto rounds = given.rounds(0.05);
    if (can_be_fewer) {
      CHECK(!rounds.realize_boundaries());
      CHECK(!rounds.too_many_merges().empty());
      CHECK(rounds.give_up().find("skeleton").seconds > 0);
    } else {
      CHECK_THROWS_WITH_AS(rounds.realize_boundaries(),
                           doctest::Contains("stays folded over, also when refined"), intersection_error);
    }
    CHECK(rounds.intersection().get("refinements") ==
          (can_be_fewer ? 2 : given.given.options.refinement_rounds));
  }
}

TEST_CASE("What a rule wants alone decides what is counted as too small") {
  struct untouched : simplifier::none {
    double angle = 0;
    wanted_angles wants(int) const { return {angle, angle}; }
  };
  decomposed_shell given(0.5, 6);
  const auto divided_by = [&](double angle) {
    untouched rule;
    rule.angle = angle;
    given.given.simplify_by = rule;
    return divide<3>(given.background.mesh, given.background.size, 6, given.given);
  };
  const auto mild = divided_by(10), strict = divided_by(45);
  CHECK(mild.pieces.part_of_element == strict.pieces.part_of_element);
  CHECK(mild.angles.violations.empty());
  CHECK(!strict.angles.violations.empty());
  for (const angle_violation& v : strict.angles.violations)
    CHECK(v.angle_deg < 45);
}

TEST_CASE("Lines whose numbers suit each other, but not the patches on them, are as they were") {
  decomposed_shell given(0.5, 16);
  const auto realize_with = [&](const any_surface_mesher& mesher, double least_angle_deg) {
    given.given.mesh_surface = mesher;
    given.want(least_angle_deg);
    skeleton_memo store;
    return realize<3>(given.model, given.background.mesh, given.divided, given.pieces.part_of_element,
                      static_cast<std::size_t>(given.pieces.parts), given.background.size, store,
                      given.given);
  };
  const auto matched = realize_with({}, 30);
  CHECK(matched.summary.get("matched_lines") > 0);
  std::set<kept<patch_mesh>> loops;
  const auto remembers = [&loops](const any_surface& s, const patch_boundary& b, const any_sizing& h) {
    loops.insert(kept<patch_mesh>::of(b.points));
    return remesh::patch_remesher{}(s, b, h);
  };
  const auto refuses_others = [&loops](const any_surface& s, const patch_boundary& b, const any_sizing& h) {
    patch_mesh mesh = remesh::patch_remesher{}(s, b, h);
    if (!loops.contains(kept<patch_mesh>::of(b.points)))
      mesh.crossings = {{0, 1}};
    return mesh;
  };
  const auto unmatched = realize_with(any_surface_mesher(remembers), 1e-3);
  CHECK(unmatched.summary.get("matched_lines") == 0);
  CHECK(unmatched.fine.points != matched.fine.points);
  const auto taken_back = realize_with(any_surface_mesher(refuses_others), 30);
  CHECK(taken_back.patches.failures.empty());
  CHECK(taken_back.summary.get("matched_lines") == 0);
  CHECK(taken_back.fine.points == unmatched.fine.points);
}

TEST_CASE("A decomposition that is given up leaves its account, and no pieces") {
  const testing::scratch_folder scratch("given_up");
  decomposed_shell given(0.5, 6);
  given.given.run_tasks = parallel::checkpointed(parallel::serial{}, spool::start(scratch, {}));
  const auto pieces = [&] {
    const auto files = entries_of(scratch);
    return std::count_if(files.begin(), files.end(), [](const std::filesystem::path& file) {
      return file.filename().string().starts_with("piece_");
    });
  };
  auto rounds = given.rounds(0.05);
  rounds.mesh_pieces();
  CHECK(pieces() == 6);
  const report account = rounds.give_up();
  CHECK(pieces() == 0);
  CHECK(account.get("rounds") > 0);

  given.given.run_tasks = parallel::serial{};
  decomposition_rounds<3, any_parameters<3>> next(given.model, given.background.mesh, given.divided,
                                                  given.background.size, given.given, account);
  CHECK(next.intersection().get("rounds") == account.get("rounds"));
  next.realize_boundaries();
  CHECK(next.intersection().get("rounds") == 2 * account.get("rounds"));
  CHECK(next.intersection().get("largest_merged") == account.get("largest_merged"));
}

TEST_CASE("Sheets that lie upon each other end in an error after work in proportion to the model") {
  TopoDS_Compound both;
  BRep_Builder().MakeCompound(both);
  for (const double shift : {0.0, 0.3})
    BRep_Builder().Add(
        both, BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(shift, shift, 0), gp::DZ()), -1, 1, -1, 1).Face());
  const any_geometry model(occt_shape_from(both, "sheets", occt::wanted::faces).model);
  long asked = 0;
  const auto size = [&asked](vec3) {
    ++asked;
    return 0.2;
  };
  CHECK_THROWS_WITH_AS(plan_background<2>(model, erased_sizing(size), parameters<>{}),
                       doctest::Contains("the surfaces of face 0 and face 1 cross"), intersection_error);
  CHECK(asked < 200000);
}

TEST_CASE("After merges a search near new patches finds what a search of everything does") {
  const auto shell = shell_of_many_rounds();
  decomposed_shell& given = *shell;
  merge_account account(given.pieces.parts, 1);
  skeleton_memo store;
  std::vector<local_id>& part = given.pieces.part_of_element;
  std::vector<kept<patch_mesh>> apart; // of patches among which nothing crosses
  std::size_t compared = 0;
  for (;;) {
    const auto made =
        realize<3>(given.model, given.background.mesh, given.divided, part,
                   static_cast<std::size_t>(account.subdomains()), given.background.size, store, given.given);
    const fine_skeleton& fine = made.fine;
    const auto& first = made.patches.first_triangle;
    const auto everything = plan_for(fine);
    const auto known = known_from_patches(fine, first, made.patches.of_patch, apart);
    const auto near =
        plan_suppression(fine, std::vector<bool>(fine.sides.size(), false), parallel::serial{}, known);
    CHECK(near.crossings == everything.crossings);
    CHECK(near.merges == everything.merges);
    if (std::count(known.triangles.begin(), known.triangles.end(), true) > 0)
      compared += near.crossings;
    if (everything.empty())
      break;
    account.merge(part, everything.merges);
    apart = made.patches.of_patch;
    for (const auto& [i, j] : crossing_triangles(fine.points, fine.sides, {}, parallel::serial{}))
      apart[std::upper_bound(first.begin(), first.end(), i) - first.begin() - 1] = {};
    sort_unique(apart);
  }
  CHECK(compared > 0);
}

TEST_CASE("Where the faces of a shell cross, their size is made smaller until they do not") {
  generate_options options;
  options.subdomains = 20;
  options.coarse_scale = testing::flat_in_shells;
  options.largest_merged_fraction = 1;
  const auto result = generate<3>(shell(0.992), uniform_size(0.2),
                                  parameters<>{}.with_mesher(mesher::tetgen{}).with_options(options));
  REQUIRE(result.failures.empty());
  CHECK(io::check_distributed(result.mesh).valid());
  const report& intersection = result.summary.children[4];
  CHECK(intersection.get("refinements") >= 1);
  CHECK(intersection.get("merges") == 20 - static_cast<double>(result.mesh.counts.size()));
  CHECK(intersection.get("largest_merged") > 1);
  CHECK(plan_for(result.mesh.skeleton).empty());
}

TEST_CASE("A refinement makes again what it reaches alone, and that is what a fresh run makes") {
  decomposed_shell given(0.5, 16);
  const auto realize_at = [&](const refined_sizing& size, skeleton_memo& store) {
    return realize<3>(given.model, given.background.mesh, given.divided, given.pieces.part_of_element,
                      static_cast<std::size_t>(given.pieces.parts), size, store, given.given);
  };
  skeleton_memo store;
  refined_sizing size(given.background.size);
  const auto before = realize_at(size, store);
  size.refine(std::vector<size_ball>{{{0, 0, 1}, 0.05, 0.15}});
  const auto after = realize_at(size, store);
  for (const char* made : {"lines_made", "patches_made"}) {
    CHECK(after.summary.get(made) > 0);
    CHECK(after.summary.get(made) < 0.25 * before.summary.get(made));
  }
  CHECK(after.fine.sides.size() > before.fine.sides.size());
  skeleton_memo other_store;
  const auto fresh = realize_at(size, other_store);
  CHECK(fresh.summary.get("patches_made") > before.summary.get("patches_made") - 1);
  CHECK(fresh.fine.points == after.fine.points);
  CHECK(fresh.fine.sides == after.fine.sides);
}

TEST_CASE(
    "Merges after failures are in the same account, and what is refused then is told with its reasons") {
  plane_drawing drawing;
  drawing.polygons = {{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, "square"}};
  const auto result =
      generate<2>(plane_domain(drawing), uniform_size(0.05),
                  parameters<>{}.with_mesher(fails_at_origin{}).with_options({.subdomains = 8}));
  const report& meshing = result.summary.children.back();
  CHECK(result.mesh.counts.size() == 6);
  CHECK(result.summary.children[4].get("merges") == 0);
  CHECK(result.summary.children[4].get("merged_after_failure") == 2);
  CHECK(result.summary.children[4].get("largest_merged") == 3);
  REQUIRE(result.failures.size() == 1);
  CHECK(testing::has(joined_reasons(result.failures.front().reasons), "not here"));
  REQUIRE(meshing.warnings.size() == 3);
  CHECK(testing::has(meshing.warnings[0], "merged with a neighbour: attempts 1, 2: mesher: not here"));
  CHECK(testing::has(meshing.warnings[2],
                     "3 of 8 subdomains would have to be merged, 2 may be: attempts 1, 2"));
}
