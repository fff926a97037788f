/// Why triangles have small angles.
#include "dovetail/core/encoding.hpp"
#include "dovetail/mesh/poor_triangles.hpp"
#include "dovetail/mesh/quality.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

using namespace dovetail;

namespace {

/// A piece, all of whose points that are in the skeleton come first, and sides with the curves that they are
/// on.
struct drawn_piece {
  simplicial_piece<2> piece;
  simplicial_skeleton<2> skeleton;

  /// The points on the boundary, those inside, and triangles of them.
  drawn_piece(const std::vector<vec3>& boundary, const std::vector<vec3>& inside,
              std::vector<simplex<2>> triangles) {
    piece.subdomain = 0;
    skeleton.points = std::vector<vec3>(boundary);
    // The skeleton has them in another order.
    std::reverse(skeleton.points.own().begin(), skeleton.points.own().end());
    for (std::size_t v = 0; v < boundary.size(); ++v) {
      piece.skeleton_points.push_back(in_skeleton(static_cast<local_id>(v), boundary.size()));
      skeleton.point_hosts.own().push_back({2, 0});
    }
    piece.mesh.points = boundary;
    piece.mesh.points.insert(piece.mesh.points.end(), inside.begin(), inside.end());
    piece.mesh.elements = std::move(triangles);
    piece.mesh.tags.assign(piece.mesh.elements.size(), 0);
  }

  /// A side on a curve, or with `no_id` between two subdomains.
  void add_side(local_id a, local_id b, local_id curve) {
    const std::size_t count = piece.skeleton_points.size();
    const simplex<1> side{in_skeleton(a, count), in_skeleton(b, count)};
    skeleton.sides.own().push_back(side);
    skeleton.side_hosts.own().push_back(curve);
    skeleton.subdomains.own().push_back({0, curve == no_id ? 1 : no_id});
    if (curve != no_id)
      for (const local_id v : side)
        skeleton.point_hosts.own()[v] = {1, curve};
  }

  /// Curves may end there.
  void set_model_vertex(local_id v) {
    skeleton.point_hosts.own()[in_skeleton(v, piece.skeleton_points.size())] = {0, v};
  }

  poor_elements poor() const {
    std::vector<local_id> listed(skeleton.sides.size());
    std::iota(listed.begin(), listed.end(), local_id{0});
    const auto found = find_poor_elements(piece, skeleton, listed);
    const auto sum = [](const auto& counts) {
      return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
    };
    const auto quality = measure_quality(piece.mesh);
    CHECK(sum(found.low) == quality.min_dihedrals.below(low_corner_deg));
    CHECK(sum(found.bad) == quality.min_dihedrals.below(bad_corner_deg));
    return found;
  }

private:
  static local_id in_skeleton(local_id v, std::size_t count) { return static_cast<local_id>(count) - 1 - v; }
};

/// That all are of one cause.
void check_cause(const poor_elements& poor, poor_cause cause, std::int64_t bad, std::int64_t low) {
  CHECK(poor.bad_by(cause) == bad);
  CHECK(poor.low_by(cause) == low);
  CHECK(std::accumulate(poor.bad.begin(), poor.bad.end(), std::int64_t{0}) == bad);
  CHECK(std::accumulate(poor.low.begin(), poor.low.end(), std::int64_t{0}) == low);
}

/// A triangle with a corner of 10 degrees at the origin, halved or not.
drawn_piece sharp(bool halved, double degrees = 10) {
  const double height = std::tan(degrees / 57.29577951308232);
  if (!halved)
    return {{{0, 0, 0}, {1, 0, 0}, {1, height, 0}}, {}, {{0, 1, 2}}};
  return {{{0, 0, 0}, {1, 0, 0}, {1, height / 2, 0}, {1, height, 0}}, {}, {{0, 1, 2}, {0, 2, 3}}};
}

} // namespace

TEST_CASE("a triangle in a corner between two curves is the model's, between other lines the interface's") {
  drawn_piece given = sharp(false);
  CHECK(given.poor().bad_by(poor_cause::thin_piece) == 1); // nothing is known of its sides
  given.add_side(0, 1, 3);
  given.add_side(2, 0, 4);
  check_cause(given.poor(), poor_cause::model_angle, 1, 1);
  CHECK(given.poor().thinnest_wall == std::numeric_limits<double>::infinity());

  drawn_piece between = sharp(false);
  between.add_side(0, 1, 3);
  between.add_side(2, 0, no_id);
  check_cause(between.poor(), poor_cause::interface_angle, 1, 1);

  CHECK(sharp(false, 31).poor().low == poor_elements{}.low);
}

TEST_CASE("so are all triangles of a corner that is divided, if it is under twice the limit") {
  drawn_piece given = sharp(true, 28);
  given.add_side(0, 1, 3);
  given.add_side(3, 0, 4);
  check_cause(given.poor(), poor_cause::model_angle, 2, 2);

  drawn_piece wide = sharp(true, 40); // twice 20 degrees: low, and under 60
  wide.add_side(0, 1, 3);
  wide.add_side(3, 0, 4);
  check_cause(wide.poor(), poor_cause::model_angle, 0, 2);

  drawn_piece cut = sharp(true, 28); // an interface halves it
  cut.add_side(0, 1, 3);
  cut.add_side(0, 2, no_id);
  cut.add_side(3, 0, 4);
  check_cause(cut.poor(), poor_cause::interface_angle, 2, 2);
}

