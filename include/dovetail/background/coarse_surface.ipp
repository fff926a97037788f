/// @file
/// What `coarse_surface.hpp` declares.
#pragma once

#include "dovetail/background/coarse_surface.hpp"
#include "dovetail/background/surface_curvature.hpp"
#include "dovetail/background/surface_faces.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/remesh/repeated_edges.hpp"

#include <map>
#include <set>

namespace dovetail::background {

namespace detail {

/// State of the rounds of `coarse_surface`.
class coarse_surface_maker {
public:
  coarse_surface_maker(const any_geometry& model, const any_sizing& sizing,
                       const coarse_surface_parameters& parameters, const any_executor& run_tasks)
      : model_(model), parameters_(parameters), run_tasks_(run_tasks), topology_(model.topology()),
        given_([&sizing, largest = 0.25 * model.bounds().diagonal()](vec3 p) {
          return std::min(sizing(p), largest);
        }),
        bounds_(all_balls(model, given_, parameters)), balls_(bounds_, parameters.growth),
        size_([this](vec3 p) { return balls_(p, given_(p)); }) {}

  coarse_surface_result run() {
    const stopwatch clock;
    curves_ = space_curves(model_, size_, parameters_.turn, parameters_.smallest_fraction);
    const auto face_count = static_cast<local_id>(topology_.faces.size());
    meshes_.resize(topology_.faces.size());
    requests_.resize(topology_.faces.size());
    std::set<local_id> pending;
    for (local_id f = 0; f < face_count; ++f) {
      requests_[at(f)].face = f;
      pending.insert(f);
    }
    int round = 0;
    for (; !pending.empty(); ++round) {
      mesh(pending);
      pending = repair(pending, round + 1 >= parameters_.rounds);
    }
    coarse_surface_result result{assemble(), std::move(bounds_), {}};
    result.summary.name = "coarse surface";
    summarise(result, round);
    result.summary.seconds = clock.seconds();
    return result;
  }

private:
  static constexpr std::size_t at(local_id i) { return static_cast<std::size_t>(i); }

  static std::vector<size_ball> all_balls(const any_geometry& model, const any_sizing& sizing,
                                          const coarse_surface_parameters& parameters) {
    std::vector<size_ball> balls =
        curvature_balls(model, sizing, {parameters.turn, parameters.smallest_fraction});
    append(balls, parameters.refinement);
    return balls;
  }

  void mesh(const std::set<local_id>& pending) {
    std::vector<face_request> batch;
    for (const local_id f : pending)
      batch.push_back(requests_[at(f)]);
    std::vector<face_result> results = remesh_faces(model_, std::span<const face_request>(batch), curves_,
                                                    size_, parameters_.remesher, run_tasks_);
    for (std::size_t i = 0; i < batch.size(); ++i)
      meshes_[at(batch[i].face)] = std::move(results[i]);
  }

  /// True when refinement multiplies the folds of a face: then its surface is folded, not its mesh.
  bool gets_worse(local_id f) {
    std::size_t& before = folds_before_[f];
    const std::size_t now = meshes_[at(f)].mesh.folded.size();
    const bool worse = before > 0 && now > 3 * before + 20;
    before = now;
    return worse;
  }

  /// Refines where faces failed and returns the faces to do again. Throws on the last round.
  std::set<local_id> repair(const std::set<local_id>& meshed, bool last_round) {
    std::vector<std::array<local_id, 2>> intervals;
    std::set<local_id> again;
    for (const local_id f : meshed)
      if (!meshes_[at(f)].failure.empty() || !meshes_[at(f)].mesh.ok()) {
        if (last_round || gets_worse(f))
          fail(f);
        refine_face(f, intervals);
        again.insert(f);
      }
    if (again.empty())
      again = forbid_shared_edges(intervals, last_round);
    if (!intervals.empty()) {
      std::set<local_id> changed;
      for (const auto& interval : intervals)
        changed.insert(interval[0]);
      halve_intervals(curves_, std::move(intervals));
      curves_.number(topology_);
      // New numbers change every face's labels, but only faces at changed curves have a new boundary.
      for (face_request& request : requests_)
        request.forbidden_edges.clear();
      for (std::size_t f = 0; f < topology_.faces.size(); ++f)
        for (const auto& coedge : topology_.faces[f].coedges)
          if (changed.contains(coedge.curve))
            again.insert(static_cast<local_id>(f));
    }
    return again;
  }

