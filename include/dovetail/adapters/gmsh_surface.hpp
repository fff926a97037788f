/// @file
/// Gmsh's Frontal-Delaunay triangulation in the parameter plane, as a mesher of surfaces; each patch in a
/// forked child. Gmsh is licensed under the GPL; a program that includes this file and links it is bound by
/// that.
#pragma once

#include "dovetail/adapters/parameter_square.hpp"
#include "dovetail/core/predicates.hpp"
#include "dovetail/distributed/run_in_child.hpp"
#include "dovetail/mesher/by_regions.hpp"
#include "dovetail/remesh/constrained_triangulation.hpp"
#include "dovetail/sizing/checked_size.hpp"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// Segments as Gmsh wants them: closed loops without a repeated vertex, the one of largest area first, and
/// slits, which are listed in both directions.
struct sorted_segments {
  using segment = std::array<local_id, 2>;
  std::vector<std::vector<segment>> loops;
  std::vector<segment> slits;

  sorted_segments(const std::vector<segment>& segments, const std::vector<local_id>& same_as,
                  const std::vector<vec2>& xy) {
    std::map<local_id, std::vector<local_id>> ends; // by start
    std::vector<segment> all;
    for (const auto& [a, b] : segments)
      all.push_back({same_as[a], same_as[b]});
    std::sort(all.begin(), all.end());
    for (const auto& [a, b] : all)
      if (!std::binary_search(all.begin(), all.end(), segment{b, a}))
        ends[a].push_back(b);
      else if (a < b)
        slits.push_back({a, b});
    for (auto& [start, next] : ends)
      while (!next.empty())
        walk(start, ends);
    const auto area = [&](const std::vector<segment>& loop) {
      double sum = 0;
      for (const auto& [a, b] : loop)
        sum += cross(xy[a], xy[b]);
      return std::abs(sum);
    };
    std::stable_sort(loops.begin(), loops.end(),
                     [&](const auto& a, const auto& b) { return area(a) > area(b); });
  }

private:
  /// Follows unused segments until it is back, and takes a loop off whenever it meets its own path.
  void walk(local_id start, std::map<local_id, std::vector<local_id>>& ends) {
    std::vector<segment> path;
    local_id at = start;
    while (!ends[at].empty()) {
      const local_id to = ends[at].back();
      ends[at].pop_back();
      path.push_back({at, to});
      at = to;
      const auto met = std::find_if(path.begin(), path.end(), [&](const segment& s) { return s[0] == to; });
      if (met != path.end()) {
        loops.emplace_back(met, path.end());
        path.erase(met, path.end());
      }
    }
  }
};

/// One use of Gmsh for a patch, in a process that ends right after it.
class gmsh_patch_session {
public:
  gmsh_patch_session(const any_surface& surface, const patch_boundary& boundary, const any_sizing& size,
                     double size_factor)
      : surface_(surface), boundary_(boundary), size_(size), size_factor_(size_factor),
        square_(surface, boundary) {}

  patch_mesh run() {
    patch_mesh mesh;
    const auto loops = triangulate_loops(square_.xy, boundary_.segments);
    mesh.crossings = loops.crossings;
    mesh.misplaced = loops.misplaced;
    if (loops.valid()) {
      same_as_ = loops.same_as;
      start();
      describe(sorted_segments(boundary_.segments, same_as_, square_.xy));
      gmsh::model::mesh::generate(2);
      if (!failure_.empty())
        throw sizing_error(failure_);
      collect(mesh);
    }
    return mesh;
  }

private:
  static void start() {
    gmsh::initialize(0, nullptr, false);
    const auto set = [](const char* option, double value) { gmsh::option::setNumber(option, value); };
    set("General.Terminal", 0);
    set("General.NumThreads", 1);
    constexpr double frontal_delaunay = 6;
    set("Mesh.Algorithm", frontal_delaunay);
    set("Mesh.MeshSizeExtendFromBoundary", 0);
    set("Mesh.MeshSizeFromPoints", 0);
    set("Mesh.MeshSizeFromCurvature", 0);
    gmsh::model::add("patch");
  }

  /// Point v has tag v + 1; every line is one edge.
  void describe(const sorted_segments& segments) {
    namespace geo = gmsh::model::geo;
    for (std::size_t v = 0; v < square_.xy.size(); ++v)
      if (same_as_[v] == static_cast<local_id>(v))
        geo::addPoint(square_.xy[v].x, square_.xy[v].y, 0, 0, static_cast<int>(v) + 1);
    const auto add_line = [](const std::array<local_id, 2>& segment) {
      const int line = geo::addLine(segment[0] + 1, segment[1] + 1);
      geo::mesh::setTransfiniteCurve(line, 2);
      return line;
    };
    std::vector<int> wires;
    for (const auto& loop : segments.loops) {
      std::vector<int> lines;
      for (const auto& segment : loop)
        lines.push_back(add_line(segment));
      wires.push_back(geo::addCurveLoop(lines));
    }
    const int face = geo::addPlaneSurface(wires);
    std::vector<int> slits;
    for (const auto& segment : segments.slits)
      slits.push_back(add_line(segment));
    geo::synchronize();
    if (!slits.empty())
      gmsh::model::mesh::embed(1, slits, 2, face);
    // Since 4.9 Gmsh also says what its other limits are, and no longer takes the least of all by itself.
    gmsh::model::mesh::setSizeCallback([this](int, int, double x, double y, double, auto... others) {
      return std::min({size_at({x, y}), others...});
    });
  }

