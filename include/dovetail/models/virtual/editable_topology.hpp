/// @file
/// The topology of a model while details of it are taken away: which of the model's own curves and coedges an
/// entity stands for.
#pragma once

#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/models/virtual/block_vector.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace dovetail::virtual_topology {

/// A coedge of the virtual model: one passage of a face along a curve that may not be the face's own.
struct virtual_coedge {
  local_id curve = no_id;     ///< of the virtual model
  bool reversed = false;      ///< run from t[1] to t[0] of that curve
  int own = 0;                ///< the coedge of the model's face that it follows in the parameter plane
  local_id own_curve = no_id; ///< the model's curve that this one passes along
  local_id own_face = no_id;  ///< the model's face: a member, where the face is a composite of several
  /// Ascending parameters of `curve`, and of `own_curve` beside them; empty where both are the same curve.
  std::vector<std::array<double, 2>> beside = {};
  /// Where the ends at t[0] and t[1] are in the parameter plane, if not where `own` says: the two ends of an
  /// edge that became a vertex.
  std::array<std::optional<vec2>, 2> corners = {};
};

/// One passage of a face.
struct passage {
  local_id face = no_id; ///< by number
  std::size_t loop = 0;  ///< of the face
  std::size_t place = 0; ///< in the loop
};

/// Entities keep the numbers that they have in the model, and those that curves are split into come after
/// them. What is taken away stays as a number: a face without loops, a curve without coedges. A value: a copy
/// is an attempt that can be dropped, and costs a small part of the model.
class editable_topology {
public:
  /// \param model stays, and is not copied
  explicit editable_topology(const any_geometry* model);

  /// The model that was given.
  const any_geometry& model() const { return *model_; }
  /// Those without loops too.
  std::size_t face_count() const { return loops_.size(); }
  /// Those that nothing passes along too.
  std::size_t curve_count() const { return curves_.size(); }
  /// A curve as it is now: its vertices may be others, and the model's curve go on beyond its parameters.
  const geometry_topology::curve& curve(local_id c) const { return curves_[c]; }
  /// A vertex, whether curves end there or not.
  const geometry_topology::vertex& vertex(local_id v) const { return vertices_[v]; }
  /// The model's curve that a curve lies on.
  local_id inner_curve(local_id c) const { return inner_curve_[c]; }
  /// The boundary of a face; none of one that is gone.
  const std::vector<std::vector<virtual_coedge>>& loops(local_id f) const { return loops_[f]; }
  /// What a face passes there.
  const virtual_coedge& at(const passage& p) const { return loops_[p.face][p.loop][p.place]; }

  /// Whether a face passes along a curve.
  bool is_used(local_id c) const { return passages_[c] > 0; }
  /// All that pass along a curve, face by face. Linear in the boundaries of these faces.
  std::vector<passage> passages_of(local_id c) const;
  /// Whether no curve has lost more than half of the distance between its ends.
  bool has_long_curves() const;
  /// Whether each coedge ends at the vertex where the next one of its loop starts.
  bool has_closed_loops() const;
  /// Whether a face is all that is left of a group that has a name: boundary conditions may be set on it.
  bool is_last_of_group(local_id f) const;
  /// How many curves end at a vertex; a closed curve counts twice.
  int curves_at(local_id v) const;

  /// The model's own point of a curve, wherever its ends are now.
  vec3 point(local_id c, double t) const { return model_->curve_point(inner_curve_[c], t); }
  /// The point in the middle of its parameters.
  vec3 middle(local_id c) const { return point(c, 0.5 * (curves_[c].t[0] + curves_[c].t[1])); }
  /// Points of a curve at even parameters, both ends included.
  std::vector<vec3> samples(local_id c, int count) const;
  /// Of the part of the model's curve, by its chords.
  double length(local_id c) const { return lengths_[c]; }
  /// Of all of a loop.
  double length_of_loop(const passage& p) const;
  /// The direction in which a passage runs at a share of its way, from 0 to 1; of unit length.
  vec3 direction(const virtual_coedge& coedge, double share) const;
  /// From a passage into the face, square to its direction and the face's normal, at such a share.
  vec3 inward(local_id face, const virtual_coedge& coedge, double share) const;
  /// Where a passage is in the parameter plane of the model's face.
  vec2 uv(const virtual_coedge& coedge, double t) const;
  /// The vertices where a passage starts and ends.
  std::array<local_id, 2> ends(const virtual_coedge& coedge) const;

  /// Splits a curve at a parameter inside of it; the part behind it is a new curve, whose number is returned.
  local_id split(local_id c, double t);
  /// Puts what ends at a vertex to another one, and remembers how far that is.
  void merge_vertices(local_id gone, local_id kept);
  /// Takes a passage out of its loop; its neighbours meet where the one is whose end is at `kept`.
  void drop(const passage& p, local_id kept);
  /// Makes a vertex of a curve: nothing passes along it, and its ends are at `kept`.
  void drop_all(local_id c, local_id kept);
  /// Takes curves that follow each other out of a face's loop; what is before and behind them meets where
  /// `kept` is, which one of the two ends at.
  void cut_out(local_id f, const std::vector<local_id>& curves, local_id kept);
  /// Lets all that passes along a curve pass along another one between the same vertices, `width` away; near
  /// its ends it may be as far away as these are.
  void replace_curve(local_id gone, local_id kept, bool same_direction, double width);
  /// Leaves a face without loops.
  void remove_face(local_id f);
  /// Gives a face the boundary of another one as well, which is left without loops.
  /// \param loops of both together
  void take_over(local_id f, local_id gone, std::vector<std::vector<virtual_coedge>> loops);

  /// How far what ends at a vertex is at most from where the model has it.
  double deviation_of_vertex(local_id v) const { return vertex_deviations_[v]; }
  /// How far what passes along a curve is at most from where the model has it.
  double deviation_of_curve(local_id c) const { return curve_deviations_[c]; }

  /// The entities as plain data: vertices without a curve are gone, curves without a passage degenerate.
  geometry_topology topology() const;

private:
  /// Counts a passage more of a face.
  void add_passage(local_id c, local_id f);
  double measured_length(local_id c) const;
  double measured_chord(local_id c) const {
    return distance(point(c, curves_[c].t[0]), point(c, curves_[c].t[1]));
  }

  const any_geometry* model_;
  block_vector<geometry_topology::vertex> vertices_;
  block_vector<geometry_topology::curve> curves_;
  block_vector<local_id> inner_curve_;
  block_vector<std::vector<std::vector<virtual_coedge>>> loops_; ///< by face
  block_vector<int> passages_;                                   ///< by curve: how many
  block_vector<std::vector<local_id>> faces_;                    ///< by curve: growing, those with a passage
                                                                 ///< and perhaps others
  block_vector<double> lengths_;                                 ///< by curve
  block_vector<double> chords_;                                  ///< by curve: between the model's own ends
  block_vector<double> vertex_deviations_, curve_deviations_;
};

/// The parameter on a coedge's own curve beside parameter t of the curve `inner` that it passes along.
double own_parameter(const any_geometry& model, local_id inner, const virtual_coedge& coedge, double t);

} // namespace dovetail::virtual_topology

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/virtual/editable_topology.ipp"
#endif
