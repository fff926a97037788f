/// @file
/// What `editable_topology.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/models/virtual/editable_topology.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace dovetail::virtual_topology {

namespace detail {

inline constexpr int samples_of_curve = 33;

} // namespace detail

DOVETAIL_INLINE double own_parameter(const any_geometry& model, local_id inner, const virtual_coedge& coedge,
                                     double t) {
  if (coedge.beside.empty())
    return t;
  const auto& pairs = coedge.beside;
  if (t <= pairs.front()[0])
    return pairs.front()[1];
  if (t >= pairs.back()[0])
    return pairs.back()[1];
  const auto after = std::lower_bound(pairs.begin(), pairs.end(), t,
                                      [](const auto& pair, double value) { return pair[0] < value; });
  const auto& [t0, s0] = *(after - 1);
  const auto& [t1, s1] = *after;
  const double seed = s0 + (s1 - s0) * (t - t0) / (t1 - t0);
  const double found = model.project_to_curve(coedge.own_curve, model.curve_point(inner, t), seed);
  const auto [least, most] = std::minmax(s0, s1);
  return std::clamp(found, least, most); // so that it never runs back
}

DOVETAIL_INLINE editable_topology::editable_topology(const any_geometry* model)
    : model_(model), vertices_(model->topology().vertices), curves_(model->topology().curves),
      vertex_deviations_(std::vector<double>(vertices_.size())),
      curve_deviations_(std::vector<double>(curves_.size())) {
  for (std::size_t c = 0; c < curves_.size(); ++c) {
    inner_curve_.push_back(static_cast<local_id>(c));
    passages_.push_back(0);
    faces_.push_back({});
    lengths_.push_back(curves_[c].degenerate ? 0 : measured_length(static_cast<local_id>(c)));
    chords_.push_back(curves_[c].degenerate ? 0 : measured_chord(static_cast<local_id>(c)));
  }
  for (const auto& face : model->topology().faces) {
    std::vector<std::vector<virtual_coedge>> loops;
    int own = 0;
    for (const auto& given : face.loops) {
      auto& loop = loops.emplace_back();
      for (const auto& coedge : given) {
        const auto f = static_cast<local_id>(loops_.size());
        loop.push_back({coedge.curve, coedge.reversed, own++, coedge.curve, f});
        add_passage(coedge.curve, f);
      }
    }
    loops_.push_back(std::move(loops));
  }
}

DOVETAIL_INLINE void editable_topology::add_passage(local_id c, local_id f) {
  ++passages_.change(c);
  const auto& known = faces_[c];
  const auto place = std::lower_bound(known.begin(), known.end(), f) - known.begin();
  if (place == static_cast<std::ptrdiff_t>(known.size()) || known[place] != f) {
    auto& faces = faces_.change(c);
    faces.insert(faces.begin() + place, f);
  }
}

DOVETAIL_INLINE std::vector<passage> editable_topology::passages_of(local_id c) const {
  std::vector<passage> found;
  for (const local_id f : faces_[c])
    for (std::size_t l = 0; l < loops_[f].size(); ++l)
      for (std::size_t k = 0; k < loops_[f][l].size(); ++k)
        if (loops_[f][l][k].curve == c)
          found.push_back({f, l, k});
  return found;
}

DOVETAIL_INLINE bool editable_topology::has_long_curves() const {
  for (std::size_t c = 0; c < curves_.size(); ++c) {
    const auto& [a, b] = curves_[c].vertices;
    if (passages_[c] > 0 && !curves_[c].degenerate && a != b &&
        distance(vertices_[a].point, vertices_[b].point) < 0.5 * chords_[c])
      return false;
  }
  return true;
}

DOVETAIL_INLINE bool editable_topology::has_closed_loops() const {
  for (std::size_t f = 0; f < loops_.size(); ++f)
    for (const auto& loop : loops_[f])
      for (std::size_t k = 0; k < loop.size(); ++k)
        if (ends(loop[k])[1] != ends(loop[(k + 1) % loop.size()])[0])
          return false;
  return true;
}

DOVETAIL_INLINE bool editable_topology::is_last_of_group(local_id f) const {
  const auto& faces = model_->topology().faces;
  const std::string& group = faces[f].group;
  if (group.empty())
    return false;
  for (std::size_t other = 0; other < faces.size(); ++other)
    if (other != static_cast<std::size_t>(f) && faces[other].group == group && !loops_[other].empty())
      return false;
  return true;
}

