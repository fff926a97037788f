#include "discrete_shapes.hpp"
#include "dovetail/models/discrete/repair.hpp"
#include "dovetail/models/discrete_model.hpp"
#include "model_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>

using namespace dovetail;
using namespace dovetail::testing;

namespace {

/// A soup whose triangles share their points, and can be given slivers.
class sliver_maker {
public:
  explicit sliver_maker(const triangle_soup& soup) : soup_(soup) {
    const auto s = repaired(soup);
    soup_ = {s.mesh.points, s.mesh.elements, {}, {}};
  }

  const triangle_soup& soup() const { return soup_; }
  vec3 point(local_id v) const { return soup_.points[v]; }
  std::size_t size() const { return soup_.triangles.size(); }
  simplex<2> triangle(std::size_t t) const { return soup_.triangles[t]; }
  local_id point_at(vec3 p) const {
    local_id best = 0;
    for (std::size_t v = 0; v < soup_.points.size(); ++v)
      if (distance(soup_.points[v], p) < distance(point(best), p))
        best = static_cast<local_id>(v);
    return best;
  }

  /// A cap: a new point this high over the edge from a to b, in the plane of the triangle that passes it so.
  local_id add_cap(local_id a, local_id b, double share, double height) {
    const std::size_t t = passing(a, b);
    const local_id c = across(t, a, b);
    const vec3 along = normalized(point(b) - point(a));
    const vec3 up = normalized(point(c) - point(a) - dot(point(c) - point(a), along) * along);
    const local_id p = add(point(a) + share * (point(b) - point(a)) + height * up);
    soup_.triangles[t] = {a, b, p};
    soup_.triangles.push_back({b, c, p});
    soup_.triangles.push_back({c, a, p});
    return p;
  }

  /// Two needles: a new point on the edge from a to b, this far from a.
  local_id add_needles(local_id a, local_id b, double away) {
    const std::size_t t = passing(a, b), u = passing(b, a);
    const local_id c = across(t, a, b), d = across(u, a, b);
    const local_id p = add(point(a) + away * normalized(point(b) - point(a)));
    soup_.triangles[t] = {a, p, c};
    soup_.triangles[u] = {p, a, d};
    soup_.triangles.push_back({p, b, c});
    soup_.triangles.push_back({b, p, d});
    return p;
  }

private:
  local_id add(vec3 p) {
    soup_.points.push_back(p);
    return static_cast<local_id>(soup_.points.size() - 1);
  }
  std::size_t passing(local_id a, local_id b) const {
    for (std::size_t t = 0; t < size(); ++t)
      for (std::size_t i = 0; i < 3; ++i)
        if (triangle(t)[i] == a && triangle(t)[(i + 1) % 3] == b)
          return t;
    FAIL("no triangle passes this edge");
    return 0;
  }
  local_id across(std::size_t t, local_id a, local_id b) const {
    for (const local_id v : triangle(t))
      if (v != a && v != b)
        return v;
    return no_id;
  }

