/// @file
/// The rounds of `coarse_surface`, whoever meshes a face.
#pragma once

#include "dovetail/background/coarse_surface.hpp"
#include "dovetail/background/surface_curvature.hpp"
#include "dovetail/background/surface_faces.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/geometry/error_of_faces.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/remesh/folds.hpp"
#include "dovetail/remesh/mesh_regions.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace dovetail::background {

namespace detail {

/// State of the rounds of `coarse_surface`.
template <geometry_model Geometry>
class coarse_surface_maker {
public:
  template <sizing_field Size>
  coarse_surface_maker(const Geometry& model, const Size& sizing, const coarse_surface_parameters& parameters,
                       const regions_mesher<Geometry>& mesh_them)
      : model_(model), parameters_(parameters), mesh_them_(mesh_them), topology_(model.topology()),
        given_([&sizing, largest = 0.25 * model.bounds().diagonal()](vec3 p) {
          return std::min(sizing(p), largest);
        }),
        bounds_(curvature_balls(model, given_, {parameters.turn, parameters.smallest_fraction})),
        curvature_(bounds_, parameters.growth), size_([this](vec3 p) { return curvature_(p, given_(p)); }) {
    faces_.count = topology_.faces.size();
    faces_.surface_of = [](const Geometry& own, std::size_t f) {
      return surface_of_face(own, static_cast<local_id>(f));
    };
  }

  coarse_surface_result run() {
    const stopwatch clock;
    for (int refinements = 0;; ++refinements) {
      coarse_surface_result result = make();
      const std::vector<size_ball> places =
          parameters_.finer_at ? parameters_.finer_at(result) : std::vector<size_ball>{};
      if (places.empty()) {
        auto counts = result.summary.as<coarse_surface_counts>();
        counts.refinement_rounds = refinements;
        result.summary.set(counts);
        result.summary.seconds = clock.seconds();
        return result;
      }
      append(bounds_, places);
      size_.refine(places);
    }
  }

private:
  using intervals = std::vector<std::array<local_id, 2>>; ///< of curves: curve, index of the interval

  /// At the sizes refined so far.
  coarse_surface_result make() {
    curves_ = space_curves(model_, size_.everywhere(), parameters_.turn, parameters_.smallest_fraction);
    regions_.assign(face_count(), {});
    folds_before_.clear();
    build_regions();
    int round = 0;
    do
      mesh();
    while (repair(++round >= parameters_.rounds));
    coarse_surface_result result{assemble(), bounds_, {}};
    result.summary.name = "coarse surface";
    summarise(result, round);
    return result;
  }

  std::size_t face_count() const { return topology_.faces.size(); }
  bool is_meshed(std::size_t f) const { return !meshed_.failures.contains(f) && meshes_[f].ok(); }

  /// New numbers of points change every face's labels.
  void build_regions() {
    origins_.clear();
    faces_.forbidden_edges.clear();
    for (std::size_t f = 0; f < face_count(); ++f) {
      face_patch patch = make_face_patch(model_, static_cast<local_id>(f), curves_);
      regions_[f].boundary = std::move(patch.boundary);
      regions_[f].face = static_cast<local_id>(f);
      regions_[f].reversed = topology_.faces[f].reversed;
      origins_.push_back(std::move(patch.origin));
    }
  }

  /// Chords that two faces share are forbidden only once every face is meshed: repairing others moves points
  /// of boundaries.
  void mesh() {
    const auto mesh_missing = [&](int chords) {
      meshed_ = mesh_them_(faces_, size_, made_,
                           {.attempts = {.chords = chords, .folds = 0},
                            .triangles_per_task = 512,
                            .on_progress = parameters_.on_progress,
                            .stage = "coarse surface"});
      meshes_.assign(face_count(), {});
      meshed_.for_each(made_, [&](std::size_t f, patch_mesh mesh) { meshes_[f] = std::move(mesh); });
    };
    mesh_missing(0);
    bool all = true;
    for (std::size_t f = 0; f < face_count(); ++f)
      all = all && is_meshed(f);
    if (all)
      mesh_missing(region_attempts{}.chords);
  }

