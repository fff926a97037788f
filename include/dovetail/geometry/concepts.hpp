/// @file
/// What the pipeline asks of a CAD model, and the plain data that describes one.
#pragma once

#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <array>
#include <concepts>
#include <optional>
#include <string>
#include <vector>

namespace dovetail {

/// Point and derivative of a curve.
struct curve_frame {
  vec3 point;      ///< on the curve
  vec3 derivative; ///< by the parameter
};

/// Point and first derivatives of a surface; the parametric normal is along cross(du, dv).
struct surface_frame {
  vec3 point; ///< on the surface
  vec3 du;    ///< by the first parameter
  vec3 dv;    ///< by the second parameter
};

/// The entities of a model and how they bound each other, as plain data.
struct geometry_topology {
  /// An end of curves.
  struct vertex {
    vec3 point;           ///< where it is
    double tolerance = 0; ///< how far from it the ends of its curves may be
  };
  /// An edge of the model.
  struct curve {
    std::array<local_id, 2> vertices{no_id, no_id}; ///< at t[0] and t[1]; equal for a closed curve
    std::array<double, 2> t{0, 0};                  ///< parameter range, t[0] < t[1]
    double tolerance = 0;                           ///< the largest distance between the curve and its faces
    bool degenerate = false;                        ///< a pole: one point, a line in parameter space
    std::string name = {};                          ///< what the file calls it; may be empty
  };
  /// One passage of a face's boundary along a curve, in the order and direction that keeps the domain in the
  /// *parameter plane* on the left.
  struct coedge {
    local_id curve = no_id; ///< the number of the curve
    bool reversed = false;  ///< run from t[1] to t[0]
  };
  /// A trimmed surface.
  struct face {
    std::vector<std::vector<coedge>> loops; ///< the outer loop and the holes, in any order
    std::vector<coedge> coedges; ///< all coedges of all loops, in loop order; `curve_uv` indexes these
    bool reversed = false;       ///< the oriented surface is opposite to the parametric normal
    std::array<local_id, 2> solids{no_id,
                                   no_id}; ///< [0] behind the oriented normal (inside), [1] in front of it
    double tolerance = 0;                  ///< how far from it its curves may be
    std::string name = {};                 ///< what the file calls it; may be empty
    std::string group = {}; ///< the group of faces that it belongs to: name, layer or colour it carries in
                            ///< the file; may be empty
  };
  /// A body bounded by faces.
  struct solid {
    std::string name = {}; ///< what the file calls it; may be empty
  };