DOVETAIL_INLINE int editable_topology::curves_at(local_id v) const {
  int count = 0;
  for (std::size_t c = 0; c < curves_.size(); ++c)
    if (passages_[c] > 0 && !curves_[c].degenerate)
      count += static_cast<int>(std::count(curves_[c].vertices.begin(), curves_[c].vertices.end(), v));
  return count;
}

DOVETAIL_INLINE std::vector<vec3> editable_topology::samples(local_id c, int count) const {
  std::vector<vec3> points;
  const auto& t = curves_[c].t;
  for (int i = 0; i < count; ++i)
    points.push_back(point(c, i + 1 < count ? t[0] + (t[1] - t[0]) * i / (count - 1) : t[1]));
  return points;
}

DOVETAIL_INLINE double editable_topology::measured_length(local_id c) const {
  const auto points = samples(c, detail::samples_of_curve);
  double length = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    length += distance(points[i], points[i + 1]);
  return length;
}

DOVETAIL_INLINE double editable_topology::length_of_loop(const passage& p) const {
  double length = 0;
  for (const auto& coedge : loops_[p.face][p.loop])
    length += lengths_[coedge.curve];
  return length;
}

DOVETAIL_INLINE vec3 editable_topology::direction(const virtual_coedge& coedge, double share) const {
  const auto& t = curves_[coedge.curve].t;
  const double along = coedge.reversed ? 1 - share : share;
  const vec3 d = model_->curve_frame(inner_curve_[coedge.curve], t[0] + along * (t[1] - t[0])).derivative;
  return normalized(coedge.reversed ? -d : d);
}

DOVETAIL_INLINE vec2 editable_topology::uv(const virtual_coedge& coedge, double t) const {
  const auto& range = curves_[coedge.curve].t;
  for (const std::size_t end : {std::size_t{0}, std::size_t{1}})
    if (t == range[end] && coedge.corners[end])
      return *coedge.corners[end];
  return model_->curve_uv(coedge.own_face, coedge.own,
                          own_parameter(*model_, inner_curve_[coedge.curve], coedge, t));
}

DOVETAIL_INLINE vec3 editable_topology::inward(local_id face, const virtual_coedge& coedge,
                                               double share) const {
  const auto& t = curves_[coedge.curve].t;
  const double along = coedge.reversed ? 1 - share : share;
  const surface_frame frame = model_->face_frame(face, uv(coedge, t[0] + along * (t[1] - t[0])));
  return normalized(cross(cross(frame.du, frame.dv), direction(coedge, share)));
}

DOVETAIL_INLINE std::array<local_id, 2> editable_topology::ends(const virtual_coedge& coedge) const {
  const auto& vertices = curves_[coedge.curve].vertices;
  return coedge.reversed ? std::array{vertices[1], vertices[0]} : vertices;
}

DOVETAIL_INLINE local_id editable_topology::split(local_id c, double t) {
  const auto behind = static_cast<local_id>(curves_.size());
  const auto middle = static_cast<local_id>(vertices_.size());
  vertices_.push_back({point(c, t), curves_[c].tolerance});
  vertex_deviations_.push_back(curve_deviations_[c]);
  geometry_topology::curve second = curves_[c];
  second.t[0] = t;
  second.vertices[0] = middle;
  curves_.push_back(std::move(second));
  auto& first_part = curves_.change(c);
  first_part.t[1] = t;
  first_part.vertices[1] = middle;
  inner_curve_.push_back(local_id{inner_curve_[c]});
  curve_deviations_.push_back(double{curve_deviations_[c]});
  passages_.push_back(0);
  faces_.push_back({});
  for (const passage& p : passages_of(c)) {
    auto& loop = loops_.change(p.face)[p.loop];
    // Passages of one loop come in its order, and each one before makes it longer by one.
    const auto shift = static_cast<std::size_t>(
        std::count_if(loop.begin(), loop.end(), [&](const auto& e) { return e.curve == behind; }));
    const auto first = loop.begin() + static_cast<std::ptrdiff_t>(p.place + shift);
    virtual_coedge before = *first, after = *first;
    after.curve = behind;
    after.corners[0].reset();
    before.corners[1].reset();
    if (!before.beside.empty()) {
      const double own = own_parameter(*model_, inner_curve_[c], *first, t);
      std::erase_if(before.beside, [&](const auto& pair) { return pair[0] >= t; });
      before.beside.push_back({t, own});
      std::erase_if(after.beside, [&](const auto& pair) { return pair[0] <= t; });
      after.beside.insert(after.beside.begin(), {t, own});
    }
    const bool reversed = first->reversed;
    *first = reversed ? after : before;
    loop.insert(first + 1, reversed ? std::move(before) : std::move(after));
    add_passage(behind, p.face);
  }
  lengths_.push_back(measured_length(behind));
  chords_.push_back(measured_chord(behind));
  chords_.change(c) = measured_chord(c);
  lengths_.change(c) = measured_length(c);
  return behind;
}

