/// @file
/// What `kept_background.hpp` declares.
#pragma once

#include "dovetail/core/content_key.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/pipeline/kept_background.hpp"

namespace dovetail::detail {

DOVETAIL_INLINE content_key background_key(int dimension, const any_geometry& model,
                                           const erased_sizing& size) {
  const box3 box = model.bounds();
  key_maker make;
  make(std::int64_t{dimension})(static_cast<std::int64_t>(model.topology().faces.size()));
  for (const vec3 p : {box.lower, box.center(), box.upper})
    make(p.x)(p.y)(p.z)(size(p));
  for (const auto& face : model.topology().faces) // details of one model may be left out, or not
    for (const auto& coedge : face.coedges)
      make(std::int64_t{coedge.curve});
  return make.key();
}

} // namespace dovetail::detail
