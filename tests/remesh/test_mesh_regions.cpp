#include "dovetail/core/error.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/remesh/any_surface_mesher.hpp"
#include "dovetail/remesh/chords.hpp"
#include "dovetail/remesh/mesh_regions.hpp"
#include "mesher/surface_mesher_contract.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>

using namespace dovetail;

namespace {

const any_sizing coarse = [](vec3) { return 10.0; };

/// Regions in a list, and the set made of them.
struct listed_regions {
  std::vector<surface_region> regions;
  std::vector<std::vector<vec3>> surface_points; ///< per region, or empty

  region_set<any_geometry> set() const {
    region_set<any_geometry> made;
    made.count = regions.size();
    made.build = [listed = regions](const any_geometry&, std::size_t r) { return listed[r]; };
    made.surface_of = [](const any_geometry&, std::size_t) { return contract::plane_at_run_time(); };
    if (!surface_points.empty())
      made.surface_points = [listed = surface_points](std::size_t r) { return listed[r]; };
    return made;
  }
};

/// Two quadrangles on one loop of four points, as the two sheets of a cushion: each needs a diagonal.
listed_regions cushion() {
  listed_regions both;
  surface_region sheet;
  contract::add_loop(sheet.boundary, remesh::plane_surface{}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1);
  both.regions = {sheet, sheet};
  both.regions[1].reversed = true;
  return both;
}

/// Triangulates a quadrangle and knows nothing of forbidden edges.
struct careless {
  patch_mesh operator()(const any_surface&, const patch_boundary&, const any_sizing&) const {
    patch_mesh made;
    made.triangles = {{0, 1, 2}, {0, 2, 3}};
    return made;
  }
};

/// Says that it may not run in threads.
struct alone : careless {
  static constexpr bool thread_safe = false;
};

/// Any model: these regions have surfaces of their own.
const any_geometry model(plane_domain({{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}}, {}}));

/// A set after `mesh_regions`.
struct meshed_set {
  listed_regions list;
  region_set<any_geometry> set;
  meshed_regions result;
  std::vector<patch_mesh> meshes;

  meshed_set(listed_regions given, const any_surface_mesher& mesher, const any_executor& run, int chords,
             region_memo& store)
      : list(std::move(given)), set(list.set()),
        result(mesh_regions(model, set, mesher, coarse, run, store, {.attempts = {.chords = chords}})),
        meshes(set.count) {
    result.for_each(store, [&](std::size_t r, patch_mesh mesh) { meshes[r] = std::move(mesh); });
  }

  /// Per edge that joins two labels inside regions: which regions.
  std::map<std::array<local_id, 2>, std::set<std::size_t>> regions_at_chords() const {
    std::map<std::array<local_id, 2>, std::set<std::size_t>> regions;
    for (std::size_t r = 0; r < meshes.size(); ++r)
      chord_finder(list.regions[r].boundary)
          .for_each(meshes[r].triangles, [&](std::size_t, const auto& chord) { regions[chord].insert(r); });
    return regions;
  }
};

meshed_set mesh_all(listed_regions set, const any_surface_mesher& mesher = {},
                    const any_executor& run = parallel::serial{}, int chords = 6) {
  region_memo store;
  return {std::move(set), mesher, run, chords, store};
}

} // namespace

TEST_CASE("no two regions have the same chord, whether the mesher can avoid it or not") {
  for (const any_surface_mesher& mesher : {any_surface_mesher(), any_surface_mesher(careless{})}) {
    const auto faulty = mesh_all(cushion(), mesher, parallel::serial{}, 0);
    CHECK(faulty.regions_at_chords().begin()->second.size() == 2);

    const auto made = mesh_all(cushion(), mesher);
    CHECK(made.result.failures.empty());
    for (const auto& [chord, regions] : made.regions_at_chords())
      CHECK(regions.size() == 1);
    CHECK(made.meshes[0].triangles.size() == 2); // the first keeps its own
    CHECK(made.meshes[1].triangles.size() > 2);
    CHECK(made.set.forbidden_edges.at(1).size() == 1);
    for (const patch_mesh& mesh : made.meshes)
      CHECK(mesh.ok());
  }
}

TEST_CASE("a chord where another region has a line is forbidden to all") {
  listed_regions set = cushion();
  surface_region& fin = set.regions.emplace_back(); // a triangle with a side across the first two
  contract::add_loop(fin.boundary, remesh::plane_surface{}, {{0, 0}, {1, 0}, {1, 1}}, 2);
  const auto made = mesh_all(std::move(set), careless{});
  CHECK(made.regions_at_chords().empty());
  CHECK(made.meshes[0].triangles.size() == 4);
}

