/// @file
/// Removal of a side between two elements: the 2-3 flip, or multi-face removal where a single one does not
/// help.
///
/// The side (x, y, z) lies between apexes a and b. All sides that lie between the same a and b form a patch;
/// a connected part of it is replaced by the edge (a, b) and one element per edge of the part's outline. The
/// part is grown from (x, y, z) where the outline's element is the worst (Shewchuk, as for edge removal).
#pragma once

#include "dovetail/improver/shape_measure.hpp"
#include "dovetail/improver/tetrahedra/local_change.hpp"

namespace dovetail::improvement {

/// The change that removes a side between two elements.
template <shape_measure Measure>
class face_removal {
public:
  static constexpr const char* name = "face removal"; ///< for reports

  /// For best_change: each side of `e`.
  template <class Offer>
  void propose(const tet_complex& mesh, local_id e, const Offer& offer) {
    for (int side = 0; side < 4 && offer.is_open(); ++side)
      offer([&](local_change& change) { return find(mesh, e, side, change); });
  }

  /// The best removal of side `side` of `e`, if it beats the elements it replaces; else false.
  bool find(const tet_complex& mesh, local_id e, int side, local_change& change) {
    if (mesh.is_fixed(e, side))
      return false;
    const half_side other = mesh.across(e, side);
    const local_id f = element_of(other);
    a_ = mesh.vertex(e, side);
    b_ = mesh.vertex(f, side_of(other));
    const float bar = std::min(mesh.value(e), mesh.value(f));
    change.clear();
    change.old.push(e);
    change.old.push(f);
    // The side's vertices, counter-clockwise seen from b: outwards of e.
    const auto& local = numbering::sides<3>[side];
    old_worst_ = bar;
    for (std::size_t k = 0; k < 3; ++k)
      if (!close(mesh, mesh.vertex(e, local[k]), mesh.vertex(e, local[(k + 1) % 3]), e, f, 0, change))
        return false;
    return change.worst > old_worst_;
  }

private:
  static constexpr int max_depth = 3;

  /// Adds the element (a, b, x, y) over the outline's edge (x, y), or those over the two further edges when
  /// the side behind (x, y) is between a and b as well and that is better. False when none beats the old
  /// ones.
  bool close(const tet_complex& mesh, local_id x, local_id y, local_id below, local_id above, int depth,
             local_change& change) {
    const auto value =
        static_cast<float>(measure_of<Measure>(mesh.point(a_), mesh.point(b_), mesh.point(x), mesh.point(y)));
    if (value > old_worst_)
      return change.add({a_, b_, x, y}, value);
    return depth < max_depth && grow(mesh, x, y, below, above, depth, change);
  }

  /// Takes the side behind the outline's edge (x, y) into the patch.
  bool grow(const tet_complex& mesh, local_id x, local_id y, local_id below, local_id above, int depth,
            local_change& change) {
    const half_side next_below = beyond(mesh, below, a_, x, y), next_above = beyond(mesh, above, b_, x, y);
    if (next_below == no_id || next_above == no_id)
      return false;
    const local_id e = element_of(next_below), f = element_of(next_above);
    const local_id z = mesh.vertex(e, side_of(next_below));
    if (mesh.vertex(f, side_of(next_above)) != z || e == f)
      return false;
    const int corner = mesh.corner_of(e, a_);
    if (mesh.is_fixed(e, corner) || mesh.across(e, corner) == no_id ||
        element_of(mesh.across(e, corner)) != f)
      return false;
    for (const local_id known : change.old)
      if (known == e || known == f)
        return false;
    if (change.old.size + 2 > 2 * max_shell)
      return false;
    change.old.push(e);
    change.old.push(f);
    old_worst_ = std::min({old_worst_, mesh.value(e), mesh.value(f)});
    return close(mesh, x, z, e, f, depth + 1, change) && close(mesh, z, y, e, f, depth + 1, change);
  }

  /// The half side across the side (apex, x, y) of `e`, or `no_id` when that is fixed.
  static half_side beyond(const tet_complex& mesh, local_id e, local_id apex, local_id x, local_id y) {
    for (int side = 0; side < 4; ++side) {
      const local_id v = mesh.vertex(e, side);
      if (v != apex && v != x && v != y)
        return mesh.is_fixed(e, side) ? no_id : mesh.across(e, side);
    }
    return no_id;
  }

  local_id a_ = no_id, b_ = no_id;
  float old_worst_ = 0;
};

} // namespace dovetail::improvement
