/// @file
/// What `composite_faces.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/models/virtual/composite_faces.hpp"
#include "dovetail/models/virtual/strip.hpp"
#include "dovetail/models/virtual/walls_at_faces.hpp"
#include "dovetail/remesh/constrained_triangulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

namespace dovetail::virtual_topology {

namespace detail {

using loops_of_face = std::vector<std::vector<virtual_coedge>>;

inline constexpr double least_cosine = 0.42; ///< of a chart's triangles to its plane

inline vec3 area_vector(const charted_triangle& t) {
  return 0.5 * cross(t.space[1] - t.space[0], t.space[2] - t.space[0]);
}

/// The direction from which the triangles are seen least obliquely, nearly; nothing where one of them is seen
/// too much so. Slivers have no direction of their own.
inline std::optional<vec3> direction_of(const std::vector<charted_triangle>& triangles) {
  constexpr double sliver = 1e-4; // of its length: its height
  constexpr double nearly_flat = 0.999;
  constexpr int steps = 200;
  std::vector<vec3> normals;
  vec3 sum;
  for (const charted_triangle& t : triangles) {
    const vec3 area = area_vector(t);
    sum += area;
    const double length = std::max({distance(t.space[0], t.space[1]), distance(t.space[1], t.space[2]),
                                    distance(t.space[2], t.space[0])});
    if (2 * norm(area) > sliver * length * length)
      normals.push_back(normalized(area));
  }
  if (normals.empty())
    return std::nullopt;
  const auto most_oblique = [&](vec3 n) {
    return *std::min_element(normals.begin(), normals.end(),
                             [n](vec3 a, vec3 b) { return dot(a, n) < dot(b, n); });
  };
  vec3 n = normalized(sum);
  if (dot(most_oblique(n), n) < nearly_flat) // as the centre of the smallest ball around points is found
    for (int step = 1; step <= steps; ++step)
      n = normalized(n + (most_oblique(n) - n) / (step + 1));
  return dot(most_oblique(n), n) >= least_cosine ? std::optional(n) : std::nullopt;
}

/// A union that may be.
struct joined_pair {
  local_id host = no_id, gone = no_id;
  loops_of_face loops;
  composite_chart chart;
};

/// Joins faces, one pair after the other.
class face_joiner {
public:
  face_joiner(editable_topology& topology, const limits& allowed, double most_turn_deg,
              const uv_of_passage& uv)
      : topology_(topology), allowed_(allowed), most_turn_(most_turn_deg / degrees_per_radian),
        triangles_(topology, uv, [&allowed](vec3 p) { return sag * allowed.length(p); }),
        walls_(topology.model(), allowed.length), members_(topology.face_count()),
        charts_(topology.face_count()), bent_(topology.face_count()), smooth_(topology.curve_count()) {
    for (std::size_t f = 0; f < members_.size(); ++f)
      members_[f] = {static_cast<local_id>(f)};
  }

  void run(std::vector<suppressed_detail>& found) {
    while (join_narrow(found) + join_at_short_edges(found) > 0)
      continue;
  }

  std::vector<composite_face> composites() {
    std::vector<composite_face> made;
    for (std::size_t f = 0; f < members_.size(); ++f)
      if (charts_[f]) {
        std::sort(members_[f].begin(), members_[f].end());
        made.push_back({static_cast<local_id>(f), members_[f], *charts_[f]});
      }
    return made;
  }

private:
  static constexpr double sag = 0.05; ///< of the limit

  const geometry_topology::face& face(local_id f) const { return topology_.model().topology().faces[f]; }

  /// How wide a face is at most, if it is narrow.
  std::optional<double> width_if_narrow(local_id f) const {
    const auto& loops = topology_.loops(f);
    if (const auto narrow = strip_of_face(topology_, allowed_, f))
      return width_of(topology_, allowed_, *narrow);
    double longest = 0;
    for (const auto& loop : loops)
      for (const virtual_coedge& coedge : loop) {
        if (!is_short(topology_, allowed_, coedge.curve))
          return std::nullopt;
        longest = std::max(longest, topology_.length(coedge.curve));
      }
    return loops.size() == 1 ? std::optional(longest) : std::nullopt;
  }

