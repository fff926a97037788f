/// @file
/// The meshes of regions, made until no two of them share an inner edge: what `mesh_regions` does, whoever
/// meshes a region.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/parallel/map_tasks.hpp"
#include "dovetail/parallel/task_model.hpp"
#include "dovetail/remesh/chords.hpp"
#include "dovetail/remesh/flat_neighbours.hpp"
#include "dovetail/remesh/mesh_regions.hpp"
#include "dovetail/remesh/surface_deviation.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// What is kept of a region's mesh, where it is asked for.
struct region_counts {
  double least_angle_deg = 180;

  using fields = field_list<&region_counts::least_angle_deg>;
};

/// In degrees; 180 without triangles.
inline double least_corner_angle(const patch_boundary& boundary, const patch_mesh& made) {
  const auto point = [&](local_id v) {
    const auto i = static_cast<std::size_t>(v), frozen = boundary.points.size();
    return i < frozen ? boundary.points[i] : made.inner_points[i - frozen];
  };
  double least = 180;
  for (const auto& [a, b, c] : made.triangles)
    least = std::min(least, smallest_corner_angle({point(a), point(b), point(c)}));
  return least;
}

/// The meshes of the regions of one set.
template <geometry_model Geometry, executor Executor>
class region_making {
public:
  region_making(const Geometry& model, region_set<Geometry>& set, const region_mesher& mesh_it,
                const refined_sizing& size, const Executor& run, region_memo& made,
                const mesh_regions_options& options)
      : model_(model), set_(set), mesh_it_(mesh_it), size_(size), run_(run), made_(made), options_(options) {
    result_.of_region.reserve(set.count);
    faces_.reserve(set.count);
    costs_.reserve(set.count);
    result_.labels.items.reserve(set.boundary_points);
    result_.labels.begins.reserve(set.count + 1);
    segments_.items.reserve(set.boundary_points);
    segments_.begins.reserve(set.count + 1);
    for (std::size_t r = 0; r < set.count; ++r) {
      const surface_region region = outline(r);
      result_.of_region.push_back(kept_mesh(r, region));
      append_row(result_.labels, region.boundary.labels);
      append_row(segments_, region.boundary.segments);
      faces_.push_back(region.face);
      costs_.push_back(triangles_within(static_cast<double>(region.boundary.segments.size())));
    }
  }

  meshed_regions run() {
    make_missing();
    for (int round = 0; round < options_.attempts.chords && forbid_shared_chords(); ++round)
      make_missing();
    return std::move(result_);
  }

private:
  template <class Item>
  static void append_row(compressed_rows<Item>& rows, const std::vector<Item>& row) {
    rows.items.insert(rows.items.end(), row.begin(), row.end());
    rows.begins.push_back(rows.items.size());
  }

  /// What the mesh of a region is a function of.
  surface_region outline(std::size_t r) const {
    return size_.is_refined() ? set_.region(model_, r) : set_.outline(model_, r);
  }

  box3 place(const Geometry& model, std::size_t r, const patch_boundary& boundary) const {
    return size_.is_refined() ? place_of(boundary, set_.surface_of(model, r)) : box3{};
  }

  /// Labels are numbers of the present set; what counts of them is which points have the same one (poles),
  /// and which edges are forbidden.
  struct places_of_labels {
    std::vector<local_id> same_label;  ///< per point: the first with its label
    std::vector<simplex<1>> forbidden; ///< edges, by points
  };
  static places_of_labels places_of(const patch_boundary& b) {
    std::vector<std::pair<local_id, local_id>> by_label; // with the place
    for (std::size_t v = 0; v < b.labels.size(); ++v)
      by_label.emplace_back(b.labels[v], static_cast<local_id>(v));
    sort_all(by_label);
    const auto first_with = [&](local_id label) {
      const auto found = std::lower_bound(by_label.begin(), by_label.end(), std::pair(label, local_id{0}));
      return found != by_label.end() && found->first == label ? found->second : no_id;
    };
    places_of_labels places;
    places.same_label.resize(b.labels.size());
    local_id first = no_id;
    for (std::size_t i = 0; i < by_label.size(); ++i) {
      const auto [label, v] = by_label[i];
      first = i > 0 && by_label[i - 1].first == label ? first : v;
      places.same_label[v] = first;
    }
    for (const auto& [x, y] : b.forbidden_edges)
      if (const local_id at_x = first_with(x), at_y = first_with(y); at_x != no_id && at_y != no_id)
        places.forbidden.push_back({at_x, at_y});
    return places;
  }

