#include "archetypes.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <memory>

// Everything here is decided by the compiler; the one run-time case only counts what was decided.

namespace dovetail {
namespace {

// --- graph_partitioner

static_assert(graph_partitioner<archetype::partitioner>);
static_assert(graph_partitioner<std::function<std::vector<local_id>(const csr_graph&, int)>>);

struct partitioner_of_int_parts {
  std::vector<short> operator()(const csr_graph&, int) const;
};
struct partitioner_that_is_not_const {
  std::vector<local_id> operator()(const csr_graph&, int);
};
struct partitioner_that_takes_the_graph_to_change {
  std::vector<local_id> operator()(csr_graph&, int) const;
};
struct partitioner_without_parts {
  std::vector<local_id> operator()(const csr_graph&) const;
};
struct partitioner_that_cannot_be_copied {
  std::unique_ptr<int> state;
  std::vector<local_id> operator()(const csr_graph&, int) const;
};
static_assert(!graph_partitioner<partitioner_of_int_parts>);
static_assert(!graph_partitioner<partitioner_that_is_not_const>);
static_assert(!graph_partitioner<partitioner_that_takes_the_graph_to_change>);
static_assert(!graph_partitioner<partitioner_without_parts>);
static_assert(!graph_partitioner<partitioner_that_cannot_be_copied>);

// --- sizing_field

static_assert(sizing_field<archetype::sizing>);
static_assert(sizing_field<any_sizing>);
static_assert(sizing_field<decltype([](vec3 p) { return p.x; })>);

struct sizing_of_coordinates {
  double operator()(double, double, double) const;
};
struct sizing_that_is_not_const {
  double operator()(vec3);
};
struct sizing_that_returns_a_vector {
  vec3 operator()(vec3) const;
};
struct sizing_that_cannot_be_copied {
  std::unique_ptr<int> state;
  double operator()(vec3) const;
};
static_assert(!sizing_field<sizing_of_coordinates>);
static_assert(!sizing_field<sizing_that_is_not_const>);
static_assert(!sizing_field<sizing_that_returns_a_vector>);
static_assert(!sizing_field<sizing_that_cannot_be_copied>);
static_assert(!sizing_field<double>);

// --- piece_mesher, boundary_keeping_mesher

static_assert(piece_mesher<archetype::mesher, 3>);
static_assert(boundary_keeping_mesher<archetype::mesher, 3>);

struct mesher_without_traits {
  mesher_result<3> operator()(const mesher_input<3>&, const any_sizing&) const;
};
struct mesher_without_sizing {
  static constexpr mesher_traits traits{};
  mesher_result<3> operator()(const mesher_input<3>&) const;
};
struct mesher_that_returns_a_bare_mesh {
  static constexpr mesher_traits traits{};
  simplicial_mesh<3> operator()(const mesher_input<3>&, const any_sizing&) const;
};
struct mesher_with_traits_of_another_type {
  static constexpr int traits = 1;
  mesher_result<3> operator()(const mesher_input<3>&, const any_sizing&) const;
};
struct mesher_that_moves_its_boundary {
  static constexpr mesher_traits traits{.keeps_boundary = false};
  mesher_result<3> operator()(const mesher_input<3>&, const any_sizing&) const;
};
static_assert(!piece_mesher<mesher_without_traits, 3>);
static_assert(!piece_mesher<mesher_without_sizing, 3>);
static_assert(!piece_mesher<mesher_that_returns_a_bare_mesh, 3>);
static_assert(!piece_mesher<mesher_with_traits_of_another_type, 3>);
static_assert(!piece_mesher<archetype::mesher, 2>, "it makes tetrahedra");
static_assert(piece_mesher<mesher_that_moves_its_boundary, 3>);
static_assert(!boundary_keeping_mesher<mesher_that_moves_its_boundary, 3>);

// --- improver

static_assert(improver<archetype::improver, 3>);

struct improver_without_frozen_entities {
  report operator()(simplicial_mesh<3>&, const any_sizing&) const;
};
struct improver_that_returns_a_mesh {
  simplicial_mesh<3> operator()(const simplicial_mesh<3>&, const frozen_entities<3>&,
                                const any_sizing&) const;
};
struct improver_that_is_not_const {
  report operator()(simplicial_mesh<3>&, const frozen_entities<3>&, const any_sizing&);
};
static_assert(!improver<improver_without_frozen_entities, 3>);
static_assert(!improver<improver_that_returns_a_mesh, 3>);
static_assert(!improver<improver_that_is_not_const, 3>);
static_assert(!improver<archetype::improver, 2>, "it improves tetrahedra");

// --- executor

static_assert(executor<archetype::executor>);

struct executor_without_workers {
  std::vector<task_outcome> run(std::size_t, const task_function&, const run_options&) const;
};
struct executor_that_loses_outcomes {
  void run(std::size_t, const task_function&, const run_options&) const;
  int workers() const;
};
struct executor_without_options {
  std::vector<task_outcome> run(std::size_t, const task_function&) const;
  int workers() const;
};
static_assert(!executor<executor_without_workers>);
static_assert(!executor<executor_that_loses_outcomes>);
static_assert(!executor<executor_without_options>);

// --- geometry_model

static_assert(geometry_model<archetype::geometry>);

struct geometry_without_bounds : archetype::geometry {
  void bounds() const = delete;
};
struct geometry_with_unseeded_projection : archetype::geometry {
  vec2 project_to_face(local_id, vec3) const;
};
struct geometry_with_points_for_frames : archetype::geometry {
  vec3 face_frame(local_id, vec2) const;
};
struct geometry_without_topology : private archetype::geometry {
  using archetype::geometry::bounds;
};
static_assert(!geometry_model<geometry_without_bounds>);
static_assert(!geometry_model<geometry_with_unseeded_projection>);
static_assert(!geometry_model<geometry_with_points_for_frames>);
static_assert(!geometry_model<geometry_without_topology>);

// --- mesh_writer, mesh_reader

static_assert(mesh_writer<archetype::writer>);
static_assert(mesh_reader<archetype::reader>);
static_assert(!mesh_writer<archetype::reader>);
static_assert(!mesh_reader<archetype::writer>);

struct writer_of_whole_meshes {
  report operator()(const simplicial_mesh<3>&, const std::filesystem::path&) const;
};
struct writer_without_report {
  void operator()(const distributed_mesh&, const std::filesystem::path&) const;
};
struct reader_into_an_argument {
  void operator()(const std::filesystem::path&, io::loaded_mesh&) const;
};
struct reader_of_a_bare_mesh {
  simplicial_mesh<3> operator()(const std::filesystem::path&) const;
};
static_assert(!mesh_writer<writer_of_whole_meshes>);
static_assert(!mesh_writer<writer_without_report>);
static_assert(!mesh_reader<reader_into_an_argument>);
static_assert(!mesh_reader<reader_of_a_bare_mesh>);

TEST_CASE("archetypes do what their concept's semantics say") {
  csr_graph path;
  path.offsets = {0, 1, 3, 4};
  path.neighbours = {1, 0, 2, 1};
  CHECK(archetype::partitioner(0)(path, 3) == std::vector<local_id>{0, 1, 2});

  const archetype::executor executor;
  const auto outcomes = executor.run(2, [](std::size_t i) { return byte_buffer(i); }, {});
  REQUIRE(outcomes.size() == 2);
  CHECK(outcomes[1].ok);
  CHECK(outcomes[1].result.size() == 1);
}

} // namespace
} // namespace dovetail
