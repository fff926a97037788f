// error: g\.project_to_face\(id, p, uv\).*invalid|no matching member function
#include "dovetail/geometry/concepts.hpp"

struct my_geometry {
  const dovetail::geometry_topology& topology() const;
  dovetail::vec3 curve_point(dovetail::local_id, double) const;
  dovetail::curve_frame curve_frame(dovetail::local_id, double) const;
  dovetail::vec2 curve_uv(dovetail::local_id, int, double) const;
  dovetail::vec3 face_point(dovetail::local_id, dovetail::vec2) const;
  dovetail::surface_frame face_frame(dovetail::local_id, dovetail::vec2) const;
  double face_curvature(dovetail::local_id, dovetail::vec2) const;
#ifdef CORRECT
  dovetail::vec2 project_to_face(dovetail::local_id, dovetail::vec3, dovetail::vec2) const;
#else
  dovetail::vec2 project_to_face(dovetail::local_id, dovetail::vec3) const;
#endif
  double project_to_curve(dovetail::local_id, dovetail::vec3, double) const;
  dovetail::box3 bounds() const;
  bool thread_safe() const;
};

template <dovetail::geometry_model G>
void use(const G&) {}

void call() {
  use(my_geometry{});
}
