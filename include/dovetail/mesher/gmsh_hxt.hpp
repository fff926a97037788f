/// @file
/// Gmsh's HXT through its library: parallel-born Delaunay meshing, here on one thread of a child process.
/// Gmsh is licensed under the GPL; a program that includes this file and links it is bound by that.
#pragma once

#include "dovetail/mesher/call_budget.hpp"
#include "dovetail/mesher/checks.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/mesher/shells.hpp"
#include "dovetail/parallel/fresh_memory.hpp"
#include "dovetail/parallel/processes.hpp"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail::mesher {

/// A model of `boundary_keeping_mesher<3>`.
///
/// Gmsh is given 0.68 times the size: on a uniform field that makes the mean edge h within 1 % and 11.4
/// elements per h^3 (measured on cubes and spheres of 0.1 to 0.5 million elements).
///
/// Gmsh has one global state, and HXT's result depends on what the process did before: so each call forks a
/// child with fresh memory, which is the only one to call Gmsh, and takes the mesh over from it. The
/// calling process must have one thread only (`usage_error` otherwise). A crash or hang of Gmsh ends in a
/// `mesher_error`.
struct gmsh_hxt {
  static constexpr mesher_traits traits{.keeps_boundary = true,
                                        .thread_safe = false,
                                        .accepts_non_manifold = false,
                                        .repeats_in_process = true, // each call has a process of its own
                                        .may_crash = false};

  /// Elements made per unit of the integral of h^-3.
  static constexpr double elements_per_inverse_cubed_size = 11.4;

  double optimise_threshold = 0.35; ///< Gmsh's `Mesh.OptimizeThreshold`, above 0 to 0.55: higher is slower
  double size_scale = 1.0;          ///< multiplies the field
  double limit_seconds = 3600;      ///< the child's wall clock; the last resort

  /// Meshes the inside of `input.boundary`. Throws `mesher_error` when Gmsh fails or its result fails the
  /// checks; `sizing_error` when the field gives an unusable size.
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const;
};

} // namespace dovetail::mesher

namespace dovetail::detail {

/// What the child sends back; an error's text, when not empty, stands for the mesh.
struct gmsh_answer {
  std::string sizing_failure;
  std::vector<vec3> points;
  std::vector<simplex<3>> elements;
  std::size_t sizing_calls = 0;
};

inline byte_buffer encode(const gmsh_answer& answer) {
  byte_writer bytes;
  bytes.text(answer.sizing_failure);
  bytes.array(answer.points);
  bytes.array(answer.elements);
  bytes.value(answer.sizing_calls);
  return bytes.take();
}
inline gmsh_answer decode_gmsh_answer(const byte_buffer& bytes) {
  byte_reader reader(bytes);
  gmsh_answer answer;
  answer.sizing_failure = reader.text();
  answer.points = reader.array<vec3>();
  answer.elements = reader.array<simplex<3>>();
  answer.sizing_calls = reader.value<std::size_t>();
  return answer;
}

/// One use of Gmsh, in a process that ends right after it.
class gmsh_session {
public:
  gmsh_session(const mesher::gmsh_hxt& parameters, const any_sizing& size) : size_(size) {
    gmsh::initialize(0, nullptr, false);
    const auto set = [](const char* option, double value) { gmsh::option::setNumber(option, value); };
    set("General.Terminal", 0);
    set("General.NumThreads", 1);
    set("Mesh.MaxNumThreads3D", 1);
    set("Mesh.Algorithm3D", 10); // HXT
    set("Mesh.MeshSizeExtendFromBoundary", 0);
    set("Mesh.MeshSizeFromPoints", 0);
    set("Mesh.MeshSizeFromCurvature", 0);
    set("Mesh.Optimize", 1);
    set("Mesh.OptimizeThreshold", parameters.optimise_threshold);
    gmsh::model::add("piece");
    scale_ = calibration * parameters.size_scale;
  }

  gmsh_answer mesh(const simplicial_mesh<2>& boundary, const std::vector<bounded_body>& bodies) {
    for (const bounded_body& body : bodies) {
      std::vector<int> loops{add_shell(boundary.points, body.outer)};
      for (const auto& shell : body.voids)
        loops.push_back(add_shell(boundary.points, shell));
      gmsh::model::geo::addVolume(loops);
    }
    gmsh::model::geo::synchronize();
    gmsh::model::mesh::setSizeCallback([this](int, int, double x, double y, double z) {
      return scale_ * size_at({x, y, z});
    });
    gmsh::model::mesh::generate(3);
    return answer();
  }

private:
  /// For a mean edge of h on uniform fields.
  static constexpr double calibration = 0.68;

  /// A discrete surface for a shell, whose node tags are the boundary's point numbers plus one.
  int add_shell(const std::vector<vec3>& points, const std::vector<simplex<2>>& shell) {
    std::vector<std::size_t> corners;
    for (const auto& t : shell)
      for (const local_id v : t)
        corners.push_back(static_cast<std::size_t>(v) + 1);
    std::vector<std::size_t> nodes = corners;
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    std::vector<double> coordinates;
    for (const std::size_t node : nodes)
      for (int axis = 0; axis < 3; ++axis)
        coordinates.push_back(points[node - 1][axis]);
    std::vector<std::size_t> tags(shell.size());
    std::iota(tags.begin(), tags.end(), next_triangle_);
    next_triangle_ += tags.size();
    const int surface = gmsh::model::addDiscreteEntity(2);
    gmsh::model::mesh::addNodes(2, surface, nodes, coordinates);
    constexpr int triangle_type = 2;
    gmsh::model::mesh::addElementsByType(surface, triangle_type, tags, corners);
    return gmsh::model::geo::addSurfaceLoop({surface});
  }