  kept<patch_mesh> kept_mesh(std::size_t r, const surface_region& region) const {
    const patch_boundary& b = region.boundary;
    const auto by = [&](const auto&... boundary) {
      return kept<patch_mesh>::of(region.face, region.size_factor, options_.attempts.folds,
                                  options_.parameters, options_.deviation, options_.angles, boundary...,
                                  size_.balls_near(place(model_, r, b)));
    };
    const std::vector<vec3> surface = set_.points_of_surface(r);
    if (const auto name = set_.name_of_boundary(r))
      return by(surface, *name,
                b.forbidden_edges.empty() ? std::vector<simplex<1>>{} : places_of(b).forbidden);
    const places_of_labels places = places_of(b);
    return by(surface, surface.empty() ? b.uv : std::vector<vec2>{}, b.points, places.same_label, b.segments,
              places.forbidden);
  }

  /// In tasks of many regions.
  void make_missing() {
    std::vector<std::size_t> regions;
    std::vector<double> costs;
    for (std::size_t r = 0; r < set_.count; ++r)
      if (!result_.failures.contains(r)) {
        regions.push_back(r);
        costs.push_back(costs_[r]);
      }
    std::vector<kept<patch_mesh>> wanted;
    for (const std::size_t r : regions)
      wanted.push_back(result_.of_region[r]);
    const auto failures = made_.meshes.make_missing(
        wanted, costs, options_.triangles_per_task,
        [&](const std::vector<std::size_t>& missing) {
          const task_model own(model_, run_);
          std::vector<patch_mesh> meshes;
          for (const std::size_t i : missing)
            meshes.push_back(make(own.get(), regions[i]));
          return meshes;
        },
        run_, run_options{.on_progress = options_.on_progress, .stage = options_.stage});
    for (const memo_failure& failure : failures)
      result_.failures[regions[failure.number]] = failure.reason;
    note_meshes();
  }

  /// Reads the meshes that were not read before, in tasks where there are many.
  void note_meshes() {
    constexpr double triangles_per_task = 1 << 16; // some 10 ms
    std::vector<std::size_t> unread, begins{0};
    double triangles = 0; // about, of the last task
    for (std::size_t r = 0; r < set_.count; ++r)
      if (!result_.failures.contains(r) && !made_.known.contains(result_.of_region[r])) {
        if (triangles >= triangles_per_task) {
          begins.push_back(unread.size());
          triangles = 0;
        }
        unread.push_back(r);
        triangles += costs_[r];
      }
    if (unread.empty())
      return;
    begins.push_back(unread.size());
    const auto read = [&](std::size_t task) {
      return meshes_known_of(span_of(unread).subspan(begins[task], begins[task + 1] - begins[task]));
    };
    made_.known.reserve(made_.known.size() + unread.size());
    const auto note = [&](std::size_t task, std::vector<region_memo::known_mesh> known) {
      for (std::size_t k = 0; k < known.size(); ++k)
        made_.known[result_.of_region[unread[begins[task] + k]]] = std::move(known[k]);
    };
    const std::size_t tasks = begins.size() - 1;
    if (tasks == 1) {
      note(0, read(0));
      return;
    }
    auto results =
        map_tasks(run_, tasks, read,
                  run_options{.on_progress = options_.on_progress.only_stopping(), .stage = options_.stage});
    for (std::size_t task = 0; task < tasks; ++task)
      note(task, value_of(std::move(results[task]), "the reading of meshes of regions"));
  }

  std::vector<region_memo::known_mesh> meshes_known_of(std::span<const std::size_t> regions) const {
    std::vector<kept<patch_mesh>> names;
    for (const std::size_t r : regions)
      names.push_back(result_.of_region[r]);
    std::vector<region_memo::known_mesh> known;
    known.reserve(regions.size());
    made_.meshes.for_each(names, [&](std::size_t i, const patch_mesh& mesh) {
      const auto labels = result_.labels[regions[i]];
      known.push_back(
          {mesh.inner_points.size(), mesh.triangles.size(),
           !mesh.crossings.empty() || !mesh.misplaced.empty() || !mesh.folded.empty(),
           deviation_in(mesh.summary), mesh.summary.template as<region_counts>().least_angle_deg,
           chord_finder({labels.begin(), labels.end()}, segments_[regions[i]]).all(mesh.triangles)});
    });
    return known;
  }

  patch_mesh make(const Geometry& model, std::size_t r) const {
    const surface_region region = set_.region(model, r);
    if (region.boundary.segments.empty())
      return {}; // a face that a model has by number only
    const any_surface surface = set_.surface_of(model, r);
    const any_sizing size = size_.near(place(model, r, region.boundary));
    patch_mesh made = mesh_it_(surface, region, size);
    made.summary = {};
    if (options_.deviation && region.face != no_id)
      made.summary.set(measure_deviation(surface, region.boundary, made, size));
    if (options_.angles && region.face == no_id)
      made.summary.set(region_counts{least_corner_angle(region.boundary, made)});
    if (!options_.parameters)
      made.inner_uv.clear();
    return made;
  }

