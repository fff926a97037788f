#include "dovetail/models/plane_domain.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/kept_details.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace dovetail;

namespace {

/// A square with a slit from its upper side down to (0.5, 0.3), whose bottom is an edge as short as it is
/// wide.
plane_domain square_with_slit(double width) {
  const double left = 0.5 - 0.5 * width, right = 0.5 + 0.5 * width;
  plane_drawing drawing;
  drawing.polygons = {
      {{{0, 0}, {1, 0}, {1, 1}, {right, 1}, {right, 0.3}, {left, 0.3}, {left, 1}, {0, 1}}, "square"}};
  return plane_domain(drawing);
}

constexpr vec3 bottom{0.5, 0.3, 0};

plane_domain square_with_chamfer(double width) {
  plane_drawing drawing;
  drawing.polygons = {{{{0, 0}, {1, 0}, {1, 1 - width}, {1 - width, 1}, {0, 1}}, "square"}};
  return plane_domain(drawing);
}

} // namespace

TEST_CASE("sizes grow from a short edge, and are those given where they are smaller") {
  const any_geometry model = square_with_slit(0.01);
  const any_sizing given = keep_bounds(uniform_size(0.1));
  const any_sizing fitted = finer_at_details(model, given);
  CHECK(fitted(bottom) == doctest::Approx(0.01));
  CHECK(fitted(bottom + vec3{0.005, 0, 0}) == doctest::Approx(0.01)); // its end
  CHECK(fitted(bottom - vec3{0, 0.1, 0}) == doctest::Approx(0.01 + 0.4 * 0.1));
  CHECK(fitted({0.1, 0.1, 0}) == 0.1);
  CHECK(fitted({0.5, -40, 0}) == 0.1); // no longer the edge's, however far
  CHECK(smallest_size_in(fitted, model.bounds()) < 0.0101);
  CHECK(smallest_size_in(fitted, {{0, 0, 0}, {0.1, 0.1, 0}}) == 0.1);
  const any_sizing steeper = finer_at_details(model, given, {.growth = 0.8});
  CHECK(steeper(bottom - vec3{0, 0.1, 0}) == doctest::Approx(0.01 + 0.8 * 0.1));
}

TEST_CASE("sizes grow from a vertex that is near to another curve, across a face and not across a gap") {
  const auto notched = [](double depth) { // from above to so far over the lower side
    plane_drawing drawing;
    drawing.polygons = {{{{0, 0}, {1, 0}, {1, 1}, {0.8, 1}, {0.5, depth}, {0.2, 1}, {0, 1}}, "notched"}};
    return any_geometry(plane_domain(drawing));
  };
  const any_sizing given = uniform_size(0.1);
  const any_sizing fitted = finer_at_details(notched(0.01), given);
  CHECK(fitted({0.5, 0.01, 0}) == doctest::Approx(0.01));
  CHECK(fitted({0.5, 0, 0}) == doctest::Approx(0.01));
  CHECK(fitted({0.55, 0, 0}) == doctest::Approx(0.01 + 0.4 * 0.05));
  CHECK(finer_at_details(notched(0.06), given)({0.5, 0.06, 0}) == 0.1);
  CHECK(finer_at_details(notched(0.00005), given)({0.5, 0, 0}) == 0.1); // it is on the lower side
  // The mouth of a slit has nothing of the square in it, whichever way it looks and with lips of any height.
  for (int turn = 0; turn < 12; ++turn)
    for (const double left : {0.98, 1.0, 1.02}) {
      const double angle = 0.1 + 0.5 * turn;
      const auto turned = [&](vec2 p) {
        return vec2{std::cos(angle) * p.x - std::sin(angle) * p.y,
                    std::sin(angle) * p.x + std::cos(angle) * p.y};
      };
      plane_drawing drawing;
      drawing.polygons = {{{}, "lips"}};
      for (const vec2 p :
           {vec2{0, 0}, {1, 0}, {1, 1}, {0.505, 1}, {0.505, 0.3}, {0.495, 0.3}, {0.495, left}, {0, left}})
        drawing.polygons[0].points.push_back(turned(p));
      const any_geometry model = plane_domain(drawing);
      const any_sizing by_details = finer_at_details(model, given);
      const auto at = [&](vec2 p) { return by_details({turned(p).x, turned(p).y, 0}); };
      CHECK(at({0.505, 1}) == 0.1);
      CHECK(at({0.495, left}) == 0.1);
      CHECK(at({0.5, 0.3}) == doctest::Approx(0.01));
    }

  const auto least_angle = [](const any_geometry& model, const any_sizing& size) {
    return generate<2>(model, size, parameters<>{}).quality.min_dihedral_deg;
  };
  CHECK(least_angle(notched(0.01), given) < 12);
  CHECK(least_angle(notched(0.01), fitted) > 20);
}