  /// True when refinement multiplies the folds of a face, at once or in two rounds: then its surface is
  /// folded, not its mesh.
  bool gets_worse(std::size_t f) {
    auto& [first, second] = folds_before_[f];
    const std::size_t now = meshes_[f].folded.size();
    const bool multiplied = are_multiplied(first, now) || are_multiplied(second, now);
    first = std::exchange(second, now);
    return multiplied;
  }

  /// Refines where faces failed; false when there is nothing to do again. Throws on the last round.
  bool repair(bool last_round) {
    intervals halved;
    bool again = false;
    for (std::size_t f = 0; f < face_count(); ++f)
      if (!is_meshed(f)) {
        if (last_round || gets_worse(f))
          fail(f);
        refine_face(f, halved);
        again = true;
      }
    if (!again)
      if (const auto repeated = separate_repeated_triangles(halved); repeated && last_round)
        fail(*repeated);
    if (halved.empty())
      return again;
    halve_intervals(curves_, std::move(halved));
    curves_.number(topology_);
    build_regions();
    return true;
  }

  void refine_face(std::size_t f, intervals& halved) {
    const patch_mesh& mesh = meshes_[f];
    for (const auto& [a, b] : mesh.crossings)
      for (const local_id s : {a, b})
        halved.push_back(origins_[f][s]);
    for (const local_id s : mesh.misplaced)
      halved.push_back(origins_[f][s]);
    if (!mesh.crossings.empty() || !mesh.misplaced.empty())
      return;
    halve_at_folds(f, halved);
    regions_[f].size_factor *= 0.8;
  }

  /// Halves the boundary segments that touch a folded triangle: mostly two curves of a narrow face whose
  /// chords cross in space.
  void halve_at_folds(std::size_t f, intervals& halved) const {
    const patch_mesh& mesh = meshes_[f];
    std::set<local_id> touched;
    for (const local_id t : mesh.folded)
      touched.insert(mesh.triangles[t].begin(), mesh.triangles[t].end());
    for (std::size_t s = 0; s < origins_[f].size(); ++s) {
      const auto& [a, b] = regions_[f].boundary.segments[s];
      if (touched.contains(a) || touched.contains(b))
        halved.push_back(origins_[f][s]);
    }
  }

  /// Halves the curves of faces with a triangle between three points of curves that another one has as well;
  /// the first such face.
  std::optional<std::size_t> separate_repeated_triangles(intervals& halved) const {
    std::optional<std::size_t> first;
    std::set<simplex<2>> triangles;
    for (std::size_t f = 0; f < face_count(); ++f) {
      const auto& labels = regions_[f].boundary.labels;
      const auto frozen = static_cast<local_id>(labels.size());
      for (simplex<2> triangle : meshes_[f].triangles) {
        if (std::any_of(triangle.begin(), triangle.end(), [&](local_id v) { return v >= frozen; }))
          continue;
        for (local_id& v : triangle)
          v = labels[v];
        if (!triangles.insert(sorted_vertices(triangle)).second) {
          append(halved, origins_[f]);
          if (!first)
            first = f;
        }
      }
    }
    return first;
  }

  std::string name_of(std::size_t f) const { return entity_name("face", f, topology_.faces[f].name); }

  [[noreturn]] void fail(std::size_t f) const {
    const patch_mesh& mesh = meshes_[f];
    const std::vector<local_id> faces{static_cast<local_id>(f)};
    const std::string start = "the coarse surface mesh fails on " + name_of(f) + ": ";
    if (const auto failure = meshed_.failures.find(f); failure != meshed_.failures.end())
      throw error_of_faces<mesher_error>(start + failure->second, faces);
    if (!mesh.crossings.empty() || !mesh.misplaced.empty()) {
      const local_id s = mesh.crossings.empty() ? mesh.misplaced[0] : mesh.crossings[0][0];
      const local_id r = mesh.crossings.empty() ? s : mesh.crossings[0][1];
      throw error_of_faces<geometry_error>(
          start + "its boundary crosses itself in the parameter plane at curves " +
              std::to_string(origins_[f][s][0]) + " and " + std::to_string(origins_[f][r][0]) +
              ", also when refined; repair the face in the CAD system",
          faces);
    }
    if (!mesh.folded.empty())
      throw error_of_faces<mesher_error>(start + folded_triangles(mesh) +
                                             "; the face is nearly singular there, repair it or give a "
                                             "smaller size",
                                         faces);
    throw error_of_faces<mesher_error>(
        start + "it cannot be kept apart from its neighbours; give a smaller size", faces);
  }

