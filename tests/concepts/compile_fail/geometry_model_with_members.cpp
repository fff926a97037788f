// near miss 1: it does not say what a member is a part of
// error 1: g\.whole_face\(id\).*invalid|no member named 'whole_face'
// near miss 2: nothing may be at a point
// error 2: g\.face_at\(id, p\).*return-type|std::same_as<std::optional<
// near miss 3: it is no geometry model
// error 3: g\.bounds\(\).*invalid|no member named 'bounds'
#include "dovetail/geometry/concepts.hpp"

using namespace dovetail;

struct my_geometry {
  const geometry_topology& topology() const;
  vec3 curve_point(local_id, double) const;
  dovetail::curve_frame curve_frame(local_id, double) const;
  vec2 curve_uv(local_id, int, double) const;
  vec3 face_point(local_id, vec2) const;
  surface_frame face_frame(local_id, vec2) const;
  double face_curvature(local_id, vec2) const;
  vec2 project_to_face(local_id, vec3, vec2) const;
  double project_to_curve(local_id, vec3, double) const;
  bool thread_safe() const;
#if NEAR_MISS != 3
  box3 bounds() const;
#endif
#if NEAR_MISS == 2
  std::optional<local_id> face_at(local_id, vec3) const;
#else
  local_id face_at(local_id, vec3) const;
#endif
#if NEAR_MISS != 1
  local_id whole_face(local_id) const;
#endif
};

template <geometry_model_with_members G>
void use(const G&) {}

template <class T>
const T& declared();

void call() {
  use(declared<my_geometry>());
}