DOVETAIL_INLINE void editable_topology::merge_vertices(local_id gone, local_id kept) {
  if (gone == kept)
    return;
  vertex_deviations_.change(kept) =
      std::max(vertex_deviations_[kept],
               vertex_deviations_[gone] + distance(vertices_[gone].point, vertices_[kept].point));
  for (std::size_t c = 0; c < curves_.size(); ++c)
    if (const auto& ends = curves_[c].vertices; std::count(ends.begin(), ends.end(), gone) > 0) {
      auto& changed = curves_.change(c).vertices;
      std::replace(changed.begin(), changed.end(), gone, kept);
    }
}

DOVETAIL_INLINE void editable_topology::drop(const passage& p, local_id kept) {
  auto& loops = loops_.change(p.face);
  auto& loop = loops[p.loop];
  const std::size_t count = loop.size();
  const virtual_coedge gone = loop[p.place];
  if (count > 1) {
    virtual_coedge& before = loop[(p.place + count - 1) % count];
    virtual_coedge& after = loop[(p.place + 1) % count];
    const auto& t = curves_[gone.curve].t;
    const bool starts_there = ends(gone)[0] == kept;
    const vec2 corner = uv(gone, starts_there != gone.reversed ? t[0] : t[1]);
    if (starts_there)
      after.corners[after.reversed ? 1 : 0] = corner;
    else
      before.corners[before.reversed ? 0 : 1] = corner;
  }
  loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(p.place));
  if (loop.empty())
    loops.erase(loops.begin() + static_cast<std::ptrdiff_t>(p.loop));
  --passages_.change(gone.curve);
}

DOVETAIL_INLINE void editable_topology::drop_all(local_id c, local_id kept) {
  for (auto passages = passages_of(c); !passages.empty(); passages = passages_of(c))
    drop(passages.front(), kept);
  const auto ends = curves_[c].vertices; // a copy: merging changes them
  for (const local_id v : ends)
    merge_vertices(v, kept);
}

DOVETAIL_INLINE void editable_topology::cut_out(local_id f, const std::vector<local_id>& curves,
                                                local_id kept) {
  const auto is_gone = [&](const virtual_coedge& coedge) {
    return std::find(curves.begin(), curves.end(), coedge.curve) != curves.end();
  };
  for (auto& loop : loops_.change(f)) {
    if (std::none_of(loop.begin(), loop.end(), is_gone))
      continue;
    // The loop begins behind what is cut out.
    std::rotate(loop.begin(), std::find_if_not(loop.begin(), loop.end(), is_gone), loop.end());
    const auto last_gone = std::find_if(loop.rbegin(), loop.rend(), is_gone).base();
    std::rotate(loop.begin(), last_gone, loop.end());
    for (const virtual_coedge& coedge : loop)
      if (is_gone(coedge))
        --passages_.change(coedge.curve);
    std::erase_if(loop, is_gone);
    virtual_coedge &first = loop.front(), &last = loop.back();
    const auto end_of = [&](const virtual_coedge& coedge, bool at_start) {
      return coedge.reversed == at_start ? 1 : 0;
    };
    const auto uv_at = [&](const virtual_coedge& coedge, int end) {
      return uv(coedge, curves_[coedge.curve].t[end]);
    };
    if (ends(first)[0] == kept)
      last.corners[end_of(last, false)] = uv_at(first, end_of(first, true));
    else
      first.corners[end_of(first, true)] = uv_at(last, end_of(last, false));
  }
}

