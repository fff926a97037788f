/// @file
/// TetGen 1.5 through its library: Delaunay refinement that keeps the given boundary.
/// TetGen is licensed under the AGPL; a program that includes this file and links it is bound by that.
#pragma once

#include "dovetail/adapters/call_budget.hpp"
#include "dovetail/adapters/tetgen_library.hpp"
#include "dovetail/adapters/void_points.hpp"
#include "dovetail/mesher/boundary_sides.hpp"
#include "dovetail/mesher/checks.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/mesher/element_labels.hpp"
#include "dovetail/sizing/checked_size.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <new>
#include <string>
#include <vector>

namespace dovetail::mesher {

/// A model of `boundary_keeping_mesher<3>`.
///
/// An element is split while the root mean square of its six edges exceeds 1.18 h at its centroid. On a
/// uniform field that gives a mean edge of h within 0.5 %, and 11.6 elements per h^3 (measured on cubes and
/// spheres of 0.06 to 7 million elements). The field is asked once per candidate element, 1.33 times per
/// element made. It is sampled at centroids only, so a field must vary slowly against its own value
/// (gradation of 0.5 or less) for every detail of it to be met.
struct tetgen {
  static constexpr mesher_traits traits{.keeps_boundary = true,
                                        .thread_safe = false, // static filters are process-wide globals
                                        .accepts_non_manifold = true,
                                        .repeats_in_process = true,
                                        .may_crash = true}; // on a self-intersecting boundary
  /// Elements made per unit of the integral of h^-3.
  static constexpr double elements_per_inverse_cubed_size = 11.6;

  double radius_edge_ratio = 2.0;       ///< upper bound, `-q`; TetGen may not end below 1.2
  double min_dihedral_deg = 0.0;        ///< lower bound asked of refinement, `-q/`; 0 to 18 is sensible
  int optimisation_level = 2;           ///< `-O`, 0 to 10: how far flips and smoothing go at the end
  double coplanarity_tolerance = 1e-8;  ///< `-T`, relative
  bool merge_coplanar_triangles = true; ///< false is `-M`: each triangle is a facet of its own
  bool use_hole_points = true;          ///< carve voids before refinement rather than after it
  double size_scale = 1.0;              ///< multiplies the field
  double call_budget_factor = 20.0;     ///< watchdog: sizing calls allowed per predicted element

  /// Meshes the inside of `input.boundary`. Throws `mesher_error` when TetGen fails, does not end, or its
  /// result fails the checks; `sizing_error` when the field gives an unusable size.
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const;

  /// With a bound of 1.4 hardly an angle of 30 degrees is missing away from the surface, for two thirds more
  /// elements.
  tetgen for_background() const {
    tetgen form = *this;
    form.radius_edge_ratio = std::min(radius_edge_ratio, 1.4);
    return form;
  }

  /// What to try, in this order, on a piece that failed.
  std::vector<tetgen> fallbacks() const {
    tetgen uncarved = *this; // a hole point too close to the boundary
    uncarved.use_hole_points = false;
    tetgen separate = *this; // nearly coplanar triangles that were merged into one facet
    separate.merge_coplanar_triangles = false;
    separate.coplanarity_tolerance = 1e-12;
    tetgen coarse_tolerance = separate; // nearly touching triangles
    coarse_tolerance.coplanarity_tolerance = 1e-6;
    tetgen relaxed = separate; // refinement that does not end at small angles, or an optimiser's failure
    relaxed.radius_edge_ratio = 10;
    relaxed.min_dihedral_deg = 0;
    relaxed.optimisation_level = 0;
    return {uncarved, separate, coarse_tolerance, relaxed};
  }
};

} // namespace dovetail::mesher

namespace dovetail::detail {

/// What TetGen's sizing callback works with while this object lives. The callback has no user pointer, hence
/// the thread_local. Exceptions pass through TetGen, whose objects live on its callers' stacks.
class tetgen_sizing {
public:
  tetgen_sizing(const any_sizing& size, double scale, std::size_t budget)
      : size_(size), scale_(scale), budget_(budget) {
    current = this;
  }
  ~tetgen_sizing() { current = nullptr; }
  tetgen_sizing(const tetgen_sizing&) = delete;
  tetgen_sizing& operator=(const tetgen_sizing&) = delete;

  std::size_t calls() const { return calls_; }

  /// TetGen's signature: the four corners, and two arguments that it leaves empty.
  static bool unsuitable(double* a, double* b, double* c, double* d, double*, double) {
    const auto point = [](const double* p) { return vec3{p[0], p[1], p[2]}; };
    return current->too_large(point(a), point(b), point(c), point(d));
  }

private:
  bool too_large(vec3 a, vec3 b, vec3 c, vec3 d) {
    if (++calls_ > budget_)
      throw mesher_error("TetGen refines without end: more than " + std::to_string(budget_) +
                         " size evaluations; make the boundary finer or the field smoother");
    constexpr double calibration = 1.18;
    const double h = calibration * scale_ * checked_size(size_, 0.25 * (a + b + c + d));
    const double squares = norm_squared(b - a) + norm_squared(c - a) + norm_squared(d - a) +
                           norm_squared(c - b) + norm_squared(d - b) + norm_squared(d - c);
    return squares > 6 * h * h;
  }

