/// @file
/// CGAL's constrained Delaunay triangulation in the parameter plane, as a mesher of surfaces. CGAL's own
/// `Delaunay_mesher_2` splits constrained edges, so neighbouring patches would not match: here the
/// triangulation is the kernel only, and all points that are inserted lie inside.
#pragma once

#include "dovetail/adapters/parameter_square.hpp"
#include "dovetail/mesher/by_regions.hpp"
#include "dovetail/remesh/constrained_triangulation.hpp"
#include "dovetail/sizing/checked_size.hpp"

#pragma push_macro("Handle") // Open CASCADE defines it
#undef Handle
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#pragma pop_macro("Handle")

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// The triangulation of one patch while points are inserted, in its `parameter_square`.
class cgal_patch {
public:
  cgal_patch(const any_surface& surface, const patch_boundary& boundary, const any_sizing& size,
             double nearest)
      : surface_(surface), boundary_(boundary), size_(size), nearest_(nearest), square_(surface, boundary) {}

  /// Inserts points on edges that are too long, in rounds, until there are none.
  patch_mesh run(int most_rounds) {
    patch_mesh made;
    const auto loops = triangulate_loops(square_.xy, boundary_.segments);
    made.crossings = loops.crossings;
    made.misplaced = loops.misplaced;
    if (!loops.valid())
      return made;
    insert_boundary();
    for (int round = 0; round < most_rounds; ++round)
      if (mark_domain(); insert_on_long_edges() == 0)
        break;
    mark_domain();
    collect(made);
    return made;
  }

private:
  using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using vertex_base = CGAL::Triangulation_vertex_base_with_info_2<local_id, kernel>;
  using face_base =
      CGAL::Triangulation_face_base_with_info_2<bool, kernel,
                                                CGAL::Constrained_triangulation_face_base_2<kernel>>;
  using structure = CGAL::Triangulation_data_structure_2<vertex_base, face_base>;
  using triangulation = CGAL::Constrained_Delaunay_triangulation_2<
      kernel, structure, CGAL::No_constraint_intersection_requiring_constructions_tag>;
  using point = kernel::Point_2;
  using face = triangulation::Face_handle;
  using vertex = triangulation::Vertex_handle;

  static vec2 of(const point& p) { return {p.x(), p.y()}; }

  /// Loops that cross were found before.
  void insert_boundary() {
    std::vector<vertex> at(boundary_.uv.size());
    face hint;
    for (std::size_t v = 0; v < at.size(); ++v) {
      const std::size_t before = mesh_.number_of_vertices();
      at[v] = mesh_.insert(point(square_.xy[v].x, square_.xy[v].y), hint);
      if (mesh_.number_of_vertices() > before) // else a slit or another loop passes here again
        at[v]->info() = static_cast<local_id>(v);
      hint = at[v]->face();
    }
    for (const auto& [a, b] : boundary_.segments) {
      const vertex from = at[a], to = at[b];
      mesh_.insert_constraint(from, to);
      starts_.emplace_back(from, to);
    }
  }

  /// Marks what lies on the left of the segments, and all that can be reached from there.
  void mark_domain() {
    for (const face f : mesh_.all_face_handles())
      f->info() = false;
    std::vector<face> stack;
    for (const auto& [from, to] : starts_) {
      face f;
      int i = 0;
      if (!mesh_.is_edge(from, to, f, i))
        continue; // the check of the result will say so
      const face left = f->vertex(triangulation::ccw(i)) == from ? f : f->neighbor(i);
      push(left, stack);
    }
    while (!stack.empty()) {
      const face f = stack.back();
      stack.pop_back();
      for (int i = 0; i < 3; ++i)
        if (!f->is_constrained(i))
          push(f->neighbor(i), stack);
    }
  }
  void push(face f, std::vector<face>& stack) {
    if (f->info() || mesh_.is_infinite(f))
      return;
    f->info() = true;
    stack.push_back(f);
  }

  /// The size and the lengths of the surface at a point of the square.
  struct local_metric {
    vec2 at;
    double size;
    vec3 dx, dy;
    double relative_length(vec2 d) const { return norm(d.x * dx + d.y * dy) / size; }
  };
  local_metric metric_at(vec2 p) const {
    const surface_frame f = surface_.frame(square_.uv(p));
    return {p, checked_size(size_, f.point), f.du / square_.scale.x, f.dv / square_.scale.y};
  }