TEST_CASE("an edge that joins two boundary points a second time within a region is split") {
  // A strip around a cylinder, its seam passed twice: four triangles, two of them beside both copies.
  surface_region strip;
  const test::cylinder cylinder{1};
  patch_boundary& b = strip.boundary;
  b.uv = {{0, 0}, {3, 0}, {6, 0}, {6, 1}, {3, 1}, {0, 1}};
  b.labels = {0, 1, 0, 2, 3, 2};
  for (const vec2 uv : b.uv)
    b.points.push_back(cylinder.frame(uv).point);
  for (local_id v = 0; v < 6; ++v)
    b.segments.push_back({v, (v + 1) % 6});
  const auto across = [](const any_surface&, const patch_boundary&, const any_sizing&) {
    patch_mesh made;
    made.triangles = {{0, 1, 5}, {1, 2, 5}, {2, 3, 5}, {3, 4, 5}}; // 2-5 joins the seam's ends, 3-5 one end
    return made;
  };
  const patch_mesh made =
      mesh_region(any_surface_mesher(across), any_surface::view_of(cylinder), strip, coarse, {});
  CHECK(made.inner_uv.size() == 2);
  CHECK(made.triangles.size() == 8);
  for (const vec3 p : made.inner_points)
    CHECK(std::hypot(p.x, p.y) == doctest::Approx(1));
}

TEST_CASE("an edge that the mesher says it had to repeat is split") {
  const surface_region region = cushion().regions[0];
  const auto honest = [](const any_surface& s, const patch_boundary& b, const any_sizing& size) {
    patch_mesh made = careless{}(s, b, size);
    chord_finder(b).for_each(made.triangles,
                             [&](std::size_t, const simplex<1>& chord) { made.repeated_edges = {chord}; });
    return made;
  };
  const patch_mesh made =
      mesh_region(any_surface_mesher(honest), contract::plane_at_run_time(), region, coarse, {});
  CHECK(made.repeated_edges.empty());
  CHECK(made.triangles.size() == 4);
}

TEST_CASE("folds: smaller sizes inside, and of the attempts the one with the fewest") {
  struct folding {
    std::shared_ptr<std::vector<double>> sizes = std::make_shared<std::vector<double>>();
    patch_mesh operator()(const any_surface& s, const patch_boundary& b, const any_sizing& size) const {
      patch_mesh made = careless{}(s, b, size);
      sizes->push_back(size({}));
      made.folded.assign(sizes->size() == 3 ? 1 : 2, 0); // the third attempt is the best
      return made;
    }
  };
  const surface_region region = cushion().regions[0];
  const folding mesher;
  const auto best = mesh_region(mesher, contract::plane_at_run_time(), region, coarse, {.folds = 4});
  CHECK(best.folded.size() == 1);
  CHECK(*mesher.sizes ==
        std::vector<double>{10, 0.8 * 10, 0.8 * 0.8 * 10, 0.8 * 0.8 * 0.8 * 10, 0.8 * 0.8 * 0.8 * 0.8 * 10});

  surface_region smaller = region;
  smaller.size_factor = 0.5;
  const folding other;
  mesh_region(other, contract::plane_at_run_time(), smaller, coarse, {.folds = 0});
  CHECK(*other.sizes == std::vector<double>{5});
}