  /// Exceptions must not pass through Gmsh's C code: the first failure is noted instead.
  double size_at(vec3 p) {
    ++calls_;
    try {
      return checked_size(size_, p);
    } catch (const std::exception& e) {
      if (failure_.empty())
        failure_ = e.what();
      return 1e22;
    }
  }

  gmsh_answer answer() const {
    gmsh_answer result;
    result.sizing_failure = failure_;
    result.sizing_calls = calls_;
    std::vector<std::size_t> nodes;
    std::vector<double> coordinates;
    std::vector<double> unused;
    gmsh::model::mesh::getNodes(nodes, coordinates, unused, -1, -1, false, false);
    std::vector<local_id> index(nodes.empty() ? 0 : *std::max_element(nodes.begin(), nodes.end()) + 1, no_id);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      index[nodes[k]] = static_cast<local_id>(k);
      result.points.push_back({coordinates[3 * k], coordinates[3 * k + 1], coordinates[3 * k + 2]});
    }
    std::vector<std::size_t> tags;
    std::vector<std::size_t> corners;
    constexpr int tetrahedron_type = 4;
    gmsh::model::mesh::getElementsByType(tetrahedron_type, tags, corners);
    result.elements.resize(tags.size());
    for (std::size_t e = 0; e < tags.size(); ++e)
      for (std::size_t k = 0; k < 4; ++k)
        result.elements[e][k] = index[corners[4 * e + k]];
    return result;
  }

  const any_sizing& size_;
  double scale_ = 1;
  std::size_t next_triangle_ = 1;
  std::string failure_;
  std::size_t calls_ = 0;
};

/// Gmsh renumbers nodes: the given points come first again, found by their exact coordinates.
inline simplicial_mesh<3> with_given_points_first(const std::vector<vec3>& given, gmsh_answer answer) {
  const auto less = [](vec3 a, vec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
  std::vector<local_id> sorted(given.size());
  std::iota(sorted.begin(), sorted.end(), local_id{0});
  const auto at = [&](local_id v) { return given[static_cast<std::size_t>(v)]; };
  std::sort(sorted.begin(), sorted.end(), [&](local_id a, local_id b) { return less(at(a), at(b)); });
  for (std::size_t k = 1; k < sorted.size(); ++k)
    if (at(sorted[k - 1]) == at(sorted[k]))
      throw mesher_error("boundary points " + std::to_string(sorted[k - 1]) + " and " +
                         std::to_string(sorted[k]) + " coincide");

  simplicial_mesh<3> mesh{given, std::move(answer.elements), {}};
  std::vector<local_id> number(answer.points.size());
  for (std::size_t k = 0; k < number.size(); ++k) {
    const vec3 p = answer.points[k];
    const auto found = std::lower_bound(sorted.begin(), sorted.end(), p,
                                        [&](local_id v, vec3 point) { return less(at(v), point); });
    if (found != sorted.end() && at(*found) == p) {
      number[k] = *found;
    } else {
      number[k] = static_cast<local_id>(mesh.points.size());
      mesh.points.push_back(p);
    }
  }
  for (auto& element : mesh.elements)
    for (local_id& v : element)
      v = number[static_cast<std::size_t>(v)];
  return mesh;
}

/// Runs in the child. Gmsh throws its messages as std::string. On used memory the same input gives other
/// meshes: HXT reads what it has not initialised.
inline byte_buffer run_gmsh(const mesher::gmsh_hxt& parameters, const simplicial_mesh<2>& boundary,
                            const std::vector<bounded_body>& bodies, const any_sizing& size) {
  return on_fresh_memory([&] {
    try {
      return encode(gmsh_session(parameters, size).mesh(boundary, bodies));
    } catch (const std::string& text) {
      throw mesher_error(text);
    } catch (const int code) {
      throw mesher_error("error " + std::to_string(code));
    }
  });
}

} // namespace dovetail::detail

namespace dovetail::mesher {

inline mesher_result<3> gmsh_hxt::operator()(const mesher_input<3>& input, const any_sizing& size) const {
  const stopwatch clock;
  require_meshable(input.boundary);
  const boundary_sides sides(input.boundary.elements);
  if (sides.entries().size() != input.boundary.elements.size())
    throw mesher_error("HXT does not take triangles that have elements on both sides; use TetGen");
  const auto bodies = bodies_of(input.boundary);
  run_options alone;
  alone.limit_seconds = limit_seconds;
  auto outcomes = parallel::processes{1}.run(
      1, [&](std::size_t) { return detail::run_gmsh(*this, input.boundary, bodies, size); }, alone);
  task_outcome& outcome = outcomes.front();
  if (!outcome.ok)
    throw mesher_error("HXT failed: " + outcome.failure);
  auto answer = detail::decode_gmsh_answer(outcome.result);
  outcome.result = {};
  if (!answer.sizing_failure.empty())
    throw sizing_error(answer.sizing_failure);

  mesher_result<3> result;
  result.summary.name = "gmsh_hxt";
  result.summary.set("sizing_calls", static_cast<double>(answer.sizing_calls));
  result.mesh = detail::with_given_points_first(input.boundary.points, std::move(answer));
  result.mesh.tags.assign(result.mesh.elements.size(), input.material);
  check_mesher_result(input, result.mesh);
  result.summary.seconds = clock.seconds();
  result.summary.set("elements", static_cast<double>(result.mesh.elements.size()));
  result.summary.set("points", static_cast<double>(result.mesh.points.size()));
  return result;
}

static_assert(boundary_keeping_mesher<gmsh_hxt, 3>);

} // namespace dovetail::mesher
