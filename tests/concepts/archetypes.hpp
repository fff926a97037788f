/// @file
/// One archetype per role concept: a type that has what the concept asks for and nothing else, so that
/// generic code that compiles with it asks for no more than the concept says. `mesher_as` and `geometry_as`
/// do a real model's job, so that the whole pipeline can run with archetypes alone.
#pragma once

#include "dovetail/distributed/concepts.hpp"
#include "dovetail/files/concepts.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/graph/csr_graph.hpp"
#include "dovetail/improver/concepts.hpp"
#include "dovetail/improver/operation.hpp"
#include "dovetail/improver/shape_measure.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/mesher/fallbacks.hpp"
#include "dovetail/mesher/preferences.hpp"
#include "dovetail/parallel/communicator.hpp"
#include "dovetail/parallel/concepts.hpp"
#include "dovetail/partition/concepts.hpp"
#include "dovetail/partition/distributed_concepts.hpp"
#include "dovetail/partition/recursive_bisection.hpp"
#include "dovetail/remesh/concepts.hpp"
#include "dovetail/sizing/bounds.hpp"
#include "dovetail/solver/concepts.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::archetype {

/// Copyable, and neither default constructible nor assignable.
class copyable_only {
public:
  explicit copyable_only(int) {}
  copyable_only(const copyable_only&) = default;
  copyable_only& operator=(const copyable_only&) = delete;
};

// for graph_partitioner
/// Splits the nodes, in their order, into parts of nearly equal count.
struct partitioner : copyable_only {
  using copyable_only::copyable_only;
  std::vector<local_id> operator()(const csr_graph& graph, int parts) const {
    const std::size_t nodes = graph.offsets.size() - 1;
    std::vector<local_id> part(nodes);
    for (std::size_t node = 0; node < nodes; ++node)
      part[node] = static_cast<local_id>(node * static_cast<std::size_t>(parts) / nodes);
    return part;
  }
};
// end

// for distributed_graph_partitioner
/// The same of the whole graph.
struct distributed_partitioner : copyable_only {
  using copyable_only::copyable_only;
  std::vector<local_id> operator()(any_communicator&, const distributed_csr_graph& graph, int parts) const {
    std::vector<local_id> part;
    for (std::int64_t node = graph.first(); node < graph.end(); ++node)
      part.push_back(static_cast<local_id>(node * parts / graph.node_count()));
    return part;
  }
  short depends_on_ranks() const { return 0; }
};
// end

// for bisection_rule
/// Splits the nodes in their order.
struct bisection {
  bisection() = default;
  bisection(const bisection&) = delete;
  bisection& operator=(const bisection&) = delete;
  std::vector<local_id> operator()(const csr_graph& graph, int left, int right) const {
    const std::size_t nodes = graph.offsets.size() - 1;
    std::vector<local_id> half(nodes, 1);
    std::fill_n(half.begin(), nodes * static_cast<std::size_t>(left) / static_cast<std::size_t>(left + right),
                0);
    return half;
  }
};
// end

// for sizing_field
struct sizing : copyable_only {
  using copyable_only::copyable_only;
  float operator()(vec3) const { return 0.2f; } // convertible to double is enough
};
// end

// for bounded_below_sizing_field
struct bounded_sizing : copyable_only {
  using copyable_only::copyable_only;
  float operator()(vec3) const { return 0.2f; }
  float smallest_size_in(const box3&) const { return 0.2f; }
};
// end

// for feature_aware_sizing_field
struct aware_sizing : copyable_only {
  using copyable_only::copyable_only;
  float operator()(vec3) const { return 0.2f; }
  float feature_size(vec3) const { return 0.5f; }
};
// end

// for narrowable_sizing_field
struct narrowable_sizing : copyable_only {
  using copyable_only::copyable_only;
  float operator()(vec3) const { return 0.2f; }
  narrowable_sizing within(const box3&) const { return *this; }
};
// end