  /// Points along the edges inside, spaced by the field; those too near to others are left out.
  std::size_t insert_on_long_edges() {
    std::vector<local_metric> candidates;
    for (const face f : mesh_.finite_face_handles()) // CGAL's own order of edges depends on addresses
      for (int i = 0; i < 3; ++i)
        if (const vertex from = f->vertex(triangulation::ccw(i)), to = f->vertex(triangulation::cw(i));
            f->info() && !f->is_constrained(i) && from->info() < to->info())
          divide(of(from->point()), of(to->point()), candidates);
    std::size_t inserted = 0;
    face hint;
    for (const local_metric& candidate : candidates) {
      const point p(candidate.at.x, candidate.at.y);
      const face f = mesh_.locate(p, hint);
      hint = f;
      if (mesh_.is_infinite(f) || has_near_vertex(f, candidate))
        continue;
      const vertex v = mesh_.insert(p, f);
      v->info() = static_cast<local_id>(boundary_.uv.size() + inner_.size());
      inner_.push_back(candidate.at);
      hint = v->face();
      ++inserted;
    }
    return inserted;
  }

  void divide(vec2 a, vec2 b, std::vector<local_metric>& candidates) const {
    constexpr double most_parts = 1e6;
    const double length = metric_at(0.5 * (a + b)).relative_length(b - a);
    const auto parts = static_cast<int>(std::lround(std::min(length, most_parts)));
    for (int i = 1; i < parts; ++i) {
      const double s = static_cast<double>(i) / parts;
      candidates.push_back(metric_at((1 - s) * a + s * b));
    }
  }

  bool has_near_vertex(face f, const local_metric& candidate) const {
    const auto is_near = [&](vertex v) {
      return !mesh_.is_infinite(v) && candidate.relative_length(of(v->point()) - candidate.at) < nearest_;
    };
    for (int i = 0; i < 3; ++i)
      if (is_near(f->vertex(i)) || is_near(mesh_.mirror_vertex(f, i)))
        return true;
    return false;
  }

  void collect(patch_mesh& made) const {
    for (const vec2 p : inner_) {
      made.inner_uv.push_back(square_.uv(p));
      made.inner_points.push_back(surface_.frame(made.inner_uv.back()).point);
    }
    for (const face f : mesh_.finite_face_handles())
      if (const simplex<2> t{f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()};
          f->info() && !square_.vanishes(t, boundary_))
        made.triangles.push_back(t);
  }

  const any_surface& surface_;
  const patch_boundary& boundary_;
  const any_sizing& size_;
  double nearest_;
  parameter_square square_;
  triangulation mesh_;
  std::vector<std::pair<vertex, vertex>> starts_; ///< the segments
  std::vector<vec2> inner_;                       ///< of the square
};

} // namespace detail

namespace mesher {

/// A model of `surface_mesher`. Triangles are Delaunay in the scaled parameter plane, spaced by lengths in
/// space; their shapes are left to an improver, more so where parameters shear or stretch unevenly. Forbidden
/// edges are not avoided.
struct cgal_delaunay {
  double nearest = 0.75; ///< new points keep this distance from others, times the size
  int rounds = 40;       ///< rounds of insertion at most

  /// About n log n in the triangles made. Throws `sizing_error` when the field gives an unusable size.
  patch_mesh operator()(const any_surface& surface, const patch_boundary& boundary,
                        const any_sizing& size) const {
    const stopwatch clock;
    patch_mesh mesh = dovetail::detail::cgal_patch(surface, boundary, size, nearest).run(rounds);
    mesh.summary.name = "cgal_delaunay";
    mesh.summary.seconds = clock.seconds();
    return mesh;
  }
};
static_assert(surface_mesher<cgal_delaunay>);

using cgal_surface = by_regions<cgal_delaunay>; ///< a mesher of pieces of D = 2 by CGAL
static_assert(boundary_keeping_mesher<cgal_surface, 2>);

} // namespace mesher
} // namespace dovetail