TEST_CASE("a mesher that cuts its boundary fails, and the other regions do not") {
  const auto cutting = [](const any_surface&, const patch_boundary& b, const any_sizing&) {
    patch_mesh made;
    if (b.segments.size() == 4) { // the sides are kept, but for the first, which gets a point
      made.inner_uv = {{0.5, 0}};
      made.inner_points = {{0.5, 0, 0}};
      made.triangles = {{0, 4, 3}, {4, 1, 2}, {4, 2, 3}};
    } else {
      made.triangles = {{0, 1, 2}};
    }
    return made;
  };
  listed_regions set = cushion();
  set.regions[1].boundary = {};
  contract::add_loop(set.regions[1].boundary, remesh::plane_surface{}, {{0, 0}, {1, 0}, {1, 1}}, 2);
  for (const any_executor& run : {any_executor(parallel::serial{}), any_executor(parallel::processes{1})}) {
    const auto made = mesh_all(set, any_surface_mesher(cutting), run);
    REQUIRE(made.result.failures.size() == 1);
    CHECK(made.result.failures.at(0) == "the surface mesher: 1 of 4 boundary edges are lost");
    CHECK(made.meshes[1].triangles.size() == 1);
  }
  const auto leaving_a_hole = [](const any_surface&, const patch_boundary&, const any_sizing&) {
    patch_mesh made;
    made.inner_uv = {{0.2, 0.5}, {0.8, 0.5}, {0.5, 0.8}};
    made.inner_points = {{0.2, 0.5, 0}, {0.8, 0.5, 0}, {0.5, 0.8, 0}};
    made.triangles = {{0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 6, 5}, {2, 3, 6}, {3, 4, 6}, {3, 0, 4}};
    return made;
  };
  CHECK_THROWS_WITH_AS(mesh_region(any_surface_mesher(leaving_a_hole), contract::plane_at_run_time(),
                                   cushion().regions[0], coarse, {}),
                       "the surface mesher: its triangles leave a hole or lie upon each other", mesher_error);
  for (const local_id invented : {7, -1}) {
    const auto inventing = [invented](const any_surface&, const patch_boundary&, const any_sizing&) {
      patch_mesh made;
      made.triangles = {{0, 1, invented}};
      return made;
    };
    CHECK_THROWS_WITH_AS(mesh_region(any_surface_mesher(inventing), contract::plane_at_run_time(),
                                     cushion().regions[0], coarse, {}),
                         "the surface mesher: its triangles name points that do not exist", mesher_error);
  }
}

TEST_CASE("a mesh is made once for the same region, and again for another") {
  region_memo store;
  const auto made_with = [&](listed_regions set) {
    const std::size_t before = store.meshes.made();
    meshed_set(std::move(set), any_surface_mesher(), parallel::serial{}, 0, store);
    return store.meshes.made() - before;
  };
  listed_regions set = cushion(); // two alike
  CHECK(made_with(set) == 2);
  CHECK(made_with(set) == 0);
  for (local_id& label : set.regions[0].boundary.labels)
    label += 7; // the numbers of labels do not count
  CHECK(made_with(set) == 0);
  const auto changed = [&](const auto& change) {
    listed_regions other = cushion();
    change(other.regions[0]);
    return made_with(other);
  };
  CHECK(changed([](surface_region& r) { r.boundary.points[2].z = 1; }) == 1);
  CHECK(changed([](surface_region& r) { r.boundary.uv[2].x = 1.5; }) == 1);
  CHECK(changed([](surface_region& r) { r.size_factor = 0.5; }) == 1);
  CHECK(changed([](surface_region& r) { r.face = 3; }) == 1);
  CHECK(changed([](surface_region& r) { r.boundary.forbidden_edges = {{0, 2}}; }) == 1);
  CHECK(changed([](surface_region& r) { r.boundary.labels[3] = r.boundary.labels[2]; }) == 1);
  set.surface_points = {{{1, 0, 0}}, {}};
  CHECK(made_with(set) == 1); // the second one is on a face, as before
}

TEST_CASE("a mesh whose surface is known by points is found by the outline of its region") {
  region_memo store;
  const auto made_with = [&](bool outlines, double moved) {
    listed_regions both = cushion();
    both.surface_points = {{{1, 0, 0}}, {{2, 0, 0}}};
    both.regions[1].boundary.points[2].z = moved;
    region_set<any_geometry> set = both.set();
    if (outlines)
      set.outline_of = [listed = both.regions](std::size_t r) {
        patch_boundary outline = listed[r].boundary;
        outline.uv.clear();
        return outline;
      };
    const std::size_t before = store.meshes.made();
    const auto result =
        mesh_regions(model, set, any_surface_mesher(careless{}), coarse, parallel::serial{}, store, {});
    CHECK(result.failures.empty());
    return store.meshes.made() - before;
  };
  CHECK(made_with(false, 0) == 3); // one of them again without the other one's diagonal
  CHECK(made_with(true, 0) == 0);
  CHECK(made_with(true, 0.5) == 2);
  CHECK(made_with(false, 0.5) == 0);
}

