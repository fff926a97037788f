/// @file
/// Solids with tiny details, and what a `virtual_model` of any model must satisfy.
#pragma once

#include "dovetail/models/discrete_model.hpp"
#include "dovetail/models/virtual_model.hpp"
#include "models/model_checks.hpp"
#include "models/triangulation_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace dovetail::testing {

/// A closed surface of polygons that are fans around an inner point each.
struct polygon_surface {
  std::vector<vec3> points;
  std::vector<simplex<2>> triangles;
  std::vector<local_id> ids;

  void add(const std::vector<vec3>& outline, vec3 centre, local_id id = no_id) {
    const auto first = static_cast<local_id>(points.size());
    const auto count = static_cast<local_id>(outline.size());
    points.insert(points.end(), outline.begin(), outline.end());
    points.push_back(centre);
    for (local_id i = 0; i < count; ++i) {
      triangles.push_back({first + count, first + i, first + (i + 1) % count});
      ids.push_back(id);
    }
  }
  discrete_model model() const { return discrete_model(points, triangles, ids, {.feature_angle_deg = 20}); }
};

using outline = std::vector<vec2>;
using id_of_side = std::function<local_id(std::size_t side, std::size_t layer)>;

/// From an outline at the bottom, z = 0, to one at the top, of as many sides, in layers between the given
/// heights; both are seen whole from `centre`. Caps have no id.
inline polygon_surface prism(const outline& bottom, const outline& top, vec2 centre,
                             const std::vector<double>& heights, const id_of_side& id = {}) {
  const std::size_t layers = heights.size() - 1;
  const auto at = [&](std::size_t i, std::size_t layer) {
    const double s = heights[layer] / heights.back();
    const vec2 p = bottom[i % bottom.size()], q = top[i % top.size()];
    return vec3{p.x + s * (q.x - p.x), p.y + s * (q.y - p.y), heights[layer]};
  };
  polygon_surface made;
  std::vector<vec3> lower, upper;
  for (std::size_t i = 0; i < bottom.size(); ++i) {
    lower.insert(lower.begin(), at(i, 0));
    upper.push_back(at(i, layers));
  }
  made.add(lower, {centre.x, centre.y, 0});
  made.add(upper, {centre.x, centre.y, heights.back()});
  for (std::size_t i = 0; i < bottom.size(); ++i)
    for (std::size_t k = 0; k < layers; ++k) {
      const std::vector<vec3> side{at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)};
      made.add(side, 0.25 * (side[0] + side[1] + side[2] + side[3]), id ? id(i, k) : no_id);
    }
  return made;
}

/// A cube of 10 whose upright edge at (10, 10) is chamfered, so wide at its bottom and its top.
inline outline chamfered_square(double width) {
  return {{0, 0}, {10, 0}, {10, 10 - width}, {10 - width, 10}, {0, 10}};
}
inline polygon_surface chamfered_cube(double at_bottom, double at_top,
                                      const std::vector<double>& heights = {0, 10},
                                      const id_of_side& id = {}) {
  return prism(chamfered_square(at_bottom), chamfered_square(at_top), {5, 5}, heights, id);
}

