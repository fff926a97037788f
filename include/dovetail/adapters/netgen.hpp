/// @file
/// Netgen 6.2 through nglib: advancing front and Delaunay meshing that keeps the given surface.
/// Netgen is licensed under the LGPL.
#pragma once

#include "dovetail/adapters/call_budget.hpp"
#include "dovetail/adapters/given_points_first.hpp"
#include "dovetail/core/octree.hpp"
#include "dovetail/distributed/run_in_child.hpp"
#include "dovetail/mesher/boundary_sides.hpp"
#include "dovetail/mesher/checks.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/mesher/shells.hpp"
#include "dovetail/sizing/checked_size.hpp"

namespace nglib {
#include <nglib.h>
}

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::mesher {

/// A model of `boundary_keeping_mesher<3>`.
///
/// Netgen has no sizing callback. Its own octree of sizes is filled from a sample of the field: boxes are
/// split until they are smaller than `sample_spacing` times the field inside them, and each gives its size at
/// its middle. Detail of the field below that spacing is missed.
///
/// That octree takes a size only where its own is more than 1.2 times larger, so Netgen cannot be calibrated
/// to 5 %: the mean edge on uniform fields came out between 0.91 and 1.10 of the size (cubes and spheres of
/// 8,000 to 70,000 elements).
///
/// nglib works with globals and prints: each call runs in a child process of its own, with its standard
/// streams closed. The calling process must have one thread only (`usage_error` otherwise).
struct netgen {
  static constexpr mesher_traits traits{.keeps_boundary = true,
                                        .thread_safe = false,
                                        .accepts_non_manifold = false,
                                        .repeats_in_process = true, // each call has a process of its own
                                        .may_crash = false};

  /// Elements made per unit of the integral of h^-3.
  static constexpr double elements_per_inverse_cubed_size = 10;
  /// What Netgen is told over the size wanted, for a mean edge of h on uniform fields.
  static constexpr double calibration = 0.92;

  int optimisation_steps = 1;  ///< rounds of Netgen's own optimiser; 0 leaves flat elements
  double sample_spacing = 1.0; ///< largest box of the sample, over the size in it
  double size_scale = 1.0;     ///< multiplies the field
  double limit_seconds = 3600; ///< the child's wall clock; the last resort

  /// Meshes the inside of `input.boundary`. Throws `mesher_error` when Netgen fails or its result fails the
  /// checks; `sizing_error` when the field gives an unusable size.
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const;
};

} // namespace dovetail::mesher

namespace dovetail::detail {

/// One use of nglib, in a process that ends right after it.
class netgen_session {
public:
  netgen_session(const mesher::netgen& parameters, const any_sizing& size)
      : parameters_(parameters), size_(size), mesh_((nglib::Ng_Init(), nglib::Ng_NewMesh())) {}

  /// What Netgen made: its points and elements.
  simplicial_mesh<3> mesh(const simplicial_mesh<2>& boundary) {
    add_boundary(boundary);
    add_sizes();
    nglib::Ng_Meshing_Parameters options;
    options.uselocalh = 1;
    options.maxh = largest_;
    options.minh = 0;
    options.optsteps_3d = parameters_.optimisation_steps;
    options.optvolmeshenable = parameters_.optimisation_steps > 0 ? 1 : 0;
    options.check_overlap = 0;
    options.check_overlapping_boundary = 1; // else Netgen does not end on a crossing
    const nglib::Ng_Result outcome = nglib::Ng_GenerateVolumeMesh(mesh_, &options);
    if (outcome != nglib::NG_OK)
      throw mesher_error("nglib returned " + std::to_string(outcome));
    return result();
  }

private:
  void add_boundary(const simplicial_mesh<2>& boundary) {
    for (const vec3 p : boundary.points) {
      std::array<double, 3> x{p.x, p.y, p.z};
      nglib::Ng_AddPoint(mesh_, x.data());
      box_.include(p);
    }
    for (const auto& t : boundary.elements) {
      std::array<int, 3> corners{t[0] + 1, t[1] + 1, t[2] + 1};
      nglib::Ng_AddSurfaceElement(mesh_, nglib::NG_TRIG, corners.data());
    }
  }

  /// Samples the field in an octree over the box, depth first: the order matters to Netgen.
  void add_sizes() {
    descend_octants(box_, [&](const box3& box, int depth) {
      const vec3 center = box.center();
      const double h = mesher::netgen::calibration * parameters_.size_scale * checked_size(size_, center);
      const vec3 extent = box.upper - box.lower;
      if (std::max({extent.x, extent.y, extent.z}) > parameters_.sample_spacing * h && depth < 12)
        return true;
      samples_.push_back({center, h});
      largest_ = std::max(largest_, h);
      return false;
    });
    nglib::Ng_RestrictMeshSizeGlobal(mesh_, largest_);
    for (const auto& [p, h] : samples_) {
      std::array<double, 3> x{p.x, p.y, p.z};
      nglib::Ng_RestrictMeshSizePoint(mesh_, x.data(), h);
    }
  }

  simplicial_mesh<3> result() const {
    simplicial_mesh<3> mesh;
    for (int v = 1; v <= nglib::Ng_GetNP(mesh_); ++v) {
      std::array<double, 3> x{};
      nglib::Ng_GetPoint(mesh_, v, x.data());
      mesh.points.push_back({x[0], x[1], x[2]});
    }
    for (int e = 1; e <= nglib::Ng_GetNE(mesh_); ++e) {
      std::array<int, 10> corners{};
      nglib::Ng_GetVolumeElement(mesh_, e, corners.data());
      mesh.elements.push_back({corners[0] - 1, corners[2] - 1, corners[1] - 1, corners[3] - 1});
    }
    return mesh;
  }

  const mesher::netgen& parameters_;
  const any_sizing& size_;
  nglib::Ng_Mesh* mesh_; // the process ends before anyone could miss its memory
  box3 box_;
  double largest_ = 0;
  std::vector<std::pair<vec3, double>> samples_;
};

/// Runs in the child, whose standard streams the worker has silenced. Netgen orders work by addresses, hence
/// the fresh memory.
inline simplicial_mesh<3> run_netgen(const mesher::netgen& parameters, const simplicial_mesh<2>& boundary,
                                     const any_sizing& size) {
  try {
    return netgen_session(parameters, size).mesh(boundary);
  } catch (const error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (...) { // Netgen has exceptions of its own
    throw mesher_error("Netgen threw an exception");
  }
}

} // namespace dovetail::detail

namespace dovetail::mesher {

inline mesher_result<3> netgen::operator()(const mesher_input<3>& input, const any_sizing& size) const {
  const stopwatch clock;
  require_meshable(input.boundary);
  const boundary_sides sides(input.boundary.elements);
  if (sides.entries().size() != input.boundary.elements.size())
    throw mesher_error("Netgen does not take triangles that have elements on both sides; use TetGen");
  bodies_of(input.boundary); // throws on wrong orientation, where Netgen would not end
  auto made =
      run_in_child("Netgen", limit_seconds, [&] { return detail::run_netgen(*this, input.boundary, size); });
  mesher_result<3> result;
  result.mesh = with_given_points_first(input.boundary.points, made.points, std::move(made.elements));
  result.mesh.tags.assign(result.mesh.elements.size(), input.material);
  check_mesher_result(input, result.mesh);
  result.summary.name = "netgen";
  result.summary.seconds = clock.seconds();
  result.summary.set(mesher_counts{result.mesh.elements.size(), result.mesh.points.size()});
  return result;
}

static_assert(boundary_keeping_mesher<netgen, 3>);

} // namespace dovetail::mesher