  /// Forbids each chord to all regions that have it but the first, and to all of them where a segment joins
  /// the same labels, or to curved ones where it lies in a flat face; false when there is nothing to do.
  bool forbid_shared_chords() {
    const auto labelled = [this](std::size_t r, const simplex<1>& edge) {
      const auto labels = std::as_const(result_.labels)[r];
      return sorted_vertices(simplex<1>{labels[edge[0]], labels[edge[1]]});
    };
    std::vector<std::pair<simplex<1>, std::size_t>> chords; // with the region
    for (std::size_t r = 0; r < set_.count; ++r)
      if (!result_.failures.contains(r))
        for (const simplex<1>& chord : made_.known.at(result_.of_region[r]).chords)
          chords.emplace_back(labelled(r, chord), r);
    if (chords.empty())
      return false;
    sort_unique(chords);
    const std::vector<std::uint8_t> is_line = chords_on_segments(chords, labelled);
    const std::vector<std::uint8_t> is_in_flat_face = chords_in_flat_faces(chords);
    std::set<std::size_t> changed;
    for (std::size_t i = 0; i < chords.size(); ++i) {
      const auto& [chord, r] = chords[i];
      const bool another_has_it = i > 0 && chords[i - 1].first == chord;
      if ((another_has_it || is_line[i] != 0 || is_in_flat_face[i] != 0) && forbid(r, chord))
        changed.insert(r);
    }
    for (const std::size_t r : changed)
      result_.of_region[r] = kept_mesh(r, outline(r));
    return !changed.empty();
  }

  /// Whether a segment of any region joins the same labels, per chord; they are sorted.
  template <class Labelled>
  std::vector<std::uint8_t> chords_on_segments(const std::vector<std::pair<simplex<1>, std::size_t>>& chords,
                                               const Labelled& labelled) const {
    std::vector<std::uint8_t> found(chords.size(), 0);
    local_id largest = 0;
    for (const auto& [chord, r] : chords)
      largest = std::max(largest, chord[1]);
    std::vector<bool> is_end(static_cast<std::size_t>(largest) + 1, false); // of a chord, as few labels are
    for (const auto& [chord, r] : chords)
      is_end[chord[0]] = is_end[chord[1]] = true;
    for (std::size_t r = 0; r < set_.count; ++r)
      for (const simplex<1>& segment : segments_[r]) {
        const simplex<1> line = labelled(r, segment);
        if (line[1] > largest || !is_end[line[0]] || !is_end[line[1]])
          continue;
        auto chord = std::lower_bound(chords.begin(), chords.end(), std::pair(line, std::size_t{0}));
        for (; chord != chords.end() && chord->first == line; ++chord)
          found[static_cast<std::size_t>(chord - chords.begin())] = 1;
      }
    return found;
  }

  /// Whether a chord is of a curved CAD face and lies in a flat one, per chord.
  std::vector<std::uint8_t>
  chords_in_flat_faces(const std::vector<std::pair<simplex<1>, std::size_t>>& chords) const {
    std::vector<std::uint8_t> found(chords.size(), 0);
    std::vector<local_id> ends;
    for (const auto& [chord, r] : chords)
      if (faces_[r] != no_id)
        append(ends, chord);
    if (ends.empty())
      return found;
    flat_neighbours flat(model_, std::move(ends));
    for (std::size_t r = 0; r < set_.count; ++r)
      if (faces_[r] != no_id)
        flat.add(faces_[r], std::as_const(result_.labels)[r]);
    for (std::size_t i = 0; i < chords.size(); ++i) {
      const auto& [chord, r] = chords[i];
      if (faces_[r] != no_id && !flat.is_flat(faces_[r]) && flat.share_a_plane(chord[0], chord[1]))
        found[i] = 1;
    }
    return found;
  }

  /// False when it is forbidden already. An edge that the region forbids itself is in no mesh of it.
  bool forbid(std::size_t r, const simplex<1>& chord) {
    auto& forbidden = set_.forbidden_edges[r];
    if (std::find(forbidden.begin(), forbidden.end(), chord) != forbidden.end())
      return false;
    forbidden.push_back(chord);
    return true;
  }

  const Geometry& model_;
  region_set<Geometry>& set_;
  const region_mesher& mesh_it_;
  const refined_sizing& size_;
  const Executor& run_;
  region_memo& made_;
  const mesh_regions_options& options_;
  std::vector<double> costs_;
  compressed_rows<simplex<1>> segments_; ///< of each region's boundary
  std::vector<local_id> faces_;          ///< of each region, no_id for interface faces
  meshed_regions result_;
};

template <geometry_model Geometry, executor Executor>
meshed_regions make_regions(const Geometry& model, region_set<Geometry>& set, const region_mesher& mesh_it,
                            const refined_sizing& size, const Executor& run, region_memo& made,
                            const mesh_regions_options& options) {
  return region_making<Geometry, Executor>(model, set, mesh_it, size, run, made, options).run();
}

} // namespace dovetail::detail
