#include "dovetail/sizing/facing_search.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

using namespace dovetail;
using sizing::surface_sample;

namespace {

constexpr double no_height = std::numeric_limits<double>::infinity();

/// Three solids with four faces each; the last of each is shared with the next one, or inside of it.
geometry_topology three_solids() {
  geometry_topology topology;
  topology.solids.resize(3);
  for (local_id s = 0; s < 3; ++s)
    for (int k = 0; k < 4; ++k) {
      auto& face = topology.faces.emplace_back();
      face.solids = {s, k < 3 ? no_id : s == 2 ? s : s + 1};
    }
  return topology;
}

/// Where and how a sample is seen from another one.
struct sight {
  double height, offset;
};
sight sight_of(const surface_sample& s, const surface_sample& from, vec3 direction) {
  const vec3 away = s.point - from.point;
  const double height = dot(away, direction);
  return {height, norm(away - height * direction)};
}

/// The height of the lowest sample that faces one through what is on its side, by looking at all.
double lowest(const std::vector<surface_sample>& samples, const geometry_topology& topology,
              const surface_sample& from, std::size_t side, double reach, double slack) {
  const vec3 direction = side == 0 ? -from.normal : from.normal;
  const local_id solid = topology.faces[from.face].solids[side];
  double best = no_height;
  for (const surface_sample& s : samples) {
    const auto& solids = topology.faces[s.face].solids;
    const double turned = dot(s.normal, direction);
    const bool faces = (solids[0] == solid && turned >= 0.8) || (solids[1] == solid && turned <= -0.8);
    const auto [height, offset] = sight_of(s, from, direction);
    if (faces && height > 0 && height < reach && offset <= std::max(0.5 * height, slack))
      best = std::min(best, height);
  }
  return best;
}

} // namespace

TEST_CASE("the lowest facing sample is found, as by looking at all") {
  const geometry_topology topology = three_solids();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0, 1), turn(-1, 1);
  std::vector<surface_sample> samples(1500);
  for (surface_sample& s : samples) {
    s.point = {place(random), place(random), place(random)};
    s.normal = normalized(vec3{turn(random), turn(random), turn(random)});
    s.face = static_cast<local_id>(random() % topology.faces.size());
  }
  const sizing::facing_search search(samples, topology);
  REQUIRE(search.samples().size() == samples.size());
  std::size_t found = 0;
  for (const surface_sample& from : search.samples())
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}})
      for (const double slack : {0.0, 0.1}) {
        const surface_sample* facing = search.find(from, side, 0.4, slack);
        const double wanted = lowest(samples, topology, from, side, 0.4, slack);
        REQUIRE((facing != nullptr) == (wanted < no_height));
        if (!facing)
          continue;
        ++found;
        const vec3 direction = side == 0 ? -from.normal : from.normal;
        CHECK(sight_of(*facing, from, direction).height == doctest::Approx(wanted).epsilon(1e-8));
      }
  CHECK(found > samples.size());
}

TEST_CASE("of samples on one plane the one most nearly above is found") {
  geometry_topology slab;
  slab.solids.resize(1);
  slab.faces.resize(2);
  for (auto& face : slab.faces)
    face.solids = {0, no_id};
  std::vector<surface_sample> samples;
  for (int f = 0; f < 2; ++f)
    for (int i = 0; i < 40; ++i)
      for (int j = 0; j < 40; ++j) {
        surface_sample s;
        s.point = {0.1 * i, 0.1 * j, 1.0 * f};
        s.normal = {0, 0, f == 0 ? -1.0 : 1.0};
        s.face = f;
        samples.push_back(s);
      }
  const sizing::facing_search search(samples, slab);
  for (const surface_sample& from : search.samples()) {
    const surface_sample* facing = search.find(from, 0, 2, 0);
    REQUIRE(facing);
    CHECK(facing->face != from.face);
    CHECK(sight_of(*facing, from, -from.normal).offset < 1e-9);
    CHECK(search.find(from, 1, 2, 0) == nullptr); // there is nothing in front
  }
}
