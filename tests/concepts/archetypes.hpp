/// @file
/// One archetype per role concept: a type that has what the concept asks for and nothing else, so that
/// generic code that compiles with it asks for no more than the concept says.
#pragma once

#include "dovetail/geometry/concepts.hpp"
#include "dovetail/graph/csr_graph.hpp"
#include "dovetail/improver/concepts.hpp"
#include "dovetail/io/concepts.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/parallel/concepts.hpp"
#include "dovetail/partition/concepts.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <algorithm>
#include <vector>

namespace dovetail::archetype {

/// Copyable, and neither default constructible nor assignable.
class copyable_only {
public:
  explicit copyable_only(int) {}
  copyable_only(const copyable_only&) = default;
  copyable_only& operator=(const copyable_only&) = delete;
};

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

struct sizing : copyable_only {
  using copyable_only::copyable_only;
  float operator()(vec3) const { return 1.0f; } // convertible to double is enough
};

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

struct improver : copyable_only {
  using copyable_only::copyable_only;
  report operator()(simplicial_mesh<3>&, const frozen_entities<3>&, const any_sizing&) const { return {}; }
};

/// Neither copyable nor movable: an executor is passed by reference where it runs.
struct executor {
  executor() = default;
  executor(const executor&) = delete;
  executor& operator=(const executor&) = delete;
  std::vector<task_outcome> run(std::size_t count, const task_function& task, const run_options&) const {
    std::vector<task_outcome> outcomes(count);
    for (std::size_t i = 0; i < count; ++i) {
      outcomes[i].result = task(i);
      outcomes[i].ok = true;
    }
    return outcomes;
  }
  short workers() const { return 1; }
};

struct writer : copyable_only {
  using copyable_only::copyable_only;
  report operator()(const distributed_mesh&, const std::filesystem::path&) const { return {}; }
};

struct reader : copyable_only {
  using copyable_only::copyable_only;
  io::loaded_mesh operator()(const std::filesystem::path&) const { return {}; }
};

/// A model without entities.
class geometry {
public:
  geometry() = default;
  geometry(const geometry&) = delete;
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

} // namespace dovetail::archetype