/// Meshes a boundary that is the surface of one tetrahedron.
struct mesher : copyable_only {
  using copyable_only::copyable_only;
  static constexpr mesher_traits traits{.keeps_boundary = true};
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing&) const {
    mesher_result<3> result;
    result.mesh.points = input.boundary.points;
    result.mesh.elements = {{0, 1, 2, 3}};
    result.mesh.tags = {input.material};
    return result;
  }
};

// for piece_mesher, boundary_keeping_mesher
template <piece_mesher<3> M>
class mesher_as {
public:
  explicit mesher_as(M held) : held_(std::move(held)) {}
  mesher_as(const mesher_as&) = default;
  mesher_as& operator=(const mesher_as&) = delete;

  static constexpr mesher_traits traits = M::traits;
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const {
    return held_(input, size);
  }

private:
  M held_;
};
// end

// for calibrated_mesher, piece_sizing_mesher
template <boundary_keeping_mesher<3> M>
struct telling_mesher_as : mesher_as<M> {
  using mesher_as<M>::mesher_as;
  static constexpr int elements_per_inverse_cubed_size = 12;
  float elements_per_subdomain() const { return 500; }
};
// end

// for line_keeping_mesher
/// M keeps the whole boundary, so the lines are kept as well; this one does not say that it does.
template <boundary_keeping_mesher<3> M>
class line_keeping_mesher_as {
public:
  explicit line_keeping_mesher_as(M held) : held_(std::move(held)) {}
  line_keeping_mesher_as(const line_keeping_mesher_as&) = default;
  line_keeping_mesher_as& operator=(const line_keeping_mesher_as&) = delete;

  static constexpr mesher_traits traits{};
  line_keeping_mesher_as with_lines(const std::vector<std::vector<vec3>>&) const { return *this; }
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const {
    return held_(input, size);
  }

private:
  M held_;
};
// end

// for has_fallbacks
/// Fails at the first try.
template <boundary_keeping_mesher<3> M>
class mesher_after_failure {
public:
  explicit mesher_after_failure(M held, bool fails = true) : held_(std::move(held)), fails_(fails) {}

  static constexpr mesher_traits traits = M::traits;
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const {
    if (fails_)
      throw mesher_error("the first try fails");
    return held_(input, size);
  }
  std::vector<mesher_after_failure> fallbacks() const { return {mesher_after_failure(held_, false)}; }

private:
  M held_;
  bool fails_;
};
// end

// for has_background_form
/// Knows which of the two it is.
template <boundary_keeping_mesher<3> M>
class mesher_of_backgrounds_and_pieces {
public:
  explicit mesher_of_backgrounds_and_pieces(M held, bool is_for_background = false)
      : held_(std::move(held)), is_for_background_(is_for_background) {}

  static constexpr mesher_traits traits = M::traits;
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const {
    return held_(input, size);
  }
  bool is_for_background() const { return is_for_background_; }
  mesher_of_backgrounds_and_pieces for_background() const {
    return mesher_of_backgrounds_and_pieces(held_, true);
  }

private:
  M held_;
  bool is_for_background_;
};
// end

// for patch_surface
/// Neither copyable nor movable: a surface is passed by reference.
template <patch_surface S>
class surface_as {
public:
  explicit surface_as(const S& held) : held_(held) {}
  surface_as(const surface_as&) = delete;
  surface_as& operator=(const surface_as&) = delete;

  surface_frame frame(vec2 uv) const { return held_.frame(uv); }
  vec2 project(vec3 p, vec2 seed) const { return held_.project(p, seed); }

private:
  const S& held_;
};
// end

// for surface_mesher
template <surface_mesher M>
class surface_mesher_as {
public:
  explicit surface_mesher_as(M held) : held_(std::move(held)) {}
  surface_mesher_as(const surface_mesher_as&) = default;
  surface_mesher_as& operator=(const surface_mesher_as&) = delete;