  inline static thread_local tetgen_sizing* current = nullptr;
  const any_sizing& size_;
  double scale_;
  std::size_t budget_;
  std::size_t calls_ = 0;
};

/// TetGen's input, held in three flat arrays instead of one allocation per triangle.
class tetgen_input {
public:
  tetgen_input(const simplicial_mesh<2>& boundary, const std::vector<vec3>& holes)
      : coordinates_(flat(boundary.points)), holes_(flat(holes)) {
    const boundary_sides sides(boundary.elements); // lists a two-sided triangle once
    for (std::size_t t = 0; t < boundary.elements.size(); ++t) {
      const auto match = sides.find(boundary.elements[t]);
      const auto& listed = sides.entries()[match.entry].listed;
      if (listed[0] == no_id || listed[1] == no_id ||
          std::min(listed[0], listed[1]) == static_cast<local_id>(t))
        corners_.insert(corners_.end(), boundary.elements[t].begin(), boundary.elements[t].end());
    }
    polygons_.resize(corners_.size() / 3);
    facets_.resize(polygons_.size());
    for (std::size_t t = 0; t < polygons_.size(); ++t) {
      polygons_[t] = {&corners_[3 * t], 3};
      facets_[t] = {&polygons_[t], 1, nullptr, 0};
    }
    io_.pointlist = coordinates_.data();
    io_.numberofpoints = static_cast<int>(boundary.points.size());
    io_.facetlist = facets_.data();
    io_.numberoffacets = static_cast<int>(facets_.size());
    io_.holelist = holes_.empty() ? nullptr : holes_.data();
    io_.numberofholes = static_cast<int>(holes.size());
    io_.tetunsuitable = tetgen_sizing::unsuitable;
  }
  ~tetgen_input() { io_.initialize(); } // forget the borrowed arrays: tetgenio would delete[] them
  tetgen_input(const tetgen_input&) = delete;
  tetgen_input& operator=(const tetgen_input&) = delete;

  tetgenio& io() { return io_; }

private:
  static std::vector<double> flat(const std::vector<vec3>& points) {
    std::vector<double> coordinates;
    coordinates.reserve(3 * points.size());
    for (const vec3 p : points)
      coordinates.insert(coordinates.end(), {p.x, p.y, p.z});
    return coordinates;
  }
  std::vector<double> coordinates_;
  std::vector<double> holes_;
  std::vector<int> corners_;
  std::vector<tetgenio::polygon> polygons_;
  std::vector<tetgenio::facet> facets_;
  tetgenio io_;
};

/// p: boundary given; Y: kept; q: shape bounds; O, T, M: see `mesher::tetgen`; F: no face list; Q: quiet.
inline std::string tetgen_switches(const mesher::tetgen& p) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "pYq%g/%gO%d/7T%g%sFQ", p.radius_edge_ratio, p.min_dihedral_deg,
                p.optimisation_level, p.coplanarity_tolerance, p.merge_coplanar_triangles ? "" : "M");
  return text.data();
}

/// What the number means that TetGen throws (its `terminatetetgen`).
inline std::string tetgen_failure(int code) {
  switch (code) {
  case 1:
    return "TetGen ran out of memory";
  case 2:
    return "TetGen met an internal error";
  case 3:
    return "TetGen found that the boundary intersects itself";
  case 4:
    return "TetGen found an input feature too small for its tolerance";
  case 5:
    return "TetGen found two boundary triangles too close to each other";
  case 10:
    return "TetGen could not read the boundary";
  default:
    return "TetGen failed with code " + std::to_string(code);
  }
}

inline void run_tetgen(const std::string& switches, tetgenio& in, tetgenio& out) {
  tetgen_function* const run = tetgen_entry();
  try {
    std::string writable = switches;
    run(writable.data(), &in, &out, nullptr, nullptr);
  } catch (int code) {
    throw mesher_error(tetgen_failure(code) + " (switches " + switches + ")");
  } catch (const std::bad_alloc&) {
    throw mesher_error(tetgen_failure(1));
  }
}

/// TetGen 1.5 lists tetrahedra with positive orientation; the checks after meshing would notice others.
inline simplicial_mesh<3> from_tetgen(const tetgenio& out) {
  simplicial_mesh<3> mesh;
  mesh.points.resize(static_cast<std::size_t>(out.numberofpoints));
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    mesh.points[v] = {out.pointlist[3 * v], out.pointlist[3 * v + 1], out.pointlist[3 * v + 2]};
  mesh.elements.resize(static_cast<std::size_t>(out.numberoftetrahedra));
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const int* corners = out.tetrahedronlist + 4 * e;
    mesh.elements[e] = {corners[0], corners[1], corners[2], corners[3]};
  }
  return mesh;
}

} // namespace dovetail::detail

namespace dovetail::mesher {

inline mesher_result<3> tetgen::operator()(const mesher_input<3>& input, const any_sizing& size) const {
  const stopwatch clock;
  require_meshable(input.boundary);
  const double elements = elements_per_inverse_cubed_size / (size_scale * size_scale * size_scale);
  detail::tetgen_sizing sizing(size, size_scale,
                               sizing_call_budget(input.boundary, size, elements, call_budget_factor));
  tetgenio out;
  {
    detail::tetgen_input in(input.boundary,
                            use_hole_points ? points_in_voids(input.boundary) : std::vector<vec3>{});
    detail::run_tetgen(detail::tetgen_switches(*this), in.io(), out);
  } // frees the input's arrays before the result is copied
  mesher_result<3> result;
  result.mesh = detail::from_tetgen(out);
  drop_outside(result.mesh, label_elements(result.mesh, input.boundary.elements),
               input.boundary.points.size());
  result.mesh.tags.assign(result.mesh.elements.size(), input.material);
  check_mesher_result(input, result.mesh);
  result.summary.name = "tetgen";
  result.summary.seconds = clock.seconds();
  result.summary.set(mesher_counts{result.mesh.elements.size(), result.mesh.points.size(), sizing.calls()});
  return result;
}

static_assert(boundary_keeping_mesher<tetgen, 3>);

} // namespace dovetail::mesher
