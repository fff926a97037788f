/// @file
/// The vertices, curves and faces of a charted surface, as plain data of the geometry concept.
#pragma once

#include "dovetail/geometry/concepts.hpp"
#include "dovetail/models/discrete/charts.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail::discrete {

/// A curve of the model: mesh vertices in order, with the arc length up to each.
struct polyline {
  std::vector<local_id> vertices; ///< of the mesh; a closed curve ends where it starts
  std::vector<double> lengths;    ///< from the start to each vertex
  bool feature = false;           ///< false: only the end of a chart within a smooth area
};

/// What `topology_builder` makes: curve i of the topology is `curves[i]`, face i is chart i.
struct curve_network {
  geometry_topology topology;   ///< entities and how they bound each other
  std::vector<polyline> curves; ///< where the curves are
};

/// Joins the edges between charts to curves and charts' boundaries to loops of coedges.
class topology_builder {
public:
  topology_builder(const charted_surface& surface, const std::vector<std::string>& group_names,
                   double corner_angle_deg)
      : s_(surface), group_names_(group_names), corner_angle_(corner_angle_deg * radians_per_degree),
        neighbours_(element_neighbours(build_sides<2>(surface.mesh))) {}

  /// The curves and loops.
  curve_network run() {
    collect_edges();
    find_breaks();
    for (std::size_t e = 0; e < edges_.size(); ++e) // open curves first: they start at breaks
      for (std::size_t end = 0; end < 2; ++end)
        if (curve_of_[e] == no_id && breaks_[edges_[e].ends[end]])
          trace(e, end);
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (curve_of_[e] == no_id) {
        breaks_[edges_[e].ends[0]] = 1; // a closed curve needs one vertex
        trace(e, 0);
      }
    add_faces();
    for (local_id solid = 0; solid < solid_count(); ++solid)
      out_.topology.solids.push_back({"solid " + std::to_string(solid)});
    return std::move(out_);
  }

private:
  struct chart_edge {
    std::array<local_id, 2> ends; ///< sorted
    std::vector<local_id> charts; ///< sorted; no_id outside of a sheet
    bool feature;
  };

  vec3 point(local_id v) const { return s_.mesh.points[v]; }
  std::size_t across(std::size_t t, std::size_t i) const { return neighbours_[t][i]; }
  local_id solid_count() const {
    return 1 + std::max(*std::max_element(s_.solid_of.begin(), s_.solid_of.end()),
                        *std::max_element(s_.front_of.begin(), s_.front_of.end()));
  }

  void collect_edges() {
    for (std::size_t t = 0; t < s_.mesh.elements.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t other = across(t, i);
        const bool rim = other == nowhere;
        if (!rim && (other < t || s_.chart_of[t] == s_.chart_of[other]))
          continue;
        const local_id other_chart = rim ? no_id : s_.chart_of[other];
        const local_id a = s_.mesh.elements[t][(i + 1) % 3];
        const local_id b = s_.mesh.elements[t][(i + 2) % 3];
        edges_.push_back({{std::min(a, b), std::max(a, b)},
                          {std::min(s_.chart_of[t], other_chart), std::max(s_.chart_of[t], other_chart)},
                          rim || s_.smooth_of[t] != s_.smooth_of[other]});
      }
    std::sort(edges_.begin(), edges_.end(), [](const chart_edge& a, const chart_edge& b) {
      return std::tie(a.ends, a.charts) < std::tie(b.ends, b.charts);
    });
    join_repeated_edges();
    curve_of_.assign(edges_.size(), no_id);
    for (std::size_t e = 0; e < edges_.size(); ++e)
      for (const local_id v : edges_[e].ends)
        at_vertex_.emplace_back(v, e);
    std::sort(at_vertex_.begin(), at_vertex_.end());
  }

  /// Where more than two triangles meet, each has brought the edge.
  void join_repeated_edges() {
    std::vector<chart_edge> joined;
    for (chart_edge& e : edges_)
      if (!joined.empty() && joined.back().ends == e.ends)
        joined.back().charts.insert(joined.back().charts.end(), e.charts.begin(), e.charts.end());
      else
        joined.push_back(std::move(e));
    edges_ = std::move(joined);
  }

  std::pair<std::size_t, std::size_t> edges_at(local_id v) const {
    const auto less = [](const auto& a, local_id b) { return a.first < b; };
    const auto first = std::lower_bound(at_vertex_.begin(), at_vertex_.end(), v, less);
    const auto last = std::lower_bound(first, at_vertex_.end(), v + 1, less);
    return {static_cast<std::size_t>(first - at_vertex_.begin()),
            static_cast<std::size_t>(last - at_vertex_.begin())};
  }

  local_id other_end(std::size_t e, local_id v) const {
    return edges_[e].ends[0] == v ? edges_[e].ends[1] : edges_[e].ends[0];
  }