  patch_mesh operator()(const any_surface& surface, const patch_boundary& boundary,
                        const any_sizing& size) const {
    return held_(any_surface::view_of(surface_as<any_surface>(surface)), boundary, size);
  }

private:
  M held_;
};
// end

// for shape_measure
/// The volume over the cube of the longest of the apex's edges: positive, zero or negative with the
/// element's.
struct shape_measure {
  shape_measure() = delete;
  template <class T>
  static T of_apex(improvement::triple<T> a, improvement::triple<T> b, improvement::triple<T> c) {
    const T longest = std::max({dot(a, a), dot(b, b), dot(c, c), T(1e-30)});
    return dot(cross(a, b), c) / (longest * std::sqrt(longest));
  }
  static double from_angle(double degrees) { return degrees / 60; }
};
// end

// for mesh_operation
/// Changes nothing; neither copyable nor movable.
struct operation {
  operation() = default;
  operation(const operation&) = delete;
  operation& operator=(const operation&) = delete;
  static constexpr std::array names{"nothing"};
  static constexpr improvement::turn when = improvement::turn::hard;
  bool mend(improvement::tet_complex&, local_id, const improvement::operation_limits<3>&,
            const improvement::recorded_tries& tries) {
    return tries([] { return false; });
  }
};
// end

// for improver
struct improver : copyable_only {
  using copyable_only::copyable_only;
  static constexpr improver_traits traits{};
  report operator()(simplicial_mesh<3>&, const frozen_entities<3>&, const any_sizing&) const { return {}; }
};
// end

// for surface_improver
struct surface_improver : copyable_only {
  using copyable_only::copyable_only;
  static constexpr improver_traits traits{};
  report operator()(simplicial_mesh<2>&, const frozen_entities<2>&, const any_sizing&) const { return {}; }
  report operator()(simplicial_mesh<2>&, const frozen_entities<2>&, const any_sizing&,
                    const surface_host&) const {
    return {};
  }
};
// end

// for executor
struct executor : copyable_only {
  using copyable_only::copyable_only;
  std::vector<task_outcome> run(std::size_t count, const task_function& task, const run_options&) const {
    std::vector<task_outcome> outcomes(count);
    for (std::size_t i = 0; i < count; ++i) {
      outcomes[i].result = task(i);
      outcomes[i].ok = true;
    }
    return outcomes;
  }
  short workers() const { return 1; }
  bool shares_process() const { return true; }
};
// end

// for communicator
struct communicator {
  communicator(const communicator&) = delete;
  communicator(communicator&&) = default;
  communicator& operator=(communicator&&) = default;
  int rank() { return 0; }
  int size() { return 1; }
  void send(int, std::int32_t, byte_buffer&&) {}
  std::optional<rank_message> receive() { return std::nullopt; }
  void wait(std::chrono::milliseconds) {}
  int descriptor() { return -1; }
  short shares_process() { return 0; }
  bool abandon(const std::string&) { return true; }
};
// end

// for mesh_writer
struct writer : copyable_only {
  using copyable_only::copyable_only;
  report operator()(const distributed_mesh&, const std::filesystem::path&) const { return {}; }
};
// end

// for piecewise_mesh_writer
struct piecewise_writer : copyable_only {
  using copyable_only::copyable_only;
  report operator()(const distributed_mesh&, const std::filesystem::path&) const { return {}; }
  io::piecewise_output<3> begin(const distributed_mesh&, const std::filesystem::path&) const { return {}; }
};
// end

// for rank_format
struct rank_format : copyable_only {
  using copyable_only::copyable_only;
  std::string name() const { return {}; }
  std::vector<std::string> files_of_rank(local_id) const { return {}; }
  std::vector<std::string> files_of_all() const { return {}; }
  void write(const io::rank_source<3>&, const rank_mesh<3>&,
             const std::vector<std::filesystem::path>&) const {}
  void write_all(const io::rank_source<3>&, const std::vector<std::filesystem::path>&) const {}
};
// end