  /// The narrowest ones first.
  std::size_t join_narrow(std::vector<suppressed_detail>& found) {
    std::vector<std::pair<double, local_id>> waiting;
    for (std::size_t k = 0; k < topology_.face_count(); ++k)
      if (const auto f = static_cast<local_id>(k); may_be_joined(f))
        if (const auto width = width_if_narrow(f))
          waiting.emplace_back(*width, f);
    std::sort(waiting.begin(), waiting.end());
    std::size_t count = 0;
    for (const auto& [ignored, f] : waiting)
      if (const auto width = may_be_joined(f) ? width_if_narrow(f) : std::nullopt)
        count += join_to_first(f, *width, neighbours_of(f), found);
    return count;
  }

  std::size_t join_at_short_edges(std::vector<suppressed_detail>& found) {
    std::vector<std::pair<double, local_id>> waiting;
    for (std::size_t k = 0; k < topology_.curve_count(); ++k)
      if (const auto c = static_cast<local_id>(k); topology_.is_used(c) && !topology_.curve(c).degenerate &&
                                                   is_short(topology_, allowed_, c) && is_smooth(c))
        waiting.emplace_back(topology_.length(c), c);
    std::sort(waiting.begin(), waiting.end());
    std::size_t count = 0;
    for (const auto& [length, c] : waiting)
      if (topology_.is_used(c)) {
        const auto passages = topology_.passages_of(c);
        count += join_to_first(passages[0].face, length, {passages[1].face}, found);
      }
    return count;
  }

  bool is_in_thin_wall(local_id f) {
    return std::any_of(members_[f].begin(), members_[f].end(),
                       [&](local_id m) { return walls_.are_thin(m); });
  }

  bool may_be_joined(local_id f) const {
    const auto& kept = allowed_.kept_faces;
    return !topology_.loops(f).empty() && std::find(kept.begin(), kept.end(), f) == kept.end();
  }

  /// Whether two faces, and no other, meet along a curve all along, at less than 10 degrees.
  bool is_smooth(local_id c) {
    auto& known = smooth_[static_cast<std::size_t>(c)];
    if (!known)
      known = meets_smoothly(c);
    return *known;
  }
  bool meets_smoothly(local_id c) {
    constexpr double smooth = 10 / degrees_per_radian;
    const auto passages = topology_.passages_of(c);
    if (passages.size() != 2 || passages[0].face == passages[1].face || !triangles_.of_curve(c))
      return false;
    const virtual_coedge &one = topology_.at(passages[0]), &other = topology_.at(passages[1]);
    for (const virtual_coedge* coedge : {&one, &other}) // faces that were moved there need not touch
      if (!coedge->beside.empty() || coedge->corners[0] || coedge->corners[1])
        return false;
    const double same = face(one.own_face).reversed == face(other.own_face).reversed ? 1 : -1;
    const auto& t = *triangles_.of_curve(c);
    try {
      return std::all_of(t.begin(), t.end(), [&](double at) {
        return angle_between(triangles_.normal(one, at), same * triangles_.normal(other, at)) <= smooth;
      });
    } catch (const geometry_error&) { // of a place where the kernel cannot evaluate a face
      return false;
    }
  }

  std::vector<local_id> common_curves(local_id f, local_id g) const {
    std::vector<local_id> common;
    for (const auto& loop : topology_.loops(f))
      for (const virtual_coedge& coedge : loop)
        for (const passage& p : topology_.passages_of(coedge.curve))
          if (p.face == g)
            common.push_back(coedge.curve);
    return common;
  }

