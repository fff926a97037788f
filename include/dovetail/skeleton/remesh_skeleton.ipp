/// @file
/// What `remesh_skeleton.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/parallel/task_model.hpp"
#include "dovetail/remesh/chords.hpp"
#include "dovetail/remesh/patch_remesher.hpp"
#include "dovetail/skeleton/patches.hpp"
#include "dovetail/skeleton/remesh_skeleton.hpp"

#include <numeric>
#include <set>

namespace dovetail {

namespace detail {

class skeleton_remesher {
public:
  skeleton_remesher(const any_geometry& model, const surface_mesh& surface,
                    std::span<const vec3> coarse_points, const coarse_skeleton& skeleton,
                    const any_sizing& size, content_key field, const remesh::patch_remesher& remesher,
                    const any_executor& run, skeleton_store& made, const progress& on_progress)
      : model_(model), surface_(surface), coarse_points_(coarse_points), skeleton_(skeleton), size_(size),
        field_(field), remesher_(remesher), run_(run), store_(made), on_progress_(on_progress) {}

  remeshed_skeleton run() {
    const stopwatch clock;
    const std::size_t lines_before = store_.lines.made(), patches_before = store_.patches.made();
    lines_ = realize_lines(model_, surface_, skeleton_, coarse_points_, size_, field_, run_, store_.lines,
                           on_progress_);
    const double line_seconds = clock.seconds();
    build_patches();
    remesh_patches();
    for (int round = 0; round < 6 && forbid_repeated_edges(); ++round)
      remesh_patches();
    remeshed_skeleton result = assemble();
    result.summary.name = "skeleton";
    result.summary.set("lines", static_cast<double>(skeleton_.lines.size()));
    result.summary.set("regions", static_cast<double>(skeleton_.regions.size()));
    result.summary.set("interface_faces", static_cast<double>(skeleton_.faces.size()));
    result.summary.set("triangles", static_cast<double>(result.fine.triangles.size()));
    result.summary.set("points", static_cast<double>(result.fine.points.size()));
    result.summary.set("lines_made", static_cast<double>(store_.lines.made() - lines_before));
    result.summary.set("patches_made", static_cast<double>(store_.patches.made() - patches_before));
    result.summary.set("line_seconds", line_seconds);
    result.summary.seconds = clock.seconds();
    return result;
  }

private:
  static std::size_t at(local_id i) { return static_cast<std::size_t>(i); }
  std::size_t patch_count() const { return skeleton_.regions.size() + skeleton_.faces.size(); }
  bool is_region(std::size_t patch) const { return patch < skeleton_.regions.size(); }
  const skeleton_face& face_of(std::size_t patch) const {
    return skeleton_.faces[patch - skeleton_.regions.size()];
  }

  void build_patches() {
    patches_.reserve(patch_count());
    for (const skeleton_region& region : skeleton_.regions)
      patches_.push_back(region_patch(model_, surface_, region, lines_));
    for (const skeleton_face& face : skeleton_.faces)
      patches_.push_back(interface_patch(face, coarse_points_, lines_).patch);
    keys_.resize(patch_count());
    for (std::size_t p = 0; p < patch_count(); ++p)
      keys_[p] = key_of(p);
  }

  /// The key of a patch: its boundary as the remesher gets it. Labels are numbers of the present skeleton;
  /// what counts of them is which points have the same one (poles), and which edges are forbidden.
  content_key key_of(std::size_t p) const {
    const patch_boundary& b = patches_[p].boundary;
    std::map<local_id, local_id> first_with_label;
    std::vector<local_id> same_label;
    for (std::size_t v = 0; v < b.labels.size(); ++v)
      same_label.push_back(first_with_label.try_emplace(b.labels[v], static_cast<local_id>(v)).first->second);
    std::vector<std::array<local_id, 2>> forbidden;
    for (const auto& [x, y] : b.forbidden_edges)
      if (const auto at_x = first_with_label.find(x), at_y = first_with_label.find(y);
          at_x != first_with_label.end() && at_y != first_with_label.end())
        forbidden.push_back({at_x->second, at_y->second});
    key_maker make(field_);
    make(std::int64_t{is_region(p) ? skeleton_.regions[p].cad_face : no_id});
    make(b.uv)(b.points)(same_label)(b.segments)(forbidden);
    if (!is_region(p))
      make(corners_of(p));
    return make.key();
  }
  std::vector<vec3> corners_of(std::size_t p) const {
    std::vector<vec3> corners;
    for (const local_id v : key_order(face_of(p)))
      corners.push_back(coarse_points_[at(v)]);
    return corners;
  }

