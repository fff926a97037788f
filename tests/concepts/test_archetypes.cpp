#include "archetypes.hpp"
#include "graph_archetypes.hpp"

#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/distributed/any_redistributor.hpp"
#include "dovetail/graph/breadth_first.hpp"
#include "dovetail/graph/contraction.hpp"
#include "dovetail/improver/native_by.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/mesher/by_regions.hpp"
#include "dovetail/models/discrete/repair.hpp"
#include "dovetail/models/discrete_model.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/models/virtual_model.hpp"
#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/partition/any_distributed_partitioner.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/pipeline/whole_background.hpp"
#include "dovetail/simplification/simplify.hpp"
#include "dovetail/solver/rank_files.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <utility>

// What each concept rejects is in compile_fail/.

namespace dovetail {
namespace {

static_assert(graph_partitioner<archetype::partitioner>);
static_assert(graph_partitioner<std::function<std::vector<local_id>(const csr_graph&, int)>>);
static_assert(distributed_graph_partitioner<archetype::distributed_partitioner>);
static_assert(!distributed_graph_partitioner<archetype::partitioner>, "it wants the whole graph");
static_assert(std::is_constructible_v<any_distributed_partitioner, archetype::distributed_partitioner> &&
              std::is_constructible_v<any_distributed_partitioner, archetype::partitioner>);
static_assert(sizing_field<archetype::sizing> && sizing_field<any_sizing>);
static_assert(sizing_field<decltype([](vec3 p) { return p.x; })>);
static_assert(bounded_below_sizing_field<archetype::bounded_sizing>);
static_assert(!feature_aware_sizing_field<archetype::bounded_sizing>);
static_assert(feature_aware_sizing_field<archetype::aware_sizing>);
static_assert(!bounded_below_sizing_field<archetype::aware_sizing>);
static_assert(narrowable_sizing_field<archetype::narrowable_sizing>);
static_assert(!narrowable_sizing_field<archetype::aware_sizing>);
static_assert(bisection_rule<archetype::bisection> && !graph_partitioner<archetype::bisection>);
static_assert(improvement::shape_measure<archetype::shape_measure>);
static_assert(improvement::mesh_operation<archetype::operation, 3>);
static_assert(!improvement::mesh_operation<archetype::operation, 2>, "it works on tetrahedra");
static_assert(patch_surface<archetype::surface_as<any_surface>>);
static_assert(piece_mesher<archetype::mesher, 3> && boundary_keeping_mesher<archetype::mesher, 3>);
static_assert(!piece_mesher<archetype::mesher, 2>, "it makes tetrahedra");
static_assert(!line_keeping_mesher<archetype::mesher> && !has_fallbacks<archetype::mesher>);
static_assert(surface_mesher<archetype::surface_mesher_as<remesh::patch_remesher>>);
static_assert(improver<archetype::improver, 3>);
static_assert(!improver<archetype::improver, 2>, "it improves tetrahedra");
static_assert(executor<archetype::executor>);
static_assert(communicator<archetype::communicator>);
static_assert(std::constructible_from<any_communicator, archetype::communicator>);
static_assert(surface_improver<archetype::surface_improver> && !improver<archetype::surface_improver, 3>);
static_assert(!surface_improver<archetype::improver>);
static_assert(geometry_model<archetype::geometry> && !geometry_model_with_planes<archetype::geometry> &&
              !geometry_model_with_members<archetype::geometry>);
static_assert(geometry_model_with_members<archetype::members_as<virtual_model>>);
static_assert(!calibrated_mesher<archetype::mesher> && !piece_sizing_mesher<archetype::mesher>);
static_assert(!has_background_form<archetype::mesher>);
static_assert(mesh_writer<archetype::writer> && mesh_reader<archetype::reader>);
static_assert(piecewise_mesh_writer<archetype::piecewise_writer> &&
              !piecewise_mesh_writer<archetype::writer>);
static_assert(std::is_constructible_v<io::any_piecewise_writer<3>, archetype::piecewise_writer>);
static_assert(redistributor<archetype::redistributor> && !redistributor<archetype::writer>);
static_assert(std::is_constructible_v<any_redistributor<3>, archetype::redistributor>);
static_assert(rank_format<archetype::rank_format> && !rank_format<archetype::rank_format, 2>);
static_assert(shared_rank_format<archetype::shared_rank_format> &&
              !shared_rank_format<archetype::shared_rank_format, 2>);
static_assert(!rank_format<archetype::shared_rank_format> && !shared_rank_format<archetype::rank_format>);
template <class Format>
using writer_by_ranks = io::rank_writer<Format, archetype::redistributor>;
static_assert(std::is_constructible_v<io::any_piecewise_writer<3>, writer_by_ranks<archetype::rank_format>>);
static_assert(
    std::is_constructible_v<io::any_piecewise_writer<3>, writer_by_ranks<archetype::shared_rank_format>>);
static_assert(!mesh_writer<archetype::reader> && !mesh_reader<archetype::writer>);

static_assert(graph<archetype::path> && !weighted_graph<archetype::path>);
static_assert(weighted_graph<archetype::weighted_path>);
static_assert(element_dual_graph<archetype::row_of_elements> && !side_dual_graph<archetype::row_of_elements>);
static_assert(side_dual_graph<archetype::fan_of_sides> && !element_dual_graph<archetype::fan_of_sides>);
static_assert(contraction_rule<archetype::contraction_rule>);
static_assert(!simplification_rule<archetype::contraction_rule, 3>);
static_assert(simplification_rule<archetype::simplification_rule, 2> &&
              simplification_rule<archetype::simplification_rule, 3>);

/// A partitioner by the archetype of a rule.
struct rule_partitioner {
  std::vector<local_id> operator()(const csr_graph& graph, int parts) const {
    return recursive_bisection(graph, parts, archetype::bisection());
  }
};

/// The native improver's schedule with the archetypes of a measure and of an operation.
struct measure_improver {
  static constexpr improver_traits traits{};
  report operator()(simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen, const any_sizing&) const {
    using namespace improvement;
    using measure = archetype::shape_measure;
    tet_complex complex = take_mesh(mesh, frozen, layout::along_curve);
    evaluate<measure>(complex);
    complex.set_sizes(present_sizes(complex));
    const surface_limits surface(complex);
    poor_tetrahedra<measure> poor(complex, surface);
    schedule_limits<3> limits;
    limits.operations.target = static_cast<float>(measure::from_angle(20));
    using operations = native_operations::on_tetrahedra<measure>::with<archetype::operation>;
    schedule<poor_tetrahedra<measure>, operations>(complex, poor).run(limits);
    give_back(complex, mesh);
    return {};
  }
};

/// The unit cube, two triangles per face.
discrete_model unit_cube() {
  triangle_soup soup;
  for (const double z : {0.0, 1.0})
    for (const double y : {0.0, 1.0})
      for (const double x : {0.0, 1.0})
        soup.points.push_back({x, y, z});
  soup.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  soup.groups.assign(soup.triangles.size(), no_id);
  return discrete_model(repaired(soup));
}

TEST_CASE("archetypes do what their concept's semantics say") {
  csr_graph path;
  path.offsets = {0, 1, 3, 4};
  path.neighbours = {1, 0, 2, 1};
  CHECK(archetype::partitioner(0)(path, 3) == std::vector<local_id>{0, 1, 2});

  const archetype::executor executor(0);
  const auto outcomes = executor.run(2, [](std::size_t i) { return byte_buffer(i); }, {});
  REQUIRE(outcomes.size() == 2);
  CHECK(outcomes[1].ok);
  CHECK(outcomes[1].result.size() == 1);
}

TEST_CASE("the pipeline needs no more of any policy than its concept says") {
  const discrete_model cube = unit_cube();
  const archetype::geometry_as geometry(cube);
  using improver = archetype::improver;
  using partitioner = archetype::partitioner;
  using mesher = archetype::mesher_as<dovetail::mesher::tetgen>;
  generate_options options;
  options.subdomains = 3;
  const parameters<mesher, partitioner, improver, archetype::executor> given{
      mesher(dovetail::mesher::tetgen{}), partitioner(0), improver(0), archetype::executor(0), options};
  const auto result = generate<3>(geometry, archetype::sizing(0), given);
  CHECK(result.failures.empty());
  CHECK(result.mesh.counts.size() == 3);
  CHECK(io::check_distributed(result.mesh).valid());
}

TEST_CASE("the pipeline needs no more of what policies are made of than the concepts say") {
  const auto check = [](const auto& size, const auto& given) {
    const auto result = generate<3>(unit_cube(), size, given);
    CHECK(result.failures.empty());
    CHECK(result.mesh.counts.size() == 3);
    CHECK(io::check_distributed(result.mesh).valid());
  };
  const auto given = parameters<>{}.with_mesher(mesher::tetgen{}).with_options({.subdomains = 3});
  SUBCASE("a bound of the size") {
    check(archetype::bounded_sizing(0), given);
  }
  SUBCASE("the size of features") {
    check(archetype::aware_sizing(0), given);
  }
  SUBCASE("a rule that bisects") {
    check(archetype::sizing(0), given.with_partitioner(rule_partitioner{}));
  }
  SUBCASE("a rule that simplifies") {
    check(archetype::sizing(0), given.with_simplifier(archetype::simplification_rule(0)));
  }
  SUBCASE("a measure of shape, and an operation") {
    check(archetype::sizing(0), given.with_improver(measure_improver{}));
  }
  SUBCASE("what to expect of a mesher") {
    using telling = archetype::telling_mesher_as<mesher::tetgen>;
    static_assert(calibrated_mesher<telling> && piece_sizing_mesher<telling>);
    check(archetype::sizing(0), given.with_mesher(telling(mesher::tetgen{})));
  }
  SUBCASE("another form for the background") {
    using both = archetype::mesher_of_backgrounds_and_pieces<mesher::tetgen>;
    static_assert(has_background_form<both>);
    check(archetype::sizing(0), given.with_mesher(both(mesher::tetgen{})));
  }
  SUBCASE("what to try next") {
    check(archetype::sizing(0), given.with_mesher(archetype::mesher_after_failure(mesher::tetgen{})));
  }
}

TEST_CASE("a background needs no more of a mesher of whole domains than its concept says") {
  const archetype::line_keeping_mesher_as whole(mesher::tetgen{});
  static_assert(line_keeping_mesher<archetype::line_keeping_mesher_as<mesher::tetgen>>);
  static_assert(!boundary_keeping_mesher<archetype::line_keeping_mesher_as<mesher::tetgen>, 3>);
  const discrete_model cube = unit_cube();
  const auto given = parameters<>{}.with_mesher(mesher::tetgen{}).with_options({.subdomains = 3});
  auto background = make_background_by(whole, cube, archetype::sizing(0), given);
  const auto result = generate_from_background<3>(cube, std::move(background), given);
  CHECK(result.failures.empty());
  CHECK(result.mesh.counts.size() == 3);
  CHECK(io::check_distributed(result.mesh).valid());
}

TEST_CASE("graph algorithms need no more of a graph than its concept says") {
  const archetype::path path(5);
  CHECK(breadth_first_order(path, 3) == std::vector<local_id>{3, 2, 4, 1, 0});
  const std::vector<local_id> label{0, 0, 1, 1, 0};
  CHECK(components_within(path, label).of_node == std::vector<local_id>{0, 0, 1, 1, 2});
  const archetype::weighted_path weighted(5);
  CHECK(contract(weighted, label, 2).edge_weights == std::vector<double>{4, 4});
  CHECK(induced_subgraph(weighted, label, 0).nodes == std::vector<local_id>{0, 1, 4});
  CHECK(csr_graph(weighted).offsets == std::vector<std::int64_t>{0, 1, 3, 5, 7, 8});
}

TEST_CASE("the contraction needs no more of dual graphs and of a rule than their concepts say") {
  const archetype::row_of_elements row(5);
  const archetype::fan_of_sides fan(5);
  const archetype::contraction_rule rule;
  const auto result = contract_bounded(row, fan, {std::vector<double>(6, 1.0), 0, 20}, rule);
  // The sides 0, 2 and 5 are left: of the first dihedral side 1 goes, of the third side 3.
  CHECK(result.super_of_element == std::vector<local_id>{0, 0, 1, 1, 1});
  CHECK(result.graph.edge_weights == std::vector<double>{3, 3});
  CHECK(result.forced.empty());

  simplicial_mesh<2> mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 0.1, 0}, {0, 0.1, 0}};
  mesh.elements = {{0, 1, 2}, {0, 2, 3}};
  CHECK(simplify<2>(mesh, mesh_duals<2>(mesh), archetype::simplification_rule(0)).super_count == 1);
}