  triangle_soup soup_;
};

discrete_model repaired_model(const triangle_soup& soup) {
  return discrete_model(repaired(soup));
}

double feature_length(const discrete_model& model) {
  double sum = 0;
  for (const auto& curve : model.topology().curves)
    if (curve.name != "chart border")
      sum += curve.t[1] - curve.t[0];
  return sum;
}

/// Where a model's features are those of the unit cube, whatever slivers lie along its edges.
void check_cube(const triangle_soup& soup) {
  const auto model = repaired_model(soup);
  CHECK(model.topology().faces.size() == 6);
  CHECK(feature_length(model) == doctest::Approx(12).epsilon(1e-4));
  for (const std::string& fault : faults_of(model))
    if (fault.find("departs") == std::string::npos) // by as much as slivers are high
      FAIL_CHECK(fault);
  for (const auto& frame : model.surface().frames) // each face is the plane that it was
    CHECK(std::max({std::abs(frame.n.x), std::abs(frame.n.y), std::abs(frame.n.z)}) > 1 - 1e-9);
}

sliver_maker unit_cube() {
  return sliver_maker(box_soup({0, 0, 0}, {1, 1, 1}));
}

/// The unit square with corners rounded in steps of 15 degrees, one high.
triangle_soup rounded_prism(double radius) {
  triangle_soup soup;
  constexpr int steps = 6;
  for (int corner = 0; corner < 4; ++corner)
    for (int i = 0; i <= steps; ++i) {
      const double angle = (corner + static_cast<double>(i) / steps) * std::numbers::pi / 2;
      const double x = corner == 0 || corner == 3 ? 1 - radius : radius;
      const double y = corner < 2 ? 1 - radius : radius;
      for (const double z : {0.0, 1.0})
        soup.points.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle), z});
    }
  const auto n = static_cast<int>(soup.points.size() / 2);
  soup.points.push_back({0.5, 0.5, 0});
  soup.points.push_back({0.5, 0.5, 1});
  for (int i = 0; i < n; ++i) {
    const int a = 2 * i, b = 2 * ((i + 1) % n);
    for (const auto& t : {simplex<2>{a, b, b + 1}, simplex<2>{a, b + 1, a + 1}, simplex<2>{b, a, 2 * n},
                          simplex<2>{a + 1, b + 1, 2 * n + 1}})
      soup.triangles.push_back(t);
  }
  return soup;
}

/// The unit cube with one edge rounded for a tenth of its length, most in its middle and not at all at the
/// ends: smooth from one face to the other there.
triangle_soup cube_with_a_nick(double radius) {
  triangle_soup soup;
  const auto add = [&](vec3 p) {
    soup.points.push_back(p);
    return static_cast<local_id>(soup.points.size() - 1);
  };
  std::array<local_id, 8> corner{};
  for (int k = 0; k < 8; ++k)
    corner[k] = add({k % 2 * 1.0, k / 2 % 2 * 1.0, k / 4 * 1.0});
  const local_id from = add({1, 0.45, 1}), to = add({1, 0.55, 1});
  std::vector<local_id> arc;
  constexpr int steps = 4;
  for (int i = 0; i <= steps; ++i) {
    const double angle = std::numbers::pi / 2 * i / steps;
    arc.push_back(add({1 - radius + radius * std::cos(angle), 0.5, 1 - radius + radius * std::sin(angle)}));
  }
  const auto fan = [&](vec3 center, const std::vector<local_id>& around) {
    const local_id c = add(center);
    for (std::size_t i = 0; i < around.size(); ++i)
      soup.triangles.push_back({c, around[i], around[(i + 1) % around.size()]});
  };
  fan({0.5, 0.5, 0}, {corner[0], corner[2], corner[3], corner[1]});
  fan({0.5, 0.5, 1}, {corner[4], corner[5], from, arc[steps], to, corner[7], corner[6]});
  fan({0.5, 0, 0.5}, {corner[0], corner[1], corner[5], corner[4]});
  fan({0.5, 1, 0.5}, {corner[2], corner[6], corner[7], corner[3]});
  fan({0, 0.5, 0.5}, {corner[0], corner[4], corner[6], corner[2]});
  fan({1, 0.5, 0.5}, {corner[1], corner[3], corner[7], to, arc[0], from, corner[5]});
  for (std::size_t i = 0; i < steps; ++i) {
    soup.triangles.push_back({from, arc[i], arc[i + 1]});
    soup.triangles.push_back({to, arc[i + 1], arc[i]});
  }
  return soup;
}

} // namespace

TEST_CASE("a sliver on a sharp edge does not join the two faces") {
  for (const double height : {1e-6, 1e-7, 1e-9, 2e-6, 1e-5, 1e-3}) {
    auto cube = unit_cube();
    cube.add_cap(cube.point_at({0, 0, 0}), cube.point_at({0, 0, 1}), 0.5, height);
    CAPTURE(height);
    check_cube(cube.soup());
    cube.add_cap(cube.point_at({0, 0, 1}), cube.point_at({0, 0, 0}), 0.3, height); // from the other side too
    check_cube(cube.soup());
  }
}