  /// Those that a face goes on into, where the edges to them are longest first.
  std::vector<local_id> neighbours_of(local_id f) {
    std::map<local_id, double> length;
    for (const auto& loop : topology_.loops(f))
      for (const virtual_coedge& coedge : loop)
        if (is_smooth(coedge.curve))
          for (const passage& p : topology_.passages_of(coedge.curve))
            if (p.face != f)
              length[p.face] += topology_.length(coedge.curve);
    std::vector<local_id> found;
    for (const auto& [g, ignored] : length)
      found.push_back(g);
    std::stable_sort(found.begin(), found.end(),
                     [&](local_id a, local_id b) { return length[a] > length[b]; });
    return found;
  }

  std::size_t join_to_first(local_id f, double length, const std::vector<local_id>& neighbours,
                            std::vector<suppressed_detail>& found) {
    for (const local_id g : neighbours)
      if (auto made = joined(f, g)) {
        found.push_back({suppressed_detail::kind::joined_face, made->gone,
                         topology_.middle(topology_.loops(made->gone)[0][0].curve), length});
        topology_.take_over(made->host, made->gone, std::move(made->loops));
        auto& members = members_[made->host];
        members.insert(members.end(), members_[made->gone].begin(), members_[made->gone].end());
        charts_[made->gone].reset();
        charts_[made->host] = std::move(made->chart);
        return 1;
      }
    return 0;
  }

  std::optional<joined_pair> joined(local_id f, local_id g) {
    const auto &first = face(f), &second = face(g);
    if (f == g || !may_be_joined(f) || !may_be_joined(g) || first.group != second.group ||
        first.name != second.name || first.solids != second.solids)
      return std::nullopt;
    const auto common = common_curves(f, g);
    if (common.empty() ||
        !std::all_of(common.begin(), common.end(), [&](local_id c) { return is_smooth(c); }))
      return std::nullopt;
    if (is_in_thin_wall(f) || is_in_thin_wall(g))
      return std::nullopt;
    const auto one = area_of(f), other = area_of(g);
    if (!one || !other || is_bent(f) || is_bent(g))
      return std::nullopt;
    const local_id host = *one >= *other ? f : g, gone = host == f ? g : f;
    auto loops = united(host, gone, common);
    try {
      if (!loops || !are_closed(*loops))
        return std::nullopt;
      auto chart = chart_of(host, gone, *loops);
      if (!chart)
        return std::nullopt;
      return joined_pair{host, gone, *std::move(loops), *std::move(chart)};
    } catch (const geometry_error&) { // likewise
      return std::nullopt;
    }
  }

  /// Of its triangles; nothing of a face that has none.
  std::optional<double> area_of(local_id f) {
    double area = 0;
    for (const local_id m : members_[f]) {
      const auto& triangles = triangles_.of_face(m);
      if (!triangles)
        return std::nullopt;
      for (const charted_triangle& t : *triangles)
        area += norm(area_vector(t));
    }
    return area;
  }

  /// Whether a member turns by more within the limit than it may. It has triangles.
  bool is_bent(local_id f) {
    return std::any_of(members_[f].begin(), members_[f].end(), [&](local_id m) {
      if (!bent_[m])
        bent_[m] = turns_much(m);
      return *bent_[m];
    });
  }
  bool turns_much(local_id member) {
    const auto& triangles = *triangles_.of_face(member);
    try {
      return std::any_of(triangles.begin(), triangles.end(), [&](const charted_triangle& t) {
        const vec2 middle = (1.0 / 3) * (t.own[0] + t.own[1] + t.own[2]);
        return topology_.model().face_curvature(member, middle) * allowed_.length(t.space[0]) > most_turn_;
      });
    } catch (const geometry_error&) { // of a place where the kernel cannot evaluate the face
      return true;
    }
  }