TEST_CASE("what policies cannot do is known before anything is meshed") {
  const plane_domain square({{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}}, {}});
  bool is_asked = false;
  const any_sizing size = [&](vec3) {
    is_asked = true;
    return 0.1;
  };
  const auto given = parameters<>{}.with_improver(archetype::surface_improver(0));
  CHECK_THROWS_AS(generate<2>(square, size, given.with_executor(any_executor(parallel::threads{2}))),
                  usage_error);
  CHECK_FALSE(is_asked);
  CHECK(generate<2>(square, size, given.with_executor(any_executor(parallel::threads{1}))).failures.empty());
  CHECK(is_asked);
}

TEST_CASE("the improver of the background is a policy") {
  const auto given = parameters<>{}.with_mesher(mesher::tetgen{}).with_options({.subdomains = 3});
  const auto told =
      generate<3>(unit_cube(), archetype::sizing(0), given.with_background_improver(archetype::improver(0)));
  CHECK(told.failures.empty());
  CHECK(measure_quality(told.background.volume).min_dihedral_deg <
        measure_quality(generate<3>(unit_cube(), archetype::sizing(0), given).background.volume)
            .min_dihedral_deg);
}

TEST_CASE("pieces of triangles need no more of an improver or a model with planes than the concepts say") {
  const plane_domain square({{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}}, {}});
  static_assert(geometry_model_with_planes<archetype::planes_as<plane_domain>>);
  const auto given =
      parameters<>{}.with_improver(archetype::surface_improver(0)).with_options({.subdomains = 3});
  const auto result = generate<2>(archetype::planes_as(square), archetype::sizing(0), given);
  CHECK(result.failures.empty());
  CHECK(io::check_distributed(result.mesh).valid());
}

TEST_CASE("pieces of triangles need no more of a surface mesher than its concept says") {
  using surface_mesher = archetype::surface_mesher_as<remesh::patch_remesher>;
  const surface_mesher held(remesh::patch_remesher{});
  const auto result = generate<2>(
      unit_cube(), archetype::sizing(0),
      parameters<>{}.with_mesher(mesher::by_regions<surface_mesher>{held}).with_options({.subdomains = 3}));
  CHECK(result.failures.empty());
  CHECK(io::check_distributed(result.mesh).valid());
  CHECK(io::mesh_hash(result.mesh) ==
        io::mesh_hash(
            generate<2>(unit_cube(), archetype::sizing(0), parameters<>{}.with_options({.subdomains = 3}))
                .mesh));
}

} // namespace
} // namespace dovetail