TEST_CASE("nor do several slivers along one edge, slivers upon slivers, and fans of them") {
  auto cube = unit_cube();
  const local_id a = cube.point_at({0, 0, 0}), b = cube.point_at({0, 0, 1});
  const local_id p = cube.add_cap(a, b, 0.5, 1e-6);
  const local_id q = cube.add_cap(a, b, 0.4, 5e-7); // three slivers, one behind the other
  check_cube(cube.soup());
  cube.add_cap(a, q, 0.5, 2e-7);
  cube.add_cap(q, b, 0.5, 2e-7);
  cube.add_cap(p, a, 0.5, 2e-7);
  cube.add_cap(b, a, 0.6, 1e-6);
  check_cube(cube.soup());

  auto row = unit_cube();
  local_id last = row.point_at({1, 1, 0});
  const local_id end = row.point_at({1, 1, 1});
  for (int i = 0; i < 6; ++i)
    last = row.add_needles(last, end, 0.1);
  local_id at = row.point_at({1, 1, 0});
  for (int i = 1; i <= 6; ++i) { // each of the seven pieces of the edge
    const local_id next = row.point_at({1, 1, 0.1 * i});
    row.add_cap(at, next, 0.5, 3e-7);
    at = next;
  }
  row.add_cap(at, end, 0.5, 3e-7);
  check_cube(row.soup());
}

TEST_CASE("nor do needles at a corner, whose short edges lie on sharp ones") {
  auto cube = unit_cube();
  const local_id corner = cube.point_at({1, 1, 1});
  for (const vec3 to : {vec3{0, 1, 1}, vec3{1, 0, 1}, vec3{1, 1, 0}}) {
    cube.add_needles(corner, cube.point_at(to), 1e-6);
    const auto model = repaired_model(cube.soup());
    CHECK(model.topology().faces.size() == 6);
    CHECK(feature_length(model) == doctest::Approx(12).epsilon(1e-4));
  }
}

TEST_CASE("a smooth surface stays smooth with slivers all over it") {
  sliver_maker ball(sphere_soup({0, 0, 0}, 1, 8));
  const std::size_t triangles = ball.size();
  for (std::size_t t = 0; t < triangles; t += 2)
    ball.add_cap(ball.triangle(t)[0], ball.triangle(t)[1], 0.5, t % 4 == 0 ? 1e-6 : 1e-8);
  for (std::size_t t = 1; t < triangles; t += 6)
    ball.add_needles(ball.triangle(t)[0], ball.triangle(t)[1], 1e-6);
  const auto model = repaired_model(ball.soup());
  CHECK(feature_length(model) == 0);
  CHECK(model.topology().faces.size() <= 16);

  sliver_maker prism(rounded_prism(0.1));
  const double before = feature_length(repaired_model(prism.soup()));
  CHECK(before > 7);
  for (std::size_t t = 0; t < 48; ++t) // slivers on long edges and needles at their ends
    if (const auto v = prism.triangle(t); prism.point(v[0]).z != prism.point(v[1]).z)
      prism.add_cap(v[0], v[1], 0.4, 1e-6);
  const auto filleted = repaired_model(prism.soup());
  CHECK(feature_length(filleted) == doctest::Approx(before).epsilon(1e-4));
}

TEST_CASE("a sharp edge stays one when its faces are smoothly joined at one place of it") {
  for (const double radius : {0.03, 0.01, 0.001}) {
    const auto model = repaired_model(cube_with_a_nick(radius));
    CAPTURE(radius);
    CHECK(feature_length(model) > 11.85);
    CHECK(feature_length(model) < 12.15);
    for (const auto& frame : model.surface().frames)
      CHECK(std::max({std::abs(frame.n.x), std::abs(frame.n.y), std::abs(frame.n.z)}) > 0.999);
  }
}

TEST_CASE("spikes that are small against the model do not cut a smooth area") {
  auto soup = sheet_soup(100, [](double x, double y) {
    return std::abs(x - 0.3) < 0.01 && std::abs(y - 0.1) < 0.01 ? 0.015 : 0.0;
  });
  const auto s = repaired(soup, "the sheet", {.allow_sheets = true});
  const discrete_model model(s, {.allow_sheets = true});
  CHECK(feature_length(model) == doctest::Approx(8)); // its border: four edges of the spike turn by more
}