  /// The boundaries of both without what is common, as the first one runs; nothing where it is not told which
  /// way these go on.
  std::optional<loops_of_face> united(local_id host, local_id gone,
                                      const std::vector<local_id>& common) const {
    const bool turned = face(host).reversed != face(gone).reversed;
    std::map<local_id, virtual_coedge> left; // by the vertex where they start
    std::vector<local_id> starts;
    for (const local_id f : {host, gone})
      for (const auto& loop : topology_.loops(f))
        for (virtual_coedge coedge : loop) {
          if (std::find(common.begin(), common.end(), coedge.curve) != common.end())
            continue;
          coedge.reversed = coedge.reversed != (f == gone && turned);
          starts.push_back(topology_.ends(coedge)[0]);
          if (!left.emplace(starts.back(), coedge).second)
            return std::nullopt;
        }
    loops_of_face made;
    for (const local_id start : starts)
      if (left.contains(start)) {
        auto& loop = made.emplace_back();
        for (auto next = left.find(start); next != left.end();
             next = left.find(topology_.ends(loop.back())[1])) {
          loop.push_back(next->second);
          left.erase(next);
        }
        if (topology_.ends(loop.back())[1] != start)
          return std::nullopt;
      }
    return made.empty() ? std::nullopt : std::optional(made);
  }

  /// Whether each passage ends where the next one starts, nearly: of members at details that were given up
  /// they need not.
  bool are_closed(const loops_of_face& loops) const {
    constexpr double nearly = 1e-3; // of the limit
    const auto end_of = [&](const virtual_coedge& coedge, bool at_start) {
      return triangles_.point(coedge, topology_.curve(coedge.curve).t[coedge.reversed == at_start ? 1 : 0]);
    };
    for (const auto& loop : loops)
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const vec3 end = end_of(loop[k], false), next = end_of(loop[(k + 1) % loop.size()], true);
        if (distance(end, next) > nearly * allowed_.length(end))
          return false;
      }
    return true;
  }

  std::optional<composite_chart> chart_of(local_id host, local_id gone, const loops_of_face& loops) {
    std::vector<charted_triangle> triangles;
    for (const local_id f : {host, gone})
      for (const local_id m : members_[f])
        for (charted_triangle t : *triangles_.of_face(m)) {
          if (face(m).reversed != face(host).reversed) {
            std::swap(t.own[1], t.own[2]);
            std::swap(t.space[1], t.space[2]);
          }
          triangles.push_back(t);
        }
    const auto direction = direction_of(triangles);
    if (!direction)
      return std::nullopt;
    const discrete::chart_frame frame = discrete::frame_along(triangles.front().space[0], *direction);
    if (!covers_once(frame, loops))
      return std::nullopt;
    return composite_chart(frame, std::move(triangles));
  }

  /// Whether the boundary is one in the plane too: then triangles none of which is turned cover it once.
  bool covers_once(const discrete::chart_frame& frame, const loops_of_face& loops) {
    std::vector<vec2> points;
    std::vector<std::array<local_id, 2>> segments;
    for (const auto& loop : loops) {
      const auto first = static_cast<local_id>(points.size());
      for (const virtual_coedge& coedge : loop) {
        const auto& t = *triangles_.of_curve(coedge.curve);
        for (std::size_t i = 0; i + 1 < t.size(); ++i)
          points.push_back(
              frame.flat(triangles_.point(coedge, coedge.reversed ? t[t.size() - 1 - i] : t[i])));
      }
      const auto end = static_cast<local_id>(points.size());
      for (local_id i = first; i < end; ++i)
        segments.push_back({i, i + 1 < end ? i + 1 : first});
    }
    return triangulate_loops(points, segments).valid();
  }

  editable_topology& topology_;
  const limits& allowed_;
  double most_turn_; ///< within the limit
  face_triangles triangles_;
  walls_at_faces walls_;
  std::vector<std::vector<local_id>> members_;         ///< by face
  std::vector<std::optional<composite_chart>> charts_; ///< by face
  std::vector<std::optional<bool>> bent_;              ///< by face of the model
  std::vector<std::optional<bool>> smooth_;            ///< by curve
};

} // namespace detail

DOVETAIL_INLINE std::vector<composite_face> join_faces(editable_topology& topology, const limits& allowed,
                                                       double most_turn_deg, const uv_of_passage& uv,
                                                       std::vector<suppressed_detail>& found) {
  detail::face_joiner joiner(topology, allowed, most_turn_deg, uv);
  joiner.run(found);
  return joiner.composites();
}

} // namespace dovetail::virtual_topology
