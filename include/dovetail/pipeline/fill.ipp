/// @file
/// What `fill.hpp` declares.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/require_valid.hpp"
#include "dovetail/mesher/checks.hpp"
#include "dovetail/mesher/enclosed_regions.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/pipeline/fill.hpp"
#include "dovetail/pipeline/fillable_surface.hpp"
#include "dovetail/pipeline/surface_faults.hpp"
#include "dovetail/sizing/volume_prediction.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// Which of the enclosed regions are filled, and with what.
struct fill_plan {
  static constexpr local_id empty = -2;
  std::vector<local_id> material; ///< per region, or `empty`
  std::vector<local_id> filled;   ///< the regions that are not empty
  bool is_oriented = true;
  std::vector<std::string> warnings = {};

  bool is_filled(local_id region) const { return region != no_id && material[region] != empty; }
  local_id material_of(local_id region) const { return is_filled(region) ? material[region] : no_id; }
};

/// Regions that see inner sides of triangles are filled, all of them where the outside sees some too.
inline void tell_voids(const enclosed_regions& regions, const simplicial_mesh<2>& surface, fill_plan& plan) {
  std::vector<bool> sees_inner_side(plan.material.size(), false);
  for (std::size_t t = 0; t < surface.elements.size(); ++t) {
    const auto [behind, before] = regions.beside()[t];
    if (behind != no_id) {
      sees_inner_side[behind] = true;
    } else if (before != no_id && plan.is_oriented) {
      plan.is_oriented = false;
      plan.warnings.push_back("triangle " + triangle_text(surface, t) +
                              " shows its inner side to the outside, so that orientations mean nothing: all "
                              "that is enclosed is filled, voids too; orient outer triangles outwards, or "
                              "name a point of each void");
    }
  }
  for (std::size_t r = 0; r < plan.material.size(); ++r)
    if (plan.is_oriented && !sees_inner_side[r])
      plan.material[r] = fill_plan::empty;
}

inline void apply_marks(const enclosed_regions& regions, const std::vector<region_mark>& marks,
                        fill_plan& plan) {
  std::vector<const region_mark*> mark_of(plan.material.size(), nullptr);
  for (const region_mark& mark : marks) {
    if (mark.material < 0 && mark.material != no_id)
      throw geometry_error("the material " + std::to_string(mark.material) + " of the point " +
                           place_text(mark.place) + " is negative; give 0 or more, or no_id for a void");
    const local_id region = is_finite(mark.place) ? regions.at(mark.place) : no_id;
    if (region == no_id)
      throw geometry_error("the point " + place_text(mark.place) +
                           " is outside of the surface; give a point inside of the region that is meant");
    const region_mark*& known = mark_of[region];
    if (known != nullptr && known->material != mark.material)
      throw geometry_error("the points " + place_text(known->place) + " and " + place_text(mark.place) +
                           " are in one region, of which they say different things");
    known = &mark;
  }
  for (std::size_t r = 0; r < mark_of.size(); ++r)
    if (mark_of[r] != nullptr)
      plan.material[r] = mark_of[r]->material == no_id ? fill_plan::empty : mark_of[r]->material;
}

/// Those without a material get the lowest numbers that no mark has taken.
inline void number_materials(const std::vector<region_mark>& marks, fill_plan& plan) {
  std::vector<local_id> taken;
  for (const region_mark& mark : marks)
    taken.push_back(mark.material);
  sort_unique(taken);
  local_id next = 0;
  for (std::size_t r = 0; r < plan.material.size(); ++r) {
    if (plan.material[r] == fill_plan::empty)
      continue;
    plan.filled.push_back(static_cast<local_id>(r));
    if (plan.material[r] != no_id)
      continue;
    while (std::binary_search(taken.begin(), taken.end(), next))
      ++next;
    plan.material[r] = next++;
  }
}

inline fill_plan plan_fill(const enclosed_regions& regions, const simplicial_mesh<2>& surface,
                           const std::vector<region_mark>& marks) {
  fill_plan plan{std::vector<local_id>(static_cast<std::size_t>(regions.count()), no_id), {}};
  if (regions.count() == 0)
    throw geometry_error("the surface encloses nothing; give closed shells");
  tell_voids(regions, surface, plan);
  apply_marks(regions, marks, plan);
  number_materials(marks, plan);
  surface_faults lost;
  for (std::size_t t = 0; t < surface.elements.size(); ++t)
    if (!plan.is_filled(regions.beside()[t][0]) && !plan.is_filled(regions.beside()[t][1]))
      lost.add([&] { return triangle_text(surface, t); });
  lost.check("a triangle has elements on neither side", "triangles have elements on neither side",
             "remove them or fill a region beside");
  return plan;
}

