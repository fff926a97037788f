// Evaluations per second of a field of 1,000 grid sources of which at most 8 cover a point.
#include "dovetail/core/report.hpp"
#include "dovetail/sizing/compose.hpp"
#include "dovetail/sizing/sources.hpp"

#include <algorithm>
#include <cstdio>
#include <random>
#include <vector>

namespace {

using namespace dovetail;

/// Ten lattices of 5 x 5 x 4 sources, shifted against each other, so that the covers of all but eight stay
/// apart: each lattice covers a point at most once, and every point is covered by about six of them.
std::vector<grid_source> sources_of_bounded_cover(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<grid_source> sources;
  for (int lattice = 0; lattice < 10; ++lattice)
    for (int i = 0; i < 100; ++i) {
      const vec3 shift{0.1 * lattice, 0.13 * lattice, 0.07 * lattice};
      const vec3 at = shift + vec3{1.0 * (i % 5), 1.0 * (i / 5 % 5), 1.0 * (i / 25)};
      const auto near = [&] { return at + vec3{0.3 * unit(random), 0.3 * unit(random), 0.3 * unit(random)}; };
      const double outer = 0.30 + 0.05 * unit(random);
      grid_source s;
      if (i % 3 == 0)
        s = point_source(at, 0.1, 0.5, 0.01);
      else if (i % 3 == 1)
        s = line_source(at, near(), 0.05, outer, 0.01);
      else
        s = triangle_source(at, near(), near(), 0.05, outer, 0.01);
      for (double& spacing : s.spacing)
        spacing *= 0.5 + unit(random);
      sources.push_back(s);
    }
  return sources;
}

int covers(const std::vector<source_field>& each, vec3 p) {
  return static_cast<int>(
      std::count_if(each.begin(), each.end(), [&](const auto& one) { return one(p) < 1; }));
}

} // namespace

int main() {
  std::mt19937 random(1);
  const auto sources = sources_of_bounded_cover(random);
  const source_field field(1.0, sources);
  std::vector<source_field> each;
  for (const auto& s : sources)
    each.emplace_back(1.0, std::vector{s});

  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<vec3> points(200'000);
  for (vec3& p : points)
    p = {5 * unit(random), 5 * unit(random), 4 * unit(random)};
  int most = 0;
  double mean = 0;
  for (std::size_t i = 0; i < 2000; ++i) {
    const int n = covers(each, points[i]);
    most = std::max(most, n);
    mean += n / 2000.0;
  }

  const auto rate = [&](const auto& h) {
    double best = 0;
    for (int repeat = 0; repeat < 5; ++repeat) {
      double sum = 0;
      const stopwatch clock;
      for (const vec3 p : points)
        sum += h(p);
      best = std::max(best, sum > 0 ? static_cast<double>(points.size()) / clock.seconds() : 0.0);
    }
    return best;
  };
  const double direct = rate(field);
  const double erased = rate(keep_bounds(field));
  std::printf("1,000 sources, covers per point: mean %.1f, most %d\n", mean, most);
  std::printf("source_field          %6.2f million evaluations per second\n", direct / 1e6);
  std::printf("through any_sizing    %6.2f million evaluations per second\n", erased / 1e6);
  return most <= 8 && direct >= 2e6 ? 0 : 1;
}
