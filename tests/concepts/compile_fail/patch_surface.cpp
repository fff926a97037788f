// near miss 1: it gives points without derivatives
// error 1: s\.frame\(uv\).*return-type|(constraint|because) 'std::same_as<(dovetail::)?vec3
// near miss 2: points cannot be projected on it
// error 2: s\.project\(p, uv\).*invalid|no member named 'project'
// near miss 3: it takes no seed
// error 3: s\.project\(p, uv\).*invalid|too many arguments
#include "dovetail/remesh/patch.hpp"

struct my_surface {
#if NEAR_MISS == 1
  dovetail::vec3 frame(dovetail::vec2) const;
#else
  dovetail::surface_frame frame(dovetail::vec2) const;
#endif
#if NEAR_MISS == 3
  dovetail::vec2 project(dovetail::vec3) const;
#elif NEAR_MISS != 2
  dovetail::vec2 project(dovetail::vec3, dovetail::vec2) const;
#endif
};

template <dovetail::patch_surface S>
void use(const S&) {}

void call() {
  use(my_surface{});
}