/// A convex polygon with chamfers and steps of random sizes at random places, straight or tapered.
inline polygon_surface random_solid(std::mt19937& random) {
  const auto between = [&](double a, double b) {
    return a + (b - a) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  const int corners = 4 + static_cast<int>(random() % 3);
  outline base;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (i + between(-0.15, 0.15)) / corners;
    base.push_back({10 * std::cos(angle), 10 * std::sin(angle)});
  }
  std::array<outline, 2> ends;
  const auto towards = [](vec2 p, vec2 q, double length) { return p + (length / norm(q - p)) * (q - p); };
  for (std::size_t i = 0; i < base.size(); ++i) {
    const vec2 before = base[(i + base.size() - 1) % base.size()], here = base[i],
               after = base[(i + 1) % base.size()];
    const auto what = random() % 4; // 0, 1: a chamfer; 2: a step behind the corner; 3: nothing
    const std::array widths{between(0.02, 0.4), random() % 3 == 0 ? between(0.02, 0.8) : 0.0};
    for (std::size_t end = 0; end < 2; ++end) {
      const double width = end == 1 && widths[1] > 0 ? widths[1] : widths[0];
      if (what < 2) {
        ends[end].push_back(towards(here, before, width));
        ends[end].push_back(towards(here, after, width * (what == 0 ? 1.0 : 2.0)));
      } else {
        ends[end].push_back(here);
      }
      if (what == 2) {
        const vec2 along = towards({0, 0}, after - here, 1.0), out{along.y, -along.x};
        ends[end].push_back(here + 3.0 * along);
        ends[end].push_back(here + (3 + 1.5 * width) * along + width * out);
        ends[end].push_back(here + 4.5 * along + width * out);
        ends[end].push_back(here + (4.5 + 1.5 * width) * along);
      }
    }
  }
  const auto split_side = random() % ends[0].size(), other_side = random() % ends[0].size();
  std::vector<double> heights{0, 0, between(3, 6), between(8, 12)};
  heights[1] = random() % 2 == 0 ? between(0.05, 0.4) : 2;
  return prism(ends[0], ends[1], {0, 0}, heights, [&](std::size_t side, std::size_t layer) {
    return side == split_side || side == other_side ? static_cast<local_id>(layer) : no_id;
  });
}

/// How often faces pass along each curve.
inline std::vector<int> passages_of_curves(const geometry_topology& topology) {
  std::vector<int> count(topology.curves.size(), 0);
  for (const auto& face : topology.faces)
    for (const auto& coedge : face.coedges)
      ++count[coedge.curve];
  return count;
}

struct entity_counts {
  std::size_t faces = 0, curves = 0, vertices = 0;
  bool operator==(const entity_counts&) const = default;
};

/// Of those that bound something.
inline entity_counts counts_of(const geometry_topology& topology) {
  entity_counts counts;
  for (const auto& face : topology.faces)
    counts.faces += face.loops.empty() ? 0 : 1;
  for (const int passages : passages_of_curves(topology))
    counts.curves += passages > 0 ? 1 : 0;
  counts.vertices = topology.vertices.size();
  return counts;
}

/// All that is wrong with a virtual model of a closed model, as sentences.
class virtual_checks {
public:
  virtual_checks(const virtual_model& made, const any_geometry& given, double limit)
      : made_(made), given_(given), topology_(made.topology()), limit_(limit),
        rounding_(1e-9 * given.bounds().diagonal()) {}

  std::string faults() {
    faults_ = faults_of(made_, absence::of_faces);
    check_numbers();
    for (std::size_t f = 0; f < topology_.faces.size(); ++f)
      check_face(static_cast<local_id>(f));
    check_curves();
    for (const auto& vertex : topology_.vertices)
      if (vertex.tolerance > given_tolerance_ + 1.5 * limit_ + rounding_)
        faults_.push_back("a vertex moved by " + std::to_string(vertex.tolerance));
    return joined(faults_);
  }

private:
  void check_numbers() {
    const auto& given = given_.topology();
    if (topology_.faces.size() != given.faces.size() || topology_.curves.size() < given.curves.size())
      faults_.push_back("faces or curves have other numbers");
    for (const auto& curve : given.curves)
      given_tolerance_ = std::max(given_tolerance_, curve.tolerance);
    for (const auto& vertex : given.vertices)
      given_tolerance_ = std::max(given_tolerance_, vertex.tolerance);
    std::vector<std::size_t> gone(given.faces.size(), 0);
    for (const suppressed_detail& one : made_.suppressed()) {
      if (!(one.length >= 0 && one.length <= limit_))
        faults_.push_back("a detail is larger than the limit");
      if (one.what == suppressed_detail::kind::narrow_face ||
          one.what == suppressed_detail::kind::joined_face)
        ++gone[one.entity];
    }
    for (std::size_t f = 0; f < gone.size(); ++f)
      if (gone[f] != (topology_.faces[f].loops.empty() && !given.faces[f].loops.empty() ? 1U : 0U))
        faults_.push_back("face " + std::to_string(f) + " is gone and not listed, or the other way round");
  }

