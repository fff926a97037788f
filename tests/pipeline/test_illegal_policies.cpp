#include "dovetail/distributed/processes.hpp"
#include "dovetail/improver/any_improver.hpp"
#include "dovetail/mesher/any_mesher.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/models/plane/read.hpp"
#include "dovetail/parallel/clock_watch.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/partition/any_partitioner.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/simplification/paper.hpp"
#include "dovetail/simplification/simplify.hpp"
#include "mesher/shapes.hpp"
#include "pipeline/plane_meshes.hpp"
#include "support/jittered_meshes.hpp"
#include "support/refusal.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using namespace dovetail;
using testing::no_number;
using testing::unit_square;

namespace {

enum class wrong {
  nothing,
  throws,
  never_ends,
  drops_tags,
  foreign_tag,
  drops_points,
  leaves_point_alone,
  names_foreign_point,
  moves_frozen,
  moves_frozen_by_a_bit,
  loses_element,
  doubles_element,
  turns_element,
  inverts_elements,
};

/// The harm that a policy does to a mesh, whose last point lies inside.
template <int D>
void spoil(wrong how, simplicial_mesh<D>& mesh) {
  switch (how) {
  case wrong::nothing:
    return;
  case wrong::throws:
    throw mesh_error("no such luck");
  case wrong::never_ends:
    for (;;)
      std::this_thread::sleep_for(std::chrono::seconds(1));
  case wrong::drops_tags:
    mesh.tags.pop_back();
    return;
  case wrong::foreign_tag:
    mesh.tags.back() = 77;
    return;
  case wrong::drops_points:
    mesh.points.resize(2);
    return;
  case wrong::leaves_point_alone:
    mesh.points.push_back(mesh.points.back());
    return;
  case wrong::names_foreign_point:
    mesh.elements.front()[0] = 1 << 30;
    return;
  case wrong::moves_frozen:
    mesh.points.front().x += 1e-6;
    return;
  case wrong::moves_frozen_by_a_bit:
    mesh.points.front().x = std::nextafter(mesh.points.front().x, 2.0);
    return;
  case wrong::loses_element:
    mesh.elements.pop_back();
    mesh.tags.pop_back();
    return;
  case wrong::doubles_element:
    mesh.elements.push_back(mesh.elements.back());
    mesh.tags.push_back(mesh.tags.back());
    return;
  case wrong::turns_element:
    std::swap(mesh.elements.front()[0], mesh.elements.front()[1]);
    return;
  case wrong::inverts_elements:
    mesh.points.back() += vec3{10, 0, 0};
    return;
  }
}

/// Fills the cube by connecting its surface to the middle, or the square its edges, and spoils that. Its
/// fallbacks are no better.
template <int D>
struct spoiling_mesher {
  static constexpr mesher_traits traits{.keeps_boundary = true};
  wrong how = wrong::nothing;

  std::vector<spoiling_mesher> fallbacks() const { return {*this}; }
  mesher_result<D> operator()(const mesher_input<D>& in, const any_sizing&) const {
    mesher_result<D> result;
    result.mesh.points = in.boundary.points;
    const auto middle = static_cast<local_id>(result.mesh.points.size());
    vec3 sum{};
    for (const vec3 p : in.boundary.points)
      sum += p;
    result.mesh.points.push_back(sum / static_cast<double>(middle));
    for (const auto& side : in.boundary.elements)
      if constexpr (D == 3)
        result.mesh.elements.push_back({side[0], side[2], side[1], middle});
      else
        result.mesh.elements.push_back({side[0], side[1], middle});
    result.mesh.tags.assign(result.mesh.elements.size(), in.material);
    spoil(how, result.mesh);
    return result;
  }
};

template <int D>
struct spoiling_improver {
  static constexpr improver_traits traits{};
  wrong how = wrong::nothing;
  report operator()(simplicial_mesh<D>& mesh, const frozen_entities<D>&, const any_sizing&) const {
    spoil(how, mesh);
    return {};
  }
};

/// What makes good again whatever the mesher did: without a check in between nobody would see it.
struct concealing_improver {
  static constexpr improver_traits traits{};
  mesher_input<3> input;
  report operator()(simplicial_mesh<3>& mesh, const frozen_entities<3>&, const any_sizing& size) const {
    mesh = spoiling_mesher<3>{}(input, size).mesh;
    return {};
  }
};

template <int D>
piece_input<D> one_piece(local_id) {
  piece_input<D> input;
  if constexpr (D == 3) {
    input.boundary.boundary = shapes::cube(2);
  } else {
    const remesh::plane_surface plane{};
    input.boundary.boundary = {
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}, {}};
    surface_region region;
    region.surface = {[plane](vec2 uv) { return plane.frame(uv); },
                      [plane](vec3 p, vec2 seed) { return plane.project(p, seed); },
                      {}};
    region.face = 0;
    input.boundary.regions.push_back(region);
  }
  return input;
}