  void refine_face(local_id f, std::vector<std::array<local_id, 2>>& intervals) {
    const patch_mesh& mesh = meshes_[at(f)].mesh;
    const face_patch patch = make_face_patch(model_, f, curves_);
    for (const auto& [a, b] : mesh.crossings)
      for (const local_id s : {a, b})
        intervals.push_back(patch.origin[at(s)]);
    for (const local_id s : mesh.misplaced)
      intervals.push_back(patch.origin[at(s)]);
    if (!mesh.crossings.empty() || !mesh.misplaced.empty())
      return;
    halve_at_folds(mesh, patch, intervals);
    requests_[at(f)].size_factor *= 0.8;
  }

  /// Halves the boundary segments that touch a folded triangle: mostly two curves of a narrow face whose
  /// chords cross in space.
  static void halve_at_folds(const patch_mesh& mesh, const face_patch& patch,
                             std::vector<std::array<local_id, 2>>& intervals) {
    std::set<local_id> touched;
    for (const local_id t : mesh.folded)
      touched.insert(mesh.triangles[at(t)].begin(), mesh.triangles[at(t)].end());
    for (std::size_t s = 0; s < patch.origin.size(); ++s) {
      const auto& [a, b] = patch.boundary.segments[s];
      if (touched.contains(a) || touched.contains(b))
        intervals.push_back(patch.origin[s]);
    }
  }

  /// Finds inner edges of different faces that join the same two surface points, and triangles that occur
  /// twice. All faces but one are told to avoid such an edge; a repeated triangle refines its curves.
  std::set<local_id> forbid_shared_edges(std::vector<std::array<local_id, 2>>& intervals, bool last_round) {
    std::map<std::array<local_id, 2>, local_id> owner;
    std::map<std::array<local_id, 3>, local_id> triangles;
    std::set<std::array<local_id, 2>> on_curves;
    std::vector<face_patch> patches;
    for (std::size_t f = 0; f < topology_.faces.size(); ++f) {
      patches.push_back(make_face_patch(model_, static_cast<local_id>(f), curves_));
      const patch_boundary& b = patches.back().boundary;
      for (const auto& [p, q] : b.segments)
        on_curves.insert(dovetail::detail::ordered(b.labels[at(p)], b.labels[at(q)]));
    }
    std::set<local_id> again;
    for (std::size_t f = 0; f < topology_.faces.size(); ++f) {
      const auto face = static_cast<local_id>(f);
      const auto& labels = patches[f].boundary.labels;
      const auto frozen = static_cast<local_id>(labels.size());
      for (const simplex<2>& triangle : meshes_[f].mesh.triangles) {
        std::array<local_id, 3> named{};
        int on_boundary = 0;
        for (std::size_t i = 0; i < 3; ++i)
          if (triangle[i] < frozen) {
            named[i] = labels[at(triangle[i])];
            ++on_boundary;
          }
        for (std::size_t i = 0; i < 3; ++i) {
          const std::size_t j = (i + 1) % 3;
          if (triangle[i] >= frozen || triangle[j] >= frozen)
            continue;
          const auto pair = dovetail::detail::ordered(named[i], named[j]);
          if (on_curves.contains(pair)) {
            if (!is_segment(patches[f], pair)) {
              requests_[f].forbidden_edges.push_back(pair);
              again.insert(face);
            }
            continue;
          }
          const auto [entry, fresh] = owner.try_emplace(pair, face);
          if (!fresh && entry->second != face) {
            requests_[f].forbidden_edges.push_back(pair);
            again.insert(face);
          }
        }
        if (on_boundary == 3) {
          sort_all(named);
          if (!triangles.try_emplace(named, face).second)
            for (const auto& origin : patches[f].origin)
              intervals.push_back(origin);
        }
      }
    }
    if (last_round && !(again.empty() && intervals.empty()))
      fail(again.empty() ? 0 : *again.begin());
    return again;
  }

  static bool is_segment(const face_patch& patch, const std::array<local_id, 2>& pair) {
    const patch_boundary& b = patch.boundary;
    return std::any_of(b.segments.begin(), b.segments.end(), [&](const auto& s) {
      return dovetail::detail::ordered(b.labels[at(s[0])], b.labels[at(s[1])]) == pair;
    });
  }

  std::string name_of(local_id f) const {
    const std::string& name = topology_.faces[at(f)].name;
    return "face " + std::to_string(f) + (name.empty() ? "" : " (" + name + ")");
  }