  surface_mesh assemble() const {
    surface_mesh out;
    place_curve_points(out);
    for (std::size_t f = 0; f < face_count(); ++f) {
      append_region(regions_[f], meshes_[f], out.mesh.points,
                    [&](const simplex<2>& triangle, const std::array<vec2, 3>& uv) {
                      out.mesh.elements.push_back(triangle);
                      out.mesh.tags.push_back(static_cast<local_id>(f));
                      out.corner_uv.push_back(uv);
                    });
      out.vertex_hosts.resize(out.mesh.points.size(), host{2, static_cast<local_id>(f)});
    }
    return out;
  }

  void place_curve_points(surface_mesh& out) const {
    for (std::size_t v = 0; v < topology_.vertices.size(); ++v) {
      out.mesh.points.push_back(topology_.vertices[v].point);
      out.vertex_hosts.push_back({0, static_cast<local_id>(v)});
    }
    for (std::size_t c = 0; c < topology_.curves.size(); ++c) {
      if (topology_.curves[c].degenerate)
        continue;
      const auto id = static_cast<local_id>(c);
      const auto& t = curves_.t[c];
      for (std::size_t i = 1; i + 1 < t.size(); ++i) {
        out.mesh.points.push_back(model_.curve_point(id, t[i]));
        out.vertex_hosts.push_back({1, id});
      }
      for (std::size_t i = 0; i + 1 < t.size(); ++i)
        out.curve_edges.push_back(
            {{curves_.point_id(topology_, id, i), curves_.point_id(topology_, id, i + 1)},
             id,
             {t[i], t[i + 1]}});
    }
  }

  void summarise(coarse_surface_result& result, int rounds) const {
    double least = 60, angle_sum = 0;
    for (const simplex<2>& triangle : result.surface.mesh.elements) {
      const double angle = smallest_corner_angle(corners(span_of(result.surface.mesh.points), triangle));
      least = std::min(least, angle);
      angle_sum += angle;
    }
    const std::size_t triangles = result.surface.mesh.elements.size();
    result.summary.set(coarse_surface_counts{
        .triangles = triangles,
        .points = result.surface.mesh.points.size(),
        .min_angle_deg = least,
        .mean_min_angle_deg = triangles > 0 ? angle_sum / static_cast<double>(triangles) : 0,
        .rounds = rounds,
        .size_balls = bounds_.size()});
  }

  const Geometry& model_;
  const coarse_surface_parameters& parameters_;
  const regions_mesher<Geometry>& mesh_them_;
  const geometry_topology& topology_;
  any_sizing given_;              ///< the caller's field, never above a quarter of the model's diagonal
  std::vector<size_ball> bounds_; ///< of the curvature, and the places refined
  graded_balls curvature_;
  refined_sizing size_; ///< the given one, bounded by curvature, and the places refined
  curve_points curves_;
  std::vector<surface_region> regions_; ///< the faces
  region_set<Geometry> faces_{
      .count = 0, .build = [this](const Geometry&, std::size_t f) { return regions_[f]; }, .surface_of = {}};
  region_memo made_; ///< faces out of reach of what is refined stay
  meshed_regions meshed_;
  std::vector<patch_mesh> meshes_; ///< of the faces
  std::vector<intervals> origins_; ///< of the segments of each face
  std::map<std::size_t, std::array<std::size_t, 2>>
      folds_before_; ///< of a face, when it last failed, and before
};

template <geometry_model Geometry, sizing_field Size>
coarse_surface_result coarse_surface_by(const Geometry& model, const Size& sizing,
                                        const coarse_surface_parameters& parameters,
                                        const regions_mesher<Geometry>& mesh_them) {
  return coarse_surface_maker(model, sizing, parameters, mesh_them).run();
}

} // namespace detail

} // namespace dovetail::background
