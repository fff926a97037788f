/// @file
/// A face as two long sides beside each other.
#pragma once

#include "dovetail/models/virtual/short_edges.hpp"

#include <array>
#include <optional>
#include <vector>

namespace dovetail::virtual_topology {

/// A curve as a side passes it.
struct side_curve {
  local_id curve = no_id; ///< by number
  bool forward = true;    ///< from t[0] to t[1]
};

/// A place on a side.
struct place_on_side {
  std::size_t curve = 0; ///< which of the side's
  double t = 0;          ///< parameter on that
  double distance = 0;   ///< from the point that was asked for
};

/// Curves that follow each other.
using side = std::vector<side_curve>;

/// Two sides that run the same way, and the short curves that join their starts and their ends, from the
/// first side to the second. A ring has no such curves, and sides that are closed.
struct strip {
  std::array<side, 2> sides;                 ///< as long as each other, about
  std::array<std::vector<local_id>, 2> ends; ///< the curves at the starts, and at the ends
  bool is_ring = false;                      ///< of two loops
  bool is_tip = false;                       ///< the face goes on where the sides end
};

/// The face as a strip, if its boundary is one: it turns back just twice, at a tip or along short curves; or
/// it is two loops. How far the sides are apart is not looked at.
std::optional<strip> strip_of_face(const editable_topology& topology, const limits& allowed, local_id f);

/// One end of a face's boundary: a loop turns back along itself there, at a tip or along short curves.
struct turn_back {
  std::size_t loop = 0;   ///< of the face
  std::size_t before = 0; ///< the last long coedge before it
  std::size_t after = 0;  ///< the first one behind it
};

/// All ends of a face.
std::vector<turn_back> turns_of_face(const editable_topology& topology, const limits& allowed, local_id f);

/// The sides at one end of a face as far as they are not further apart than the least limit along it, the
/// curves split there; nothing where that is less than three widths or one limit long. The topology is
/// changed in either case.
std::optional<strip> narrow_end(editable_topology& topology, const limits& allowed, local_id f,
                                const turn_back& turn);

/// The same of two curves that leave one vertex beside each other, each run from there.
std::optional<strip> narrow_gap(editable_topology& topology, const limits& allowed, const side_curve& first,
                                const side_curve& second);

/// Whether a face is a narrow strip, or has a narrow end, that ends at a curve.
bool has_narrow_end_at(const editable_topology& topology, const limits& allowed, local_id f, local_id c);

/// The vertices of a side from its start to its end: one more than curves.
/// \param topology that its curves are of
/// \param one a side, of one curve or more
std::vector<local_id> vertices_of(const editable_topology& topology, const side& one);

/// Splits a curve of a side, and the side there.
/// \param topology that its curves are of
/// \param one the side, which gets a curve more
/// \param where a place inside of a curve
void split(editable_topology& topology, side& one, const place_on_side& where);

/// Whether a place is inside of its curve, so that it can be split there.
/// \param topology that its curves are of
/// \param allowed the limits
/// \param one the side
/// \param where a place on it
bool is_inside(const editable_topology& topology, const limits& allowed, const side& one,
               const place_on_side& where);

/// The nearest point of a side. Linear in its curves.
/// \param topology that its curves are of
/// \param one the side
/// \param p a point
place_on_side nearest_on(const editable_topology& topology, const side& one, vec3 p);

/// The largest distance of a side from the other one, at samples; nothing where it exceeds the limit.
std::optional<double> width_of(const editable_topology& topology, const limits& allowed, const strip& narrow);

} // namespace dovetail::virtual_topology

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/virtual/strip.ipp"
#endif
