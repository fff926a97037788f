/// @file
/// Gmsh's volume meshers through its library, each call in a forked child: what `gmsh_hxt` and
/// `gmsh_delaunay` have in common. Gmsh is licensed under the GPL; a program that includes this file and
/// links it is bound by that.
#pragma once

#include "dovetail/adapters/call_budget.hpp"
#include "dovetail/adapters/given_points_first.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/distributed/run_in_child.hpp"
#include "dovetail/mesher/boundary_sides.hpp"
#include "dovetail/mesher/checks.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/mesher/shells.hpp"
#include "dovetail/sizing/checked_size.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// What tells one use of Gmsh from another.
struct gmsh_settings {
  std::string name;              ///< in messages and reports
  int algorithm = 0;             ///< `Mesh.Algorithm3D`
  double size_factor = 1;        ///< what Gmsh is told, over the size wanted
  double optimise_threshold = 0; ///< `Mesh.OptimizeThreshold`
  double limit_seconds = 0;      ///< the child's wall clock
};

/// What the child sends back.
struct gmsh_answer {
  std::vector<vec3> points;
  std::vector<simplex<3>> elements;
  std::size_t sizing_calls = 0;

  using fields = field_list<&gmsh_answer::points, &gmsh_answer::elements, &gmsh_answer::sizing_calls>;
};

/// One use of Gmsh, in a process that ends right after it.
class gmsh_session {
public:
  gmsh_session(const gmsh_settings& settings, const any_sizing& size)
      : size_(size), scale_(settings.size_factor) {
    gmsh::initialize(0, nullptr, false);
    const auto set = [](const char* option, double value) { gmsh::option::setNumber(option, value); };
    set("General.Terminal", 0);
    set("General.NumThreads", 1);
    set("Mesh.MaxNumThreads3D", 1);
    set("Mesh.Algorithm3D", settings.algorithm);
    set("Mesh.MeshSizeExtendFromBoundary", 0);
    set("Mesh.MeshSizeFromPoints", 0);
    set("Mesh.MeshSizeFromCurvature", 0);
    set("Mesh.Optimize", settings.optimise_threshold > 0 ? 1 : 0);
    set("Mesh.OptimizeThreshold", settings.optimise_threshold);
    gmsh::model::add("piece");
  }

  gmsh_answer mesh(const simplicial_mesh<2>& boundary, const std::vector<bounded_body>& bodies) {
    for (const bounded_body& body : bodies) {
      std::vector<int> loops{add_shell(boundary.points, body.outer)};
      for (const auto& shell : body.voids)
        loops.push_back(add_shell(boundary.points, shell));
      gmsh::model::geo::addVolume(loops);
    }
    gmsh::model::geo::synchronize();
    // Since 4.9 Gmsh also says what its other limits are, and no longer takes the least of all by itself.
    gmsh::model::mesh::setSizeCallback([this](int, int, double x, double y, double z, auto... others) {
      return std::min({scale_ * size_at({x, y, z}), others...});
    });
    gmsh::model::mesh::generate(3);
    if (!failure_.empty())
      throw sizing_error(failure_);
    return answer();
  }

private:
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
  double scale_;
  std::size_t next_triangle_ = 1;
  std::string failure_;
  std::size_t calls_ = 0;
};

/// Runs in the child. Gmsh throws its messages as std::string. On used memory the same input gives other
/// meshes: HXT reads what it has not initialised.
inline gmsh_answer run_gmsh(const gmsh_settings& settings, const simplicial_mesh<2>& boundary,
                            const std::vector<bounded_body>& bodies, const any_sizing& size) {
  try {
    return gmsh_session(settings, size).mesh(boundary, bodies);
  } catch (const std::string& text) {
    throw mesher_error(text);
  } catch (const int code) {
    throw mesher_error("error " + std::to_string(code));
  }
}

/// Meshes a piece in a child with fresh memory, and checks the result. Throws `mesher_error` when Gmsh fails,
/// crashes or does not end, or its result fails the checks; `sizing_error` when the field gives an unusable
/// size; `usage_error` in a process with several threads.
inline mesher_result<3> mesh_with_gmsh(const gmsh_settings& settings, const mesher_input<3>& input,
                                       const any_sizing& size) {
  const stopwatch clock;
  require_meshable(input.boundary);
  const boundary_sides sides(input.boundary.elements);
  if (sides.entries().size() != input.boundary.elements.size())
    throw mesher_error(settings.name +
                       " does not take triangles that have elements on both sides; use TetGen");
  const auto bodies = bodies_of(input.boundary);
  auto answer = run_in_child(settings.name, settings.limit_seconds,
                             [&] { return run_gmsh(settings, input.boundary, bodies, size); });
  mesher_result<3> result;
  result.mesh = with_given_points_first(input.boundary.points, answer.points, std::move(answer.elements));
  result.mesh.tags.assign(result.mesh.elements.size(), input.material);
  check_mesher_result(input, result.mesh);
  result.summary.name = settings.name;
  result.summary.seconds = clock.seconds();
  result.summary.set(
      mesher_counts{result.mesh.elements.size(), result.mesh.points.size(), answer.sizing_calls});
  return result;
}

} // namespace dovetail::detail