TEST_CASE("a mesh whose boundary has a name is found by that and its surface") {
  region_memo store;
  const auto made_with = [&](int name_of_second, double at, bool refined) {
    listed_regions both = cushion();
    both.surface_points = {{{1, 0, 0}}, {{at, 0, 0}}};
    region_set<any_geometry> set = both.set();
    set.outline_of = [listed = both.regions](std::size_t r) {
      patch_boundary outline = listed[r].boundary;
      outline.uv.clear();
      outline.points.clear();
      return outline;
    };
    set.boundary_name = [=](std::size_t r) {
      return std::optional(kept<patch_boundary>::of(r == 0 ? 8 : name_of_second));
    };
    refined_sizing size(coarse);
    if (refined)
      size.refine(std::vector<size_ball>{{{100, 100, 100}, 1, 1}}); // far away
    const std::size_t before = store.meshes.made();
    const auto result =
        mesh_regions(model, set, any_surface_mesher(careless{}), size, parallel::serial{}, store, {});
    CHECK(result.failures.empty());
    CHECK(result.labels.size() == 2);
    return store.meshes.made() - before;
  };
  CHECK(made_with(9, 2, false) == 3); // one of them again without the other one's diagonal
  CHECK(made_with(9, 2, false) == 0);
  CHECK(made_with(9, 2, true) == 0); // of the whole region, by the same name
  CHECK(made_with(10, 2, false) == 2);
  CHECK(made_with(10, 3, false) == 2);
}

TEST_CASE("chords are found again among meshes that were made before") {
  region_memo store;
  const auto mesh = [&](listed_regions set) {
    return meshed_set(std::move(set), any_surface_mesher(careless{}), parallel::serial{}, 6, store);
  };
  const meshed_set first = mesh(cushion());
  const std::size_t made = store.meshes.made();
  listed_regions renamed = cushion();
  for (surface_region& region : renamed.regions)
    for (local_id& label : region.boundary.labels)
      label += 7; // chords are kept by places in the boundary, not by labels
  for (const meshed_set& again : {mesh(cushion()), mesh(renamed)}) {
    CHECK(store.meshes.made() == made);
    CHECK(again.result.of_region == first.result.of_region);
    CHECK(again.set.forbidden_edges.at(1).size() == 1);
    for (const auto& [chord, regions] : again.regions_at_chords())
      CHECK(regions.size() == 1);
  }
}

TEST_CASE("threads: the same meshes; a mesher that may not run there is refused") {
  const auto one = mesh_all(cushion()), many = mesh_all(cushion(), {}, parallel::threads{2});
  for (std::size_t r = 0; r < 2; ++r)
    CHECK(one.meshes[r].triangles == many.meshes[r].triangles);
  CHECK_THROWS_AS(mesh_all(cushion(), alone{}, parallel::threads{2}), usage_error);
}

TEST_CASE("regions are joined by their labels, along the face") {
  const auto made = mesh_all(cushion(), careless{});
  std::vector<vec3> points = made.list.regions[0].boundary.points;
  double area = 0;
  for (std::size_t r = 0; r < 2; ++r)
    append_region(made.list.regions[r], made.meshes[r], points, [&](const simplex<2>& t, const auto& uv) {
      const auto at = [&](std::size_t k) { return points[t[k]]; };
      const double twice = cross(at(1) - at(0), at(2) - at(0)).z;
      CHECK((r == 0 ? twice > 0 : twice < 0)); // the second is reversed
      area += twice / 2;
      for (std::size_t k = 0; k < 3; ++k)
        CHECK(vec3{uv[k].x, uv[k].y, 0} == at(k));
    });
  CHECK(points.size() == 5);
  CHECK(area == doctest::Approx(0));
}

TEST_CASE("a region that bulges far out of its boundary is refined where it is, at its tip") {
  const auto finger = [](vec2 uv) {
    const double x = uv.x - 0.5, y = uv.y - 0.5;
    return surface_frame{{uv.x, uv.y, 40 * std::exp(-20 * (x * x + y * y))}, {1, 0, 0}, {0, 1, 0}};
  };
  const any_surface surface{finger, [](vec3 p, vec2) { return vec2{p.x, p.y}; }};
  const patch_boundary boundary = cushion().regions.front().boundary;
  refined_sizing size(coarse);
  const std::vector<size_ball> tip{{{0.5, 0.5, 40}, 0.1, 0.1}};
  size.refine(tip);
  CHECK(size.balls_near(place_of(boundary, surface)).size() == 1);
  CHECK(size.near(place_of(boundary, surface))(tip.front().center) == doctest::Approx(0.1));
  CHECK(size.balls_near(place_of(boundary, contract::plane_at_run_time())).empty());
}