TEST_CASE("sizes are small all along a face that is far narrower than they are") {
  const auto strip = [](double left, double right) { // as wide as that at its ends
    plane_drawing drawing;
    drawing.polygons = {{{{0, 0}, {1, 0}, {1, right}, {0, left}}, "strip"}};
    return any_geometry(plane_domain(drawing));
  };
  const any_sizing given = uniform_size(0.1);
  const any_sizing even = finer_at_details(strip(0.01, 0.01), given, {.dimension = 2});
  for (const double x : {0.3, 0.5, 0.66})
    for (const double y : {0.0, 0.005, 0.01}) {
      CHECK(even({x, y, 0}) > 0.0199);
      CHECK(even({x, y, 0}) < 0.02 + 0.4 * 0.0112); // half a width and half a size from the next place
    }
  CHECK(even({0.5, 0.4, 0}) == 0.1);
  const any_sizing tapered = finer_at_details(strip(0.01, 0.04), given, {.dimension = 2});
  CHECK(tapered({0.25, 0, 0}) == doctest::Approx(0.035).epsilon(0.15));
  CHECK(tapered({0.75, 0, 0}) == doctest::Approx(0.065).epsilon(0.15));
  CHECK(finer_at_details(strip(0.03, 0.03), given)({0.5, 0, 0}) == doctest::Approx(0.06).epsilon(0.2));
  CHECK(finer_at_details(strip(0.06, 0.06), given)({0.5, 0, 0}) == 0.1); // twice its width is more

  plane_drawing wedge; // narrows down to a corner
  wedge.polygons = {{{{0, 0}, {1, 0}, {1, 0.05}}, "wedge"}};
  for (const int dimension : {2, 3})
    CHECK(finer_at_details(any_geometry(plane_domain(wedge)), given, {.dimension = dimension})({0.3, 0, 0}) ==
          0.1);

  plane_drawing bridge; // between the boundary and a round hole, no vertex of which is near to it
  bridge.polygons = {{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, "square"}};
  auto& hole = bridge.polygons.emplace_back();
  hole.name = "hole";
  for (int k = 0; k < 8; ++k) {
    const double angle = 3.14159265 * (k + 0.5) / 4;
    hole.points.push_back({0.5 + 0.25 * std::cos(angle), 0.24 + 0.25 * std::sin(angle)});
  }
  const any_sizing at_bridge = finer_at_details(any_geometry(plane_domain(bridge)), given);
  CHECK(at_bridge({0.5, 0, 0}) < 0.04);
  CHECK(at_bridge({0.5, 1, 0}) == 0.1);

  const auto least_angle = [&](const any_sizing& size) {
    const auto made = generate<2>(strip(0.01, 0.01), size, parameters<>{});
    REQUIRE(made.failures.empty());
    return made.quality.min_dihedral_deg;
  };
  CHECK(least_angle(given) < 12);
  CHECK(least_angle(even) > 15);
}