  /// Curves end where other than two edges meet, where the charts beside them change, where they turn
  /// sharply, and at given corners.
  void find_breaks() {
    breaks_.assign(s_.mesh.points.size(), 0);
    for (std::size_t k = 0; k < at_vertex_.size(); ++k) {
      const local_id v = at_vertex_[k].first;
      if (k > 0 && at_vertex_[k - 1].first == v)
        continue;
      const auto [first, last] = edges_at(v);
      bool ends = last - first != 2;
      if (!ends) {
        const std::size_t a = at_vertex_[first].second;
        const std::size_t b = at_vertex_[first + 1].second;
        const double turn =
            angle_between(point(v) - point(other_end(a, v)), point(other_end(b, v)) - point(v));
        const double sharp = edges_[a].feature ? corner_angle_ : 2 * corner_angle_;
        ends = edges_[a].charts != edges_[b].charts || edges_[a].feature != edges_[b].feature || turn > sharp;
      }
      breaks_[v] = ends ? 1 : 0;
    }
    for (const local_id v : s_.corners)
      breaks_[v] = 1;
  }

  local_id model_vertex(local_id v) {
    if (vertex_of_.empty())
      vertex_of_.assign(s_.mesh.points.size(), no_id);
    if (vertex_of_[v] == no_id) {
      vertex_of_[v] = static_cast<local_id>(out_.topology.vertices.size());
      out_.topology.vertices.push_back({point(v), 0});
    }
    return vertex_of_[v];
  }

  void trace(std::size_t e, std::size_t end) {
    polyline curve;
    curve.feature = edges_[e].feature;
    local_id at = edges_[e].ends[end];
    curve.vertices.push_back(at);
    curve.lengths.push_back(0);
    const auto id = static_cast<local_id>(out_.curves.size());
    while (true) {
      curve_of_[e] = id;
      const local_id next = other_end(e, at);
      curve.lengths.push_back(curve.lengths.back() + distance(point(at), point(next)));
      curve.vertices.push_back(next);
      at = next;
      if (breaks_[at])
        break;
      const auto [first, last] = edges_at(at);
      const std::size_t a = at_vertex_[first].second;
      e = a == e ? at_vertex_[last - 1].second : a;
    }
    geometry_topology::curve item;
    const local_id from = model_vertex(curve.vertices.front());
    item.vertices = {from, model_vertex(curve.vertices.back())};
    item.t = {0, curve.lengths.back()};
    item.name = curve.feature ? "" : "chart border";
    out_.topology.curves.push_back(item);
    out_.curves.push_back(std::move(curve));
  }

  std::size_t edge_between(local_id a, local_id b) const {
    const std::array<local_id, 2> ends{std::min(a, b), std::max(a, b)};
    const auto found = std::lower_bound(edges_.begin(), edges_.end(), ends,
                                        [](const chart_edge& e, const auto& key) { return e.ends < key; });
    return static_cast<std::size_t>(found - edges_.begin());
  }

  void add_faces() {
    std::vector<std::vector<std::size_t>> members(s_.frames.size());
    for (std::size_t t = 0; t < s_.chart_of.size(); ++t)
      members[s_.chart_of[t]].push_back(t);
    for (const auto& chart : members) {
      geometry_topology::face face;
      face.solids = {s_.solid_of[chart.front()], s_.front_of[chart.front()]};
      const local_id group = s_.group_of[chart.front()];
      face.group = group == no_id ? "" : group_names_[group];
      face.name = "surface " + std::to_string(s_.smooth_of[chart.front()]);
      for (const auto& loop : boundary_loops(s_.mesh.elements, s_.chart_of, chart,
                                             [&](std::size_t t, std::size_t i) { return across(t, i); }))
        face.loops.push_back(coedges_of(loop));
      for (const auto& loop : face.loops)
        face.coedges.insert(face.coedges.end(), loop.begin(), loop.end());
      out_.topology.faces.push_back(std::move(face));
    }
  }

  /// Runs of edges on one curve, begun at a vertex of the model.
  std::vector<geometry_topology::coedge> coedges_of(const std::vector<boundary_edge>& loop) const {
    std::size_t start = 0;
    while (start + 1 < loop.size() && !breaks_[loop[start].from])
      ++start;
    std::vector<geometry_topology::coedge> coedges;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const boundary_edge& e = loop[(start + k) % loop.size()];
      if (k > 0 && !breaks_[e.from])
        continue;
      const local_id id = curve_of_[edge_between(e.from, e.to)];
      const auto& vertices = out_.curves[id].vertices;
      const bool forward = vertices.front() == e.from && vertices[1] == e.to;
      coedges.push_back({id, !forward});
    }
    return coedges;
  }

  const charted_surface& s_;
  const std::vector<std::string>& group_names_;
  double corner_angle_;
  std::vector<std::array<local_id, 3>> neighbours_;
  std::vector<chart_edge> edges_; ///< sorted by their ends
  std::vector<local_id> curve_of_;
  std::vector<std::pair<local_id, std::size_t>> at_vertex_; ///< (vertex, edge), sorted
  std::vector<char> breaks_;                                ///< per vertex: curves end here
  std::vector<local_id> vertex_of_;                         ///< per mesh vertex: vertex of the model
  curve_network out_;
};

} // namespace dovetail::discrete
