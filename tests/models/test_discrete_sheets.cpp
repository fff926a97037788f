#include "discrete_shapes.hpp"
#include "dovetail/models/discrete/cluster_measures.hpp"
#include "dovetail/models/discrete/repair.hpp"
#include "dovetail/models/discrete_model.hpp"
#include "model_checks.hpp"
#include "support/refusal.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

using namespace dovetail;
using namespace dovetail::testing;

namespace {

constexpr repair_options sheets_allowed{.allow_sheets = true};

oriented_surfaces repaired_sheet(const triangle_soup& soup) {
  return repaired(soup, "sheet.stl", sheets_allowed);
}

discrete_model sheet_model(const triangle_soup& soup) {
  discrete_model model(repaired_sheet(soup), {.allow_sheets = true});
  for (const std::string& fault : faults_of(model))
    FAIL_CHECK(fault);
  return model;
}

/// Length of the curves that bound one face only.
double rim_length(const discrete_model& model) {
  std::vector<int> passages(model.topology().curves.size(), 0);
  for (const auto& face : model.topology().faces)
    for (const auto& coedge : face.coedges)
      ++passages[coedge.curve];
  double sum = 0;
  for (std::size_t c = 0; c < passages.size(); ++c)
    if (passages[c] == 1)
      sum += model.topology().curves[c].t[1];
  return sum;
}

std::string refusal(const triangle_soup& soup, const repair_options& options) {
  return refusal_of<geometry_error>([&] { return repaired(soup, "sheet.stl", options); });
}

/// A strip of n squares, turned by half a turn before its ends meet.
triangle_soup moebius_soup(int n) {
  triangle_soup soup;
  for (int i = 0; i < n; ++i) {
    const double turn = 2 * std::numbers::pi * i / n;
    for (const double side : {-0.3, 0.3}) {
      const double r = 1 + side * std::cos(turn / 2);
      soup.points.push_back({r * std::cos(turn), r * std::sin(turn), side * std::sin(turn / 2)});
    }
  }
  for (int i = 0; i < n; ++i) {
    const bool last = i + 1 == n;
    const local_id a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    soup.triangles.push_back({a, c, d});
    soup.triangles.push_back({a, d, b});
  }
  soup.groups.assign(soup.triangles.size(), no_id);
  return soup;
}

} // namespace

TEST_CASE("a sheet is refused unless sheets are allowed, and then its boundary is warned of") {
  const auto soup = sheet_soup(3, [](double, double) { return 0.0; });
  const std::string message = refusal(soup, {});
  CHECK_MESSAGE(message.find("sheet.stl: the surface is open: 12 edges") != std::string::npos, message);
  const auto surfaces = repaired_sheet(soup);
  CHECK(surfaces.solids == 0);
  CHECK(surfaces.repairs.get("sheets") == 1);
  CHECK(surfaces.repairs.get("shells") == 0);
  REQUIRE(surfaces.repairs.warnings.size() == 1);
  CHECK(surfaces.repairs.warnings[0].find("12 edges") != std::string::npos);
}

TEST_CASE("a sheet's triangles are turned to the side of most of them") {
  auto soup = sheet_soup(8, [](double x, double y) { return 0.3 * x * y; });
  std::mt19937 random(1);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    if (t == 0 || random() % 4 == 0)
      std::swap(soup.triangles[t][1], soup.triangles[t][2]);
  const auto surfaces = repaired_sheet(soup);
  const discrete::cluster_measures measures(surfaces.mesh);
  for (std::size_t t = 0; t < surfaces.mesh.elements.size(); ++t)
    REQUIRE(measures.area_vector(t).z > 0);
}

TEST_CASE("a plane sheet is one face with four curves") {
  const auto model = sheet_model(sheet_soup(4, [](double, double) { return 0.0; }));
  CHECK(model.topology().faces.size() == 1);
  CHECK(model.topology().curves.size() == 4);
  CHECK(model.topology().vertices.size() == 4);
  CHECK(model.topology().solids.empty());
  CHECK(model.topology().faces[0].solids == std::array{no_id, no_id});
  CHECK(rim_length(model) == doctest::Approx(8));
}

TEST_CASE("a box without its lid has five faces, and a rim") {
  const auto model = sheet_model(open_box_soup({0, 0, 0}, {1, 2, 3}, 4));
  CHECK(model.topology().faces.size() == 5);
  CHECK(model.topology().curves.size() == 12);
  CHECK(model.topology().vertices.size() == 8);
  CHECK(rim_length(model) == doctest::Approx(6));
}

TEST_CASE("a strongly curved sheet is cut into charts that end at its rim") {
  const auto model = sheet_model(sheet_soup(30, [](double x, double y) { return 2 * (x * x + y * y); }));
  CHECK(model.topology().faces.size() > 1);
  CHECK(model.topology().faces.size() < 20);
  // The rim: four parabolas z = 2 + 2 t^2 between -1 and 1.
  const double slope = 4;
  const double parabola = std::sqrt(1 + slope * slope) + std::asinh(slope) / slope;
  CHECK(rim_length(model) == doctest::Approx(4 * parabola).epsilon(0.01));
}

TEST_CASE("a sheet with a hole, and one with corners that touch") {
  auto soup = sheet_soup(6, [](double x, double) { return 0.2 * x * x; });
  std::erase_if(soup.triangles, [&](const simplex<2>& t) {
    const auto at = [&](local_id v) { return soup.points[v]; };
    const vec3 center = (at(t[0]) + at(t[1]) + at(t[2])) / 3;
    return std::abs(center.x) < 0.33 && std::abs(center.y) < 0.33;
  });
  soup.groups.resize(soup.triangles.size());
  const auto holed = sheet_model(soup);
  CHECK(holed.topology().faces[0].loops.size() == 2);

  auto bow = sheet_soup(2, [](double, double) { return 0.0; });
  bow.triangles = {bow.triangles[0], bow.triangles[1], bow.triangles[6], bow.triangles[7]};
  bow.groups.resize(4);
  const auto touching = sheet_model(bow);
  CHECK(touching.topology().faces.size() == 2);
  CHECK(rim_length(touching) == doctest::Approx(8));
}

TEST_CASE("a sheet beside a closed surface leaves its solid alone") {
  triangle_soup soup = box_soup({-3, -3, -3}, {3, 3, 3}, 2);
  append(soup, sheet_soup(4, [](double x, double y) { return 0.1 * x * y; }));
  const auto model = sheet_model(soup);
  CHECK(model.topology().solids.size() == 1);
  CHECK(model.topology().faces.size() == 7);
  std::size_t free = 0;
  for (const auto& face : model.topology().faces)
    free += face.solids[0] == no_id && face.solids[1] == no_id ? 1 : 0;
  CHECK(free == 1);
}

TEST_CASE("one-sided and crossing sheets are refused") {
  CHECK(refusal(moebius_soup(24), sheets_allowed).find("one side only") != std::string::npos);
  triangle_soup crossing = sheet_soup(3, [](double x, double) { return x; });
  append(crossing, sheet_soup(4, [](double x, double) { return -x + 0.1; }));
  CHECK(refusal(crossing, sheets_allowed).find("crosses itself") != std::string::npos);
}