TEST_CASE("a strip that needs too many elements stays as it is") {
  plane_drawing drawing;
  drawing.polygons = {{{{0, 0}, {1, 0}, {1, 0.005}, {0, 0.005}}, "strip"}};
  const any_geometry model = plane_domain(drawing);
  for (const int dimension : {2, 3}) {
    const auto fit = [&](double most) {
      return details_to_fit(model, uniform_size(0.1), {.most_elements = most, .dimension = dimension});
    };
    const double end = sizing::elements_of_growth(0.005, 0.1, 0.4, dimension);
    const double along = sizing::elements_of_growth_along(0.01, 0.1, 0.4, dimension);
    const detail_fit all = fit(1e9);
    CHECK(all.fitted == 3); // two short edges, and what is between them
    CHECK(all.left == 0);
    // Sizes grow from the ends first: beside these the strip adds less.
    CHECK(all.elements < 2 * end + along);
    CHECK(all.elements > 2 * end + 0.4 * along);
    const detail_fit ends = fit(0.99 * all.elements);
    CHECK(ends.fitted == 2);
    CHECK(ends.left == 1);
    CHECK(ends.elements == doctest::Approx(2 * end));
    CHECK(ends.elements_of_all == doctest::Approx(all.elements));
    const detail_fit none = fit(1e-3);
    CHECK(none.fitted == 0);
    CHECK(none.left == 3);
    CHECK(none.elements_of_all > 2 * end);
  }
}

TEST_CASE("where no edge is short the field is the one given") {
  const any_sizing given = [](vec3) { return 0.1; };
  const auto is_given = [&](const any_sizing& size) {
    return size.target_type() == given.target_type() && size(bottom) == 0.1;
  };
  CHECK(is_given(finer_at_details(any_geometry(square_with_slit(0.03)), given)));
  CHECK_FALSE(is_given(finer_at_details(any_geometry(square_with_slit(0.02)), given)));
  CHECK(is_given(finer_at_details(any_geometry(square_with_slit(0.02)), given, {.share_of_size = 0.1})));
}

TEST_CASE("details that need too many elements stay as they are, the costly ones first") {
  plane_drawing drawing; // with two corners cut off
  drawing.polygons = {{{{0, 0}, {1, 0}, {1, 0.99}, {0.99, 1}, {0.001, 1}, {0, 0.999}}, "square"}};
  const any_geometry model = plane_domain(drawing);
  const any_sizing given = uniform_size(0.1);
  const double wide = 0.01 * std::sqrt(2.0), narrow = 0.001 * std::sqrt(2.0);
  for (const int dimension : {2, 3}) {
    const double cheap = sizing::elements_of_growth(wide, 0.1, 0.4, dimension);
    const double both = cheap + sizing::elements_of_growth(narrow, 0.1, 0.4, dimension);
    const auto fit = [&](double most) {
      return details_to_fit(model, given, {.most_elements = most, .dimension = dimension});
    };
    const auto size_at = [&](const detail_fit& of, vec3 p) { return finer_at(given, of.places, 0.4)(p); };
    const detail_fit all = fit(both * 1.01);
    CHECK(size_at(all, {1, 1, 0}) < 0.02);
    CHECK(size_at(all, {0, 1, 0}) < 0.002);
    CHECK(all.fitted == 2);
    CHECK(all.left == 0);
    CHECK(all.elements == doctest::Approx(both));
    const detail_fit one = fit(both * 0.99);
    CHECK(size_at(one, {1, 1, 0}) < 0.02);
    CHECK(size_at(one, {0, 1, 0}) == 0.1);
    CHECK(one.fitted == 1);
    CHECK(one.left == 1);
    CHECK(one.elements == doctest::Approx(cheap));
    CHECK(one.elements_of_all == doctest::Approx(both));
    const detail_fit none = fit(cheap * 0.99);
    CHECK(size_at(none, {1, 1, 0}) == 0.1);
    CHECK(none.fitted == 0);
    CHECK(none.left == 2);
    CHECK(none.elements == 0);
  }
}