  /// The size in the square. Exceptions must not pass through Gmsh's C code: the first failure is noted.
  double size_at(vec2 p) {
    try {
      const surface_frame f = surface_.frame(square_.uv(p));
      const double stretch = std::sqrt(norm(cross(f.du, f.dv)) / (square_.scale.x * square_.scale.y));
      return std::min(size_factor_ * checked_size(size_, f.point) / stretch, 1e22);
    } catch (const std::exception& e) {
      if (failure_.empty())
        failure_ = e.what();
      return 1e22;
    }
  }

  static std::vector<std::size_t> nodes_of(int dimension, int entity, std::vector<double>& coordinates) {
    std::vector<std::size_t> nodes;
    std::vector<double> unused;
    gmsh::model::mesh::getNodes(nodes, coordinates, unused, dimension, entity, false, false);
    return nodes;
  }

  void collect(patch_mesh& mesh) {
    std::vector<double> coordinates;
    if (!nodes_of(1, -1, coordinates).empty())
      throw mesher_error("it put points on the boundary's lines");
    std::map<std::size_t, local_id> index;
    for (std::size_t v = 0; v < same_as_.size(); ++v)
      if (same_as_[v] == static_cast<local_id>(v))
        index[nodes_of(0, static_cast<int>(v) + 1, coordinates).at(0)] = static_cast<local_id>(v);
    const auto inner = nodes_of(2, -1, coordinates);
    std::vector<vec2> xy = square_.xy;
    for (std::size_t k = 0; k < inner.size(); ++k) {
      index[inner[k]] = static_cast<local_id>(xy.size());
      xy.push_back({coordinates[3 * k], coordinates[3 * k + 1]});
      mesh.inner_uv.push_back(square_.uv(xy.back()));
      mesh.inner_points.push_back(surface_.frame(mesh.inner_uv.back()).point);
    }
    std::vector<std::size_t> tags, corners;
    constexpr int triangle_type = 2;
    gmsh::model::mesh::getElementsByType(triangle_type, tags, corners);
    for (std::size_t t = 0; t < tags.size(); ++t)
      add_triangle({index.at(corners[3 * t]), index.at(corners[3 * t + 1]), index.at(corners[3 * t + 2])}, xy,
                   mesh);
  }

  /// Counter-clockwise, and left out when two corners are the same point of a pole.
  void add_triangle(simplex<2> t, const std::vector<vec2>& xy, patch_mesh& mesh) const {
    const auto at = [&](std::size_t k) { return xy[t[k]]; };
    if (orient2d(at(0), at(1), at(2)) < 0)
      std::swap(t[1], t[2]);
    if (!(orient2d(at(0), at(1), at(2)) > 0))
      throw mesher_error("it made a flat triangle");
    if (!square_.vanishes(t, boundary_))
      mesh.triangles.push_back(t);
  }

  const any_surface& surface_;
  const patch_boundary& boundary_;
  const any_sizing& size_;
  double size_factor_;
  parameter_square square_;
  std::vector<local_id> same_as_;
  std::string failure_;
};

} // namespace detail

namespace mesher {

/// A model of `surface_mesher`. The size is isotropic in the scaled parameter plane: on planes, cylinders and
/// cones' narrow parts triangles are as good there as in space, where the parameters shear or stretch them
/// unevenly they are not, and an improver has more to do. Forbidden edges are not avoided.
struct gmsh_frontal {
  static constexpr bool thread_safe = false; ///< only one call at a time in a process

  double size_scale = 1.0;     ///< multiplies the field
  double limit_seconds = 3600; ///< the child's wall clock; the last resort

  /// Throws `mesher_error` when Gmsh fails, crashes or does not end; `sizing_error` when the field gives an
  /// unusable size; `usage_error` in a process with several threads.
  patch_mesh operator()(const any_surface& surface, const patch_boundary& boundary,
                        const any_sizing& size) const {
    const stopwatch clock;
    patch_mesh mesh = run_in_child("Gmsh's surface mesher", limit_seconds, [&] {
      try {
        return dovetail::detail::gmsh_patch_session(surface, boundary, size, size_scale).run();
      } catch (const std::string& text) { // as Gmsh throws its messages
        throw mesher_error(text);
      }
    });
    mesh.summary.name = "gmsh_frontal";
    mesh.summary.seconds = clock.seconds();
    return mesh;
  }
};
static_assert(surface_mesher<gmsh_frontal>);

/// A child process for each region of a piece.
using gmsh_surface = by_regions<gmsh_frontal>;
static_assert(boundary_keeping_mesher<gmsh_surface, 2>);

} // namespace mesher
} // namespace dovetail