  void check_face(local_id f) {
    const auto& face = topology_.faces[f];
    int k = 0;
    for (const auto& loop : face.loops)
      for (std::size_t i = 0; i < loop.size(); ++i, ++k) {
        const auto& here = loop[i];
        const auto& next = loop[(i + 1) % loop.size()];
        const auto& curve = topology_.curves[here.curve];
        if (curve.vertices[here.reversed ? 0 : 1] !=
            topology_.curves[next.curve].vertices[next.reversed ? 1 : 0])
          faults_.push_back("face " + std::to_string(f) + " has an open loop");
        for (int step = 0; step <= 64; ++step) {
          const double t = step < 64 ? curve.t[0] + (curve.t[1] - curve.t[0]) * step / 64 : curve.t[1];
          const vec3 on_face = made_.face_point(f, made_.curve_uv(f, k, t));
          const bool at_end = step == 0 || step == 64;
          const auto& end = topology_.vertices[curve.vertices[step == 0 ? 0 : 1]];
          const double away =
              distance(on_face, at_end || curve.degenerate ? end.point : made_.curve_point(here.curve, t));
          if (away > curve.tolerance + (at_end || curve.degenerate ? end.tolerance : 0) + rounding_)
            faults_.push_back("face " + std::to_string(f) + " is " + std::to_string(away) +
                              " away from curve " + std::to_string(here.curve));
        }
      }
  }

  void check_curves() {
    const auto passages = passages_of_curves(topology_), before = passages_of_curves(given_.topology());
    const auto& gone = made_.suppressed();
    const bool has_gaps = std::any_of(gone.begin(), gone.end(), [](const suppressed_detail& one) {
      return one.what == suppressed_detail::kind::narrow_gap; // two edges of the surface are one
    });
    const int most = *std::max_element(before.begin(), before.end()) * (has_gaps ? 2 : 1);
    for (std::size_t c = 0; c < passages.size(); ++c) {
      const auto& curve = topology_.curves[c];
      const std::string name = "curve " + std::to_string(c);
      if (passages[c] == 0 ? !curve.degenerate : !curve.degenerate && (passages[c] < 2 || passages[c] > most))
        faults_.push_back(name + " has " + std::to_string(passages[c]) + " passages");
      if (curve.tolerance >
          given_tolerance_ + (1 + 4 * 1.5) * limit_ + rounding_) // its own way, and its ends and corners
        faults_.push_back(name + " moved by " + std::to_string(curve.tolerance));
      for (const std::size_t end : {std::size_t{0}, std::size_t{1}})
        if (const auto& vertex = topology_.vertices[curve.vertices[end]];
            passages[c] > 0 && distance(made_.curve_point(static_cast<local_id>(c), curve.t[end]),
                                        vertex.point) > vertex.tolerance + given_tolerance_ + rounding_)
          faults_.push_back(name + " does not end at its vertex");
      if (c < given_.topology().curves.size() && passages[c] > 0 && !curve.degenerate &&
          curve.vertices[0] == curve.vertices[1] &&
          given_.topology().curves[c].vertices[0] != given_.topology().curves[c].vertices[1])
        faults_.push_back(name + " closed");
    }
  }

  const virtual_model& made_;
  const any_geometry& given_;
  const geometry_topology& topology_;
  double limit_, rounding_, given_tolerance_ = 0;
  std::vector<std::string> faults_;
};

} // namespace dovetail::testing
