/// @file
/// Edges too short to be anything but rounding: their two vertices become one.
#pragma once

#include "dovetail/models/occt/brep.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace dovetail::occt {

/// Collapses all edges shorter than a length. On a face where such an edge spans a part of the parameter
/// plane it becomes a pole; elsewhere its coedge goes, and the loop is closed over it. Faces and loops that
/// lose all their coedges go as well. Numbers of vertices and curves stay gapless and in order.
class small_edge_collapse {
public:
  small_edge_collapse(brep& data, double length) : data_(data), length_(length) {}

  /// Returns the number of edges collapsed.
  std::size_t run() {
    find_short_edges();
    if (count_ == 0)
      return 0;
    merge_vertices();
    for (std::size_t f = 0; f < data_.faces.size(); ++f)
      drop_coedges(f);
    drop_empty_faces();
    drop_unused_curves();
    drop_unused_vertices();
    return count_;
  }

private:
  static constexpr double no_extent = 1e-3; // of the face's rectangle
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  void find_short_edges() {
    const auto& curves = data_.topology.curves;
    short_.assign(curves.size(), false);
    for (std::size_t c = 0; c < curves.size(); ++c) {
      if (curves[c].degenerate || curve_length(c) > length_)
        continue;
      short_[c] = true;
      ++count_;
    }
  }

  double curve_length(std::size_t c) const {
    constexpr int samples = 8;
    const auto& t = data_.topology.curves[c].t;
    double length = 0;
    vec3 before = to_vec3(data_.curves[c].Value(t[0]));
    for (int i = 1; i <= samples; ++i) {
      const vec3 now = to_vec3(data_.curves[c].Value(t[0] + (t[1] - t[0]) * i / samples));
      length += distance(before, now);
      before = now;
    }
    return length;
  }

  /// Every vertex gets the first one it is joined to.
  void merge_vertices() {
    auto& topology = data_.topology;
    std::vector<local_id> root(topology.vertices.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](local_id v) {
      while (root[v] != v)
        v = root[v];
      return v;
    };
    for (std::size_t c = 0; c < short_.size(); ++c) {
      if (!short_[c])
        continue;
      const local_id a = find(topology.curves[c].vertices[0]), b = find(topology.curves[c].vertices[1]);
      root[std::max(a, b)] = std::min(a, b);
      auto& kept = topology.vertices[std::min(a, b)];
      kept.tolerance = std::max(kept.tolerance, length_);
      topology.curves[c].degenerate = true;
    }
    for (auto& curve : topology.curves)
      for (local_id& v : curve.vertices)
        v = find(v);
    for (std::size_t c = 0; c < short_.size(); ++c)
      if (short_[c])
        data_.collapsed.emplace_back(data_.edges[c], topology.curves[c].vertices[0]);
  }

  void drop_coedges(std::size_t f) {
    auto& face = data_.topology.faces[f];
    const face_surface& surface = data_.surfaces[f];
    const auto& box = surface.box();
    std::vector<std::vector<geometry_topology::coedge>> loops;
    std::vector<std::vector<coedge_curve>> loop_curves;
    std::size_t k = 0;
    bool changed = false;
    for (const auto& loop : face.loops) {
      std::vector<geometry_topology::coedge> kept;
      std::vector<coedge_curve> kept_curves;
      const bool is_point = std::all_of(loop.begin(), loop.end(), [&](const auto& coedge) {
        return short_[coedge.curve] || data_.topology.curves[coedge.curve].degenerate;
      });
      for (const auto& coedge : loop) {
        const coedge_curve& curve = data_.coedges[f][k++];
        const vec2 extent = curve.end(surface) - curve.start(surface);
        const bool spans = std::abs(extent.x) > no_extent * (box[0][1] - box[0][0]) ||
                           std::abs(extent.y) > no_extent * (box[1][1] - box[1][0]);
        const bool drop = is_point || (short_[coedge.curve] && !spans);
        changed = changed || drop;
        if (drop)
          continue;
        kept.push_back(coedge);
        kept_curves.push_back(curve);
      }
      if (kept.empty())
        continue;
      loops.push_back(std::move(kept));
      loop_curves.push_back(std::move(kept_curves));
    }
    if (!changed)
      return;
    face.loops = std::move(loops);
    face.coedges.clear();
    data_.coedges[f].clear();
    for (std::size_t l = 0; l < face.loops.size(); ++l) {
      close_gaps(loop_curves[l], surface);
      face.coedges.insert(face.coedges.end(), face.loops[l].begin(), face.loops[l].end());
      data_.coedges[f].insert(data_.coedges[f].end(), loop_curves[l].begin(), loop_curves[l].end());
    }
  }

  void drop_empty_faces() {
    std::size_t kept = 0;
    for (std::size_t f = 0; f < data_.faces.size(); ++f) {
      if (data_.topology.faces[f].coedges.empty())
        continue;
      if (kept != f) {
        data_.topology.faces[kept] = std::move(data_.topology.faces[f]);
        data_.faces[kept] = data_.faces[f];
        data_.surfaces[kept] = data_.surfaces[f];
        data_.coedges[kept] = std::move(data_.coedges[f]);
      }
      ++kept;
    }
    data_.topology.faces.resize(kept);
    data_.faces.resize(kept);
    data_.surfaces.resize(kept);
    data_.coedges.resize(kept);
  }

  void drop_unused_curves() {
    std::vector<bool> used(data_.edges.size(), false);
    for (const auto& face : data_.topology.faces)
      for (const auto& coedge : face.coedges)
        used[coedge.curve] = true;
    std::vector<std::size_t> number(used.size(), none);
    std::size_t kept = 0;
    for (std::size_t c = 0; c < used.size(); ++c) {
      if (!used[c])
        continue;
      number[c] = kept;
      data_.topology.curves[kept] = data_.topology.curves[c];
      data_.edges[kept] = data_.edges[c];
      data_.curves[kept] = data_.curves[c];
      ++kept;
    }
    data_.topology.curves.resize(kept);
    data_.edges.resize(kept);
    data_.curves.resize(kept);
    const auto renumber = [&](geometry_topology::coedge& coedge) {
      coedge.curve = static_cast<local_id>(number[coedge.curve]);
    };
    for (auto& face : data_.topology.faces) {
      std::for_each(face.coedges.begin(), face.coedges.end(), renumber);
      for (auto& loop : face.loops)
        std::for_each(loop.begin(), loop.end(), renumber);
    }
  }

  void drop_unused_vertices() {
    auto& topology = data_.topology;
    std::vector<bool> used(topology.vertices.size(), false);
    for (const auto& curve : topology.curves)
      for (const local_id v : curve.vertices)
        used[v] = true;
    std::vector<local_id> number(used.size(), no_id);
    std::size_t kept = 0;
    for (std::size_t v = 0; v < used.size(); ++v) {
      if (!used[v])
        continue;
      number[v] = static_cast<local_id>(kept);
      topology.vertices[kept++] = topology.vertices[v];
    }
    topology.vertices.resize(kept);
    for (auto& curve : topology.curves)
      for (local_id& v : curve.vertices)
        v = number[v];
    for (auto& [edge, v] : data_.collapsed)
      v = number[v];
  }

  brep& data_;
  double length_;
  std::vector<bool> short_;
  std::size_t count_ = 0;
};

} // namespace dovetail::occt