  std::vector<vertex> vertices; ///< by number
  std::vector<curve> curves;    ///< by number
  std::vector<face> faces;      ///< by number
  std::vector<solid> solids;    ///< by number
};

/// The role `geometry_model`: what the pipeline asks of a CAD model.
///
/// Valid expressions for `const G& g`, indices `local_id f` of a face and `c` of a curve, `vec2 uv`, `double
/// t`, `vec3 p`:
///
/// - `g.topology()`: const geometry_topology&; vertices, curves, faces, solids as plain data
/// - `g.curve_point(c, t)`: vec3; point of a curve
/// - `g.curve_frame(c, t)`: curve_frame; point and first derivative
/// - `g.curve_uv(f, k, t)`: vec2; parameters on face f of the point t of its coedge k (index into the face's
/// coedges)
/// - `g.face_point(f, uv)`: vec3; point of a face's surface
/// - `g.face_frame(f, uv)`: surface_frame; point and both first derivatives
/// - `g.face_curvature(f, uv)`: largest absolute principal curvature, 1 / length
/// - `g.project_to_face(f, p, uv)`: vec2; parameters of the point of the surface nearest p, started from the
/// seed uv
/// - `g.project_to_curve(c, p, t)`: parameter of the point of the curve nearest p, started from the seed t
/// - `g.bounds()`: box3 of the model
/// - `g.thread_safe()`: whether queries may run in several threads at once
///
/// Semantics: a face's parameter plane is one planar domain on the left of its coedges' parameter curves.
/// Seams and poles cut a periodic face open: a seam is passed twice, a pole is a coedge whose curve is
/// degenerate. Queries may run in several processes. A copy is cheap, and may be queried in another thread
/// whatever `thread_safe()` is.
///
/// Complexity: constant; a projection takes a few Newton steps from its seed and never searches globally.
///
/// Failure: a query throws `geometry_error` naming the entity when the kernel cannot evaluate it. What a
/// model gives is taken as it is; `any_geometry` holds one and checks its topology, points and errors.
///
/// Models: occt_model, discrete_model, curved_model, implicit_model, plane_domain, virtual_model,
/// any_geometry.
template <class G>
concept geometry_model = std::copy_constructible<G> &&
    requires(const G& g, local_id id, int k, vec2 uv, vec3 p, double t) {
  { g.topology() } -> std::convertible_to<const geometry_topology&>;
  { g.curve_point(id, t) } -> std::same_as<vec3>;
  { g.curve_frame(id, t) } -> std::same_as<curve_frame>;
  { g.curve_uv(id, k, t) } -> std::same_as<vec2>;
  { g.face_point(id, uv) } -> std::same_as<vec3>;
  { g.face_frame(id, uv) } -> std::same_as<surface_frame>;
  { g.face_curvature(id, uv) } -> std::convertible_to<double>;
  { g.project_to_face(id, p, uv) } -> std::same_as<vec2>;
  { g.project_to_curve(id, p, t) } -> std::convertible_to<double>;
  { g.bounds() } -> std::same_as<box3>;
  { g.thread_safe() } -> std::convertible_to<bool>;
};

/// The role `geometry_model_with_planes`: a model that knows which of its faces are planes.
///
/// Valid expressions for `const G& g`, `local_id f`: those of `geometry_model<G>` and
///
/// - `g.plane_of_face(f)`: std::optional<surface_frame>; a point of the plane, and two orthogonal unit
/// vectors in it
///
/// Semantics: the frame's cross(du, dv) is along the face's parametric normal. Nothing for a face that is not
/// known to be a plane. On a plane points are computed without queries, and pieces of one plane (D = 2) are
/// not searched for crossings.
///
/// Complexity: constant.
///
/// Failure: none.
///
/// Models: occt_model, plane_domain, any_geometry, virtual_model.
template <class G>
concept geometry_model_with_planes = geometry_model<G> && requires(const G& g, local_id id) {
  { g.plane_of_face(id) } -> std::same_as<std::optional<surface_frame>>;
};

/// The role `geometry_model_with_members`: a model whose faces may be several faces, its members, that are
/// met with again in the mesh.
///
/// Valid expressions for `const G& g`, `local_id f`, `vec3 p`: those of `geometry_model<G>` and
///
/// - `g.face_at(f, p)`: local_id; the member of face f that is nearest p
/// - `g.whole_face(f)`: local_id; the face that a member is a part of
///
/// Semantics: members have numbers of faces. A face that is not several is its only member. Triangles of the
/// mesh of solids have numbers of members.
///
/// Complexity: constant, or log n.
///
/// Failure: none.
///
/// Models: any_geometry, virtual_model.
template <class G>
concept geometry_model_with_members = geometry_model<G> && requires(const G& g, local_id id, vec3 p) {
  { g.face_at(id, p) } -> std::same_as<local_id>;
  { g.whole_face(id) } -> std::same_as<local_id>;
};

/// The plane of a face, as `geometry_model_with_planes` has it; nothing of a model that knows no planes.
/// \param model a model
/// \param face the number of a face
template <geometry_model G>
std::optional<surface_frame> plane_of_face([[maybe_unused]] const G& model, [[maybe_unused]] local_id face) {
  if constexpr (geometry_model_with_planes<G>)
    return model.plane_of_face(face);
  else
    return std::nullopt;
}

/// The member of a face at a point, as `geometry_model_with_members` has it; the face, of other models.
/// \param model a model
/// \param face the number of a face
/// \param p a point of that face, or near it
template <geometry_model G>
local_id face_at([[maybe_unused]] const G& model, local_id face, [[maybe_unused]] vec3 p) {
  if constexpr (geometry_model_with_members<G>)
    return model.face_at(face, p);
  else
    return face;
}

/// The face that a member is a part of, as `geometry_model_with_members` has it; the member, of other models.
/// \param model a model
/// \param member the number of a face
template <geometry_model G>
local_id whole_face([[maybe_unused]] const G& model, local_id member) {
  if constexpr (geometry_model_with_members<G>)
    return model.whole_face(member);
  else
    return member;
}

} // namespace dovetail