template <int D>
meshed_pieces<D> mesh_one(const any_mesher<D>& mesh_it, const any_improver<D>& improve) {
  const any_sizing unit = [](vec3) { return 1.0; };
  return mesh_subdomains<D>(1, one_piece<D>, mesh_it, improve, unit,
                            parallel::clock_watch(parallel::processes{1}, 0.3));
}

struct harm {
  wrong how;
  std::string reason;
};
const std::vector<harm> harms{
    {wrong::throws, "no such luck"},
    {wrong::never_ends, "time limit"},
    {wrong::drops_tags, "tags"},
    {wrong::foreign_tag, "77"},
    {wrong::drops_points, "does not exist"},
    {wrong::leaves_point_alone, "is in no element"},
    {wrong::names_foreign_point, "does not exist"},
    {wrong::moves_frozen, "boundary point 0 was moved"},
    {wrong::moves_frozen_by_a_bit, "boundary point 0 was moved"},
    {wrong::loses_element, "lost"},
    {wrong::doubles_element, "overlap"},
    {wrong::turns_element, ""},
    {wrong::inverts_elements, "flat or inverted"},
};

/// On a surface that is no plane, elements that are turned by a moved point are left to who finds crossings.
template <int D>
bool is_found(wrong how) {
  return D == 3 || how != wrong::inverts_elements;
}

template <int D>
void check_meshers() {
  for (const harm& h : harms) {
    if (!is_found<D>(h.how))
      continue;
    CAPTURE(h.reason);
    for (const bool improves : {false, true}) {
      const any_improver<D> improve = improves ? any_improver<D>(spoiling_improver<D>{}) : any_improver<D>{};
      const auto result = mesh_one<D>({spoiling_mesher<D>{h.how}, "wrong"}, improve);
      REQUIRE(result.failures.size() == 1);
      const auto& reasons = result.failures.front().reasons;
      CHECK(reasons.size() == (improves ? 3 : 2)); // each attempt, and without the improver
      for (const std::string& reason : reasons) {
        CAPTURE(reason);
        CHECK(testing::has(reason, h.reason));
        CHECK((h.how == wrong::never_ends || testing::contains(reason, "mesher 'wrong': ")));
      }
    }
  }
}

template <int D>
void check_improvers() {
  for (const harm& h : harms) {
    // After an improver of triangles points that nobody has are dropped.
    if (!is_found<D>(h.how) || (D == 2 && h.how == wrong::leaves_point_alone))
      continue;
    CAPTURE(h.reason);
    const auto result = mesh_one<D>(spoiling_mesher<D>{}, {spoiling_improver<D>{h.how}, "bad"});
    REQUIRE(result.failures.empty());
    const auto input = one_piece<D>(0);
    CHECK(result.load(0).mesh.elements.size() == input.boundary.boundary.elements.size());
    CHECK_NOTHROW(check_mesher_result(input.boundary, result.load(0).mesh));
    REQUIRE_FALSE(result.summary.warnings.empty());
    const std::string& warning = result.summary.warnings.back();
    CAPTURE(warning);
    CHECK(testing::has(warning, "left unimproved after attempts 1, 2: "));
    CHECK(testing::has(warning, h.reason));
    CHECK((h.how == wrong::never_ends || testing::contains(warning, "improver 'bad': ")));
  }
}