TEST_CASE("sides of another face at the same vertex do not divide a corner") {
  drawn_piece given = sharp(false, 20);
  given.add_side(0, 1, 3);
  given.add_side(2, 0, 4);
  check_cause(given.poor(), poor_cause::model_angle, 0, 1);
  drawn_piece folded({{0, 0, 0}, {1, 0, 0}, {1, 0.36, 0}, {1, 0.18, 1}, {0.3, 1, 1}}, {},
                     {{0, 1, 2}, {0, 3, 4}});
  folded.piece.mesh.tags = {0, 1};
  folded.add_side(0, 1, 3);
  folded.add_side(2, 0, 4);
  folded.add_side(0, 3, no_id); // above the middle of the first triangle
  folded.add_side(0, 4, no_id);
  check_cause(folded.poor(), poor_cause::model_angle, 0, 1);
}

TEST_CASE("where all vertices are on curves the face is narrow; one inside is the mesher's") {
  // A strip of width 0.1 between two curves, one long triangle each way.
  drawn_piece strip({{0, 0, 0}, {1, 0, 0}, {1, 0.1, 0}, {0, 0.1, 0}}, {}, {{0, 1, 2}, {0, 2, 3}});
  for (local_id v = 0; v < 4; ++v)
    strip.add_side(v, (v + 1) % 4, v);
  const auto narrow = strip.poor();
  check_cause(narrow, poor_cause::thin_wall, 2, 2);
  CHECK(narrow.thinnest_wall == doctest::Approx(0.1 / std::sqrt(1.01)));
  CHECK(name_of_triangles(poor_cause::thin_wall) == "narrow face");
  CHECK(name_of_triangles(poor_cause::inside) == "inside");

  // The same where three sides are an interface's.
  drawn_piece piece({{0, 0, 0}, {1, 0, 0}, {1, 0.1, 0}, {0, 0.1, 0}}, {}, {{0, 1, 2}, {0, 2, 3}});
  piece.add_side(0, 1, 0);
  for (local_id v = 1; v < 4; ++v)
    piece.add_side(v, (v + 1) % 4, no_id);
  check_cause(piece.poor(), poor_cause::thin_piece, 2, 2);

  // A flat triangle on a curve, whose third vertex is joined to two or three others that are on none.
  const std::vector<vec3> inner{{0.5, 0.05, 0}, {0, 0.6, 0}, {1, 0.6, 0}, {0.5, 1, 0}};
  const std::vector<simplex<2>> around{{0, 1, 2}, {0, 2, 3}, {1, 4, 2}};
  drawn_piece flat({{0, 0, 0}, {1, 0, 0}}, inner, around);
  flat.add_side(0, 1, 0);
  CHECK(flat.poor().bad_by(poor_cause::thin_wall) == 1);
  auto more = around;
  more.push_back({2, 4, 5});
  drawn_piece wide({{0, 0, 0}, {1, 0, 0}}, inner, more);
  wide.add_side(0, 1, 0);
  CHECK(wide.poor().bad_by(poor_cause::thin_wall) == 0);
  CHECK(wide.poor().bad_by(poor_cause::inside) == 1);
}

namespace {

/// Between a line at the bottom and one that leaves it at x = 0, or begins above it there, up to x = 3, with
/// or without an inner vertex in the last quadrangle.
drawn_piece between_lines(double at_start, double at_end, bool with_inner) {
  const auto above = [&](double x) { return vec3{x, at_start + (at_end - at_start) * x / 3, 0}; };
  const bool meet = at_start == 0;
  std::vector<vec3> boundary{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, above(1), above(2), above(3)};
  std::vector<simplex<2>> triangles{{0, 1, 4}, {1, 2, 4}, {2, 5, 4}};
  if (!meet) {
    boundary.push_back(above(0)); // 7
    triangles.push_back({0, 4, 7});
  }
  const auto inner = static_cast<local_id>(boundary.size());
  if (with_inner)
    triangles.insert(triangles.end(), {{2, 3, inner}, {3, 6, inner}, {6, 5, inner}, {5, 2, inner}});
  else
    triangles.insert(triangles.end(), {{2, 3, 5}, {3, 6, 5}});
  drawn_piece made(boundary,
                   with_inner ? std::vector<vec3>{0.5 * (boundary[2] + boundary[6])} : std::vector<vec3>{},
                   std::move(triangles));
  for (const local_id v : {0, 1, 2})
    made.add_side(v, v + 1, 3);
  made.add_side(4, 5, 4);
  made.add_side(5, 6, 4);
  made.add_side(meet ? 0 : 7, 4, 4);
  made.add_side(3, 6, 5);
  if (!meet)
    made.add_side(0, 7, 6);
  for (const local_id v : {0, 3, 6, 7})
    if (v < static_cast<local_id>(boundary.size()))
      made.set_model_vertex(v);
  return made;
}

} // namespace

TEST_CASE("where two curves run into each other triangles between them are the model's, far away too") {
  const auto meeting = between_lines(0, 0.1, false).poor();
  CHECK(meeting.low_by(poor_cause::model_angle) == 5);
  CHECK(meeting.low_by(poor_cause::thin_wall) == 0);
  const auto with_inner = between_lines(0, 0.1, true).poor();
  CHECK(with_inner.low_by(poor_cause::model_angle) == 7);

  const auto apart = between_lines(0.05, 0.1, false).poor();
  CHECK(apart.low_by(poor_cause::model_angle) == 0);
  CHECK(apart.low_by(poor_cause::thin_wall) == 6);
}

TEST_CASE("causes of pieces add up, and survive as bytes") {
  drawn_piece given = sharp(false);
  given.add_side(0, 1, 3);
  given.add_side(2, 0, 4);
  auto sum = given.poor();
  sum.merge(sharp(false).poor());
  CHECK(sum.bad_by(poor_cause::model_angle) == 1);
  CHECK(sum.bad_by(poor_cause::thin_piece) == 1);
  CHECK(encoded(decoded<poor_elements>(encoded(sum))) == encoded(sum));
}
