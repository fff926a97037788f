/// @file
/// A model without the details that are far smaller than the size.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/models/virtual/suppressed_detail.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace dovetail {

/// What of a model is a detail.
struct virtual_options {
  double share_of_size = 0.25; ///< edges up to this share of the size there, and faces so narrow, are details
  double share_of_folded =
      1; ///< the same, if it is larger and the other is not 0, for faces between two that
         ///< go on along each other, where the surface goes there, back and there again
  double share_of_joined = 1;   ///< faces up to this share of the size wide, or with so short an edge between
                                ///< them, are one with a face that they go on into smoothly; 0: none, as
                                ///< D = 2 wants it, where faces are what is meshed
  double most_turn_deg = 40;    ///< a face that turns by more within that share of the size is not joined:
                                ///< elements that need not follow its edges would cut its corner off
  double least_angle_deg = 40;  ///< what would leave a sharper edge between faces behind stays,
                                ///< unless these are the walls of a slit: nothing is meshed there
  double least_corner_deg = 28; ///< what would leave a sharper corner of a face behind stays
  std::vector<local_id> kept_faces = {}; ///< whose boundaries stay as they are
};

/// How much of a model was suppressed.
struct suppression_counts {
  std::size_t narrow_faces = 0; ///< faces that are curves
  std::size_t narrow_ends = 0;  ///< of faces that stay
  std::size_t narrow_gaps = 0;  ///< between two edges of a solid, where they begin
  std::size_t short_edges = 0;  ///< edges that are vertices
  std::size_t joined_faces = 0; ///< faces that are one with another
  double largest = 0;           ///< the widest face, or the longest edge, of those that are left out

  using fields = field_list<&suppression_counts::narrow_faces, &suppression_counts::narrow_ends,
                            &suppression_counts::narrow_gaps, &suppression_counts::short_edges,
                            &suppression_counts::joined_faces, &suppression_counts::largest>;
};

/// Any `geometry_model` as it is meant at the sizes given: faces far narrower than the size are the curves
/// along which their neighbours meet, edges far shorter than it are vertices. Numbers of faces and curves are
/// those of the model that is wrapped: what is suppressed has a number and no boundary, and curves that were
/// split come after the others; vertices are renumbered. Points inside of faces are on the model's surfaces.
/// Points on curves are on the model's curves, but near a vertex that is elsewhere now, to which they bend;
/// how far the faces are from them at most is in `tolerance`. Faces that go on smoothly into each other are
/// one where one of them is narrower than the size: it has the number of the largest, and coordinates of a
/// plane as parameters; which of the model's faces is at a point tells `face_at`. After the virtual
/// operations of CAD-based meshing (A. Sheffer, T. Blacker, M. Bercovier, "Virtual topology operators for
/// meshing", 2000).
///
/// Copies are cheap. Queries take what the model's take, and a projection to a curve where a face ends at
/// another's. Thread-safe as the model.
class virtual_model {
public:
  /// Throws what queries of the model throw, and `sizing_error` for options out of range.
  /// \param model the model
  /// \param size lengths in the model's unit, by point
  /// \param options what is a detail
  virtual_model(any_geometry model, const any_sizing& size, const virtual_options& options = {});

  const geometry_topology& topology() const;
  box3 bounds() const { return model_.bounds(); }
  bool thread_safe() const { return model_.thread_safe(); }

  vec3 curve_point(local_id c, double t) const;
  dovetail::curve_frame curve_frame(local_id c, double t) const;
  vec2 curve_uv(local_id f, int k, double t) const;
  vec3 face_point(local_id f, vec2 uv) const;
  surface_frame face_frame(local_id f, vec2 uv) const;
  double face_curvature(local_id f, vec2 uv) const;
  vec2 project_to_face(local_id f, vec3 p, vec2 seed) const;
  double project_to_curve(local_id c, vec3 p, double seed) const;
  std::optional<surface_frame> plane_of_face(local_id f) const;

  /// The face of the model as drawn that is at a point of face f: f, but for faces that are several.
  local_id face_at(local_id f, vec3 p) const;
  /// The face that one of the model as drawn is a part of: f, but for faces that were joined to another.
  local_id whole_face(local_id f) const;

  /// What it does not have, in the order in which it was given up.
  const std::vector<suppressed_detail>& suppressed() const;
  /// `suppression_counts`.
  report summary() const;

private:
  struct data;

  any_geometry model_;
  std::shared_ptr<const data> data_;
};

static_assert(geometry_model_with_planes<virtual_model> && geometry_model_with_members<virtual_model>);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/virtual_model.ipp"
#endif