  [[noreturn]] void fail(local_id f) const {
    const face_result& result = meshes_[at(f)];
    const std::string start = "the coarse surface mesh fails on " + name_of(f) + ": ";
    if (!result.failure.empty())
      throw mesher_error(start + result.failure);
    if (!result.mesh.crossings.empty() || !result.mesh.misplaced.empty()) {
      const face_patch patch = make_face_patch(model_, f, curves_);
      const local_id s =
          result.mesh.crossings.empty() ? result.mesh.misplaced[0] : result.mesh.crossings[0][0];
      const local_id r = result.mesh.crossings.empty() ? s : result.mesh.crossings[0][1];
      throw geometry_error(start + "its boundary crosses itself in the parameter plane at curves " +
                           std::to_string(patch.origin[at(s)][0]) + " and " +
                           std::to_string(patch.origin[at(r)][0]) +
                           ", also when refined; repair the face in the CAD system");
    }
    if (!result.mesh.folded.empty())
      throw mesher_error(start + std::to_string(result.mesh.folded.size()) +
                         " triangles stay folded over; the face is nearly singular there, repair it or give "
                         "a smaller size");
    throw mesher_error(start + "it cannot be kept apart from its neighbours; give a smaller size");
  }

  surface_mesh assemble() const {
    surface_mesh out;
    place_curve_points(out);
    for (std::size_t f = 0; f < topology_.faces.size(); ++f)
      append_face(static_cast<local_id>(f), out);
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

  void append_face(local_id f, surface_mesh& out) const {
    const patch_boundary b = make_face_patch(model_, f, curves_).boundary;
    const patch_mesh& mesh = meshes_[at(f)].mesh;
    const auto frozen = static_cast<local_id>(b.uv.size());
    const auto first_inner = static_cast<local_id>(out.mesh.points.size());
    append(out.mesh.points, mesh.inner_points);
    out.vertex_hosts.resize(out.mesh.points.size(), host{2, f});
    for (simplex<2> triangle : mesh.triangles) {
      if (topology_.faces[at(f)].reversed)
        std::swap(triangle[1], triangle[2]);
      std::array<vec2, 3> uv;
      for (std::size_t i = 0; i < 3; ++i) {
        const local_id v = triangle[i];
        uv[i] = v < frozen ? b.uv[at(v)] : mesh.inner_uv[at(v - frozen)];
        triangle[i] = v < frozen ? b.labels[at(v)] : first_inner + v - frozen;
      }
      out.mesh.elements.push_back(triangle);
      out.mesh.tags.push_back(f);
      out.corner_uv.push_back(uv);
    }
  }

  void summarise(coarse_surface_result& result, int rounds) const {
    double least = 60, angle_sum = 0;
    for (const face_result& face : meshes_) {
      least = std::min(least, face.mesh.summary.get("min_angle_deg", 60));
      angle_sum += face.mesh.summary.get("mean_min_angle_deg") * face.mesh.summary.get("triangles");
    }
    const auto triangles = static_cast<double>(result.surface.mesh.elements.size());
    result.summary.set("triangles", triangles);
    result.summary.set("points", static_cast<double>(result.surface.mesh.points.size()));
    result.summary.set("min_angle_deg", least);
    result.summary.set("mean_min_angle_deg", triangles > 0 ? angle_sum / triangles : 0);
    result.summary.set("rounds", rounds);
    result.summary.set("size_balls", static_cast<double>(balls_.size()));
  }

  const any_geometry& model_;
  const coarse_surface_parameters& parameters_;
  const any_executor& run_tasks_;
  const geometry_topology& topology_;
  any_sizing given_; ///< the caller's field, never above a quarter of the model's diagonal
  std::vector<size_ball> bounds_;
  graded_balls balls_;
  any_sizing size_;
  curve_points curves_;
  std::vector<face_request> requests_;
  std::vector<face_result> meshes_;
  std::map<local_id, std::size_t> folds_before_;
};

} // namespace detail

DOVETAIL_INLINE coarse_surface_result coarse_surface(const any_geometry& model, const any_sizing& sizing,
                                                     const coarse_surface_parameters& parameters,
                                                     const any_executor& run_tasks) {
  return detail::coarse_surface_maker(model, sizing, parameters, run_tasks).run();
}

} // namespace dovetail::background