/// Per region the triangles beside it: twice their number, and one more for those it is before.
inline compressed_rows<std::size_t> triangles_of_regions(const enclosed_regions& regions) {
  return sorted_into_rows<std::size_t>(static_cast<std::size_t>(regions.count()), [&](const auto& put) {
    for (std::size_t t = 0; t < regions.beside().size(); ++t)
      for (std::size_t s = 0; s < 2; ++s)
        if (const local_id region = regions.beside()[t][s]; region != no_id)
          put(region, 2 * t + s);
  });
}

/// The boundary of a region, oriented outwards; a triangle with the region on both sides is in it twice.
inline piece_input<3> boundary_of_region(std::span<const std::size_t> sides,
                                         const simplicial_mesh<2>& surface, local_id material) {
  piece_input<3> input;
  input.boundary.material = material;
  simplicial_mesh<2>& boundary = input.boundary.boundary;
  for (const std::size_t side : sides) {
    const auto& [a, b, c] = surface.elements[side / 2];
    boundary.elements.push_back(side % 2 == 0 ? simplex<2>{a, b, c} : simplex<2>{a, c, b});
  }
  auto& used = input.skeleton_points;
  for (const simplex<2>& triangle : boundary.elements)
    used.insert(used.end(), triangle.begin(), triangle.end());
  sort_unique(used);
  for (const local_id v : used)
    boundary.points.push_back(surface.points[v]);
  for (simplex<2>& triangle : boundary.elements)
    for (local_id& v : triangle)
      v = static_cast<local_id>(std::lower_bound(used.begin(), used.end(), v) - used.begin());
  return input;
}

/// What the sizes ask for in the whole box, by few samples and by the least sizes that the field tells.
struct box_prediction {
  double elements = 0;
  double least_density = 1e300; ///< elements per volume where sizes are largest
};
inline box_prediction predict_in_box(const simplicial_mesh<2>& surface, const any_sizing& size) {
  constexpr int across = 12;
  box3 box;
  for (const simplex<2>& triangle : surface.elements)
    for (const local_id v : triangle)
      box.include(surface.points[v]);
  const vec3 step = (box.upper - box.lower) / across;
  box_prediction result;
  for (int x = 0; x < across; ++x)
    for (int y = 0; y < across; ++y)
      for (int z = 0; z < across; ++z) {
        box3 cell;
        cell.include(box.lower + vec3{x * step.x, y * step.y, z * step.z});
        cell.include(box.lower + vec3{(x + 1) * step.x, (y + 1) * step.y, (z + 1) * step.z});
        const double sampled = sizing::density_at<3>(checked_size(size, cell.center()));
        const double least_size = smallest_size_in(size, cell);
        const double most = least_size > 0 ? std::max(sampled, sizing::density_at<3>(least_size)) : sampled;
        result.elements += most * step.x * step.y * step.z;
        result.least_density = std::min(result.least_density, sampled);
      }
  return result;
}

