/// @file
/// Operations of one's own beside the native improver's.
#include "dovetail/improver/native_by.hpp"
#include "improver_checks.hpp"
#include "support/jittered_meshes.hpp"

#include <doctest/doctest.h>

#include <array>

using namespace dovetail;
using namespace dovetail::improvement;

namespace {

/// Moves a vertex to the mean of its neighbours when that is better.
template <shape_measure Measure>
class centering {
public:
  static constexpr std::array names{"centering"};
  static constexpr turn when = turn::always;

  bool mend(tet_complex& mesh, local_id e, const operation_limits<3>& limits, const recorded_tries& tries) {
    for (const local_id v : mesh.vertices(e))
      if (mesh.is_free(v) && tries([&] { return improve(mesh, v, limits.band); }))
        return true;
    return false;
  }

private:
  bool improve(tet_complex& mesh, local_id v, const size_band& band) {
    if (!star_.start(mesh, v))
      return false;
    vec3 sum{};
    for (const local_id e : star_.elements())
      for (const vec3 corner : star_.opposite_side(mesh, e))
        sum += corner;
    return star_.move(mesh, sum / (3.0 * star_.elements().size), {.worst = star_.worst(mesh)}, band);
  }
  star_move<Measure> star_;
};

/// Relaxes the vertices of a triangle; made from the mesh.
class relaxing {
public:
  static constexpr std::array names{"relaxing"};
  static constexpr turn when = turn::hard;

  explicit relaxing(surface_complex& mesh) : smooth_(mesh) {}
  bool mend(surface_complex& mesh, local_id t, const operation_limits<2>&, const recorded_tries& tries) {
    for (local_id c = 3 * t; c < 3 * t + 3; ++c)
      if (const local_id v = mesh.table.vertex[c]; mesh.inner(v) && tries([&] { return smooth_.relax(v); }))
        return true;
    return false;
  }

private:
  dovetail::detail::smoother<surface_complex> smooth_;
};

/// Both of them alone.
struct own_operations {
  template <shape_measure Measure>
  using on_tetrahedra = operation_list<3, centering<Measure>>;
  using on_triangles = operation_list<2, relaxing>;
};
/// The native ones and both.
struct more_operations {
  template <shape_measure Measure>
  using on_tetrahedra = typename native_operations::on_tetrahedra<Measure>::template with<centering<Measure>>;
  using on_triangles = native_operations::on_triangles::with<relaxing>;
};
static_assert(improver<native_by<own_operations>, 3> && improver<native_by<own_operations>, 2>);

} // namespace

TEST_CASE("operations of one's own are all that is tried when the list has no others") {
  auto mesh = dovetail_test::jittered_cubes(6, 0.25, 3);
  const double before_3 = measure_quality(mesh).min_dihedral_deg;
  const report told = native_by<own_operations>{}(mesh);
  CHECK(told.get("centering tried") > 0);
  CHECK(told.get("centering accepted") > 0);
  CHECK(told.get("edge removal tried", -1) == -1);
  CHECK(measure_quality(mesh).min_dihedral_deg > before_3);
  CHECK(check_validity(mesh).valid());

  auto triangles = dovetail_test::jittered_squares(20, 0.3, 1, 0);
  const double before_2 = measure_quality(triangles).min_dihedral_deg;
  native preset;
  preset.search_iterations = -2; // nothing is relaxed before the sweeps
  const report of_triangles = native_by<own_operations>{preset}(triangles);
  CHECK(of_triangles.get("relaxing accepted") > 0);
  CHECK(measure_quality(triangles).min_dihedral_deg >= before_2);
}

TEST_CASE("operations of one's own are tried after the native ones") {
  auto mesh = dovetail_test::jittered_cubes(6, 0.25, 3);
  const report told = native_by<more_operations>{}(mesh);
  CHECK(told.get("edge removal accepted") > 0);
  CHECK(told.get("centering tried") > 0);
  CHECK(check_validity(mesh).valid());
  auto triangles = dovetail_test::jittered_squares(20, 0.3, 1, 0);
  const report of_triangles = native_by<more_operations>{}(triangles);
  CHECK(of_triangles.get("edge removal accepted") > 0);
  CHECK(of_triangles.get("relaxing tried") < of_triangles.get("smoothing tried"));
}

TEST_CASE("the native improver's meshes are those of its list") {
  auto one = dovetail_test::jittered_cubes(5, 0.25, 7), other = one;
  native::fast()(one);
  native_by<native_operations>{native::fast()}(other);
  CHECK(one.points == other.points);
  CHECK(one.elements == other.elements);
}
