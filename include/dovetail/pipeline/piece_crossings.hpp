/// @file
/// Crossing triangles of finished pieces in D = 2, within a piece and between pieces.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/intersection/crossing_refinement.hpp"
#include "dovetail/intersection/crossing_triangles.hpp"
#include "dovetail/intersection/suppression.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/pipeline/realize.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace dovetail {

namespace detail {

/// Whether all faces are known to lie in one plane. Pieces there cannot cross: each covers what its lines
/// enclose, which is checked, and the lines were tested with the background mesh.
inline bool lies_in_one_plane(const any_geometry& model) {
  std::optional<surface_frame> first;
  const double tolerance = 1e-9 * model.bounds().diagonal();
  for (std::size_t f = 0; f < model.topology().faces.size(); ++f) {
    const auto plane = model.plane_of_face(static_cast<local_id>(f));
    if (!plane)
      return false;
    if (!first)
      first = plane;
    const vec3 normal = normalized(cross(first->du, first->dv));
    if (std::abs(dot(plane->point - first->point, normal)) > tolerance ||
        norm(cross(normalized(cross(plane->du, plane->dv)), normal)) > 1e-9)
      return false;
  }
  return true;
}

/// All pieces as one mesh; the elements' tags are CAD faces.
inline simplicial_mesh<2> joined_pieces(const simplicial_skeleton<2>& skeleton,
                                        const meshed_pieces<2>& meshed) {
  std::size_t points = skeleton.points.size(), elements = 0;
  for (const piece_summary& piece : meshed.pieces) {
    points += static_cast<std::size_t>(piece.counts.inner_points);
    elements += static_cast<std::size_t>(piece.counts.elements);
  }
  simplicial_mesh<2> whole;
  whole.points.reserve(points);
  whole.elements.reserve(elements);
  whole.tags.reserve(elements);
  append(whole.points, skeleton.points);
  for (std::size_t s = 0; s < meshed.pieces.size(); ++s) {
    const simplicial_piece<2> piece = meshed.load(static_cast<local_id>(s));
    const std::size_t shared = piece.skeleton_points.size();
    const std::size_t first = whole.points.size();
    whole.points.insert(whole.points.end(), piece.mesh.points.begin() + static_cast<std::ptrdiff_t>(shared),
                        piece.mesh.points.end());
    for (simplex<2> triangle : piece.mesh.elements) {
      for (local_id& v : triangle)
        v = static_cast<std::size_t>(v) < shared
                ? piece.skeleton_points[static_cast<std::size_t>(v)]
                : static_cast<local_id>(first + static_cast<std::size_t>(v) - shared);
      whole.elements.push_back(triangle);
    }
    append(whole.tags, piece.mesh.tags);
  }
  return whole;
}

/// The crossings of all finished pieces, in an order that does not depend on the executor. Loads points and
/// triangles of all pieces at once, also from a spool: about 32 bytes per triangle with the search's lists,
/// which is the only step of D = 2 that needs memory for the whole mesh. Nothing is loaded when the model
/// lies in one plane. O(n log n); on smooth surfaces a small part of the time for meshing them.
inline std::vector<surface_crossing> crossings_of_pieces(const any_geometry& model,
                                                         const realized<2>& skeleton,
                                                         const meshed_pieces<2>& meshed,
                                                         const any_executor& run) {
  std::vector<surface_crossing> crossings;
  if (lies_in_one_plane(model))
    return crossings;
  const simplicial_mesh<2> whole = joined_pieces(skeleton.fine, meshed);
  for (const auto& [i, j] : crossing_triangles(whole.points, whole.elements, {}, run))
    crossings.push_back(describe_crossing(whole.points, whole.elements, whole.tags,
                                          static_cast<std::size_t>(i), static_cast<std::size_t>(j)));
  return crossings;
}

/// In D = 3 crossings are removed before pieces are meshed, and tetrahedra inside a boundary without
/// crossings do not cross.
inline std::vector<surface_crossing> crossings_of_pieces(const any_geometry&, const realized<3>&,
                                                         const meshed_pieces<3>&, const any_executor&) {
  return {};
}

} // namespace detail

/// The rounds in which pieces are made again where finished ones cross, with a smaller size there.
class piece_crossing_rounds {
public:
  piece_crossing_rounds(const any_sizing& size, int most_rounds)
      : size_(size), refinement_(size, most_rounds) {}

  /// The field for the pieces to be made next.
  const any_sizing& size() const { return size_; }
  /// Its key.
  content_key field() const { return refinement_.key({}); }

  /// Whether the pieces are fit to be kept; otherwise `size` is smaller afterwards. Pieces that failed are
  /// left to whoever deals with failures. Throws `intersection_error` naming two CAD faces that cross when
  /// all rounds are used up.
  template <int D>
  bool accept(const any_geometry& model, const realized<D>& skeleton, const meshed_pieces<D>& meshed,
              const any_parameters<D>& given) {
    if (!meshed.failures.empty())
      return true;
    const stopwatch clock;
    const auto crossings = detail::crossings_of_pieces(model, skeleton, meshed, given.run_tasks);
    crossings_ += static_cast<double>(crossings.size());
    seconds_ += clock.seconds();
    if (crossings.empty())
      return true;
    size_ = refinement_.refine(crossings, model.topology());
    ++refinements_;
    return false;
  }

  void add_to(report& intersection) const {
    intersection.add("crossings", crossings_);
    intersection.add("refinements", refinements_);
    intersection.seconds += seconds_;
  }

private:
  any_sizing size_;
  crossing_refinement refinement_;
  double crossings_ = 0, refinements_ = 0, seconds_ = 0;
};

} // namespace dovetail
