/// @file
/// What of a model was taken away before it is meshed.
#pragma once

#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <cstdint>
#include <string_view>

namespace dovetail {

/// A detail of a model that a `virtual_model` does not have.
struct suppressed_detail {
  /// What it is, and what it became.
  enum class kind : std::uint8_t {
    narrow_face, ///< a face that became a curve, or a vertex
    narrow_end,  ///< the end of a face, which became a curve
    narrow_gap,  ///< where two edges of a solid begin beside each other: they became one there
    short_edge,  ///< an edge that became a vertex
    joined_face  ///< a face that is one with a neighbour, which it goes on into smoothly
  };
  kind what = kind::narrow_face; ///< what it is
  local_id entity = no_id;       ///< its number in the model that was given
  vec3 place{};                  ///< a point of it
  double length = 0;             ///< the face's largest width, the edge's length; of joined faces that of the
                                 ///< narrower one, or of the edge that was between them
};

/// A few words, such as "narrow face".
inline std::string_view name_of(suppressed_detail::kind what) {
  switch (what) {
  case suppressed_detail::kind::narrow_face:
    return "narrow face";
  case suppressed_detail::kind::narrow_end:
    return "narrow end of a face";
  case suppressed_detail::kind::narrow_gap:
    return "narrow gap between edges";
  case suppressed_detail::kind::short_edge:
    return "short edge";
  case suppressed_detail::kind::joined_face:
    return "face joined to another";
  }
  return "";
}

} // namespace dovetail
