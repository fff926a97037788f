/// @file
/// The box around a model, by samples that are driven to the extremes.
#pragma once

#include "dovetail/models/occt/topology.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace dovetail::occt {

/// Where a face is in its parameter plane: its loops as polygons.
class face_region {
public:
  face_region(const brep& data, std::size_t face) {
    constexpr int samples = 16;
    std::size_t k = 0;
    for (const auto& loop : data.topology.faces[face].loops) {
      std::vector<vec2>& polygon = polygons_.emplace_back();
      for (std::size_t end = k + loop.size(); k < end; ++k) {
        const coedge_curve& curve = data.coedges[face][k];
        const auto& range = curve.edge_range();
        for (int i = 0; i < samples; ++i) {
          const double s = static_cast<double>(curve.reversed() ? samples - i : i) / samples;
          polygon.push_back(curve.at(range[0] + s * (range[1] - range[0]), data.surfaces[face]));
        }
      }
    }
  }

  /// Even-odd rule along a line of constant v.
  bool contains(vec2 p) const {
    bool inside = false;
    for (const auto& polygon : polygons_) {
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
          inside = !inside;
      }
    }
    return inside;
  }

private:
  std::vector<std::vector<vec2>> polygons_;
};

/// Walks from `uv` inside the face as long as the coordinate along `axis` times `sign` grows.
inline vec3 climbed(const face_surface& surface, const face_region& region, vec2 uv, int axis, double sign,
                    vec2 step) {
  vec3 best = surface.point(uv);
  for (int round = 0; round < 12;) {
    bool moved = false;
    for (const vec2 by : {vec2{step.x, 0}, vec2{-step.x, 0}, vec2{0, step.y}, vec2{0, -step.y}}) {
      const vec3 p = surface.point(uv + by);
      if (sign * (p[axis] - best[axis]) > 0 && region.contains(uv + by)) {
        uv = uv + by, best = p, moved = true;
        break;
      }
    }
    if (!moved) {
      step = 0.5 * step;
      ++round;
    }
  }
  return best;
}

/// The box around all faces and curves, right to about 1e-6 of its size. Far faster than OCCT's optimal box.
inline box3 bounds_of(const brep& data) {
  constexpr int curve_samples = 64, grid = 12;
  box3 box;
  for (const auto& vertex : data.topology.vertices)
    box.include(vertex.point);
  for (std::size_t c = 0; c < data.curves.size(); ++c) {
    const auto& curve = data.topology.curves[c];
    for (int i = 0; !curve.degenerate && i <= curve_samples; ++i)
      box.include(to_vec3(data.curves[c].Value(curve.t[0] + (curve.t[1] - curve.t[0]) * i / curve_samples)));
  }
  for (std::size_t f = 0; f < data.surfaces.size(); ++f) {
    const face_surface& surface = data.surfaces[f];
    if (surface.adaptor().GetType() == GeomAbs_Plane)
      continue; // its curves bound it
    const face_region region(data, f);
    const auto& rectangle = surface.box();
    const vec2 step{(rectangle[0][1] - rectangle[0][0]) / grid, (rectangle[1][1] - rectangle[1][0]) / grid};
    std::array<vec2, 6> seeds{};
    box3 reached;
    for (int i = 0; i < grid; ++i) {
      for (int j = 0; j < grid; ++j) {
        const vec2 uv{rectangle[0][0] + (i + 0.5) * step.x, rectangle[1][0] + (j + 0.5) * step.y};
        if (!region.contains(uv))
          continue;
        const vec3 p = surface.point(uv);
        for (int axis = 0; axis < 3; ++axis) {
          if (p[axis] < reached.lower[axis])
            reached.lower[axis] = p[axis], seeds[axis] = uv;
          if (p[axis] > reached.upper[axis])
            reached.upper[axis] = p[axis], seeds[static_cast<std::size_t>(axis) + 3] = uv;
        }
      }
    }
    for (int axis = 0; !reached.empty() && axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      box.include(climbed(surface, region, seeds[k], axis, -1, 0.5 * step));
      box.include(climbed(surface, region, seeds[k + 3], axis, 1, 0.5 * step));
    }
  }
  return box;
}

} // namespace dovetail::occt