// for shared_rank_format
struct shared_rank_format : copyable_only {
  using copyable_only::copyable_only;
  std::string name() const { return {}; }
  std::vector<std::string> files_of_all() const { return {}; }
  void lay_out(const io::rank_source<3>&, const std::vector<io::rank_counts>&,
               const std::vector<std::filesystem::path>&) const {}
  void write(const io::rank_source<3>&, const rank_mesh<3>&,
             const std::vector<std::filesystem::path>&) const {}
};
// end

// for redistributor
struct redistributor : copyable_only {
  using copyable_only::copyable_only;
  redistribution<3> operator()(const distributed_mesh&, int) const { return {}; }
};
// end

// for mesh_reader
struct reader : copyable_only {
  using copyable_only::copyable_only;
  io::loaded_mesh operator()(const std::filesystem::path&) const { return {}; }
};
// end

/// A model without entities.
class geometry {
public:
  geometry() = default;
  geometry(const geometry&) = default;
  geometry& operator=(const geometry&) = delete;

  const geometry_topology& topology() const { return topology_; }
  vec3 curve_point(local_id, double) const { return {}; }
  dovetail::curve_frame curve_frame(local_id, double) const { return {}; }
  vec2 curve_uv(local_id, int, double) const { return {}; }
  vec3 face_point(local_id, vec2) const { return {}; }
  surface_frame face_frame(local_id, vec2) const { return {}; }
  float face_curvature(local_id, vec2) const { return 0; }
  vec2 project_to_face(local_id, vec3, vec2 seed) const { return seed; }
  float project_to_curve(local_id, vec3, double) const { return 0; }
  box3 bounds() const { return {}; }
  bool thread_safe() const { return true; }

private:
  geometry_topology topology_;
};

// for geometry_model
template <geometry_model G>
class geometry_as {
public:
  explicit geometry_as(const G& held) : held_(held) {}
  geometry_as(const geometry_as&) = default;
  geometry_as& operator=(const geometry_as&) = delete;

  const geometry_topology& topology() const { return held_.topology(); }
  vec3 curve_point(local_id c, double t) const { return held_.curve_point(c, t); }
  dovetail::curve_frame curve_frame(local_id c, double t) const { return held_.curve_frame(c, t); }
  vec2 curve_uv(local_id f, int coedge, double t) const { return held_.curve_uv(f, coedge, t); }
  vec3 face_point(local_id f, vec2 uv) const { return held_.face_point(f, uv); }
  surface_frame face_frame(local_id f, vec2 uv) const { return held_.face_frame(f, uv); }
  double face_curvature(local_id f, vec2 uv) const { return held_.face_curvature(f, uv); }
  vec2 project_to_face(local_id f, vec3 p, vec2 seed) const { return held_.project_to_face(f, p, seed); }
  double project_to_curve(local_id c, vec3 p, double seed) const {
    return held_.project_to_curve(c, p, seed);
  }
  box3 bounds() const { return held_.bounds(); }
  bool thread_safe() const { return held_.thread_safe(); }

private:
  const G& held_;
};
// end

// for geometry_model_with_planes
template <geometry_model_with_planes G>
struct planes_as : geometry_as<G> {
  explicit planes_as(const G& held) : geometry_as<G>(held), known(held) {}
  std::optional<surface_frame> plane_of_face(local_id f) const { return known.plane_of_face(f); }
  const G& known;
};
// end

// for geometry_model_with_members
template <geometry_model_with_members G>
struct members_as : geometry_as<G> {
  explicit members_as(const G& held) : geometry_as<G>(held), known(held) {}
  local_id face_at(local_id f, vec3 p) const { return known.face_at(f, p); }
  local_id whole_face(local_id f) const { return known.whole_face(f); }
  const G& known;
};
// end

} // namespace dovetail::archetype