DOVETAIL_INLINE void editable_topology::replace_curve(local_id gone, local_id kept, bool same_direction,
                                                      double width) {
  const auto& t = curves_[kept].t;
  double furthest = curve_deviations_[gone] + width;
  for (const passage& p : passages_of(gone)) {
    virtual_coedge& coedge = loops_.change(p.face)[p.loop][p.place];
    const auto& range = curves_[gone].t;
    std::array own{own_parameter(*model_, inner_curve_[gone], coedge, range[0]),
                   own_parameter(*model_, inner_curve_[gone], coedge, range[1])};
    if (!same_direction) {
      std::swap(own[0], own[1]);
      std::swap(coedge.corners[0], coedge.corners[1]);
      coedge.reversed = !coedge.reversed;
    }
    std::vector<std::array<double, 2>> pairs{{t[0], own[0]}};
    for (int i = 1; i + 1 < detail::samples_of_curve; ++i) {
      const double share = static_cast<double>(i) / (detail::samples_of_curve - 1);
      const double at = t[0] + share * (t[1] - t[0]);
      const double steps_left = detail::samples_of_curve - i;
      const double seed = pairs.back()[1] + (own[1] - pairs.back()[1]) / steps_left;
      const double found = model_->project_to_curve(coedge.own_curve, point(kept, at), seed);
      const auto [least, most] = std::minmax(pairs.back()[1], own[1]);
      pairs.push_back({at, std::clamp(found, least, most)});
    }
    pairs.push_back({t[1], own[1]});
    for (const auto& [at, beside] :
         pairs) // at its ends, whose vertices are not quite beside each other, more
      furthest = std::max(furthest, distance(point(kept, at), model_->curve_point(coedge.own_curve, beside)));
    coedge.beside = std::move(pairs);
    coedge.curve = kept;
    --passages_.change(gone);
    add_passage(kept, p.face);
  }
  curves_.change(kept).tolerance = std::max(curves_[kept].tolerance, curves_[gone].tolerance);
  curve_deviations_.change(kept) = std::max(curve_deviations_[kept], furthest);
}

DOVETAIL_INLINE void editable_topology::remove_face(local_id f) {
  for (const auto& loop : loops_[f])
    for (const virtual_coedge& coedge : loop)
      --passages_.change(coedge.curve);
  loops_.change(f).clear();
}

DOVETAIL_INLINE void editable_topology::take_over(local_id f, local_id gone,
                                                  std::vector<std::vector<virtual_coedge>> loops) {
  remove_face(f);
  remove_face(gone);
  for (const auto& loop : loops)
    for (const virtual_coedge& coedge : loop)
      add_passage(coedge.curve, f);
  loops_.change(f) = std::move(loops);
}

DOVETAIL_INLINE geometry_topology editable_topology::topology() const {
  geometry_topology made;
  made.faces = model_->topology().faces;
  made.solids = model_->topology().solids;
  for (std::size_t c = 0; c < curves_.size(); ++c)
    made.curves.push_back(curves_[c]);
  std::vector<local_id> number(vertices_.size(), no_id);
  for (std::size_t c = 0; c < curves_.size(); ++c)
    if (passages_[c] > 0)
      for (const local_id v : curves_[c].vertices)
        number[v] = 0;
  for (std::size_t v = 0; v < vertices_.size(); ++v)
    if (number[v] != no_id) {
      number[v] = static_cast<local_id>(made.vertices.size());
      made.vertices.push_back(vertices_[v]);
      made.vertices.back().tolerance += vertex_deviations_[v];
    }
  for (std::size_t c = 0; c < curves_.size(); ++c) {
    auto& curve = made.curves[c];
    curve.tolerance += curve_deviations_[c];
    curve.degenerate = curve.degenerate || passages_[c] == 0;
    for (local_id& v : curve.vertices)
      v = passages_[c] > 0 ? number[v] : 0;
  }
  for (std::size_t f = 0; f < loops_.size(); ++f) {
    auto& face = made.faces[f];
    face.loops.clear();
    face.coedges.clear();
    for (const auto& loop : loops_[f]) {
      auto& made_loop = face.loops.emplace_back();
      for (const auto& coedge : loop)
        made_loop.push_back({coedge.curve, coedge.reversed});
      face.coedges.insert(face.coedges.end(), made_loop.begin(), made_loop.end());
    }
  }
  return made;
}

} // namespace dovetail::virtual_topology