/// Throws for sizes that ask for far too many elements. They are predicted with care only where those of the
/// box would be too many.
inline void require_few_enough(const simplicial_mesh<2>& surface, std::size_t regions,
                               const subdomain_source& source, const any_sizing& size, double density,
                               double most) {
  const box_prediction in_box = predict_in_box(surface, size);
  if (density * in_box.elements <= most)
    return;
  const prediction_options rough{.density = density, .relative_error = 0.3, .largest_cells = 20'000};
  double total = 0;
  for (std::size_t k = 0; k < regions; ++k) {
    const auto boundary = source(static_cast<local_id>(k)).boundary.boundary;
    // A needle slips between the few cells of a rough prediction: its volume tells what there is at least,
    // but for a margin, as the largest size may have been missed.
    constexpr double margin = 0.1;
    const double least = margin * density * in_box.least_density *
                         enclosed_volume(span_of(boundary.points), span_of(boundary.elements));
    total += std::max(predict_volume_elements(boundary, erased_sizing(size), rough).elements, least);
  }
  if (!(total <= most))
    throw sizing_error("the sizes predict about " + number_text(total, 3) +
                       " elements, more than the limit of " + number_text(most, 3) + "; give larger sizes");
}

/// Appends a region's elements; its first points are the surface's.
inline filled_region append_region(const simplicial_piece<3>& piece, simplicial_mesh<3>& mesh) {
  const auto& given = piece.skeleton_points;
  const std::size_t first = mesh.points.size();
  append(mesh.points, std::span(piece.mesh.points).subspan(given.size()));
  filled_region region{piece.material, piece.mesh.elements.size(), 0};
  for (simplex<3> element : piece.mesh.elements) {
    for (local_id& v : element) {
      const auto k = static_cast<std::size_t>(v);
      v = k < given.size() ? given[k] : static_cast<local_id>(first + k - given.size());
    }
    const auto at = [&](std::size_t k) { return mesh.points[element[k]]; };
    region.volume += signed_volume(at(0), at(1), at(2), at(3));
    mesh.elements.push_back(element);
    mesh.tags.push_back(piece.material);
  }
  return region;
}

[[noreturn]] inline void throw_unfilled(const std::vector<piece_failure>& failures, std::size_t regions) {
  const piece_failure& first = failures.front();
  throw mesher_error((regions == 1
                          ? "the inside"
                          : std::to_string(failures.size()) + " of " + std::to_string(regions) +
                                " regions, the first with number " + std::to_string(first.subdomain) + ",") +
                     " could not be meshed: " + joined_reasons(first.reasons));
}

} // namespace detail

DOVETAIL_INLINE filled_surface detail::fill_by(const enclosed_region_mesher& mesh_regions,
                                               const simplicial_mesh<2>& surface, const any_sizing& size,
                                               const fill_options& options) {
  const stopwatch clock;
  filled_surface result;
  report& summary = result.summary;
  summary.name = "fill";
  const auto timed = [&](const char* name, const auto& work) {
    options.on_progress.stop_if_requested();
    const stopwatch part;
    auto made = work();
    summary.children.push_back(
        {.name = name, .seconds = part.seconds(), .counters = {}, .warnings = {}, .children = {}});
    return made;
  };
  timed("checks", [&] { return require_fillable(surface), true; });
  const auto regions = timed("regions", [&] { return enclosed_regions(surface); });
  const detail::fill_plan plan = detail::plan_fill(regions, surface, options.marks);
  const any_sizing sizes = timed("sizes", [&]() -> any_sizing {
    sizing::checked_size(options.growth, "the growth of the sizes");
    return size ? within_surface_sizes(size, surface, options.growth)
                : any_sizing(erased_sizing(surface_sizes(surface, options.growth)));
  });

  const auto sides = detail::triangles_of_regions(regions);
  const auto source = [&](local_id k) {
    const local_id region = plan.filled[k];
    return detail::boundary_of_region(sides[region], surface, plan.material[region]);
  };
  const double density = mesh_regions.elements_per_inverse_cubed_size;
  detail::require_few_enough(surface, plan.filled.size(), source, sizes,
                             density > 0 ? density : elements_per_unit<3>, options.largest_prediction);
  meshing_options how;
  for (const local_id region : plan.filled)
    how.predicted_cost.push_back(static_cast<double>(sides[region].size()));
  how.on_progress = options.on_progress;
  meshed_pieces<3> made = mesh_regions.mesh(plan.filled.size(), source, refined_sizing(sizes), how);
  if (!made.failures.empty())
    detail::throw_unfilled(made.failures, plan.filled.size());
  result.mesh.points = surface.points;
  for (std::size_t k = 0; k < plan.filled.size(); ++k)
    result.regions.push_back(detail::append_region(made.load(static_cast<local_id>(k)), result.mesh));
  for (const auto& [behind, before] : regions.beside())
    result.materials_beside.push_back({plan.material_of(behind), plan.material_of(before)});
  result.quality = made.quality;

  summary.set(fill_counts{.triangles = surface.elements.size(),
                          .regions = plan.filled.size(),
                          .voids = plan.material.size() - plan.filled.size(),
                          .elements = result.mesh.elements.size(),
                          .points = result.mesh.points.size()});
  summary.warnings = plan.warnings;
  summary.children.push_back(std::move(made.summary));
  summary.seconds = clock.seconds();
  return result;
}

} // namespace dovetail