  void remesh_patches() {
    constexpr double triangles_per_task = 4096;
    std::vector<double> costs; // the triangles in a disk with so many segments around it
    for (const skeleton_patch& patch : patches_) {
      const auto segments = static_cast<double>(patch.boundary.segments.size());
      costs.push_back(segments + segments * segments / 5.4);
    }
    const auto failure = store_.patches.make_missing(
        keys_, costs, triangles_per_task,
        [&](const std::vector<std::size_t>& wanted) {
          const task_model own(model_, run_);
          std::vector<byte_buffer> encoded;
          for (const std::size_t p : wanted)
            encoded.push_back(encode(in_space(remesh_patch(own.get(), p))));
          return encoded;
        },
        run_, run_options{.on_progress = on_progress_, .stage = "skeleton"});
    if (failure)
      throw mesher_error("remeshing of " + name_of(failure->entity) + " failed: " + failure->reason);
  }

  /// A skeleton has no use for the rest.
  static patch_mesh in_space(patch_mesh mesh) {
    mesh.inner_uv.clear();
    mesh.summary = {};
    return mesh;
  }

  /// Calls `use(patch, mesh)` for each patch in turn.
  template <class Use>
  void for_each_patch(const Use& use) const {
    store_.patches.for_each(
        keys_, [&](std::size_t p, const byte_buffer& bytes) { use(p, decode_patch_mesh(bytes)); });
  }

  patch_mesh remesh_patch(const any_geometry& model, std::size_t p) const {
    if (is_region(p))
      return remesher_(remesh::model_surface{&model, skeleton_.regions[p].cad_face}, patches_[p].boundary,
                       size_);
    const interface_face_patch face = interface_patch(face_of(p), coarse_points_, lines_);
    patch_boundary boundary = face.patch.boundary;
    boundary.forbidden_edges = patches_[p].boundary.forbidden_edges;
    return remesher_(face.surface, boundary, size_);
  }

  std::string name_of(std::size_t p) const {
    if (!is_region(p))
      return "interface face " + std::to_string(p - skeleton_.regions.size());
    const local_id f = skeleton_.regions[p].cad_face;
    const std::string& name = model_.topology().faces[at(f)].name;
    return "a region of face " + std::to_string(f) + (name.empty() ? "" : " (" + name + ")");
  }

  /// An inner edge that joins two boundary points belongs to one patch only, and none joins neighbours on a
  /// line. Tells the later patches to do without; false when there is nothing to do.
  bool forbid_repeated_edges() {
    std::vector<std::pair<std::array<local_id, 2>, std::size_t>> chords; // patch_count() stands for the lines
    for (std::size_t l = 0; l < lines_.keys.size(); ++l) {
      const auto numbers = lines_.along(static_cast<local_id>(l), lines_.keys[l].vertices[0]);
      for (std::size_t i = 0; i + 1 < numbers.size(); ++i)
        chords.emplace_back(sorted_vertices(std::array{numbers[i], numbers[i + 1]}), 0);
    }
    const std::size_t on_lines = chords.size();
    for_each_patch([&](std::size_t p, const patch_mesh& mesh) { collect_chords(p, mesh, chords); });
    for (std::size_t i = on_lines; i < chords.size(); ++i)
      ++chords[i].second; // lines sort first
    sort_unique(chords);
    std::set<std::size_t> changed;
    for (std::size_t i = 1; i < chords.size(); ++i)
      if (chords[i].first == chords[i - 1].first) {
        const std::size_t p = chords[i].second - 1;
        auto& forbidden = patches_[p].boundary.forbidden_edges;
        if (std::find(forbidden.begin(), forbidden.end(), chords[i].first) == forbidden.end()) {
          forbidden.push_back(chords[i].first);
          changed.insert(p);
        }
      }
    for (const std::size_t p : changed)
      keys_[p] = key_of(p); // a different mesh than without them
    return !changed.empty();
  }

  void collect_chords(std::size_t p, const patch_mesh& mesh,
                      std::vector<std::pair<std::array<local_id, 2>, std::size_t>>& chords) const {
    chord_finder(patches_[p].boundary)
        .for_each(mesh.triangles,
                  [&](std::size_t, const std::array<local_id, 2>& chord) { chords.emplace_back(chord, p); });
  }

  remeshed_skeleton assemble() {
    remeshed_skeleton result;
    fine_skeleton& fine = result.fine;
    fine.points = std::move(lines_.points);
    fine.point_hosts = std::move(lines_.hosts);
    reserve(fine);
    double folded = 0;
    for_each_patch([&](std::size_t p, const patch_mesh& mesh) {
      if (!mesh.crossings.empty() || !mesh.misplaced.empty())
        result.failures.push_back(failure_of(p, mesh));
      if (!mesh.folded.empty()) {
        folded += static_cast<double>(mesh.folded.size());
        if (is_region(p))
          result.summary.warnings.push_back(name_of(p) + ": " + std::to_string(mesh.folded.size()) +
                                            " triangles turn away from the surface");
      }
      append_patch(p, mesh, result);
    });
    result.first_triangle.push_back(static_cast<local_id>(fine.triangles.size()));
    result.summary.set("folded_triangles", folded);
    for (std::size_t l = 0; l < lines_.keys.size(); ++l)
      if (lines_.keys[l].on.dimension == 1)
        append_curve_edges(static_cast<local_id>(l), fine);
    result.patch_keys = std::move(keys_);
    return result;
  }