TEST_CASE("the elements that growing sizes add are an integral") {
  // By the trapezoidal rule.
  CHECK(sizing::elements_of_growth(1, 4, 0.4) == doctest::Approx(179).epsilon(0.01));
  CHECK(sizing::elements_of_growth(1, 100, 0.4) == doctest::Approx(2334).epsilon(0.01));
  for (const double to : {4.0, 100.0}) {
    constexpr int steps = 100000;
    const double growth = 0.4, reach = (to - 1) / growth;
    double sum = 0;
    for (int k = 0; k < steps; ++k) {
      const double r = reach * (k + 0.5) / steps, size = 1 + growth * r;
      sum += r * (1 / (size * size) - 1 / (to * to)) * reach / steps;
    }
    CHECK(sizing::elements_of_growth(1, to, growth, 2) ==
          doctest::Approx(4 / std::sqrt(3.0) * 2 * 3.14159265 * sum).epsilon(0.001));
    double in_plane = 0, in_space = 0; // beside a line, per length
    for (int k = 0; k < steps; ++k) {
      const double r = reach * (k + 0.5) / steps, size = 1 + growth * r;
      in_plane += (1 / (size * size) - 1 / (to * to)) * reach / steps;
      in_space += r * (1 / std::pow(size, 3) - 1 / std::pow(to, 3)) * reach / steps;
    }
    CHECK(sizing::elements_of_growth_along(1, to, growth, 2) ==
          doctest::Approx(2 * 4 / std::sqrt(3.0) * in_plane).epsilon(0.001));
    CHECK(sizing::elements_of_growth_along(1, to, growth) ==
          doctest::Approx(3.14159265 * 6 * std::sqrt(2.0) * in_space).epsilon(0.001));
  }
}

TEST_CASE("no size becomes smaller than is allowed, however short an edge is") {
  const any_geometry model = square_with_chamfer(1e-7);
  const any_sizing given = uniform_size(0.1);
  CHECK(finer_at_details(model, given)({1, 1, 0}) == doctest::Approx(1e-4).epsilon(0.01));
  const any_sizing fitted = finer_at_details(model, given, {.least_size = 0.01});
  CHECK(fitted({1, 1, 0}) == doctest::Approx(0.01).epsilon(0.01));
  CHECK(finer_at_details(model, given, {.least_size = 0.1})({1, 1, 0}) == 0.1);
  CHECK(generate<2>(model, fitted, parameters<>{}).failures.empty());
}

TEST_CASE("triangles beside a short edge have good angles when sizes fit it") {
  const any_geometry model = square_with_chamfer(0.002);
  const auto least_angle = [&](const any_sizing& size) {
    const auto result = generate<2>(model, size, parameters<>{});
    REQUIRE(result.failures.empty());
    return result.quality.min_dihedral_deg;
  };
  CHECK(least_angle(uniform_size(0.1)) < 8);
  CHECK(least_angle(finer_at_details(model, uniform_size(0.1))) > 20);
}

TEST_CASE("options and sizes out of range are refused") {
  const any_geometry model = square_with_slit(0.01);
  for (const double bad : {-1.0, std::nan("")}) {
    CHECK_THROWS_AS(finer_at_details(model, uniform_size(0.1), {.share_of_size = bad}), sizing_error);
    CHECK_THROWS_AS(finer_at_details(model, uniform_size(0.1), {.growth = bad}), sizing_error);
  }
  CHECK_THROWS_AS(finer_at_details(model, uniform_size(0.1), {.growth = 0}), sizing_error);
  CHECK_THROWS_AS(finer_at_details(model, uniform_size(0.1), {.share_of_size = 1.5}), sizing_error);
  CHECK_THROWS_AS(finer_at_details(model, uniform_size(0.1), {.most_elements = std::nan("")}), sizing_error);
  CHECK_THROWS_AS(finer_at_details(model, uniform_size(0.1), {.dimension = 1}), sizing_error);
  for (const double bad : {-1.0, 0.0, std::nan("")})
    CHECK_THROWS_AS(finer_at_details(model, [bad](vec3) { return bad; }), sizing_error);
}
