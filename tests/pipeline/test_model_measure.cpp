#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/models/discrete/repair.hpp"
#include "dovetail/models/discrete_model.hpp"
#include "dovetail/pipeline/compare_with_plan.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "models/discrete_shapes.hpp"

#include <algorithm>
#include <doctest/doctest.h>
#include <optional>
#include <string>

using namespace dovetail;

namespace {

simplicial_skeleton<3> skeleton_of(const triangle_soup& soup) {
  const auto s = repaired(soup);
  simplicial_skeleton<3> skeleton;
  skeleton.points.own() = s.mesh.points;
  skeleton.sides.own() = s.mesh.elements;
  skeleton.subdomains.own().assign(s.mesh.elements.size(), {0, no_id});
  return skeleton;
}

report summary_with_gap(double gap) {
  report deviation, skeleton, summary;
  note_deviation(deviation, "face 0", {0, 0, 0, gap});
  skeleton.name = "skeleton";
  skeleton.children.push_back(deviation);
  summary.children.push_back(skeleton);
  return summary;
}

template <int D>
generated<D> mesh_of(const discrete_model& model) {
  if constexpr (D == 3)
    return generate<3>(model, uniform_size(0.3), parameters<>{}.with_mesher(mesher::tetgen{}));
  else
    return generate<2>(model, uniform_size(0.3), parameters<>{});
}

std::size_t warnings_of(const report& summary, const std::string& text) {
  std::size_t count = 0;
  for (const std::string& warning : summary.warnings)
    count += warning.find(text) != std::string::npos ? 1 : 0;
  for (const report& part : summary.children)
    count += warnings_of(part, text);
  return count;
}

} // namespace

TEST_CASE("a mesh much larger than planned is told of, unless it is small") {
  const auto warnings = [](double planned, double made) {
    report summary;
    compare_with_plan(planned, made, summary);
    return warnings_of(summary, "were predicted: small features of the model");
  };
  CHECK(warnings(23'000, 47'735) == 1);
  CHECK(warnings(40'000, 47'735) == 0);
  CHECK(warnings(90'000, 47'735) == 0);
  CHECK(warnings(2'300, 4'773) == 0);
  CHECK(warnings(0, 47'735) == 0); // nothing was planned
}

TEST_CASE("a volume that differs by more than lies between mesh and model is warned of") {
  const auto skeleton = skeleton_of(testing::box_soup({0, 0, 0}, {1, 1, 1}, 3));
  CHECK(volume_inside(skeleton) == doctest::Approx(1));
  const auto warnings = [&](std::optional<double> of_model, double gap) {
    report summary = summary_with_gap(gap);
    compare_volume(skeleton, of_model, summary);
    return warnings_of(summary, "the mesh fills a volume of 1");
  };
  CHECK(warnings(1, 0) == 0);
  CHECK(warnings(1.05, 0.01) == 1);
  CHECK(warnings(0.95, 0.01) == 1);
  CHECK(warnings(1.05, 0.03) == 0);
  CHECK(warnings({}, 0) == 0);
  CHECK(warnings(1.5, 0.3) == 1); // explained, but much
}

TEST_CASE("a mesh that cuts off the edges of its model says so, and others say nothing") {
  const auto cube = repaired(testing::box_soup({0, 0, 0}, {1, 1, 1}, 2));
  const auto smooth = mesh_of<3>(discrete_model(cube, {.feature_angle_deg = 100})); // no edge is one
  CHECK(smooth.summary.get("volume") < 0.99);
  CHECK(warnings_of(smooth.summary, "it cuts off an edge") > 0);
  CHECK(warnings_of(mesh_of<2>(discrete_model(cube, {.feature_angle_deg = 100})).summary,
                    "it cuts off an edge") > 0);

  const auto right = mesh_of<3>(discrete_model(cube));
  CHECK(right.summary.get("volume") == doctest::Approx(1));
  CHECK(right.summary.get("model_volume") == doctest::Approx(1));
  CHECK(warnings_of(right.summary, "") == 0);
  const auto ball = mesh_of<3>(discrete_model(repaired(testing::sphere_soup({0, 0, 0}, 0.5, 10))));
  CHECK(warnings_of(ball.summary, "") == 0);
}

TEST_CASE("a sliver on a sharp edge leaves the volume as it is") {
  auto soup = testing::box_soup({0, 0, 0}, {1, 1, 1});
  const auto cube = repaired(soup);
  soup = {cube.mesh.points, cube.mesh.elements, {}, {}};
  const auto at = [&](vec3 p) {
    for (std::size_t v = 0; v < soup.points.size(); ++v)
      if (soup.points[v] == p)
        return static_cast<local_id>(v);
    return no_id;
  };
  // Of the triangle of the side z = 0 at this edge, all but a strip as thin as rounding is cut off.
  const local_id a = at({0, 0, 0}), b = at({0, 1, 0}), tip = static_cast<local_id>(soup.points.size());
  soup.points.push_back({1e-6, 0.5, 0});
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    auto v = soup.triangles[t];
    const auto has = [&](local_id p) { return std::find(v.begin(), v.end(), p) != v.end(); };
    if (!has(a) || !has(b) || soup.points[v[0]].z != 0 || soup.points[v[1]].z != 0 ||
        soup.points[v[2]].z != 0)
      continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const simplex<2> part{v[i], v[(i + 1) % 3], tip};
      if (i == 0)
        soup.triangles[t] = part;
      else
        soup.triangles.push_back(part);
    }
    break;
  }
  const auto made = mesh_of<3>(discrete_model(repaired(soup)));
  CHECK(made.summary.get("volume") == doctest::Approx(1).epsilon(1e-5));
  CHECK(warnings_of(made.summary, "") == 0);
}
