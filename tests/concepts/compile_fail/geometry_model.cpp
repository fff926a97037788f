// near miss 1: projection takes no seed
// error 1: g\.project_to_face\(id, p, uv\).*invalid|no matching member function|too many arguments
// near miss 2: a frame is only a point
// error 2: g\.face_frame\(id, uv\).*return-type|(constraint|because) 'std::same_as<(dovetail::)?vec3
// near miss 3: it does not say whether threads may share it
// error 3: g\.thread_safe\(\).*invalid|no member named 'thread_safe'
// near miss 4: curves have no parameters on their faces
// error 4: g\.curve_uv\(id, k, t\).*invalid|no member named 'curve_uv'
// near miss 5: it cannot be copied, so each thread cannot have its own
// error 5: (copy_constructible|is_constructible)
#include "dovetail/geometry/concepts.hpp"

using namespace dovetail;

struct my_geometry {
#if NEAR_MISS == 5
  my_geometry(const my_geometry&) = delete;
#endif
  const geometry_topology& topology() const;
  vec3 curve_point(local_id, double) const;
  dovetail::curve_frame curve_frame(local_id, double) const;
  vec3 face_point(local_id, vec2) const;
  double face_curvature(local_id, vec2) const;
  double project_to_curve(local_id, vec3, double) const;
  box3 bounds() const;
#if NEAR_MISS == 1
  vec2 project_to_face(local_id, vec3) const;
#else
  vec2 project_to_face(local_id, vec3, vec2) const;
#endif
#if NEAR_MISS == 2
  vec3 face_frame(local_id, vec2) const;
#else
  surface_frame face_frame(local_id, vec2) const;
#endif
#if NEAR_MISS != 3
  bool thread_safe() const;
#endif
#if NEAR_MISS != 4
  vec2 curve_uv(local_id, int, double) const;
#endif
};

template <geometry_model G>
void use(const G&) {}

template <class T>
const T& declared();

void call() {
  use(declared<my_geometry>());
}