/// What is said when the square is meshed in four parts with such parameters; empty when nothing is wrong.
template <class Error, class Parameters>
std::string complaint(const Parameters& given, const any_sizing& size = uniform_size(0.05)) {
  generate_options options;
  options.subdomains = 4;
  try {
    generate<2>(unit_square(), size, given.with_options(options));
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

/// A good partition, changed.
struct changed_partition {
  std::function<void(std::vector<local_id>&)> change;
  std::vector<local_id> operator()(const csr_graph& graph, int parts) const {
    auto part = partition::greedy{}(graph, parts);
    change(part);
    return part;
  }
};

std::string complaint_of_partition(std::function<void(std::vector<local_id>&)> change) {
  return complaint<partition_error>(
      parameters<>{}.with_partitioner(any_partitioner(changed_partition{std::move(change)}, "mine")));
}

/// The paper's rule, changed.
struct changed_rule : simplifier::paper {
  std::function<void(side_judgement&)> change = [](side_judgement&) {};
  std::optional<double> other_penalty = {};

  template <int D>
  side_judgement operator()(const simplicial_mesh<D>& mesh, const side_table<D>& sides) const {
    auto judged = simplifier::paper::operator()(mesh, sides);
    change(judged);
    return judged;
  }
  double penalty(const deficit& missed) const {
    return other_penalty ? *other_penalty : simplifier::paper::penalty(missed);
  }
};

std::string complaint_of_rule(changed_rule rule) {
  rule.surface_shape_deg = 180; // all sides are candidates, so that some are refused
  return complaint<usage_error>(parameters<>{}.with_simplifier(rule));
}

} // namespace

TEST_CASE_TEMPLATE("The policies of these tests are legal but for the harm they do", Dimension,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int D = Dimension::value;
  const auto result = mesh_one<D>(spoiling_mesher<D>{}, spoiling_improver<D>{});
  CHECK(result.failures.empty());
  CHECK(result.summary.warnings.empty());
}

TEST_CASE("A mesher of solids that breaks its promises fails on every attempt, by name") {
  check_meshers<3>();
}

TEST_CASE("A mesher of surfaces that breaks its promises fails on every attempt, by name") {
  check_meshers<2>();
}

TEST_CASE("An improver of tetrahedra that breaks its promises is left out, and the reasons are told") {
  check_improvers<3>();
}

TEST_CASE("An improver of triangles that breaks its promises is left out, and the reasons are told") {
  check_improvers<2>();
}

TEST_CASE("What is wrong with a mesher's result is found before an improver hides it") {
  const concealing_improver conceals{one_piece<3>(0).boundary};
  CHECK(mesh_one<3>(spoiling_mesher<3>{}, conceals).failures.empty());
  for (const wrong how : {wrong::moves_frozen, wrong::inverts_elements, wrong::loses_element})
    CHECK(mesh_one<3>(spoiling_mesher<3>{how}, conceals).failures.size() == 1);
}

TEST_CASE("A partitioner that breaks its promises is refused by name") {
  CHECK(complaint_of_partition([](auto&) {}).empty());
  CHECK(testing::has(complaint_of_partition([](auto& part) { part.front() = 99; }),
                     "'mine' put node 0 into part 99"));
  CHECK(testing::has(complaint_of_partition([](auto& part) { part.back() = -1; }), "into part -1"));
  CHECK(testing::has(complaint_of_partition([](auto& part) { part.pop_back(); }),
                     "nodes into parts, the graph has"));
  CHECK(testing::has(complaint_of_partition([](auto& part) { part.push_back(0); }),
                     "nodes into parts, the graph has"));
  CHECK(testing::has(complaint_of_partition([](auto& part) { part.clear(); }), "put 0 nodes"));
  CHECK(testing::has(complaint_of_partition([](auto& part) { std::replace(part.begin(), part.end(), 2, 1); }),
                     "left part 2 of 4 without a node"));
}

TEST_CASE("A rule of simplification that says what is no number is refused") {
  CHECK(complaint_of_rule({}).empty());
  changed_rule rule;
  rule.change = [](side_judgement& judged) { judged.quality.assign(judged.quality.size(), no_number); };
  CHECK(testing::has(complaint_of_rule(rule), "quality nan"));
  rule.change = [](side_judgement& judged) { judged.quality.assign(judged.quality.size(), -1.0); };
  CHECK(testing::has(complaint_of_rule(rule), "quality -1"));
  rule.change = [](side_judgement& judged) { judged.quality.pop_back(); };
  CHECK(testing::has(complaint_of_rule(rule), "it must give one quality each"));
  rule.change = [](side_judgement& judged) { judged.wanted_angle_deg = no_number; };
  CHECK(testing::has(complaint_of_rule(rule), "dihedrals of nan"));
  for (const double penalty : {no_number, -1.0, 0.0, std::numeric_limits<double>::infinity()}) {
    changed_rule penalised;
    penalised.other_penalty = penalty;
    CHECK(testing::has(complaint_of_rule(penalised), "the penalty"));
  }
}

TEST_CASE("A rule that propagates what is no number is refused") {
  const auto mesh = dovetail_test::jittered_cubes(3);
  const auto sides = build_sides(mesh);
  const auto with = [&](const deficit& missed) {
    const coupled_ridge<3> ridge{{21, 22}, {missed}};
    return simplify<3>(mesh, mesh_duals<3>(mesh, sides), simplifier::paper{}, {}, std::span(&ridge, 1));
  };
  CHECK_NOTHROW(with({1, 2}));
  CHECK_THROWS_AS(with({no_number, 2}), usage_error);
  CHECK_THROWS_AS(with({-1, 2}), usage_error);
  CHECK_THROWS_AS(with({1, no_number}), usage_error);
}

TEST_CASE("A negative number of subdomains is refused") {
  generate_options options;
  options.subdomains = -3;
  CHECK_THROWS_WITH_AS(generate<2>(unit_square(), uniform_size(0.5), parameters<>{}.with_options(options)),
                       doctest::Contains("subdomains is -3"), usage_error);
}

TEST_CASE("Sizes that are no sizes somewhere are refused, with the place") {
  for (const double bad : {no_number, -1.0, 0.0, std::numeric_limits<double>::infinity()}) {
    CAPTURE(bad);
    const any_sizing size = [bad](vec3 p) { return p.x > 0.8 && p.y > 0.8 ? bad : 0.05; };
    CHECK(testing::has(complaint<sizing_error>(parameters<>{}, size), "the size at ("));
    CHECK(testing::has(complaint<sizing_error>(parameters<>{}.with_executor(parallel::processes{2}), size),
                       "the size at ("));
  }
}