  /// Exactly: what grows by doubling holds up to twice as much, and both copies as it grows.
  void reserve(fine_skeleton& fine) const {
    std::size_t points = fine.points.size(), triangles = 0;
    for_each_patch([&](std::size_t, const patch_mesh& mesh) {
      points += mesh.inner_points.size();
      triangles += mesh.triangles.size();
    });
    fine.points.reserve(points);
    fine.point_hosts.reserve(points);
    fine.triangles.reserve(triangles);
    fine.subdomains.reserve(triangles);
    fine.cad_faces.reserve(triangles);
  }

  patch_failure failure_of(std::size_t p, const patch_mesh& mesh) const {
    patch_failure failure;
    (is_region(p) ? failure.region : failure.face) =
        static_cast<local_id>(is_region(p) ? p : p - skeleton_.regions.size());
    std::set<local_id> lines;
    for (const auto& [a, b] : mesh.crossings)
      for (const local_id segment : {a, b})
        lines.insert(patches_[p].line_of_segment[at(segment)]);
    for (const local_id segment : mesh.misplaced)
      lines.insert(patches_[p].line_of_segment[at(segment)]);
    for (const local_id line : lines)
      if (line != no_id && lines_.keys[at(line)].on.dimension > 1)
        failure.removable_lines.push_back(line);
    failure.reason = name_of(p) + ": its boundary lines cross in the parameter plane";
    return failure;
  }

  void append_patch(std::size_t p, const patch_mesh& mesh, remeshed_skeleton& result) const {
    fine_skeleton& fine = result.fine;
    const auto& labels = patches_[p].boundary.labels;
    const auto frozen = static_cast<local_id>(labels.size());
    const auto first_inner = static_cast<local_id>(fine.points.size());
    result.first_triangle.push_back(static_cast<local_id>(fine.triangles.size()));
    append(fine.points, mesh.inner_points);
    fine.point_hosts.resize(fine.points.size(),
                            is_region(p) ? host{2, skeleton_.regions[p].cad_face} : host{});
    auto subdomains = is_region(p) ? skeleton_.regions[p].subdomains : face_of(p).subdomains;
    bool swap = is_region(p) ? model_.topology().faces[at(skeleton_.regions[p].cad_face)].reversed
                             : !same_turn(key_order(face_of(p)), face_of(p).vertices);
    if (subdomains[0] == no_id) { // a face that bounds nothing behind it
      std::swap(subdomains[0], subdomains[1]);
      swap = !swap;
    }
    for (simplex<2> triangle : mesh.triangles) {
      if (swap)
        std::swap(triangle[1], triangle[2]);
      for (local_id& v : triangle)
        v = v < frozen ? labels[at(v)] : first_inner + v - frozen;
      fine.triangles.push_back(triangle);
      fine.subdomains.push_back(subdomains);
      fine.cad_faces.push_back(is_region(p) ? skeleton_.regions[p].cad_face : no_id);
    }
  }

  void append_curve_edges(local_id line, fine_skeleton& fine) const {
    const auto numbers = lines_.along(line, lines_.keys[at(line)].vertices[0]);
    for (std::size_t i = 0; i + 1 < numbers.size(); ++i) {
      fine.curve_edges.push_back({numbers[i], numbers[i + 1]});
      fine.curves.push_back(lines_.keys[at(line)].on.id);
    }
  }

  const any_geometry& model_;
  const surface_mesh& surface_;
  std::span<const vec3> coarse_points_;
  const coarse_skeleton& skeleton_;
  const any_sizing& size_;
  content_key field_;
  const remesh::patch_remesher& remesher_;
  const any_executor& run_;
  skeleton_store& store_;
  const progress& on_progress_;
  numbered_lines lines_;
  std::vector<skeleton_patch> patches_;
  std::vector<content_key> keys_;
};

} // namespace detail

DOVETAIL_INLINE remeshed_skeleton remesh_skeleton(const any_geometry& model, const surface_mesh& surface,
                                                  std::span<const vec3> coarse_points,
                                                  const coarse_skeleton& skeleton, const any_sizing& size,
                                                  content_key field, const remesh::patch_remesher& remesher,
                                                  const any_executor& run, skeleton_store& made,
                                                  const progress& on_progress) {
  return detail::skeleton_remesher(model, surface, coarse_points, skeleton, size, field, remesher, run, made,
                                   on_progress)
      .run();
}

} // namespace dovetail
