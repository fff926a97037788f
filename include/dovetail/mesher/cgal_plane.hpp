/// @file
/// Plane pieces by CGAL's constrained Delaunay triangulation. CGAL's own `Delaunay_mesher_2` splits
/// constrained edges, so neighbouring pieces would not match: here the triangulation is the kernel only, and
/// all points that are inserted lie inside.
#pragma once

#include "dovetail/mesher/region_assembly.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <cmath>
#include <string>
#include <vector>

namespace dovetail {

namespace detail {

/// The triangulation of one region while points are inserted.
class plane_triangulation {
public:
  plane_triangulation(const remesh::plane_surface& plane, const patch_boundary& boundary,
                      const any_sizing& size)
      : plane_(plane), boundary_(boundary), size_(size) {}

  /// Inserts points on edges that are too long, in rounds, until there are none.
  patch_mesh run(int most_rounds, double nearest) {
    insert_boundary();
    for (int round = 0; round < most_rounds; ++round)
      if (mark_domain(); insert_on_long_edges(nearest) == 0)
        break;
    mark_domain();
    return result();
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
  double size_at(vec2 uv) const { return size_(plane_.frame(uv).point); }

  void insert_boundary() {
    std::vector<vertex> at(boundary_.uv.size());
    face hint;
    for (std::size_t v = 0; v < at.size(); ++v) {
      const std::size_t before = mesh_.number_of_vertices();
      at[v] = mesh_.insert(point(boundary_.uv[v].x, boundary_.uv[v].y), hint);
      if (mesh_.number_of_vertices() > before) // else a slit passes here again
        at[v]->info() = static_cast<local_id>(v);
      hint = at[v]->face();
    }
    for (const auto& [a, b] : boundary_.segments) {
      const vertex from = at[static_cast<std::size_t>(a)], to = at[static_cast<std::size_t>(b)];
      try {
        mesh_.insert_constraint(from, to);
      } catch (const triangulation::Intersection_of_constraints_exception&) {
        throw mesher_error("a region's boundary lines cross near (" + std::to_string(from->point().x()) +
                           ", " + std::to_string(from->point().y()) + ")");
      }
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

  struct candidate {
    vec2 at;
    double size;
  };

  /// Points along the edges inside, spaced by the field; those too near to others are left out.
  std::size_t insert_on_long_edges(double nearest) {
    std::vector<candidate> candidates;
    for (const auto& edge : mesh_.finite_edges())
      if (edge.first->info() && !edge.first->is_constrained(edge.second))
        divide(of(edge.first->vertex(triangulation::ccw(edge.second))->point()),
               of(edge.first->vertex(triangulation::cw(edge.second))->point()), candidates);
    std::size_t inserted = 0;
    face hint;
    for (const candidate& c : candidates) {
      const face f = mesh_.locate(point(c.at.x, c.at.y), hint);
      hint = f;
      if (mesh_.is_infinite(f) || is_near(f, c.at, nearest * c.size))
        continue;
      const vertex v = mesh_.insert(point(c.at.x, c.at.y), f);
      v->info() = static_cast<local_id>(boundary_.uv.size() + inner_.size());
      inner_.push_back(c.at);
      hint = v->face();
      ++inserted;
    }
    return inserted;
  }

  void divide(vec2 a, vec2 b, std::vector<candidate>& candidates) const {
    const double h = size_at(0.5 * (a + b));
    const auto parts = static_cast<int>(std::lround(std::min(norm(b - a) / h, 1e6)));
    for (int i = 1; i < parts; ++i) {
      const double s = static_cast<double>(i) / parts;
      const vec2 p = (1 - s) * a + s * b;
      candidates.push_back({p, size_at(p)});
    }
  }

  bool is_near(face f, vec2 p, double reach) const {
    for (int i = 0; i < 3; ++i) {
      if (norm(of(f->vertex(i)->point()) - p) < reach)
        return true;
      const vertex across = mesh_.mirror_vertex(f, i);
      if (!mesh_.is_infinite(across) && norm(of(across->point()) - p) < reach)
        return true;
    }
    return false;
  }

  patch_mesh result() const {
    patch_mesh made;
    made.inner_uv = inner_;
    for (const vec2 uv : inner_)
      made.inner_points.push_back(plane_.frame(uv).point);
    for (const face f : mesh_.finite_face_handles())
      if (f->info())
        made.triangles.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
    return made;
  }

  const remesh::plane_surface& plane_;
  const patch_boundary& boundary_;
  const any_sizing& size_;
  triangulation mesh_;
  std::vector<std::pair<vertex, vertex>> starts_; ///< the segments
  std::vector<vec2> inner_;
};

} // namespace detail

namespace mesher {

/// Fills plane regions with Delaunay triangles of the size asked for; their shapes are left to the improver.
struct cgal_plane {
  static constexpr mesher_traits traits{.keeps_boundary = true,
                                        .thread_safe = true,
                                        .accepts_non_manifold = true,
                                        .repeats_in_process = true,
                                        .may_crash = false};

  double nearest = 0.75; ///< new points keep this distance from others, times the size
  int rounds = 40;       ///< rounds of insertion at most

  /// About n log n in the triangles made. Throws `mesher_error` for a face that is not known to be a plane.
  mesher_result<2> operator()(const mesher_input<2>& input, const any_sizing& size) const {
    const stopwatch clock;
    auto result = assemble_regions(input, [&](const any_surface& surface, const patch_boundary& boundary) {
      if (!surface.plane)
        throw mesher_error("this mesher takes plane domains only; use the native one for CAD surfaces");
      return dovetail::detail::plane_triangulation(*surface.plane, boundary, size).run(rounds, nearest);
    });
    result.summary.seconds = clock.seconds();
    return result;
  }
};
static_assert(boundary_keeping_mesher<cgal_plane, 2>);

} // namespace mesher
} // namespace dovetail
